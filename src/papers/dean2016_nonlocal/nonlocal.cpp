// Defines the method `nonlocal`, which chooses poses, bandwidth and window for the non-local means
// of a take. Its live form averages each new pose with similar ones among the last poses.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "cleaner/live.hpp"
#include "cleaner/method_row.hpp"
#include "cleaner/pieces.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/rotation.hpp"
#include "metrics/track_noise.hpp"
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

// Non-local pose means of the past only: patches end at their pose, and only earlier poses are
// averaged.
struct CausalNonlocalSettings {
  std::size_t window = 20;     // earlier poses
  std::size_t patch = 11;      // poses of a patch
  std::size_t neighbours = 0;  // only the most similar patches; 0: all of the window
  // The paper's sigma, radians; 0: `noise_share` times the noise measured in the frames so far.
  double bandwidth = 0;
  double noise_share = 0.8;  // chosen by hand (docs/details/nonlocal.md); no sweep is stored
};

// The noise of the frames so far, from second differences of whole poses: their median over frames
// ignores the few frames with a jump.
class RunningNoise {
 public:
  // Sum over joints of the squared second difference of three successive poses.
  void add(double squared_difference, std::size_t joints) {
    // The mean is 3 channels x 6 noise^2 a joint; the median of a chi-square distribution of n
    // degrees is about n (1 - 2 / (9 n))^3.
    const double degrees = 3 * static_cast<double>(joints);
    const double median_share = portable::pow(1 - 2 / (9 * degrees), 3);
    values_[count_++ % most_frames] = squared_difference / (6 * degrees * median_share);
  }
  bool known() const { return count_ >= least_frames; }
  double variance() {
    sorted_.assign(values_.begin(),
                   values_.begin() + static_cast<std::ptrdiff_t>(std::min(count_, most_frames)));
    return upper_median_of(sorted_);
  }

 private:
  // Fewest frames before the noise is known, and the number over which it is measured. Chosen by
  // hand, not swept.
  static constexpr std::size_t least_frames = 8;
  static constexpr std::size_t most_frames = 256;
  std::size_t count_ = 0;
  std::vector<double> values_ = std::vector<double>(most_frames);  // a ring
  std::vector<double> sorted_;
};

// A ring of the last items, the newest first. Their memory is reused.
template <class T>
class Latest {
 public:
  explicit Latest(std::size_t most) : things_(most) {}
  std::size_t size() const { return std::min(count_, things_.size()); }
  // Returns a place for a new item, overwriting the oldest.
  T& add() { return things_[count_++ % things_.size()]; }
  // 0 is the newest.
  T& operator[](std::size_t age) { return things_[(count_ - 1 - age) % things_.size()]; }
  const T& operator[](std::size_t age) const {
    return things_[(count_ - 1 - age) % things_.size()];
  }

 private:
  std::vector<T> things_;
  std::size_t count_ = 0;
};

// The root position is unchanged: earlier places of a body do not determine its present one.
class CausalNonlocal final : public LiveFilter {
 public:
  // `joints`: those that belong to the pose.
  CausalNonlocal(const CausalNonlocalSettings& settings, std::vector<std::size_t> joints)
      : settings_(settings),
        joints_(std::move(joints)),
        past_(settings.window + 1),
        distances_(std::max<std::size_t>(settings.patch, 1)) {}

  std::size_t lookahead() const override { return 0; }

  bool push(const Frame& in, Frame& out) override {
    remember(in);
    find_weights();
    out = in;
    const Frame& present = past_[0];
    for (const std::size_t joint : joints_)
      out.rotations[joint] = present.rotations[joint] * exp(mean_turn(joint));
    for (std::size_t i = 1; i < out.positions.size(); ++i)
      out.positions[i] = present.positions[i] + mean_move(i);
    return true;
  }

  bool flush(Frame&) override { return false; }

 private:
  // For one frame and each lag: the sum of squared angles to the frame that long ago, over joints
  // measured in both.
  struct Distances {
    std::vector<double> sums, pairs;
  };

  // Adds the frame to the past ones. Unmeasured rotations are held.
  void remember(const Frame& frame) {
    past_.add() = frame;
    for (const std::size_t joint : joints_) {
      if (past_.size() > 1 && !frame.is_observed(joint)) {
        past_[0].rotations[joint] = past_[1].rotations[joint];
      }
    }
    Distances& row = distances_.add();
    row.sums.clear();
    row.pairs.clear();
    for (std::size_t lag = 1; lag < past_.size(); ++lag) {
      double sum = 0, pairs = 0;
      for (const std::size_t joint : joints_) {
        if (!frame.is_observed(joint) || !past_[lag].is_observed(joint)) continue;
        const double angle = angle_between(frame.rotations[joint], past_[lag].rotations[joint]);
        sum += angle * angle;
        pairs += 1;
      }
      row.sums.push_back(sum);
      row.pairs.push_back(pairs);
    }
    if (past_.size() >= 3) measure_noise();
  }

  void measure_noise() {
    double sum = 0;
    std::size_t count = 0;
    for (const std::size_t joint : joints_) {
      if (!past_[0].is_observed(joint) || !past_[1].is_observed(joint) ||
          !past_[2].is_observed(joint)) {
        continue;
      }
      const Quat middle = conjugate(past_[1].rotations[joint]);
      const Vec3 bend =
          log(middle * past_[0].rotations[joint]) + log(middle * past_[2].rotations[joint]);
      sum += dot(bend, bend);
      ++count;
    }
    if (count > 0) noise_.add(sum, count);
  }

  // sum_s w_s Log(q^-1 q_s) / (1 + sum_s w_s) over the measured samples.
  Vec3 mean_turn(std::size_t joint) const {
    const Quat present = conjugate(past_[0].rotations[joint]);
    Vec3 sum;
    double total = past_[0].is_observed(joint) ? 1 : 0;
    for (std::size_t lag = 1; lag <= weights_.size(); ++lag) {
      const double weight = weights_[lag - 1];
      if (weight == 0 || !past_[lag].is_observed(joint)) continue;
      sum += weight * log(present * past_[lag].rotations[joint]);
      total += weight;
    }
    return total > 0 ? (1 / total) * sum : Vec3{};
  }

  Vec3 mean_move(std::size_t column) const {
    Vec3 sum;
    double total = 1;
    for (std::size_t lag = 1; lag <= weights_.size(); ++lag) {
      sum += weights_[lag - 1] * (past_[lag].positions[column] - past_[0].positions[column]);
      total += weights_[lag - 1];
    }
    return (1 / total) * sum;
  }

  // Mean squared difference per channel of the patches that end now and `lag` frames ago.
  double patch_distance(std::size_t lag) const {
    double sum = 0, pairs = 0;
    for (std::size_t age = 0; age < distances_.size(); ++age) {
      const Distances& row = distances_[age];
      if (row.sums.size() < lag) break;
      sum += row.sums[lag - 1];
      pairs += row.pairs[lag - 1];
    }
    return pairs > 0 ? sum / (3 * pairs) : std::numeric_limits<double>::infinity();
  }

  void find_weights() {
    const bool automatic = settings_.bandwidth == 0;
    const double variance = automatic && noise_.known() ? noise_.variance() : 0;
    weights_.clear();
    if (automatic && variance == 0) return;
    for (std::size_t lag = 1; lag < past_.size(); ++lag) weights_.push_back(patch_distance(lag));
    keep_nearest(weights_);
    const double bandwidth2 = automatic ? settings_.noise_share * settings_.noise_share * variance
                                        : settings_.bandwidth * settings_.bandwidth;
    double floor = 2 * variance;
    if (!automatic && !weights_.empty())
      floor = *std::min_element(weights_.begin(), weights_.end());
    if (std::isinf(floor)) floor = 0;
    for (double& value : weights_) {
      value = portable::exp(-std::max(0.0, value - floor) / (2 * bandwidth2));
    }
  }

  void keep_nearest(std::vector<double>& distances) {
    if (settings_.neighbours == 0 || settings_.neighbours >= distances.size()) return;
    sorted_ = distances;
    const double limit = of_rank(sorted_, settings_.neighbours - 1);
    for (double& value : distances) {
      if (value > limit) value = std::numeric_limits<double>::infinity();
    }
  }

  CausalNonlocalSettings settings_;
  std::vector<std::size_t> joints_;
  RunningNoise noise_;
  Latest<Frame> past_;           // the present frame first
  Latest<Distances> distances_;  // of the frames of a patch, the present one first
  std::vector<double> weights_;  // of the poses 1, 2, ... frames ago; the present one has weight 1
  std::vector<double> sorted_;
};

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

class NonlocalCleaner final : public OptionedCleaner<NonlocalOptions> {
 public:
  explicit NonlocalCleaner(const NonlocalOptions& options)
      : OptionedCleaner("nonlocal", nonlocal_table(), options) {
    if (options.causal && options.window_s == 0) {
      throw Error(ErrorKind::usage,
                  "window_s: 0 means the whole take, and causal needs a window of the past");
    }
  }

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
    return std::make_unique<CausalNonlocal>(settings, pose_joints(like.joints->skeleton));
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
};

}  // namespace

std::unique_ptr<Cleaner> make_nonlocal(const NonlocalOptions& options) {
  return std::make_unique<NonlocalCleaner>(options);
}

Method nonlocal_method() {
  return method_row<nonlocal_table, make_nonlocal>(
      "nonlocal", "averages poses that occur in similar stretches of motion",
      "Dean 2016, Non-local Pose Means for Denoising Motion Capture Data");
}

}  // namespace kinemend
