#include "clean/filter_channels.hpp"
#include "clean/method_list.hpp"
#include "kinemend/experimental/signal.hpp"
#include "kinemend/methods.hpp"

namespace kinemend {

namespace {

const OptionTable<WeightedMeanOptions>& table() {
  static const auto options =
      OptionTable<WeightedMeanOptions>().integer(&WeightedMeanOptions::passes, "passes", "", 1, 100,
                                                 "how many times the five-frame mean is taken");
  return options;
}

class WeightedMean final : public Cleaner {
 public:
  explicit WeightedMean(const WeightedMeanOptions& options) : options_(options) {}

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& progress) const override {
    filter_channels(take, ChannelChoice::quaternion, sink, progress, [this](PoseMatrix& channels) {
      weighted_mean_filter(channels, static_cast<int>(options_.passes));
    });
    return {};
  }

  LiveSupport live_support(double) const override {
    return {LiveSupport::Kind::windowed, 2 * static_cast<std::size_t>(options_.passes)};
  }

 private:
  WeightedMeanOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_weighted_mean(const WeightedMeanOptions& options) {
  table().validate(options);
  return std::make_unique<WeightedMean>(options);
}

Method weighted_mean_method() {
  return {"weighted-mean", "weighted moving mean of five frames, as animators smooth keys",
          "Smooth Keys of Blender's graph editor", table().specs(),
          [](const OptionValues& values) { return make_weighted_mean(table().parse(values)); }};
}

}  // namespace kinemend
