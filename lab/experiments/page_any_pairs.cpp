// Figures of docs/methods/learned.md: takes of markerless systems and depth cameras beside markers
// of the same motion, from systems and persons outside the training of the shipped models.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/quantiles.hpp"
#include "compared.hpp"
#include "kinemend/extend/model.hpp"
#include "made_pairs.hpp"
#include "methods/learned/motion_filter.hpp"
#include "page.hpp"
#include "system_pairs.hpp"

namespace kinemend::papers {
namespace {

PairErrors share_of(const PairErrors& errors, const PairErrors& before) {
  return {errors.value / before.value, errors.velocity / before.velocity,
          errors.fast / before.fast};
}

struct Source {
  std::size_t takes = 0;
  double within = 0;  ///< summed over takes
  std::map<std::string, PairErrors> shares;
  // For each method, the change of each clean reference take, degrees.
  std::map<std::string, std::vector<double>> reference_changes;
};

double root_mean_square_of_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double square = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    square += static_cast<double>(a[i] - b[i]) * static_cast<double>(a[i] - b[i]);
  return std::sqrt(square / static_cast<double>(a.size()));
}

// The share of errors not larger than the deviation that the network states.
double share_within(const MotionSample& pair) {
  static const MotionNetwork network = motion_network_of(*shipped_model("learned"));
  MotionTake take = pair.take;
  add_measured_smoothing(take);
  MotionResult result = filtered(network, take);
  join_measured(take, result);
  std::size_t count = 0, within = 0;
  for (std::size_t i = 0; i < pair.truth.size(); ++i) {
    if (pair.truth[i] == 0) continue;
    ++count;
    within += std::abs(result.values[i] - pair.truth[i]) <= result.deviation[i] ? 1U : 0U;
  }
  return static_cast<double>(within) / static_cast<double>(count);
}

void add_pair(const Take& noisy, const Take& reference, double least_deg, Source& source) {
  const PairInChannels both = pair_in_channels(noisy, reference, least_deg);
  const MotionTracks& tracks = both.tracks;
  const MotionSample& pair = both.sample;
  if (!moves(pair)) return;
  const auto errors_by = [&](const Compared& by) {
    return errors_of(channels_of(tracks, cleaned(noisy, by)), pair);
  };
  const PairErrors untouched = errors_of(pair.take.values, pair);
  const auto add = [&](const std::string& name, const PairErrors& errors) {
    PairErrors& sum = source.shares[name];
    const PairErrors share = share_of(errors, untouched);
    sum.value += share.value;
    sum.velocity += share.velocity;
    sum.fast += share.fast;
  };
  PairErrors best{0, std::numeric_limits<double>::max(), 0};
  for (const double cutoff_hz : {1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0}) {
    if (cutoff_hz >= noisy.frame_rate_hz / 2.2) break;
    const PairErrors errors = errors_by({"", "butterworth", {{"cutoff_hz", cutoff_hz}}});
    if (errors.velocity < best.velocity) best = errors;
  }
  add("best cut", best);
  add("butterworth", errors_by({"", "butterworth"}));
  const std::vector<float> clean = channels_of(tracks, reference);
  std::vector<Compared> methods = auto_and_learned;
  methods.push_back(learned_of_video);
  for (const Compared& by : methods) {
    add(by.label, errors_by(by));
    source.reference_changes[by.label].push_back(
        root_mean_square_of_difference(channels_of(tracks, cleaned(reference, by)), clean));
  }
  const MotionSample seen{tracks.take, values_in(tracks, view_of(reference))};
  source.within += share_within(mapped_pair({"", seen}, least_deg).sample);
  ++source.takes;
}

// Adds walks with the noise of such systems, for use without data.
void add_made_pairs(std::map<std::string, Source>& sources) {
  const MarkerPair depth = made_pair("walk", 30, "depth");
  add_pair(depth.noisy, depth.reference, least_move_deg, sources["depth"]);
  const Take walk = synthesize({.motion = "walk", .duration_s = 5, .frame_rate_hz = 60});
  add_pair(damaged(walk, "system", {{"kind", std::string("inertial")}}, 1), walk, least_turn_deg,
           sources["inertial"]);
}

void page_any_pairs(const Arguments& arguments) {
  std::map<std::string, Source> sources;
  std::size_t number = 0;
  for (const SystemPair& pair : pairs_below(arguments.data / "real2")) {
    if (arguments.quick && number++ % 20 != 0) continue;
    const auto noisy = read_take(pair.noisy).take, reference = read_take(pair.reference).take;
    add_pair(noisy, reference, noisy.has_joints() ? least_turn_deg : least_move_deg,
             sources[pair.source]);
  }
  if (sources.empty()) add_made_pairs(sources);
  Table table(arguments, "any_pairs.csv", "source,method,takes,value,velocity,above_6_hz,within");
  for (const auto& [name, source] : sources) {
    const auto count = static_cast<double>(source.takes);
    for (const auto& [method, sum] : source.shares) {
      table.add({name, method, fmt::format("{}", source.takes), figure(sum.value / count),
                 figure(sum.velocity / count), figure(sum.fast / count),
                 method == "learned" ? figure(source.within / count) : ""});
      fmt::print("{:8} {:12} {:4}  {:.3f} {:.3f} {:.3f}\n", name, method, source.takes,
                 sum.value / count, sum.velocity / count, sum.fast / count);
    }
  }
  table.close();
  Table references(arguments, "any_references.csv", "source,method,takes,median_deg,most_deg");
  for (const auto& [name, source] : sources) {
    for (auto [method, changes] : source.reference_changes) {
      const double median = upper_median_of(changes),
                   most = *std::max_element(changes.begin(), changes.end());
      references.add(
          {name, method, fmt::format("{}", changes.size()), figure(median), figure(most)});
      fmt::print("reference {:8} {:12} median {:.4f} most {:.3f} deg\n", name, method, median,
                 most);
    }
  }
  references.close();
}

const Registration page_any_pairs_entry("page_any_pairs", page_any_pairs);

}  // namespace
}  // namespace kinemend::papers
