// The method `wavelet`: shrinks the wavelet coefficients of a take's channels.
#include "classic/filter_channels.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/signal.hpp"

namespace kinemend {

namespace {

std::vector<std::string> families() {
  std::vector<std::string> names;
  for (int n = 1; n <= 10; ++n) names.push_back("db" + std::to_string(n));
  for (int n = 2; n <= 10; ++n) names.push_back("sym" + std::to_string(n));
  return names;
}

const OptionTable<WaveletCleanerOptions>& wavelet_table() {
  static const auto options =
      OptionTable<WaveletCleanerOptions>()
          .choice(&WaveletCleanerOptions::family, "family", families(),
                  "wavelet: db (Daubechies) or sym (symlet) with its number of vanishing moments")
          .choice(
              &WaveletCleanerOptions::threshold, "threshold", {"universal", "sure"},
              "universal removes more noise, and small detail with it; sure adapts to each scale")
          .choice(&WaveletCleanerOptions::shrinkage, "shrinkage", {"soft", "hard"},
                  "soft also shrinks the coefficients that stay; hard keeps them unchanged");
  return options;
}

WaveletOptions signal_options(const WaveletCleanerOptions& options) {
  const bool symlet = options.family.starts_with("sym");
  WaveletOptions result;
  result.family = symlet ? WaveletFamily::symlet : WaveletFamily::daubechies;
  result.vanishing_moments = std::stoi(options.family.substr(symlet ? 3 : 2));
  result.threshold =
      options.threshold == "sure" ? WaveletThreshold::sure : WaveletThreshold::universal;
  result.shrinkage = options.shrinkage == "soft" ? WaveletShrinkage::soft : WaveletShrinkage::hard;
  return result;
}

class Wavelet final : public Cleaner {
 public:
  explicit Wavelet(const WaveletCleanerOptions& options) : options_(options) {}

  std::string_view name() const override { return "wavelet"; }
  OptionValues options() const override { return wavelet_table().values(options_); }

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& progress) const override {
    filter_channels(take, ChannelChoice::suitable, sink, progress,
                    [options = signal_options(options_)](PoseMatrix& channels) {
                      wavelet_denoise(channels, options);
                    });
    return {};
  }

 private:
  WaveletCleanerOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_wavelet(const WaveletCleanerOptions& options) {
  wavelet_table().validate(options);
  return std::make_unique<Wavelet>(options);
}

Method wavelet_method() {
  return {"wavelet", "wavelet shrinkage: adapts to the noise and keeps sudden motion",
          "Donoho & Johnstone 1994, 1995", wavelet_table().specs(),
          [](const OptionValues& values) { return make_wavelet(wavelet_table().parse(values)); }};
}

}  // namespace kinemend
