// The method `kalman`: a smoother of each track that assumes steady motion, and its causal filter.
#include <algorithm>
#include <cmath>

#include "classic/track_kalman.hpp"
#include "cleaner/live.hpp"
#include "kinemend/extend/method_options.hpp"
#include "metrics/track_noise.hpp"

namespace kinemend {

namespace {

const OptionTable<KalmanOptions>& kalman_table() {
  static const auto options =
      OptionTable<KalmanOptions>()
          .choice(&KalmanOptions::model, "model", {"position", "velocity"},
                  "the quantity that is assumed to change little from frame to frame")
          .flag(&KalmanOptions::smoother, "smoother",
                "use the whole take; off: past frames only, which can run live")
          .number(&KalmanOptions::noise_deg, "noise_deg", "deg", 0, 45,
                  "standard deviation of the noise per axis; 0: estimated from the take")
          .number(
              &KalmanOptions::agility, "agility", "", 0.01, 100,
              "how quickly the motion may change, 1: everyday motion; larger follows more closely");
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
    // Relative change of the estimate with each sample. Chosen by hand, not swept.
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

// The causal filter of one track. Noise that is not given is measured while filtering.
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

  std::string_view name() const override { return "kalman"; }
  OptionValues options() const override { return kalman_table().values(options_); }

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& progress) const override {
    if (!options_.smoother) return clean_as_live(*this, take, sink, progress);
    CleanTrace trace;
    const std::vector<double> levels = noise_of(take);
    trace.noise = levels;
    for (std::size_t n = 0; n < levels.size(); ++n) {
      if (take.tracks[n].space == Space::rotation) trace.noise[n] *= degrees_per_radian;
    }
    filter_pieces(take, sink, progress, [&]<class Sample>(Piece<Sample>& piece) {
      const double radian = take.tracks[piece.track].radian;
      const double noise = std::max(levels[piece.track], least_noise * radian);
      piece.samples = kalman_smooth<Sample>(piece.samples, piece.observed, noise, radian,
                                            model_for(options_, take.frame_rate_hz, radian));
    });
    return trace;
  }

  LiveSupport live_support(double frame_rate_hz) const override {
    return options_.smoother ? Cleaner::live_support(frame_rate_hz) : LiveSupport{};
  }

  std::unique_ptr<LiveFilter> live(const TakeView& like) const override {
    if (options_.smoother) return Cleaner::live(like);
    const double rate_hz = like.frame_rate_hz, reach = radian_of_positions(like);
    return causal_filter(
        like,
        LiveTrack<Quat>(model_for(options_, rate_hz, 1), options_.noise_deg * radians_per_degree,
                        1),
        LiveTrack<Vec3>(model_for(options_, rate_hz, reach),
                        like.joints ? 0 : options_.noise_deg * radians_per_degree * reach, reach));
  }

 private:
  // The noise of each track from all its observed samples: radians or file units. The option does
  // not apply to positions of joints.
  std::vector<double> noise_of(const TakeView& take) const {
    std::vector<double> noise(take.tracks.size());
    const std::vector<std::size_t> tracks = changeable_tracks(take);
    for_each_parallel(tracks.size(), tracks.size() * take.frames, [&](std::size_t i) {
      const Track& track = take.tracks[tracks[i]];
      const double given = options_.noise_deg * radians_per_degree * track.radian;
      if (track.space == Space::rotation) {
        noise[tracks[i]] = given > 0 ? given : track_noise(observed_rotations(take, tracks[i]));
      } else {
        noise[tracks[i]] =
            given > 0 && take.markers ? given : track_noise(observed_positions(take, tracks[i]));
      }
    });
    return noise;
  }

  KalmanOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_kalman(const KalmanOptions& options) {
  kalman_table().validate(options);
  return std::make_unique<Kalman>(options);
}

Method kalman_method() {
  return {"kalman", "Kalman smoother or live filter that assumes steady motion",
          "Kalman 1960; Rauch, Tung & Striebel 1965; baseline of Lou & Chai 2010",
          kalman_table().specs(),
          [](const OptionValues& values) { return make_kalman(kalman_table().parse(values)); }};
}

}  // namespace kinemend
