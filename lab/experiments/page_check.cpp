// Figures of docs/measured/check.md: detection of randomly exchanged marker labels; takes whose
// noise does not show, and clean takes; stands beside force plates.
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "check/marker_support.hpp"
#include "clean_worlds.hpp"
#include "kept_takes.hpp"
#include "kinemend/check.hpp"
#include "page.hpp"
#include "system_pairs.hpp"

namespace kinemend::papers {
namespace {

void exchanged_labels(const Arguments& arguments) {
  Table table(arguments, "page_swaps.csv", "take,pairs,to_the_frame,others,as_it_is");
  for (const char* file : {"85_02.c3d", "85_12.c3d", "05_13.c3d", "S02-Trial-Walk-1-vicon.c3d"}) {
    const auto path = find_take(arguments.data, file);
    const Take clean = path ? read_take(*path).take : test::synthetic_markers("walk");
    test::Tally tally;
    // At least two centimetres apart: the files are in millimetres, the synthetic markers in
    // centimetres.
    for (std::uint64_t seed = 1; seed <= (arguments.quick ? 2 : 10); ++seed) {
      const auto trial = test::with_random_swaps(clean, 8, path ? 20 : 2, seed);
      tally.add(trial.swaps, find_swaps(trial.clip));
    }
    table.add({std::filesystem::path(file).stem().string(), fmt::format("{}", tally.put_in),
               fmt::format("{}", tally.right), fmt::format("{}", tally.found - tally.right),
               fmt::format("{}", find_swaps(clean).size())});
    if (arguments.quick) break;
  }
  table.close();
}

// Counts takes with findings that are not faults.
struct Doubts {
  std::size_t takes = 0, expected_noise = 0, no_contact = 0, either = 0;
  std::size_t nothing = 0;  ///< neither finding, and no warning

  void add(const Take& take) {
    bool expects = false, never_stands = false, is_faulty = false;
    for (const Finding& finding : check_take(take).findings) {
      expects = expects || finding.kind == FindingKind::expected_noise;
      never_stands = never_stands || finding.kind == FindingKind::no_contact;
      is_faulty = is_faulty || finding.severity != Severity::note;
    }
    ++takes;
    expected_noise += expects ? 1 : 0;
    no_contact += never_stands ? 1 : 0;
    either += expects || never_stands ? 1 : 0;
    nothing += expects || never_stands || is_faulty ? 0 : 1;
  }
};

void doubts(const Arguments& arguments) {
  std::map<std::string, Doubts> found;
  for (const std::string& name : kept_takes(arguments)) {
    const Take take = kept_take(arguments, name);
    found["CMU"].add(take);
    for (const std::string kind : {"video", "depth", "inertial"})
      found["CMU like " + kind].add(damaged(take, "system", {{"kind", kind}}, 1));
  }
  for (const auto& [world, takes] : clean_worlds(arguments)) {
    for (const Take& take : takes)
      found[world.second == "deg" ? "worlds, joints" : "worlds, markers"].add(take);
  }
  const std::vector<SystemPair> pairs =
      arguments.quick ? std::vector<SystemPair>{} : pairs_below(arguments.data / "real2");
  for (const SystemPair& pair : pairs) {
    found[pair.source].add(read_take(pair.noisy).take);
    found[pair.source + " reference"].add(read_take(pair.reference).take);
  }
  Table table(arguments, "page_doubts.csv",
              "takes,number,expected_noise,no_contact,either,nothing");
  for (const auto& [name, those] : found) {
    table.add({quoted(name), fmt::format("{}", those.takes),
               fmt::format("{}", those.expected_noise), fmt::format("{}", those.no_contact),
               fmt::format("{}", those.either), fmt::format("{}", those.nothing)});
    fmt::print("{:20} {:4} takes: {} expected noise, {} no contact, {} either, {} nothing\n", name,
               those.takes, those.expected_noise, those.no_contact, those.either, those.nothing);
  }
  table.close();
}

// Takes of marker sets with force plates. The windows of touch-down and lift-off
// (src/feet/ground_times.cpp) are tuned on some of them; the others are of other laboratories.
struct PlateTake {
  const char* file;
  bool is_tuned_on;
};
constexpr std::array<PlateTake, 7> plate_takes{{{"PiG_Motion3_FF.c3d", true},
                                                {"PiG_Motion-FlatFoot-One.c3d", true},
                                                {"PiG_Motion-FlatFoot-Full.c3d", true},
                                                {"FunctionalWalk.c3d", true},
                                                {"ADemo1_rewrite_c3d_pc_float.c3d", false},
                                                {"c3d_sample.c3d", false},
                                                {"type-2a.c3d", false}}};

void force_plate_stands(const Arguments& arguments) {
  Table table(arguments, "page_plates.csv", "takes,number,loads,found,onset_ms,offset_ms");
  for (const bool is_tuned_on : {true, false}) {
    std::size_t takes = 0;
    std::vector<PlateStand> stands;
    for (const PlateTake& plate_take : plate_takes) {
      const auto path = find_take(arguments.data, plate_take.file);
      if (plate_take.is_tuned_on != is_tuned_on || !path) continue;
      const Take take = read_take(*path).take;
      CheckSettings settings;
      settings.plates = force_plates(take);
      const CheckReport report = check_take(take, settings);
      ++takes;
      stands.insert(stands.end(), report.plate_stands.begin(), report.plate_stands.end());
    }
    const PlateFigures figures = plate_figures(stands);
    const auto text = [](const std::optional<double>& ms) {
      return ms ? fmt::format("{:.4g}", *ms) : std::string();
    };
    table.add({is_tuned_on ? "tuned on" : "others", fmt::format("{}", takes),
               fmt::format("{}", figures.loads), fmt::format("{}", figures.found),
               text(figures.onset_ms), text(figures.offset_ms)});
  }
  table.close();
}

void page_check(const Arguments& arguments) {
  exchanged_labels(arguments);
  doubts(arguments);
}

const Registration page_check_entry("page_check", page_check);
const Registration page_plates_entry("page_plates", force_plate_stands);

}  // namespace
}  // namespace kinemend::papers
