// Feet that stand under the noise of capture systems: how much of the standing time is found and
// how much of what is found is right, how far standing feet slide before and after they are held,
// and whether anything else gets worse. On takes that neither network has learned from.
#include <algorithm>
#include <array>
#include <cmath>

#include "experiment.hpp"
#include "feet/contacts.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/methods.hpp"

namespace kinemend::papers {
namespace {

// Walks, runs, jumps, dances and others; persons 05, 07 and 131 appear in no training of contacts.
std::vector<std::string> stands_takes(const Arguments& arguments) {
  if (arguments.quick || arguments.data.empty()) return {"walk"};
  return {"07_01", "07_02", "07_03",  "07_04",  "07_06",  "07_07",  "07_08",  "07_09",
          "07_10", "07_11", "131_01", "131_03", "131_05", "131_07", "131_10", "131_13",
          "02_02", "02_05", "08_01",  "08_08",  "08_11",  "35_01",  "35_14",  "16_15",
          "16_21", "10_01", "26_01",  "09_03",  "09_06",  "16_35",  "16_45",  "16_01",
          "05_02", "05_10", "05_14",  "49_04",  "49_17",  "06_11",  "01_13",  "135_09"};
}

struct NoiseKind {
  const char* name;
  const char* damage;
  OptionValues values;
  Source source;
};

const std::vector<NoiseKind>& stands_noises() {
  static const std::vector<NoiseKind> kinds{
      {"none", "", {}, Source::unknown},
      {"white", "gaussian", {{"std_deg", 1.5}}, Source::unknown},
      {"video", "system", {{"kind", std::string("video")}}, Source::video},
      {"suit", "system", {{"kind", std::string("inertial")}}, Source::suit},
      {"depth", "system", {{"kind", std::string("depth")}}, Source::depth},
      {"triangulated", "system", {{"kind", std::string("triangulated")}}, Source::unknown}};
  return kinds;
}

// Standing time in frames of parts: of the truth, of what is found, and of both.
struct PartTime {
  double truth = 0, found = 0, both = 0;

  void add(const Take& take, const std::vector<FootContact>& right,
           const std::vector<FootContact>& says) {
    const std::size_t points = 2 * find_legs(take.skeleton).size();
    const std::vector<std::uint8_t> a = feet::contact_flags(right, take.frame_count(), points),
                                    b = feet::contact_flags(says, take.frame_count(), points);
    for (std::size_t i = 0; i < a.size(); ++i) {
      truth += a[i];
      found += b[i];
      both += a[i] & b[i];
    }
  }
  double found_share() const { return truth > 0 ? both / truth : 0; }
  double right_share() const { return found > 0 ? both / found : 0; }
};

// Errors of the legs, the feet and the root.
struct LegErrors {
  double rotations_deg = 0, legs_cm = 0, feet_cm = 0, root_cm = 0;
};

LegErrors leg_errors(const Take& truth, const Take& result, double cm) {
  LegErrors errors;
  const std::vector<double> joints = geodesic_rms_deg_per_joint(truth, result);
  const std::vector<Leg> legs = find_legs(truth.skeleton);
  double turns = 0;
  for (const Leg& leg : legs) {
    for (const std::int32_t joint : {leg.hip, leg.knee, leg.ankle})
      turns += joints[static_cast<std::size_t>(joint)] * joints[static_cast<std::size_t>(joint)];
  }
  const auto count = static_cast<double>(std::max<std::size_t>(legs.size(), 1));
  errors.rotations_deg = std::sqrt(turns / (3 * count));
  const auto frames = static_cast<double>(truth.frame_count());
  for (std::size_t f = 0; f < truth.frame_count(); ++f) {
    const Pose right = forward_kinematics(truth, f), pose = forward_kinematics(result, f);
    const auto distance = [&](std::int32_t joint) {
      const auto j = static_cast<std::size_t>(joint);
      return cm * norm(pose.positions[j] - right.positions[j]) / frames;
    };
    for (const Leg& leg : legs) {
      const double toe = distance(leg.toe >= 0 ? leg.toe : leg.ankle), ankle = distance(leg.ankle);
      errors.feet_cm += (toe + ankle) / (2 * count);
      errors.legs_cm += (toe + ankle + distance(leg.knee)) / (3 * count);
    }
    errors.root_cm += cm * norm(result.root_position(f) - truth.root_position(f)) / frames;
  }
  return errors;
}

// Sums over takes of one kind of noise.
struct StandsRow {
  double takes = 0, truth = 0, cleaned = 0, held = 0, pop_cleaned = 0, pop_held = 0;
  LegErrors before, after;
  std::size_t worse = 0;  // takes whose legs or root are farther off than before
  PartTime thresholds, model;
};

void add(LegErrors& sum, const LegErrors& one) {
  sum.rotations_deg += one.rotations_deg;
  sum.legs_cm += one.legs_cm;
  sum.feet_cm += one.feet_cm;
  sum.root_cm += one.root_cm;
}

void add_take(const Take& truth, const NoiseKind& kind, StandsRow& row) {
  const double cm = 100 * guess_length_unit(truth.skeleton)->metres;
  ContactSettings rules;
  rules.finder = ContactFinder::thresholds;
  const std::vector<FootContact> contacts = true_contacts(truth);
  Take noisy = truth;
  Random random(47);
  if (*kind.damage != 0) apply_damage(noisy, kind.damage, kind.values, random);
  CleanSettings settings;
  settings.source = kind.source;
  settings.feet = FeetSettings{};
  settings.feet->mode = FeetMode::off;
  const std::unique_ptr<Cleaner> cleaner = make_learned();
  const Take cleaned = clean_take(noisy, *cleaner, settings).take;
  settings.feet->mode = FeetMode::automatic;
  const Take held = clean_take(noisy, *cleaner, settings).take;
  ++row.takes;
  row.thresholds.add(truth, contacts, find_contacts(cleaned, rules));
  row.model.add(truth, contacts, find_contacts(cleaned));
  const FeetFigures of_truth = feet_figures(truth, contacts),
                    of_cleaned = feet_figures(cleaned, contacts),
                    of_held = feet_figures(held, contacts);
  row.truth += cm * of_truth.slide;
  row.cleaned += cm * of_cleaned.slide;
  row.held += cm * of_held.slide;
  row.pop_cleaned += of_cleaned.knee_pop_deg;
  row.pop_held += of_held.knee_pop_deg;
  const LegErrors before = leg_errors(truth, cleaned, cm), after = leg_errors(truth, held, cm);
  add(row.before, before);
  add(row.after, after);
  constexpr double rounding = 1.001;
  row.worse += after.rotations_deg > rounding * before.rotations_deg ||
                       after.legs_cm > rounding * before.legs_cm ||
                       after.root_cm > rounding * before.root_cm
                   ? 1
                   : 0;
}

void feet_stands(const Arguments& arguments) {
  fmt::print(
      "Standing time of heels and toes found, and share of it that is right, by thresholds and by\n"
      "the model; slide per frame over the true stands; errors of hips, knees and ankles, of "
      "knees,\n"
      "ankles and toes, of ankles and toes, and of the root; takes in which legs or root are "
      "worse.\n\n"
      "| noise | found, right: thresholds | model | slide cm: truth | cleaned | held | rotations "
      "deg "
      "| legs cm | feet cm | root cm | knee pop deg | worse |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  Table table(arguments, "feet_stands.csv",
              "noise,takes,found_thresholds,right_thresholds,found,right,slide_truth_cm,slide_"
              "cleaned_cm,slide_held_cm,rotations_cleaned_deg,rotations_held_deg,legs_cleaned_cm,"
              "legs_held_cm,feet_cleaned_cm,feet_held_cm,root_cleaned_cm,root_held_cm,pop_cleaned_"
              "deg,pop_held_deg,worse");
  for (const NoiseKind& kind : stands_noises()) {
    StandsRow row;
    for (const std::string& name : stands_takes(arguments)) {
      const Take whole = load_take(arguments, name + ".bvh", {.motion = "walk"}).clip;
      constexpr std::size_t most_frames = 1800;
      add_take(slice(whole, 0, std::min(whole.frame_count(), most_frames)), kind, row);
    }
    const double n = row.takes;
    fmt::print(
        "| {} | {:.2f}, {:.2f} | {:.2f}, {:.2f} | {:.3f} | {:.3f} | {:.3f} | {:.2f}, {:.2f} "
        "| {:.2f}, {:.2f} | {:.2f}, {:.2f} | {:.2f}, {:.2f} | {:.1f}, {:.1f} | {} of {} |\n",
        kind.name, row.thresholds.found_share(), row.thresholds.right_share(),
        row.model.found_share(), row.model.right_share(), row.truth / n, row.cleaned / n,
        row.held / n, row.before.rotations_deg / n, row.after.rotations_deg / n,
        row.before.legs_cm / n, row.after.legs_cm / n, row.before.feet_cm / n,
        row.after.feet_cm / n, row.before.root_cm / n, row.after.root_cm / n, row.pop_cleaned / n,
        row.pop_held / n, row.worse, n);
    std::fflush(stdout);
    std::vector<std::string> cells{kind.name, fmt::format("{}", n)};
    for (const double value :
         {row.thresholds.found_share(), row.thresholds.right_share(), row.model.found_share(),
          row.model.right_share(), row.truth / n, row.cleaned / n, row.held / n,
          row.before.rotations_deg / n, row.after.rotations_deg / n, row.before.legs_cm / n,
          row.after.legs_cm / n, row.before.feet_cm / n, row.after.feet_cm / n,
          row.before.root_cm / n, row.after.root_cm / n, row.pop_cleaned / n, row.pop_held / n})
      cells.push_back(fmt::format("{:.5g}", value));
    cells.push_back(fmt::format("{}", row.worse));
    table.add(cells);
  }
  table.close();
}

const Registration feet_stands_entry("feet_stands", feet_stands);

}  // namespace
}  // namespace kinemend::papers
