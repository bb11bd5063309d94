#include <algorithm>
#include <cmath>

#include "clean/live_frames.hpp"
#include "clean/medians.hpp"
#include "clean/method_list.hpp"
#include "clean/tracks.hpp"
#include "kinemend/methods.hpp"

namespace kinemend {

namespace {

const OptionTable<HampelOptions>& table() {
  static const auto options =
      OptionTable<HampelOptions>()
          .number(&HampelOptions::window_s, "window_s", "s", 0.01, 5, "length of the whole window")
          .number(&HampelOptions::threshold, "threshold", "", 0, 100,
                  "robust standard deviations per axis beyond which a sample is a spike")
          .number(&HampelOptions::minimum_deg, "minimum_deg", "deg", 0, 180,
                  "smaller deviations are no spikes");
  return options;
}

// Median length of a vector of three independent standard normal components.
constexpr double median_length = 1.5381722544550522;

struct Rule {
  std::size_t half = 1;       // frames
  double threshold = 4;       // standard deviations per axis
  double least_distance = 0;  // radians or file units
};

// The sample at `t`, or its window's median where it is a spike. The window is cut at the ends of
// the take: there the first and last samples are far from the median in every motion, so they are
// spikes only if the sample beside them is far off as well.
template <class Sample>
bool despike_at(std::span<const Sample> track, std::size_t t, const Rule& rule,
                MedianScratch& scratch, std::vector<double>& distances, Sample& replacement) {
  const std::size_t first = t - std::min(t, rule.half);
  const std::size_t last = std::min(track.size() - 1, t + rule.half);
  const auto window = track.subspan(first, last - first + 1);
  if (window.size() < 5) return false;
  const Sample middle = window[medoid(window, scratch)];
  const double own = chord(middle, track[t]);
  if (own <= rule.least_distance) return false;

  distances.clear();
  for (const Sample& sample : window) distances.push_back(chord(middle, sample));
  const auto half = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), half, distances.end());
  if (own <= rule.threshold * *half / median_length) return false;

  const std::size_t reach = std::min(t - first, last - t);
  if (reach < rule.half) {
    const std::size_t beside = t == first             ? t + 1
                               : t == last            ? t - 1
                               : t - first < last - t ? t - 1
                                                      : t + 1;
    if (chord(track[beside], track[t]) < own / 2) return false;
  }
  const std::size_t near = std::max<std::size_t>(reach, 2);
  const std::size_t from = std::max(first, t - std::min(t, near));
  const std::size_t to = std::min(last, t + near);
  replacement = l1_median(track.subspan(from, to - from + 1), scratch);
  return true;
}

class Hampel final : public Cleaner {
 public:
  explicit Hampel(const HampelOptions& options) : options_(options) {}

  CleanTrace clean(Clip& clip, const Selection& selection) const override {
    CleanTrace trace;
    const std::vector<std::size_t> joints = selected_joints(clip, selection);
    const auto positions = selected_positions(clip, selection);
    bridge_gaps(clip, joints, trace);
    const std::size_t frames = clip.frame_count();
    if (trace.actions.empty()) trace.actions.assign(clip.local_rotations.size(), Action::kept);
    trace.root_actions.assign(frames, Action::kept);
    const Rule turn = rotation_rule(clip), shift = position_rule(clip);
    for_each_parallel(joints.size() + positions.size(), joints.size() * frames, [&](std::size_t i) {
      if (i < joints.size()) {
        despike_joint(clip, joints[i], turn, trace);
      } else {
        const PositionTrack& track = positions[i - joints.size()];
        const bool root = track.values == clip.root_positions.data();
        despike_positions(track, frames, shift, root ? &trace.root_actions : nullptr);
      }
    });
    return trace;
  }

  LiveSupport live_support(double rate_hz) const override {
    return {LiveSupport::Kind::windowed, half_frames(rate_hz)};
  }

  LiveFrame clean_frame(const Clip& window, std::size_t frame) const override {
    Clip copy = window;
    CleanTrace trace;
    const Selection all = Selection::all(copy);
    const std::vector<std::size_t> joints = selected_joints(copy, all);
    bridge_gaps(copy, joints, trace);
    MedianScratch scratch;
    std::vector<double> distances;
    const Rule turn = rotation_rule(copy), shift = position_rule(copy);
    for (const std::size_t j : joints) {
      const std::vector<Quat> track = joint_track(copy, j);
      despike_at<Quat>(track, frame, turn, scratch, distances, copy.rotation(frame, j));
    }
    for (const PositionTrack& positions : selected_positions(copy, all)) {
      const std::vector<Vec3> track = position_track(positions, copy.frame_count());
      despike_at<Vec3>(track, frame, shift, scratch, distances,
                       positions.values[frame * positions.stride]);
    }
    return frame_of(copy, frame);
  }

 private:
  std::size_t half_frames(double rate_hz) const {
    return frames_in(options_.window_s / 2, rate_hz, 3);
  }
  Rule rotation_rule(const Clip& clip) const {
    return {half_frames(clip.frame_rate_hz), options_.threshold,
            options_.minimum_deg * radians_per_degree};
  }
  Rule position_rule(const Clip& clip) const {
    Rule rule = rotation_rule(clip);
    rule.least_distance *= typical_bone_length(clip.skeleton);
    return rule;
  }

  static void despike_joint(Clip& clip, std::size_t joint, const Rule& rule, CleanTrace& trace) {
    MedianScratch scratch;
    std::vector<double> distances;
    const std::vector<Quat> track = joint_track(clip, joint);
    for (std::size_t t = 0; t < track.size(); ++t) {
      if (!despike_at<Quat>(track, t, rule, scratch, distances, clip.rotation(t, joint))) continue;
      Action& action = trace.actions[t * clip.joint_count() + joint];
      if (action == Action::kept) action = Action::despiked;
    }
  }

  static void despike_positions(const PositionTrack& positions, std::size_t frames,
                                const Rule& rule, std::vector<Action>* actions) {
    MedianScratch scratch;
    std::vector<double> distances;
    const std::vector<Vec3> track = position_track(positions, frames);
    for (std::size_t t = 0; t < frames; ++t) {
      Vec3& value = positions.values[t * positions.stride];
      if (despike_at<Vec3>(track, t, rule, scratch, distances, value) && actions) {
        (*actions)[t] = Action::despiked;
      }
    }
  }

  HampelOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_hampel(const HampelOptions& options) {
  table().validate(options);
  return std::make_unique<Hampel>(options);
}

Method hampel_method() {
  return {"hampel", "finds spikes, replaces them, and leaves every other sample alone",
          "Hampel 1974; Davies & Gather 1993", table().specs(),
          [](const OptionValues& values) { return make_hampel(table().parse(values)); }};
}

}  // namespace kinemend
