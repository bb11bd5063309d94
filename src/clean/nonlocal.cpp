#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "clean/clip_tracks.hpp"
#include "clean/filter_tracks.hpp"
#include "clean/live_frames.hpp"
#include "clean/marker_tracks.hpp"
#include "clean/method_list.hpp"
#include "clean/nonlocal_causal.hpp"
#include "clean/whole_markers.hpp"
#include "kinemend/frame_rate.hpp"
#include "kinemend/methods.hpp"
#include "metrics/track_noise.hpp"
#include "tracks/nonlocal_filter.hpp"

namespace kinemend {

namespace {

// The automatic bandwidth of the causal filter, as a share of the noise.
constexpr double causal_noise_share = 0.8;
// How far the root position is averaged when the window is the whole take: beyond, the body is
// elsewhere.
const double travel_window_s = NonlocalOptions{}.window_s;

const OptionTable<NonlocalOptions>& table() {
  static const OptionTable<NonlocalOptions> result =
      OptionTable<NonlocalOptions>()
          .number(&NonlocalOptions::window_s, "window_s", "s", 0, 60,
                  "whole learning window; 0: the whole take")
          .number(&NonlocalOptions::patch_s, "patch_s", "s", 0, 10, "whole patch")
          .integer(&NonlocalOptions::neighbours, "neighbours", "", 0, 1e6,
                   "average the k most similar poses only; 0: all of the window")
          .number(&NonlocalOptions::bandwidth_deg, "bandwidth_deg", "deg", 0, 180,
                  "difference per channel that makes poses dissimilar; 0: from the noise")
          .choice(&NonlocalOptions::boundary, "boundary", {"neumann", "mirror", "dirichlet"},
                  "beyond the ends: the gradient goes on, time turns back, or the pose is held")
          .flag(&NonlocalOptions::causal, "causal", "past poses only, for live use");
  return result;
}

// Joints that turn at all; all of them where the skeleton names no channels.
std::vector<std::size_t> pose_joints(const Skeleton& skeleton) {
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    const auto& channels = skeleton.channels[j];
    if (std::any_of(channels.begin(), channels.end(), is_rotation)) joints.push_back(j);
  }
  if (!joints.empty()) return joints;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) joints.push_back(j);
  return joints;
}

// Half of a whole window of so many seconds, in frames: 2 r + 1 of them are nearest to it.
std::size_t radius_frames(double seconds, double frame_rate_hz, std::size_t least) {
  const auto radius = std::lround((seconds * window_rate_hz(frame_rate_hz) - 1) / 2);
  return std::max(least, static_cast<std::size_t>(std::max(radius, 0L)));
}

class NonlocalCleaner final : public Cleaner {
 public:
  explicit NonlocalCleaner(const NonlocalOptions& options) : options_(options) {
    table().validate(options);
    if (options.causal && options.window_s == 0) {
      throw Error(ErrorKind::usage, "window_s: 0 (the whole take) is not to be had with causal");
    }
  }

  CleanTrace clean(Clip& clip, const Selection& selection) const override {
    if (options_.causal) return clean_causally(*this, clip, selection);
    CleanTrace trace;
    if (clip.frame_count() < 2) return trace;
    const std::vector<std::size_t> joints = pose_joints(clip.skeleton);
    NonlocalTake take;
    if (clip.observed.empty()) {
      take = make_take(clip, joints, selection);
    } else {
      Clip bridged = clip;  // joints that are not selected belong to the pose, too, but stay
      CleanTrace unused;
      bridge_gaps(bridged, joints, unused);
      take = make_take(bridged, joints, selection);
    }
    NonlocalSettings settings = settings_for(clip.frame_rate_hz);
    if (options_.bandwidth_deg == 0) trace.noise_deg.assign(clip.joint_count(), 0.0);
    if (options_.bandwidth_deg == 0 && !choose_bandwidth(joints, take, settings, trace)) {
      return trace;
    }
    nonlocal_filter(take, settings);
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      for (std::size_t i = 0; i < joints.size(); ++i) {
        if (take.wanted[i]) clip.rotation(f, joints[i]) = take.rotations[i][f];
      }
    }
    const auto tracks = selected_positions(clip, selection);
    for (std::size_t p = 0; p < tracks.size(); ++p) store_positions(take.positions[p], tracks[p]);
    mark_gaps(clip, selected_joints(clip, selection), trace);
    return trace;
  }

  MarkerTrace clean_markers(MarkerClip& clip, const MarkerSelection& selection) const override {
    if (options_.causal) {
      throw Error(ErrorKind::usage, "nonlocal with causal works on joints, not on markers");
    }
    MarkerTrace trace;
    if (clip.frame_count() < 2) return trace;
    // Markers that are not selected belong to the pose, too.
    MarkerSelection everything = selection;
    everything.markers.assign(clip.marker_count(), 1);
    const std::vector<WholeMarker> markers = whole_markers(clip, everything);
    NonlocalTake take;
    for (const WholeMarker& marker : markers) add_point(clip, marker, take);
    NonlocalSettings settings = settings_for(clip.frame_rate_hz);
    settings.bandwidth *= marker_reach(selection.body_height);
    if (options_.bandwidth_deg == 0 && !choose_bandwidth(clip, markers, take, settings, trace)) {
      return trace;
    }
    nonlocal_filter(take, settings);
    for (std::size_t p = 0; p < markers.size(); ++p) {
      const std::size_t m = markers[p].marker;
      if (!marker_selected(clip, selection, m)) continue;
      for (std::size_t f = 0; f < clip.frame_count(); ++f) {
        if (clip.is_observed(f, m)) clip.position(f, m) = take.points[p][f];
      }
    }
    return trace;
  }

  LiveSupport live_support(double frame_rate_hz) const override {
    if (options_.causal) return {LiveSupport::Kind::causal, 0};
    // The noise of a whole take and the whole take itself are not known live.
    if (options_.bandwidth_deg == 0 || options_.window_s == 0) return {};
    const NonlocalSettings settings = settings_for(frame_rate_hz);
    return {LiveSupport::Kind::windowed, settings.window_radius + settings.patch_radius};
  }

  std::unique_ptr<FrameFilter> make_frame_filter(const Skeleton& skeleton,
                                                 double frame_rate_hz) const override {
    if (!options_.causal) return nullptr;
    const NonlocalSettings offline = settings_for(frame_rate_hz);
    CausalNonlocalSettings settings;
    settings.window = 2 * offline.window_radius;
    settings.patch = 2 * offline.patch_radius + 1;
    settings.neighbours = offline.neighbours;
    settings.bandwidth = offline.bandwidth;
    settings.noise_share = causal_noise_share;
    return make_causal_nonlocal(settings, pose_joints(skeleton));
  }

 private:
  NonlocalSettings settings_for(double frame_rate_hz) const {
    NonlocalSettings settings;
    settings.whole_take = options_.window_s == 0;
    settings.window_radius = radius_frames(options_.window_s, frame_rate_hz, 1);
    settings.patch_radius = radius_frames(options_.patch_s, frame_rate_hz, 0);
    settings.neighbours = static_cast<std::size_t>(options_.neighbours);
    settings.bandwidth = options_.bandwidth_deg * radians_per_degree;
    settings.boundary = options_.boundary == "mirror"      ? NonlocalBoundary::mirror
                        : options_.boundary == "dirichlet" ? NonlocalBoundary::dirichlet
                                                           : NonlocalBoundary::neumann;
    settings.travel_radius = settings.whole_take ? radius_frames(travel_window_s, frame_rate_hz, 1)
                                                 : settings.window_radius;
    return settings;
  }

  static NonlocalTake make_take(Clip& clip, const std::vector<std::size_t>& joints,
                                const Selection& selection) {
    NonlocalTake take;
    take.rotations = load_rotations(clip, joints);
    const std::vector<std::size_t> moving = selected_joints(clip, selection);
    for (const std::size_t joint : joints) {
      take.observed.push_back(observed_weights(clip, joint));
      take.wanted.push_back(std::binary_search(moving.begin(), moving.end(), joint));
    }
    for (const PositionTrack& positions : selected_positions(clip, selection)) {
      take.positions.push_back(load_positions(positions, clip.frame_count()));
      take.travels.push_back(positions.values == clip.root_positions.data());
    }
    return take;
  }

  static void add_point(const MarkerClip& clip, const WholeMarker& marker, NonlocalTake& take) {
    const std::size_t frames = clip.frame_count();
    VectorTrack track(frames);
    std::vector<double> observed(frames + lane_room);
    std::size_t seen = 0;
    for (std::size_t f = 0; f < frames; ++f) {
      track.set(f, marker.positions[f]);
      observed[f] = clip.is_observed(f, marker.marker) ? 1 : 0;
      seen += clip.is_observed(f, marker.marker) ? 1 : 0;
    }
    if (seen == frames) observed.clear();
    take.points.push_back(std::move(track));
    take.points_observed.push_back(std::move(observed));
  }

  static bool choose_bandwidth(const MarkerClip& clip, const std::vector<WholeMarker>& markers,
                               const NonlocalTake& take, NonlocalSettings& settings,
                               MarkerTrace& trace) {
    trace.noise.assign(clip.marker_count(), 0.0);
    double sum = 0;
    for (const WholeMarker& marker : markers) {
      const double noise = trace.noise[marker.marker] = observed_noise(clip, marker.marker);
      sum += noise * noise;
    }
    if (sum == 0) return false;
    const double variance = sum / static_cast<double>(markers.size());
    settings.noise_distance = 2 * variance;
    settings.bandwidth = best_bandwidth(take, settings, variance);
    return true;
  }

  // Bandwidth and distance of noise from the take; false when there is no noise to remove.
  static bool choose_bandwidth(const std::vector<std::size_t>& joints, const NonlocalTake& take,
                               NonlocalSettings& settings, CleanTrace& trace) {
    double sum = 0;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      std::vector<Quat> track(take.rotations[i].frames);
      for (std::size_t f = 0; f < track.size(); ++f) track[f] = take.rotations[i][f];
      const double noise = track_noise(track);
      trace.noise_deg[joints[i]] = noise * degrees_per_radian;
      sum += noise * noise;
    }
    if (sum == 0) return false;
    const double variance = sum / static_cast<double>(joints.size());
    settings.noise_distance = 2 * variance;
    settings.bandwidth = best_bandwidth(take, settings, variance);
    return true;
  }

  NonlocalOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_nonlocal(const NonlocalOptions& options) {
  return std::make_unique<NonlocalCleaner>(options);
}

Method nonlocal_method() {
  return {"nonlocal", "averages poses whose surroundings in time are alike",
          "Dean 2016, Non-local Pose Means for Denoising Motion Capture Data", table().specs(),
          [](const OptionValues& values) { return make_nonlocal(table().parse(values)); }};
}

}  // namespace kinemend
