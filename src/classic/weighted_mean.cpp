// The method `weighted-mean`: repeated means of neighbouring samples.
#include "classic/filter_channels.hpp"
#include "cleaner/live.hpp"
#include "kinemend/extend/body.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/signal.hpp"

namespace kinemend {

namespace {

const OptionTable<WeightedMeanOptions>& weighted_mean_table() {
  static const auto options =
      OptionTable<WeightedMeanOptions>().integer(&WeightedMeanOptions::passes, "passes", "", 1, 100,
                                                 "how many times the five-frame mean is applied");
  return options;
}

// All passes as one mask: their impulse response far from both ends.
std::vector<double> mask_of(int passes) {
  const std::size_t half = 2 * static_cast<std::size_t>(passes);
  PoseMatrix impulse(4 * half + 1, 1);
  impulse.row(2 * half)[0] = 1;
  weighted_mean_filter(impulse, passes);
  std::vector<double> mask(2 * half + 1);
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = impulse.row(half + i)[0];
  return mask;
}

// The method away from the ends: channels of quaternions with continued signs, or positions about
// the middle one.
template <class Sample>
class WeightedMeanStep {
 public:
  explicit WeightedMeanStep(std::span<const double> mask)
      : mask_(mask.begin(), mask.end()), window_(mask.size()) {}

  Quat step(Quat newest) {
    window_.push(sign_.next(newest));
    Quat sum{0, 0, 0, 0};
    for (std::size_t i = 0; i < mask_.size(); ++i) sum = sum + mask_[i] * window_.samples()[i];
    return normalized(sum);
  }
  Vec3 step(Vec3 newest) {
    window_.push(newest);
    const auto samples = window_.samples();
    const Vec3 middle = samples[mask_.size() / 2];
    Vec3 sum;
    for (std::size_t i = 0; i < mask_.size(); ++i) sum += mask_[i] * (samples[i] - middle);
    return middle + sum;
  }

 private:
  std::vector<double> mask_;
  SlidingWindow<Sample> window_;
  SignContinuation sign_;
};

class WeightedMean final : public Cleaner {
 public:
  explicit WeightedMean(const WeightedMeanOptions& options) : options_(options) {}

  std::string_view name() const override { return "weighted-mean"; }
  OptionValues options() const override { return weighted_mean_table().values(options_); }

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& progress) const override {
    filter_channels(take, ChannelChoice::quaternion, sink, progress, channel_filter());
    return {};
  }

  LiveSupport live_support(double) const override { return {}; }

  std::unique_ptr<LiveFilter> live(const TakeView& like) const override {
    const std::vector<double> mask = mask_of(passes());
    return windowed_filter<WeightedMeanStep>(
        like, mask.size() / 2,
        [&](const Track&, auto sample) { return WeightedMeanStep<decltype(sample)>(mask); },
        [filter = channel_filter()](auto& piece) { filter_channels(piece, filter); });
  }

 private:
  int passes() const { return static_cast<int>(options_.passes); }
  std::function<void(PoseMatrix&)> channel_filter() const {
    return [passes = passes()](PoseMatrix& channels) { weighted_mean_filter(channels, passes); };
  }

  WeightedMeanOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_weighted_mean(const WeightedMeanOptions& options) {
  weighted_mean_table().validate(options);
  return std::make_unique<WeightedMean>(options);
}

Method weighted_mean_method() {
  return {"weighted-mean", "weighted moving mean of five frames, like Smooth Keys in Blender",
          "Smooth Keys of Blender's graph editor", weighted_mean_table().specs(),
          [](const OptionValues& values) {
            return make_weighted_mean(weighted_mean_table().parse(values));
          }};
}

}  // namespace kinemend
