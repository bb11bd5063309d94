#include <algorithm>
#include <cmath>
#include <utility>

#include "base/quantiles.hpp"
#include "clean/clip_tracks.hpp"
#include "clean/live_frames.hpp"
#include "clean/marker_tracks.hpp"
#include "clean/method_list.hpp"
#include "kinemend/frame_rate.hpp"
#include "kinemend/methods.hpp"
#include "tracks/medians.hpp"

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

struct Rule {
  std::size_t half = 1;       // frames
  double threshold = 4;       // standard deviations per axis
  double least_distance = 0;  // radians or file units
};

template <class Sample>
using Track = std::span<const Sample>;

template <class Sample>
class Despiker {
 public:
  Despiker(Track<Sample> track, const Rule& rule)
      : track_(track), rule_(rule), medoids_(track, 2 * rule.half + 1) {}

  /// Puts the median of the samples about `t` into `sample` if the one at `t` is a spike. `t` only
  /// grows from call to call.
  bool despike(std::size_t t, Sample& sample) {
    const std::size_t first = t - std::min(t, rule_.half);
    const std::size_t last = std::min(track_.size() - 1, t + rule_.half);
    if (!is_spike(t, first, last)) return false;
    const std::size_t near = std::max<std::size_t>(std::min(t - first, last - t), 2);
    const std::size_t from = std::max(first, t - std::min(t, near));
    const std::size_t to = std::min(last, t + near);
    const auto window = track_.subspan(from, to - from + 1);
    sample = l1_median(window, medoid(window), scratch_);
    return true;
  }

 private:
  bool is_spike(std::size_t t, std::size_t first, std::size_t last) {
    constexpr std::size_t least_frames = 5;
    if (last - first + 1 < least_frames) return false;
    const std::size_t middle = medoids_.find(first, last);
    const double own = medoids_.distance(middle, t);
    if (own <= rule_.least_distance) return false;
    distances_.clear();
    for (std::size_t f = first; f <= last; ++f) distances_.push_back(medoids_.distance(middle, f));
    if (own <= rule_.threshold * upper_median_of(distances_) / median_of_chi3) return false;
    return last - first == 2 * rule_.half || stands_alone(t, first, last, own);
  }

  // Where the take's end cuts the window, the outermost samples are far from the median in every
  // motion. They are spikes only if the sample beside them, towards the end or inwards, is far off
  // as well.
  bool stands_alone(std::size_t t, std::size_t first, std::size_t last, double own) const {
    const bool at_start = t - first < last - t;
    const std::size_t outer =
        at_start ? t - std::min<std::size_t>(t - first, 1) : std::min(t + 1, last);
    const std::size_t beside = outer != t ? outer : at_start ? t + 1 : t - 1;
    return medoids_.distance(beside, t) >= own / 2;
  }

  Track<Sample> track_;
  Rule rule_;
  MovingMedoid<Sample> medoids_;
  std::vector<Vec3> scratch_;
  std::vector<double> distances_;
};

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
    std::vector<ActionTrack> actions;
    actions.reserve(positions.size());
    for (const PositionTrack& track : positions)
      actions.push_back(position_actions(clip, track, trace));
    const Rule turn = rotation_rule(clip), shift = position_rule(clip);
    for_each_parallel(joints.size() + positions.size(), joints.size() * frames, [&](std::size_t i) {
      if (i < joints.size()) {
        despike_joint(clip, joints[i], turn, trace);
      } else {
        despike_positions(positions[i - joints.size()], frames, shift, actions[i - joints.size()]);
      }
    });
    return trace;
  }

  MarkerTrace clean_markers(MarkerClip& clip, const MarkerSelection& selection) const override {
    const Rule rule = rule_for(clip.frame_rate_hz, marker_reach(selection.body_height));
    std::vector<Action> actions(clip.positions.size(), Action::kept);
    MarkerTrace trace = filter_marker_paths(clip, selection, [&](MarkerPath& path) {
      const std::vector<Vec3> track = path.positions;
      Despiker<Vec3> despiker(track, rule);
      for (std::size_t t = 0; t < track.size(); ++t) {
        if (despiker.despike(t, path.positions[t])) {
          actions[(path.first_frame + t) * clip.marker_count() + path.marker] = Action::despiked;
        }
      }
    });
    for (std::size_t i = 0; i < actions.size(); ++i) {
      if (clip.observed[i] == 0) actions[i] = Action::kept;
    }
    trace.actions = std::move(actions);
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
    const Rule turn = rotation_rule(copy), shift = position_rule(copy);
    for (const std::size_t j : joints) {
      const std::vector<Quat> track = joint_track(copy, j);
      Despiker<Quat>(track, turn).despike(frame, copy.rotation(frame, j));
    }
    for (const PositionTrack& positions : selected_positions(copy, all)) {
      const std::vector<Vec3> track = position_track(positions, copy.frame_count());
      Vec3& value = positions.values[frame * positions.stride];
      Despiker<Vec3>(track, shift).despike(frame, value);
    }
    return frame_of(copy, frame);
  }

 private:
  std::size_t half_frames(double rate_hz) const {
    return frames_in(options_.window_s / 2, window_rate_hz(rate_hz), 3);
  }
  // `scale`: the distance that counts as one radian.
  Rule rule_for(double rate_hz, double scale) const {
    return {half_frames(rate_hz), options_.threshold,
            options_.minimum_deg * radians_per_degree * scale};
  }
  Rule rotation_rule(const Clip& clip) const { return rule_for(clip.frame_rate_hz, 1); }
  Rule position_rule(const Clip& clip) const {
    return rule_for(clip.frame_rate_hz, typical_bone_length(clip.skeleton));
  }

  static void despike_joint(Clip& clip, std::size_t joint, const Rule& rule, CleanTrace& trace) {
    const std::vector<Quat> track = joint_track(clip, joint);
    Despiker<Quat> despiker(track, rule);
    for (std::size_t t = 0; t < track.size(); ++t) {
      if (!despiker.despike(t, clip.rotation(t, joint))) continue;
      Action& action = trace.actions[t * clip.joint_count() + joint];
      if (action == Action::kept) action = Action::despiked;
    }
  }

  static void despike_positions(const PositionTrack& positions, std::size_t frames,
                                const Rule& rule, ActionTrack actions) {
    const std::vector<Vec3> track = position_track(positions, frames);
    Despiker<Vec3> despiker(track, rule);
    for (std::size_t t = 0; t < frames; ++t) {
      Vec3& value = positions.values[t * positions.stride];
      if (despiker.despike(t, value)) actions.values[t * actions.stride] = Action::despiked;
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
