// Figures of docs/methods/learned.md: takes of markerless systems and of depth cameras beside
// markers of the same motion, of systems and persons that no model that ships has seen.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/quantiles.hpp"
#include "compared.hpp"
#include "kinemend/experimental/model.hpp"
#include "kinemend/experimental/representation.hpp"
#include "kinemend/experimental/signal.hpp"
#include "kinemend/rotation.hpp"
#include "learned/corrector/measured_smoothing.hpp"
#include "learned/corrector/motion_channels.hpp"
#include "learned/corrector/motion_filter.hpp"
#include "learned/corrector/motion_samples.hpp"
#include "made_pairs.hpp"
#include "methods/core/pieces.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

struct Pair {
  std::string source, noisy, reference;
};

// Those that tools/train_learned does not learn from.
bool is_left_out(const std::string& name) {
  if (name.starts_with("lbmc-")) {
    const std::string system = name.substr(5, name.find('-', 5) - 5);
    return system != "M1" && system != "M2" && system != "M3" && system != "M5" && system != "M7";
  }
  const std::size_t person = name.find("_s");
  return name.starts_with("kinect-") && person != std::string::npos && name[person + 3] > '3';
}

std::vector<Pair> pairs_below(const std::filesystem::path& folder) {
  std::vector<Pair> pairs;
  if (!std::filesystem::is_directory(folder)) return pairs;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const std::size_t at = name.find(".noisy.");
    if (at == std::string::npos || !is_left_out(name)) continue;
    const std::string reference = name.substr(0, at) + ".reference." + name.substr(at + 7);
    pairs.push_back(
        {name.substr(0, name.find('-')), entry.path().string(), (folder / reference).string()});
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.noisy < b.noisy; });
  return pairs;
}

struct Errors {
  double value = 0, velocity = 0, fast = 0;
};

// Root mean squares over channels whose reference moves. F x C.
Errors errors_of(const std::vector<float>& values, const MotionSample& pair) {
  const MotionTake& take = pair.take;
  PoseMatrix error(take.frames, take.channels);
  std::vector<std::uint8_t> moves(take.channels);
  for (std::size_t f = 0; f < take.frames; ++f) {
    for (std::size_t c = 0; c < take.channels; ++c) {
      const std::size_t i = f * take.channels + c;
      error(f, c) = static_cast<double>(values[i] - pair.truth[i]);
      if (pair.truth[i] != 0) moves[c] = 1;
    }
  }
  PoseMatrix fast = error;
  filter_zero_phase(fast, butterworth_lowpass(4, 6, take.frame_rate_hz));
  Errors sums;
  double count = 0;
  for (std::size_t f = 1; f + 1 < take.frames; ++f) {
    for (std::size_t c = 0; c < take.channels; ++c) {
      if (moves[c] == 0) continue;
      const double change = (error(f + 1, c) - error(f - 1, c)) * take.frame_rate_hz / 2;
      const double quick = error(f, c) - fast(f, c);
      sums.value += error(f, c) * error(f, c);
      sums.velocity += change * change;
      sums.fast += quick * quick;
      count += 1;
    }
  }
  return {std::sqrt(sums.value / count), std::sqrt(sums.velocity / count),
          std::sqrt(sums.fast / count)};
}

Errors share_of(const Errors& errors, const Errors& before) {
  return {errors.value / before.value, errors.velocity / before.velocity,
          errors.fast / before.fast};
}

struct Source {
  std::size_t takes = 0;
  double within = 0;  ///< summed over takes
  std::map<std::string, Errors> shares;
  // Of each method, what it does to the references, which are clean: degrees, of each take.
  std::map<std::string, std::vector<double>> reference_changes;
};

double root_mean_square_of_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double square = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    square += static_cast<double>(a[i] - b[i]) * static_cast<double>(a[i] - b[i]);
  return std::sqrt(square / static_cast<double>(a.size()));
}

// The share of errors that are no larger than the deviation that the network states.
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

// F x 3 (J - 1): the turns of the joints below the root, degrees, going on past half a turn.
std::vector<float> channels_of(const MotionTracks& tracks, const Take& clip) {
  if (!clip.has_joints()) return values_in(tracks, view_of(clip));
  const std::size_t joints = clip.joint_count() - 1;
  std::vector<float> values;
  std::vector<Vec3> last(joints);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t j = 0; j < joints; ++j) {
      last[j] = continue_rotation_vector(log(clip.rotation(f, j + 1)), last[j]);
      for (const double radians : {last[j].x, last[j].y, last[j].z})
        values.push_back(static_cast<float>(degrees_per_radian * radians));
    }
  }
  return values;
}

void add_pair(const Take& noisy, const Take& reference, double least_deg, Source& source) {
  const TakeView view = view_of(noisy);
  MotionTracks tracks = motion_tracks_of(view, changeable_tracks(view));
  MotionSample both{tracks.take, channels_of(tracks, reference)};
  both.take.values = channels_of(tracks, noisy);
  both.take.channels = both.take.values.size() / both.take.frames;
  const MotionSample pair = mapped_pair({"", std::move(both)}, least_deg).sample;
  if (std::all_of(pair.truth.begin(), pair.truth.end(), [](float v) { return v == 0; })) return;
  const auto channels_by = [&](const std::string& method, const OptionValues& options, Take clip) {
    clean_in_place(*make_cleaner(method, options), clip);
    return channels_of(tracks, clip);
  };
  const auto errors_by = [&](const std::string& method, const OptionValues& options) {
    return errors_of(channels_by(method, options, noisy), pair);
  };
  const Errors untouched = errors_of(pair.take.values, pair);
  const auto add = [&](const std::string& name, const Errors& errors) {
    Errors& sum = source.shares[name];
    const Errors share = share_of(errors, untouched);
    sum.value += share.value;
    sum.velocity += share.velocity;
    sum.fast += share.fast;
  };
  Errors best{0, std::numeric_limits<double>::max(), 0};
  for (const double cutoff_hz : {1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0}) {
    if (cutoff_hz >= noisy.frame_rate_hz / 2.2) break;
    const Errors errors = errors_by("butterworth", {{"cutoff_hz", cutoff_hz}});
    if (errors.velocity < best.velocity) best = errors;
  }
  add("best cut", best);
  add("butterworth", errors_by("butterworth", {}));
  const std::vector<float> clean = channels_of(tracks, reference);
  for (const Compared& compared : auto_and_learned) {
    add(compared.label, errors_by(compared.method, compared.options));
    source.reference_changes[compared.label].push_back(root_mean_square_of_difference(
        channels_by(compared.method, compared.options, reference), clean));
  }
  const MotionSample seen{tracks.take, values_in(tracks, view_of(reference))};
  source.within += share_within(mapped_pair({"", seen}, least_deg).sample);
  ++source.takes;
}

constexpr double least_turn_deg = 2, least_move_deg = 0.34;

// Without data: walks with the noise of such systems.
void add_made_pairs(std::map<std::string, Source>& sources) {
  const MarkerPair depth = made_pair("walk", 30, "depth");
  add_pair(depth.noisy, depth.reference, least_move_deg, sources["depth"]);
  const Take walk = synthesize({.motion = "walk", .duration_s = 5, .frame_rate_hz = 60});
  add_pair(damaged(walk, "system", {{"kind", std::string("inertial")}}, 1), walk, least_turn_deg,
           sources["inertial"]);
}

void experiment(const Arguments& arguments) {
  std::map<std::string, Source> sources;
  std::size_t number = 0;
  for (const Pair& pair : pairs_below(arguments.data / "real2")) {
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

const Registration registration("page_any_pairs", experiment);

}  // namespace
}  // namespace kinemend::papers
