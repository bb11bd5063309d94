// The method `nonlocal`: chooses poses, bandwidth and window for the non-local means of a take.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "cleaner/lanes.hpp"
#include "cleaner/live.hpp"
#include "cleaner/windowed.hpp"
#include "kinemend/experimental/frame_rate.hpp"
#include "kinemend/methods.hpp"
#include "metrics/track_noise.hpp"
#include "papers/dean2016_nonlocal/entries.hpp"
#include "papers/dean2016_nonlocal/nonlocal_causal.hpp"
#include "papers/dean2016_nonlocal/nonlocal_filter.hpp"

namespace kinemend {

namespace {

// Range over which the root position is averaged when the window is the whole take: beyond it, the
// body is elsewhere.
const double travel_window_s = NonlocalOptions{}.window_s;

const OptionTable<NonlocalOptions>& nonlocal_table() {
  static const OptionTable<NonlocalOptions> result =
      OptionTable<NonlocalOptions>()
          .number(&NonlocalOptions::window_s, "window_s", "s", 0, 60,
                  "length of the window that is searched for similar poses; 0: the whole take")
          .number(&NonlocalOptions::patch_s, "patch_s", "s", 0, 10,
                  "length of the stretch of motion (patch) that is compared")
          .integer(&NonlocalOptions::neighbours, "neighbours", "", 0, 1e6,
                   "number of similar poses that are averaged; 0: all poses of the window")
          .number(&NonlocalOptions::bandwidth_deg, "bandwidth_deg", "deg", 0, 180,
                  "difference per channel beyond which poses count little; 0: from the noise")
          .choice(&NonlocalOptions::boundary, "boundary", {"neumann", "mirror", "dirichlet"},
                  "padding at the ends: neumann continues the motion, mirror runs back in time, "
                  "dirichlet holds the pose")
          .flag(&NonlocalOptions::causal, "causal", "use past poses only, for live use");
  return result;
}

// Joints with rotation channels; all joints if the skeleton names no channels.
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

// Half of a window of `seconds`, in frames: 2 r + 1 is nearest to the window.
std::size_t radius_frames(double seconds, double frame_rate_hz, std::size_t least) {
  const auto radius = std::lround((seconds * window_rate_hz(frame_rate_hz) - 1) / 2);
  return std::max(least, static_cast<std::size_t>(std::max(radius, 0L)));
}

// Poses are compared as a whole: each frame is cleaned by running the method on its window.
class NonlocalWindow final : public WindowedFilter {
 public:
  NonlocalWindow(const Cleaner& cleaner, const TakeView& like, std::size_t half)
      : WindowedFilter(like, half), cleaner_(cleaner) {}

 private:
  void clean(std::size_t frame, bool /*has_stepped*/, Frame& out) override {
    const TakeView& take = window();
    const auto sink = [&](std::size_t track, const CleanedTrack& cleaned) {
      const Track& source = take.tracks[track];
      if (source.space == Space::rotation) {
        out.rotations[track] = cleaned.rotations[frame];
      } else if (take.gaps == GapTreatment::bridge || source.is_observed(frame)) {
        position_in(take, track, out) = cleaned.positions[frame];
      }
    };
    cleaner_.clean(take, sink, {});
  }

  const Cleaner& cleaner_;
};

class NonlocalCleaner final : public Cleaner {
 public:
  explicit NonlocalCleaner(const NonlocalOptions& options) : options_(options) {
    nonlocal_table().validate(options);
    if (options.causal && options.window_s == 0) {
      throw Error(ErrorKind::usage, "window_s: 0 (the whole take) is not to be had with causal");
    }
  }

  std::string_view name() const override { return "nonlocal"; }
  OptionValues options() const override { return nonlocal_table().values(options_); }

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& progress) const override {
    if (options_.causal) return clean_as_live(*this, take, sink, progress);
    CleanTrace trace;
    if (take.frames < 2) return trace;
    Pose pose = pose_of(take);
    NonlocalSettings settings = settings_for(take.frame_rate_hz);
    if (take.markers) settings.bandwidth *= radian_of_positions(take);
    if (options_.bandwidth_deg == 0 && !choose_bandwidth(take, pose, settings, trace)) return trace;
    nonlocal_filter(pose.take, settings);
    for (std::size_t i = 0; i < pose.rotations.size(); ++i) {
      if (pose.take.wanted[i])
        sink(pose.rotations[i], result_of(take, pose.rotations[i], pose.take.rotations[i]));
    }
    for (std::size_t i = 0; i < pose.positions.size(); ++i)
      sink(pose.positions[i], result_of(pose.take.positions[i]));
    for (std::size_t i = 0; i < pose.points.size(); ++i) {
      if (take.tracks[pose.points[i]].selected)
        sink(pose.points[i], result_of(pose.take.points[i]));
    }
    return trace;
  }

  LiveSupport live_support(double frame_rate_hz) const override {
    // Live use cannot measure the noise of a whole take or search the whole take.
    const bool is_windowed = options_.bandwidth_deg > 0 && options_.window_s > 0;
    return options_.causal || is_windowed ? LiveSupport{} : Cleaner::live_support(frame_rate_hz);
  }

  std::unique_ptr<LiveFilter> live(const TakeView& like) const override {
    if (!live_support(like.frame_rate_hz).runs()) return Cleaner::live(like);
    const NonlocalSettings offline = settings_for(like.frame_rate_hz);
    if (!options_.causal)
      return std::make_unique<NonlocalWindow>(*this, like,
                                              offline.window_radius + offline.patch_radius);
    if (!like.joints)
      throw Error(ErrorKind::usage, "nonlocal with causal works on joints, not on markers");
    CausalNonlocalSettings settings;
    settings.window = 2 * offline.window_radius;
    settings.patch = 2 * offline.patch_radius + 1;
    settings.neighbours = offline.neighbours;
    settings.bandwidth = offline.bandwidth;
    return make_causal_nonlocal(settings, pose_joints(like.joints->skeleton));
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

  // All tracks of the pose, selected or not, with their numbers.
  struct Pose {
    NonlocalTake take;
    std::vector<std::size_t> rotations, positions, points;
  };

  static Pose pose_of(const TakeView& take) {
    return take.joints ? pose_of_joints(take) : pose_of_markers(take);
  }

  static Pose pose_of_joints(const TakeView& take) {
    Pose pose;
    pose.rotations = pose_joints(take.joints->skeleton);
    const std::vector<std::size_t> changeable = changeable_tracks(take);
    for (const std::size_t joint : pose.rotations) {
      const Piece<Quat> piece = rotation_piece(take, joint);
      pose.take.rotations.push_back(to_lanes(piece.samples));
      pose.take.observed.push_back(lane_weights(piece));
      pose.take.wanted.push_back(std::binary_search(changeable.begin(), changeable.end(), joint));
    }
    for (const std::size_t track : changeable) {
      if (take.tracks[track].space != Space::position) continue;
      pose.positions.push_back(track);
      pose.take.positions.push_back(to_lanes(position_pieces(take, track).front().samples));
      pose.take.travels.push_back(track == take.root_track());
    }
    return pose;
  }

  static Pose pose_of_markers(const TakeView& take) {
    Pose pose;
    for (std::size_t m = 0; m < take.owners; ++m) {
      if (!take.markers->holds_positions(m)) continue;
      const std::vector<Vec3> positions = whole_positions(take, m);
      if (positions.empty()) continue;
      pose.points.push_back(m);
      pose.take.points.push_back(to_lanes(positions));
      pose.take.points_observed.push_back(lane_weights(observed_of(take.tracks[m])));
    }
    return pose;
  }

  static CleanedTrack result_of(const VectorTrack& track) {
    CleanedTrack cleaned;
    cleaned.positions.reserve(track.frames);
    for (std::size_t f = 0; f < track.frames; ++f) cleaned.positions.push_back(track[f]);
    return cleaned;
  }

  static CleanedTrack result_of(const TakeView& take, std::size_t number,
                                const RotationTrack& track) {
    Piece<Quat> piece{number, 0, {}, observed_of(take.tracks[number]), {}};
    for (std::size_t f = 0; f < track.frames; ++f) piece.samples.push_back(track[f]);
    return assemble(std::move(piece));
  }

  // Sets bandwidth and distance of noise from the take; false if there is no noise to remove.
  static bool choose_bandwidth(const TakeView& take, const Pose& pose, NonlocalSettings& settings,
                               CleanTrace& trace) {
    trace.noise.assign(take.tracks.size(), 0.0);
    double sum = 0;
    for (std::size_t i = 0; i < pose.rotations.size(); ++i) {
      const RotationTrack& lanes = pose.take.rotations[i];
      std::vector<Quat> track(lanes.frames);
      for (std::size_t f = 0; f < track.size(); ++f) track[f] = lanes[f];
      const double noise = track_noise(track);
      trace.noise[pose.rotations[i]] = noise * degrees_per_radian;
      sum += noise * noise;
    }
    for (const std::size_t track : pose.points) {
      const double noise = trace.noise[track] = track_noise(observed_positions(take, track));
      sum += noise * noise;
    }
    if (sum == 0) return false;
    const double variance = sum / static_cast<double>(pose.rotations.size() + pose.points.size());
    settings.noise_distance = 2 * variance;
    settings.bandwidth = best_bandwidth(pose.take, settings, variance);
    return true;
  }

  NonlocalOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_nonlocal(const NonlocalOptions& options) {
  return std::make_unique<NonlocalCleaner>(options);
}

Method nonlocal_method() {
  return {"nonlocal", "averages poses that occur in similar stretches of motion",
          "Dean 2016, Non-local Pose Means for Denoising Motion Capture Data",
          nonlocal_table().specs(),
          [](const OptionValues& values) { return make_nonlocal(nonlocal_table().parse(values)); }};
}

}  // namespace kinemend
