// The method `one-euro`: a causal low-pass filter whose cutoff grows with the speed.
#include "classic/filter_channels.hpp"
#include "classic/track_kalman.hpp"
#include "cleaner/live.hpp"
#include "kinemend/extend/method_options.hpp"

namespace kinemend {

namespace {

const OptionTable<OneEuroOptions>& one_euro_table() {
  static const auto options =
      OptionTable<OneEuroOptions>()
          .number(&OneEuroOptions::min_cutoff_hz, "min_cutoff_hz", "Hz", 0.01, 100,
                  "cutoff at rest; a lower one steadies held poses more")
          .number(
              &OneEuroOptions::speed_coefficient, "speed_coefficient", "", 0, 1000,
              "increase of the cutoff with speed, Hz per radian/s; a higher one delays motion less")
          .number(&OneEuroOptions::speed_cutoff_hz, "speed_cutoff_hz", "Hz", 0.01, 100,
                  "cutoff of the low-pass filter on the measured speed");
  return options;
}

// Weight of the new sample in an exponential mean of this cutoff.
double smoothing(double cutoff_hz, double rate_hz) {
  const double time_constant_s = 1 / (2 * pi * cutoff_hz);
  return 1 / (1 + time_constant_s * rate_hz);
}

template <class Sample>
class OneEuroTrack {
 public:
  // `scale`: the distance that corresponds to one radian.
  OneEuroTrack(const OneEuroOptions& options, double rate_hz, double scale)
      : options_(options), rate_hz_(rate_hz), scale_(scale) {}

  Sample step(Sample sample, bool seen) {
    if (!seen) return started_ ? smooth_ : sample;
    if (!started_) {
      started_ = true;
      return last_ = smooth_ = sample;
    }
    const Vec3 velocity = rate_hz_ * minus(sample, last_);
    last_ = sample;
    const double share = smoothing(options_.speed_cutoff_hz, rate_hz_);
    velocity_ = (1 - share) * velocity_ + share * velocity;
    const double speed = norm(velocity_) / scale_;
    const double cutoff_hz = options_.min_cutoff_hz + options_.speed_coefficient * speed;
    return smooth_ = plus(smooth_, smoothing(cutoff_hz, rate_hz_) * minus(sample, smooth_));
  }

 private:
  OneEuroOptions options_;
  double rate_hz_, scale_;
  Sample last_, smooth_;
  Vec3 velocity_;
  bool started_ = false;
};

class OneEuro final : public Cleaner {
 public:
  explicit OneEuro(const OneEuroOptions& options) : options_(options) {}

  std::string_view name() const override { return "one-euro"; }
  OptionValues options() const override { return one_euro_table().values(options_); }

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& progress) const override {
    CleanTrace trace = clean_as_live(*this, take, sink, progress);
    if (std::string warning = warning_at(take.frame_rate_hz); !warning.empty())
      trace.warnings.push_back(std::move(warning));
    return trace;
  }
  LiveSupport live_support(double frame_rate_hz) const override {
    return {.warning = warning_at(frame_rate_hz)};
  }
  std::unique_ptr<LiveFilter> live(const TakeView& like) const override {
    const double rate_hz = like.frame_rate_hz;
    return causal_filter(like, OneEuroTrack<Quat>(options_, rate_hz, 1),
                         OneEuroTrack<Vec3>(options_, rate_hz, radian_of_positions(like)));
  }

 private:
  std::string warning_at(double rate_hz) const {
    if (is_below_nyquist(options_.min_cutoff_hz, rate_hz)) return {};
    return cutoff_warning("min_cutoff_hz", options_.min_cutoff_hz, rate_hz) +
           "; a pose that is held is hardly smoothed";
  }

  OneEuroOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_one_euro(const OneEuroOptions& options) {
  one_euro_table().validate(options);
  return std::make_unique<OneEuro>(options);
}

Method one_euro_method() {
  return {"one-euro", "live filter that smooths much at rest and little in motion",
          "Casiez, Roussel & Vogel 2012", one_euro_table().specs(),
          [](const OptionValues& values) { return make_one_euro(one_euro_table().parse(values)); }};
}

}  // namespace kinemend
