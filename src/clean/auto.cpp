#include <algorithm>
#include <cmath>
#include <utility>

#include "base/progress.hpp"
#include "clean/auto_markers.hpp"
#include "clean/clip_tracks.hpp"
#include "clean/method_list.hpp"
#include "kinemend/methods.hpp"
#include "tracks/moving_chart.hpp"
#include "tracks/spikes.hpp"
#include "tracks/track_cleaning.hpp"
#include "tracks/vector_tracks.hpp"

namespace kinemend {

namespace {

const OptionTable<AutoOptions>& table() {
  static const auto options =
      OptionTable<AutoOptions>()
          .number(&AutoOptions::sensitivity, "sensitivity", "", 0, 4,
                  "scales the estimated noise: above 1 smooths more, below 1 less, 0 not at all")
          .flag(&AutoOptions::despike, "despike", "finds and repairs spikes");
  return options;
}

class Auto final : public Cleaner {
 public:
  explicit Auto(const AutoOptions& options) : options_(options) {}

  CleanTrace clean(Clip& clip, const Selection& selection) const override {
    CleanTrace trace;
    const std::vector<std::size_t> joints = selected_joints(clip, selection);
    bridge_gaps(clip, joints, trace);
    if (clip.frame_count() < fewest_clean_frames) return trace;
    if (trace.actions.empty()) trace.actions.assign(clip.local_rotations.size(), Action::kept);
    const JointSink keep = [&](std::size_t joint, std::vector<Quat> rotations,
                               std::vector<Action> actions) {
      set_joint_track(clip, joint, rotations);
      for (std::size_t t = 0; t < actions.size(); ++t) {
        Action& action = trace.actions[t * clip.joint_count() + joint];
        if (action == Action::kept) action = actions[t];
      }
    };
    clean_parts(clip, selection, joints, keep, {}, trace);
    return trace;
  }

  CleanTrace clean_joints(Clip& clip, const Selection& selection, const JointSink& sink,
                          const std::function<void(double)>& progress) const override {
    // Bridges would take the place of what is there before anybody has seen it.
    if (!clip.observed.empty()) return Cleaner::clean_joints(clip, selection, sink, progress);
    CleanTrace trace;
    if (clip.frame_count() < fewest_clean_frames) return trace;
    clean_parts(clip, selection, selected_joints(clip, selection), sink, progress, trace);
    return trace;
  }

  MarkerTrace clean_markers(MarkerClip& clip, const MarkerSelection& selection) const override {
    return clean_markers_by_evidence(clip, selection, options_);
  }

 private:
  void clean_parts(Clip& clip, const Selection& selection, const std::vector<std::size_t>& joints,
                   const JointSink& sink, const std::function<void(double)>& tell,
                   CleanTrace& trace) const {
    ShareProgress progress(tell);
    clean_rotations(clip, joints, sink, progress, trace);
    clean_positions(clip, selected_positions(clip, selection), trace);
  }

  // A chart takes more room than the vectors that it gives: it is made once for these, and again
  // to come back from them.
  static MovingChart chart_of(std::vector<Quat> track, double frame_rate_hz,
                              std::vector<std::uint8_t>* gross = nullptr) {
    std::vector<std::uint8_t> marks = replace_gross_spikes(track);
    if (gross) *gross = std::move(marks);
    return make_moving_chart(track, frame_rate_hz);
  }

  void clean_rotations(const Clip& clip, const std::vector<std::size_t>& joints,
                       const JointSink& sink, ShareProgress& progress, CleanTrace& trace) const {
    const std::size_t frames = clip.frame_count(), count = joints.size();
    VectorTracks tracks(frames, count);
    SampleMarks suspects(frames, count), gaps(frames, count);
    progress.begin_part(0.2, count);
    for_each_parallel(count, frames * count, [&](std::size_t n) {
      const std::vector<Quat> track = joint_track(clip, joints[n]);
      std::vector<std::uint8_t> gross;
      const MovingChart chart = chart_of(track, clip.frame_rate_hz, &gross);
      for (std::size_t t = 0; t < frames; ++t) {
        tracks.set(t, n, degrees_per_radian * chart.vector_of(t, track[t]));
        suspects(t, n) = gross[t];
        gaps(t, n) = !clip.is_observed(t, joints[n]);
      }
      progress.step();
    });

    const CleanedTracks verdicts =
        clean_tracks(tracks, suspects, gaps, tracks_nearby(clip.skeleton, joints),
                     clip.frame_rate_hz, {options_.sensitivity, options_.despike}, &progress);

    trace.noise_deg.assign(clip.joint_count(), 0);
    progress.begin_part(1, count);
    for_each_parallel(count, frames * count, [&](std::size_t n) {
      trace.noise_deg[joints[n]] = verdicts.noise[n];
      const auto spikes = verdicts.marked.track(n);
      const bool smoothed = verdicts.shares[n] != 0;
      if (smoothed || std::find(spikes.begin(), spikes.end(), 1) != spikes.end()) {
        std::vector<Quat> track = joint_track(clip, joints[n]);
        const MovingChart chart = chart_of(track, clip.frame_rate_hz);
        std::vector<Action> actions(frames, Action::kept);
        for (std::size_t t = 0; t < frames; ++t) {
          if (!smoothed && spikes[t] == 0) continue;
          track[t] = chart.rotation_of(t, radians_per_degree * tracks.at(t, n));
          if (spikes[t] != 0) actions[t] = Action::despiked;
        }
        sink(joints[n], std::move(track), std::move(actions));
      }
      progress.step();
    });
  }

  // Positions go the same way, on the scale at which a degree moves the end of a typical bone.
  void clean_positions(Clip& clip, const std::vector<PositionTrack>& positions,
                       CleanTrace& trace) const {
    if (positions.empty()) return;
    const std::size_t frames = clip.frame_count(), count = positions.size();
    const double degrees_per_unit = degrees_per_radian / typical_bone_length(clip.skeleton);
    VectorTracks tracks(frames, count);
    SampleMarks gaps(frames, count);
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t position = position_number(clip, positions[n]);
      for (std::size_t t = 0; t < frames; ++t) {
        gaps(t, n) = !clip.is_position_observed(t, position);
        tracks.set(t, n, degrees_per_unit * positions[n].values[t * positions[n].stride]);
      }
    }
    const SampleMarks none(frames, count);
    const CleanedTracks verdicts =
        clean_tracks(tracks, none, gaps, std::vector<std::vector<std::size_t>>(count),
                     clip.frame_rate_hz, {options_.sensitivity, options_.despike});
    for (std::size_t n = 0; n < count; ++n) {
      const ActionTrack actions = position_actions(clip, positions[n], trace);
      if (is_root(clip, positions[n])) trace.root_noise = verdicts.noise[n] / degrees_per_unit;
      for (std::size_t t = 0; t < frames; ++t) {
        const bool spike = verdicts.marked(t, n) != 0;
        if (verdicts.shares[n] == 0 && !spike) continue;
        positions[n].values[t * positions[n].stride] = (1 / degrees_per_unit) * tracks.at(t, n);
        if (spike) actions.values[t * actions.stride] = Action::despiked;
      }
    }
  }

  // 0: the root's, k + 1: of translated joint k.
  static std::size_t position_number(const Clip& clip, const PositionTrack& track) {
    if (is_root(clip, track)) return 0;
    return 1 + static_cast<std::size_t>(track.values - clip.joint_translations.data());
  }

  // The tracks of the joints that are near each joint, where they are cleaned too.
  static std::vector<std::vector<std::size_t>> tracks_nearby(
      const Skeleton& skeleton, const std::vector<std::size_t>& joints) {
    const auto joints_near = joints_nearby(skeleton.parents);
    std::vector<std::vector<std::size_t>> result(joints.size());
    for (std::size_t n = 0; n < joints.size(); ++n) {
      for (const std::size_t other : joints_near[joints[n]]) {
        const auto found = std::lower_bound(joints.begin(), joints.end(), other);
        if (found != joints.end() && *found == other) {
          result[n].push_back(static_cast<std::size_t>(found - joints.begin()));
        }
      }
    }
    return result;
  }

  AutoOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_auto(const AutoOptions& options) {
  table().validate(options);
  return std::make_unique<Auto>(options);
}

Method auto_method() {
  return {"auto",
          "measures each joint's noise, repairs spikes, smooths as much as the noise asks and "
          "leaves clean takes alone",
          "Kinemend; smoothing by evidence after Eilers 2003 and Wahba 1985", table().specs(),
          [](const OptionValues& values) { return make_auto(table().parse(values)); }};
}

}  // namespace kinemend
