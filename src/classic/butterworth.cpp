// The method `butterworth`: a low-pass filter, forward and backward on a whole take.
#include "classic/filter_channels.hpp"
#include "cleaner/method_row.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/signal.hpp"

namespace kinemend {

namespace {

const OptionTable<ButterworthOptions>& butterworth_table() {
  static const auto options =
      OptionTable<ButterworthOptions>()
          .integer(&ButterworthOptions::order, "order", "", 1, 12,
                   "filter order of each of the two passes")
          .number(&ButterworthOptions::cutoff_hz, "cutoff_hz", "Hz", 0.05, 500,
                  "cutoff of one pass (half power); must be below half of the frame rate");
  return options;
}

class Butterworth final : public OptionedCleaner<ButterworthOptions> {
 public:
  using OptionedCleaner::OptionedCleaner;

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& progress) const override {
    const double rate_hz = take.frame_rate_hz;
    if (!is_below_nyquist(options_.cutoff_hz, rate_hz)) {
      CleanTrace trace;
      trace.warnings.push_back(cutoff_warning("cutoff_hz", options_.cutoff_hz, rate_hz) +
                               "; nothing is filtered");
      return trace;
    }
    const auto sections =
        butterworth_lowpass(static_cast<int>(options_.order), options_.cutoff_hz, rate_hz);
    const std::size_t pad = settling_frames(sections);
    filter_channels(take, ChannelChoice::quaternion, sink, progress,
                    [&](PoseMatrix& channels) { filter_zero_phase(channels, sections, pad); });
    return {};
  }
};

}  // namespace

std::unique_ptr<Cleaner> make_butterworth(const ButterworthOptions& options) {
  return std::make_unique<Butterworth>("butterworth", butterworth_table(), options);
}

Method butterworth_method() {
  return method_row<butterworth_table, make_butterworth>(
      "butterworth",
      "low-pass filter with a fixed cutoff, run forward and backward so that nothing is delayed",
      "Butterworth 1930; the usual filter of biomechanics (Winter 1974)");
}

}  // namespace kinemend
