#include <algorithm>
#include <cmath>

#include "clean/clip_tracks.hpp"
#include "clean/live_frames.hpp"
#include "clean/marker_tracks.hpp"
#include "clean/method_list.hpp"
#include "kinemend/methods.hpp"
#include "metrics/track_noise.hpp"
#include "tracks/track_kalman.hpp"

namespace kinemend {

namespace {

const OptionTable<KalmanOptions>& table() {
  static const auto options =
      OptionTable<KalmanOptions>()
          .choice(&KalmanOptions::model, "model", {"position", "velocity"},
                  "what stays about constant from frame to frame")
          .flag(&KalmanOptions::smoother, "smoother",
                "uses the whole take; off: the past only, which also runs live")
          .number(&KalmanOptions::noise_deg, "noise_deg", "deg", 0, 45,
                  "noise of a sample per axis; 0: estimated")
          .number(&KalmanOptions::agility, "agility", "", 0.01, 100,
                  "process noise relative to that of everyday motion: larger follows more closely");
  return options;
}

// Standard deviations of the driving noise of everyday motion: chosen so that 1.5 degrees of noise
// at 120 Hz are smoothed at about 8 Hz.
constexpr double acceleration_noise = 9.0;  // rad / s^1.5
constexpr double velocity_noise = 0.2;      // rad / s^0.5
constexpr double least_noise = 1e-7;        // rad

// `scale` is 1 for rotations, the typical bone length for positions.
KalmanModel model_for(const KalmanOptions& options, double rate_hz, double scale) {
  KalmanModel model;
  model.with_velocity = options.model == "velocity";
  model.frame_step_s = 1 / rate_hz;
  const double density =
      options.agility * scale * (model.with_velocity ? acceleration_noise : velocity_noise);
  model.process_density = density * density;
  return model;
}

// The running median of second differences, on a logarithmic scale.
class NoiseMeter {
 public:
  explicit NoiseMeter(double start) : noise_(start) {}

  template <class Sample>
  double measure(Sample a, Sample b, Sample c) {
    constexpr double rate = 0.05;
    const double sample = second_difference(a, b, c) * noise_per_second_difference;
    noise_ *= sample > noise_ ? 1 + rate : 1 / (1 + rate);
    noise_ = std::max(noise_, least_);
    return noise_;
  }
  double noise() const { return noise_; }

 private:
  double noise_;
  double least_ = noise_ * 1e-5;
};

// The causal filter of one track. Noise that is not given is measured on the way.
template <class Sample>
class LiveTrack {
 public:
  LiveTrack(const KalmanModel& model, double noise, double scale)
      : model_(model), scale_(scale), fixed_noise_(noise), meter_(radians_per_degree * scale) {}

  Sample step(Sample sample, bool seen) {
    if (!started_ && !seen) return sample;
    if (!started_) {
      started_ = true;
      before_ = last_ = sample;
      count_ = 1;
      state_ = start_state(sample, noise(), scale_);
      return sample;
    }
    state_ = predict(state_, model_);
    if (seen) {
      if (++count_ > 2) meter_.measure(before_, last_, sample);
      before_ = last_;
      last_ = sample;
      update(state_, sample, noise() * noise());
    }
    return state_.x;
  }

 private:
  double noise() const { return fixed_noise_ > 0 ? fixed_noise_ : meter_.noise(); }

  KalmanModel model_;
  double scale_, fixed_noise_;
  NoiseMeter meter_;
  TrackState<Sample> state_;
  Sample before_, last_;
  std::size_t count_ = 0;
  bool started_ = false;
};

class Kalman final : public Cleaner {
 public:
  explicit Kalman(const KalmanOptions& options) : options_(options) {}

  CleanTrace clean(Clip& clip, const Selection& selection) const override {
    if (!options_.smoother) return clean_causally(*this, clip, selection);
    CleanTrace trace;
    const std::vector<std::size_t> joints = selected_joints(clip, selection);
    const auto positions = selected_positions(clip, selection);
    mark_gaps(clip, joints, trace);
    trace.noise_deg.assign(clip.joint_count(), 0);
    const std::size_t frames = clip.frame_count();
    for_each_parallel(joints.size() + positions.size(), joints.size() * frames, [&](std::size_t i) {
      if (i < joints.size()) {
        smooth_joint(clip, joints[i], trace);
      } else {
        smooth_positions(clip, positions[i - joints.size()]);
      }
    });
    return trace;
  }

  MarkerTrace clean_markers(MarkerClip& clip, const MarkerSelection& selection) const override {
    if (!options_.smoother) return clean_markers_causally(*this, clip, selection);
    const double reach = marker_reach(selection.body_height);
    const KalmanModel model = model_for(options_, clip.frame_rate_hz, reach);
    const std::vector<double> noise = marker_noise(clip, selection, reach);
    MarkerTrace trace = filter_marker_paths(clip, selection, [&](MarkerPath& path) {
      path.positions =
          kalman_smooth<Vec3>(path.positions, path.observed,
                              std::max(noise[path.marker], least_noise * reach), reach, model);
    });
    trace.noise = noise;
    return trace;
  }

  LiveSupport live_support(double) const override {
    if (options_.smoother) return {};
    return {LiveSupport::Kind::causal, 0};
  }

  std::unique_ptr<FrameFilter> make_frame_filter(const Skeleton& skeleton,
                                                 double rate_hz) const override {
    if (options_.smoother) return nullptr;
    using Filter = TrackFrameFilter<LiveTrack<Quat>, LiveTrack<Vec3>>;
    const double bone = typical_bone_length(skeleton);
    return std::make_unique<Filter>(skeleton,
                                    LiveTrack<Quat>(model_for(options_, rate_hz, 1),
                                                    options_.noise_deg * radians_per_degree, 1),
                                    LiveTrack<Vec3>(model_for(options_, rate_hz, bone), 0, bone));
  }

  std::unique_ptr<MarkerFilter> make_marker_filter(const MarkerClip& like,
                                                   double body_height) const override {
    if (options_.smoother) return nullptr;
    const double reach = marker_reach(body_height);
    return std::make_unique<TrackMarkerFilter<LiveTrack<Vec3>>>(
        like, LiveTrack<Vec3>(model_for(options_, like.frame_rate_hz, reach),
                              options_.noise_deg * radians_per_degree * reach, reach));
  }

 private:
  // Of each marker, from all of its observed samples.
  std::vector<double> marker_noise(const MarkerClip& clip, const MarkerSelection& selection,
                                   double reach) const {
    const double given = options_.noise_deg * radians_per_degree * reach;
    std::vector<double> noise(clip.marker_count());
    for_each_parallel(noise.size(), clip.positions.size(), [&](std::size_t m) {
      if (!marker_selected(clip, selection, m)) return;
      noise[m] = given > 0 ? given : observed_noise(clip, m);
    });
    return noise;
  }

  void smooth_joint(Clip& clip, std::size_t joint, CleanTrace& trace) const {
    const std::vector<Quat> track = joint_track(clip, joint);
    std::vector<Quat> seen;
    std::vector<std::uint8_t> observed;
    if (!clip.observed.empty()) {
      for (std::size_t f = 0; f < track.size(); ++f) {
        observed.push_back(clip.is_observed(f, joint));
        if (observed.back()) seen.push_back(track[f]);
      }
    }
    const double given = options_.noise_deg * radians_per_degree;
    const double noise = given > 0 ? given : track_noise(observed.empty() ? track : seen);
    trace.noise_deg[joint] = noise * degrees_per_radian;
    const KalmanModel model = model_for(options_, clip.frame_rate_hz, 1);
    set_joint_track(clip, joint,
                    kalman_smooth<Quat>(track, observed, std::max(noise, least_noise), 1, model));
  }

  void smooth_positions(const Clip& clip, const PositionTrack& positions) const {
    const double scale = typical_bone_length(clip.skeleton);
    const std::vector<Vec3> track = position_track(positions, clip.frame_count());
    const double noise = std::max(track_noise(track), least_noise * scale);
    const KalmanModel model = model_for(options_, clip.frame_rate_hz, scale);
    set_position_track(positions, kalman_smooth<Vec3>(track, {}, noise, scale, model));
  }

  KalmanOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_kalman(const KalmanOptions& options) {
  table().validate(options);
  return std::make_unique<Kalman>(options);
}

Method kalman_method() {
  return {"kalman", "model of steady motion, as smoother or as live filter",
          "Kalman 1960; Rauch, Tung & Striebel 1965; baseline of Lou & Chai 2010", table().specs(),
          [](const OptionValues& values) { return make_kalman(table().parse(values)); }};
}

}  // namespace kinemend
