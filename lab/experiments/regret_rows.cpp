// Makes the takes of the table of regret.
#include "regret_rows.hpp"

#include <cmath>
#include <memory>
#include <utility>

#include "camera_pairs.hpp"
#include "clean_worlds.hpp"
#include "kept_takes.hpp"
#include "kinemend/extend/figures.hpp"
#include "marker_noise.hpp"
#include "noise_kinds.hpp"
#include "page.hpp"
#include "quality/lower_rate.hpp"
#include "system_pairs.hpp"

namespace kinemend::papers {
namespace {

constexpr std::uint64_t seed = 7;
const std::vector<std::string> systems{"video", "triangulated", "depth", "inertial", "optical"};

using DamageOfTake = std::function<Take(const Take&)>;

struct NamedDamage {
  std::string name;
  DamageOfTake damage;
  bool has_gaps = false;
};

DamageOfTake by(const std::string& name, const OptionValues& options) {
  return [name, options](const Take& take) { return damaged(take, name, options, seed); };
}

std::string percent(double share) { return fmt::format("{:g} %", 100 * share); }

std::vector<NamedDamage> joint_damages() {
  std::vector<NamedDamage> all;
  for (const double deg : {0.5, 1.5, 4.0})
    all.push_back({fmt::format("white {:g} deg", deg), by("gaussian", {{"std_deg", deg}})});
  all.push_back({"half of each channel", by("gaussian-channels", {{"k", 0.5}})});
  for (const double correlation : {0.5, 0.8, 0.95})
    all.push_back({fmt::format("correlation {:g}", correlation),
                   by("ar1", {{"std_deg", 1.5}, {"correlation", correlation}})});
  all.push_back({"held for two frames", [](const Take& take) {
                   return quality::of_lower_rate(noisy(take, 1.5, 0, seed), 2, true);
                 }});
  all.push_back(
      {"lines between 30 Hz", [](const Take& take) { return noise_of_30_hz(take, seed); }});
  all.push_back({"below 4 Hz", [](const Take& take) { return low_passed_noise(take, seed); }});
  for (const double std_deg : {0.0, 1.5}) {
    for (const double share : {0.004, 0.05, 0.1, 0.2}) {
      all.push_back(
          {fmt::format("outliers {}{}", percent(share), std_deg > 0 ? " and white" : ""),
           [std_deg, share](const Take& take) { return noisy(take, std_deg, share, seed); }});
    }
  }
  for (const std::string& kind : systems)
    all.push_back({"like " + kind, by("system", {{"kind", kind}})});
  all.push_back({"gaps", by("gaps", {{"start_probability", 0.005}, {"mean_length_s", 0.1}}), true});
  all.push_back({"gaps and white",
                 [](const Take& take) {
                   return damaged(noisy(take, 1.5, 0, seed), "gaps",
                                  {{"start_probability", 0.005}, {"mean_length_s", 0.1}}, seed);
                 },
                 true});
  return all;
}

std::vector<NamedDamage> marker_damages() {
  std::vector<NamedDamage> all;
  for (const auto& [name, std_mm, correlation] :
       {MarkerNoise{"white 1 mm", 1, 0}, MarkerNoise{"white 3 mm", 3, 0},
        MarkerNoise{"white 15 mm", 15, 0}, MarkerNoise{"correlation 0.8, 3 mm", 3, 0.8},
        MarkerNoise{"correlation 0.8, 15 mm", 15, 0.8},
        MarkerNoise{"correlation 0.95, 15 mm", 15, 0.95}}) {
    const MarkerNoise noise{name, std_mm, correlation};
    all.push_back({"markers: " + name,
                   [noise](const Take& take) { return with_marker_noise(take, noise, seed); }});
  }
  for (const double share : {0.004, 0.05, 0.2})
    all.push_back({"markers: outliers " + percent(share),
                   by("outliers", {{"share", share}, {"std_deg", 25.0}})});
  for (const std::string& kind : systems)
    all.push_back({"markers: like " + kind, by("system", {{"kind", kind}})});
  all.push_back({"markers: gaps and white 1 mm",
                 [](const Take& take) {
                   return damaged(with_marker_noise(take, {"", 1, 0}, seed), "gaps",
                                  {{"start_probability", 0.005}, {"mean_length_s", 0.1}}, seed);
                 },
                 true});
  return all;
}

// The first one is short, for methods that take minutes: walk, run, dance, punch.
std::vector<std::string> regret_takes(const Arguments& arguments) {
  if (arguments.quick || arguments.data.empty()) return {"walk"};
  return {"35_01", "09_03", "49_17", "02_05"};
}

Take regret_take(const Arguments& arguments, const std::string& name) {
  if (arguments.quick || arguments.data.empty())
    return synthesize({.motion = name, .duration_s = 1.5, .frame_rate_hz = 60});
  return kept_take(arguments, name);
}

using ErrorOfTake = std::function<double(const Take& truth, const Take& cleaned)>;

void add_damaged(const Arguments& arguments, const std::vector<NamedDamage>& damages,
                 const std::function<Take(Take)>& prepare, const std::string& unit,
                 const ErrorOfTake& error, std::vector<RegretRow>& rows) {
  for (const NamedDamage& damage : damages) {
    RegretRow row{damage.name, unit};
    row.has_gaps = damage.has_gaps;
    // In the quick form, even a second of a slow method for each row would take too long.
    row.has_slow = !arguments.quick || rows.empty();
    std::vector<std::string> names = regret_takes(arguments);
    // Filling gaps takes longer than all methods together.
    if (row.has_gaps) names.resize(std::min<std::size_t>(2, names.size()));
    for (const std::string& name : names) {
      row.cases.push_back([=] {
        const Take truth = prepare(regret_take(arguments, name));
        Take take = damage.damage(truth);
        // Samples held until the next measurement end with a measurement.
        const Take cut = slice(truth, 0, take.frame_count());
        return RegretCase{std::move(take), [cut, error](const Take& cleaned) {
                            return std::vector<double>{error(cut, cleaned)};
                          }};
      });
    }
    rows.push_back(std::move(row));
  }
}

// Compares the samples observed in both takes.
double seen_distance_mm(const Take& truth, const Take& cleaned) {
  return compare_markers(truth, cleaned, {}).all.rms_distance;
}

std::vector<double> listed(const PairErrors& errors) {
  return {errors.value, errors.velocity, errors.fast};
}

RegretRow pair_row(const std::string& name) {
  RegretRow row{name, ""};
  row.figures = {"value", "velocity", "above 6 Hz"};
  row.cut_by = 1;
  return row;
}

// Uses every fourth Kinect take, because they are many and similar.
void add_system_pairs(const Arguments& arguments, std::vector<RegretRow>& rows) {
  RegretRow markerless = pair_row("markerless systems"), kinect = pair_row("Kinect");
  const auto case_of = [](const Take& noisy, const Take& reference) {
    const double least_deg = noisy.has_joints() ? least_turn_deg : least_move_deg;
    const auto pair =
        std::make_shared<const PairInChannels>(pair_in_channels(noisy, reference, least_deg));
    return RegretCase{noisy, [pair](const Take& cleaned) {
                        return listed(errors_of(channels_of(pair->tracks, cleaned), pair->sample));
                      }};
  };
  std::size_t number = 0;
  const std::vector<SystemPair> pairs = arguments.quick || arguments.data.empty()
                                            ? std::vector<SystemPair>{}
                                            : pairs_below(arguments.data / "real2");
  for (const SystemPair& pair : pairs) {
    const bool is_kinect = pair.source == "kinect";
    if (is_kinect && number++ % 4 != 0) continue;
    (is_kinect ? kinect : markerless).cases.push_back([=] {
      return case_of(read_take(pair.noisy).take, read_take(pair.reference).take);
    });
  }
  if (pairs.empty()) {
    kinect.cases.push_back([=] {
      const MarkerPair depth = made_pair("walk", 30, "depth");
      return case_of(depth.noisy, depth.reference);
    });
  }
  for (RegretRow& row : {std::ref(markerless), std::ref(kinect)})
    if (!row.cases.empty()) rows.push_back(std::move(row));
}

void add_camera_pairs(const Arguments& arguments, std::vector<RegretRow>& rows) {
  RegretRow drumming = pair_row("drumming from video"), depth = pair_row("depth camera");
  Arguments of_pairs = arguments;
  if (arguments.quick) of_pairs.data.clear();
  for (MarkerPair& pair : camera_pairs(of_pairs)) {
    // Drumming has ten markers, a depth camera nineteen; synthetic pairs are walks from both.
    const bool is_depth = pair.noisy.marker_count() > 10;
    (is_depth ? depth : drumming).cases.push_back([pair] {
      return RegretCase{pair.noisy, [pair](const Take& cleaned) {
                          return listed(errors_of(pair.reference, pair.noisy, cleaned));
                        }};
    });
  }
  for (RegretRow& row : {std::ref(drumming), std::ref(depth)})
    if (!row.cases.empty()) rows.push_back(std::move(row));
}

// A clean take of at most ten seconds; its error is the change.
std::function<RegretCase()> clean_case(Take take) {
  take = slice(
      take, 0,
      std::min(take.frame_count(), static_cast<std::size_t>(std::lround(10 * take.frame_rate_hz))));
  return [take] {
    return RegretCase{take, [take](const Take& cleaned) {
                        if (take.has_joints())
                          return std::vector<double>{geodesic_rms_deg(take, cleaned)};
                        const double metres = metres_per_unit(take.unit);
                        return std::vector<double>{(metres > 0 ? 1000 * metres : 1) *
                                                   seen_distance_mm(take, cleaned)};
                      }};
  };
}

void add_clean(const Arguments& arguments, std::vector<RegretRow>& rows) {
  const auto clean_row = [](const std::string& name, const std::string& unit) {
    RegretRow row{name, unit};
    row.is_clean = true;
    row.has_slow = false;
    return row;
  };
  RegretRow own = clean_row("clean: CMU", "deg"), markers = clean_row("clean: markers", "mm"),
            joints = clean_row("clean: other worlds", "deg"),
            hands = clean_row("clean: hands shake at 7 Hz", "mm");
  for (const std::string& name : regret_takes(arguments)) {
    const Take take = regret_take(arguments, name);
    own.cases.push_back(clean_case(take));
    markers.cases.push_back(clean_case(in_millimetres(take)));
  }
  const Take still = in_millimetres(regret_take(arguments, regret_takes(arguments).back()));
  hands.cases.push_back(clean_case(with_shaking_hands(still, 7)));
  // Two takes of each world; one synthetic take is enough.
  const std::size_t most = arguments.quick ? 1 : 2;
  for (const auto& [world, takes] : clean_worlds(arguments)) {
    for (std::size_t i = 0; i < std::min(most, takes.size()); ++i)
      (world.second == "deg" ? joints : markers).cases.push_back(clean_case(takes[i]));
  }
  for (RegretRow* row : {&own, &joints, &markers, &hands}) rows.push_back(std::move(*row));
}

}  // namespace

std::vector<RegretRow> regret_rows(const Arguments& arguments) {
  std::vector<RegretRow> rows;
  add_damaged(
      arguments, joint_damages(), [](Take take) { return take; }, "deg",
      [](const Take& truth, const Take& cleaned) { return rms_deg(truth, cleaned); }, rows);
  add_damaged(arguments, marker_damages(), in_millimetres, "mm", seen_distance_mm, rows);
  add_system_pairs(arguments, rows);
  add_camera_pairs(arguments, rows);
  add_clean(arguments, rows);
  for (RegretRow& row : rows) {
    if (arguments.quick || row.has_gaps) {
      row.cutoffs_hz = {1, 4, 12};
    } else {
      row.cutoffs_hz = {0.7, 1, 1.5, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 25, 30, 40};
    }
  }
  return rows;
}

}  // namespace kinemend::papers
