#include <algorithm>

#include "clean/clip_tracks.hpp"
#include "clean/live_frames.hpp"
#include "clean/marker_tracks.hpp"
#include "clean/method_list.hpp"
#include "kinemend/frame_rate.hpp"
#include "kinemend/methods.hpp"
#include "tracks/medians.hpp"

namespace kinemend {

namespace {

const OptionTable<MedianOptions>& table() {
  static const auto options = OptionTable<MedianOptions>().number(
      &MedianOptions::window_s, "window_s", "s", 0.001, 2, "length of the whole window");
  return options;
}

template <class Sample>
using Track = std::span<const Sample>;

// Median of the window about `t`, which shrinks towards the ends and stays centred.
template <class Sample>
Sample inner_median(Track<Sample> track, std::size_t t, std::size_t half,
                    std::vector<Vec3>& scratch) {
  const std::size_t h = std::min({half, t, track.size() - 1 - t});
  if (h == 0) return track[t];
  const auto window = track.subspan(t - h, 2 * h + 1);
  return l1_median(window, medoid(window), scratch);
}

Quat extrapolated(Quat near, Quat far) {
  return normalized(near * exp(2.0 * log(conjugate(far) * near)));
}
Vec3 extrapolated(Vec3 near, Vec3 far) { return near + 2.0 * (near - far); }

// Tukey's rule for the last sample at either end: the median of it, of the median beside it, and of
// the point that the medians beside it lead to.
template <class Sample>
Sample end_median(Sample end, Sample near, Sample far, std::vector<Vec3>& scratch) {
  const Sample three[3] = {end, near, extrapolated(near, far)};
  const Track<Sample> samples(three);
  return l1_median(samples, medoid(samples), scratch);
}

template <class Sample>
Sample median_at(Track<Sample> track, std::size_t t, std::size_t half, std::vector<Vec3>& scratch) {
  const std::size_t last = track.size() - 1;
  if (track.size() < 4 || half == 0 || (t > 0 && t < last)) {
    return inner_median(track, t, half, scratch);
  }
  const std::size_t near = t == 0 ? 1 : last - 1, far = t == 0 ? 2 : last - 2;
  return end_median(track[t], inner_median(track, near, half, scratch),
                    inner_median(track, far, half, scratch), scratch);
}

template <class Sample>
std::vector<Sample> median_track(const std::vector<Sample>& samples, std::size_t half) {
  const Track<Sample> track(samples);
  std::vector<Vec3> scratch;
  MovingMedoid<Sample> medoids(track, 2 * half + 1);
  std::vector<Sample> result(track.size());
  for (std::size_t t = 0; t < track.size(); ++t) {
    const std::size_t h = std::min({half, t, track.size() - 1 - t});
    if (h == 0) {
      result[t] = median_at(track, t, half, scratch);
    } else {
      const std::size_t middle = medoids.find(t - h, t + h);
      result[t] = l1_median(track.subspan(t - h, 2 * h + 1), middle - (t - h), scratch);
    }
  }
  return result;
}

class Median final : public Cleaner {
 public:
  explicit Median(const MedianOptions& options) : options_(options) {}

  CleanTrace clean(Clip& clip, const Selection& selection) const override {
    CleanTrace trace;
    const std::vector<std::size_t> joints = selected_joints(clip, selection);
    const auto positions = selected_positions(clip, selection);
    bridge_gaps(clip, joints, trace);
    const std::size_t half = half_frames(clip.frame_rate_hz), frames = clip.frame_count();
    for_each_parallel(joints.size() + positions.size(), joints.size() * frames, [&](std::size_t i) {
      if (i < joints.size()) {
        set_joint_track(clip, joints[i], median_track(joint_track(clip, joints[i]), half));
      } else {
        const PositionTrack& track = positions[i - joints.size()];
        set_position_track(track, median_track(position_track(track, frames), half));
      }
    });
    return trace;
  }

  MarkerTrace clean_markers(MarkerClip& clip, const MarkerSelection& selection) const override {
    const std::size_t half = half_frames(clip.frame_rate_hz);
    return filter_marker_paths(clip, selection, [half](MarkerPath& path) {
      path.positions = median_track(path.positions, half);
    });
  }

  LiveSupport live_support(double rate_hz) const override {
    // The ends look at the medians of the two frames beside them.
    const std::size_t half = half_frames(rate_hz);
    const std::size_t end = half == 0 ? 0 : half == 1 ? 3 : 4;
    return {LiveSupport::Kind::windowed, std::max(half, end)};
  }

  LiveFrame clean_frame(const Clip& window, std::size_t frame) const override {
    Clip copy = window;
    CleanTrace trace;
    const Selection all = Selection::all(copy);
    const std::vector<std::size_t> joints = selected_joints(copy, all);
    bridge_gaps(copy, joints, trace);
    const std::size_t half = half_frames(copy.frame_rate_hz), frames = copy.frame_count();
    std::vector<Vec3> scratch;
    for (const std::size_t j : joints) {
      const std::vector<Quat> track = joint_track(copy, j);
      copy.rotation(frame, j) = median_at(Track<Quat>(track), frame, half, scratch);
    }
    for (const PositionTrack& positions : selected_positions(copy, all)) {
      const std::vector<Vec3> track = position_track(positions, frames);
      positions.values[frame * positions.stride] =
          median_at(Track<Vec3>(track), frame, half, scratch);
    }
    return frame_of(copy, frame);
  }

 private:
  std::size_t half_frames(double rate_hz) const {
    return frames_in(options_.window_s / 2, window_rate_hz(rate_hz), 1);
  }

  MedianOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_median(const MedianOptions& options) {
  table().validate(options);
  return std::make_unique<Median>(options);
}

Method median_method() {
  return {"median", "running median: removes short spikes and keeps edges",
          "Tukey 1977; the median of rotations is Hartley et al.'s L1 mean (2011)", table().specs(),
          [](const OptionValues& values) { return make_median(table().parse(values)); }};
}

}  // namespace kinemend
