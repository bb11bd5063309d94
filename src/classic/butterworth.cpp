// The method `butterworth`: forward and backward on a whole take, forward only if it is causal.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "classic/filter_channels.hpp"
#include "cleaner/live.hpp"
#include "kinemend/extend/body.hpp"
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
                  "cutoff of one pass (half power); must be below half of the frame rate")
          .flag(&ButterworthOptions::causal, "causal",
                "forward pass only: delays the motion, and can run live");
  return options;
}

// Forward filter of one track. Unseen samples hold the last value.
template <class Sample>
class ButterworthTrack {
 public:
  explicit ButterworthTrack(std::vector<Biquad> sections) : state_(std::move(sections)) {}

  Vec3 step(Vec3 position, bool seen) {
    if (!started_ && !seen) return position;
    if (!started_) origin_ = position, started_ = true;
    if (seen) held_ = position;
    const Vec3 p = held_ - origin_;
    double row[] = {p.x, p.y, p.z};
    state_.step(row);
    return origin_ + Vec3{row[0], row[1], row[2]};
  }

  Quat step(Quat rotation, bool seen) {
    if (!started_) held_ = rotation, started_ = true;
    if (seen) held_ = sign_.next(rotation);
    double row[] = {held_.w, held_.x, held_.y, held_.z};
    state_.step(row);
    return normalized({row[0], row[1], row[2], row[3]});
  }

 private:
  CausalState state_;
  SignContinuation sign_;
  Sample held_;
  Vec3 origin_;
  bool started_ = false;
};

class Butterworth final : public Cleaner {
 public:
  explicit Butterworth(const ButterworthOptions& options) : options_(options) {}

  std::string_view name() const override { return "butterworth"; }
  OptionValues options() const override { return butterworth_table().values(options_); }

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& progress) const override {
    if (!acts(take.frame_rate_hz)) {
      CleanTrace trace;
      trace.warnings.push_back(nothing_to_do(take.frame_rate_hz));
      return trace;
    }
    if (options_.causal) return clean_as_live(*this, take, sink, progress);
    const auto sections = design(take.frame_rate_hz);
    const std::size_t pad = settling_frames(sections);
    filter_channels(take, ChannelChoice::quaternion, sink, progress,
                    [&](PoseMatrix& channels) { filter_zero_phase(channels, sections, pad); });
    return {};
  }

  LiveSupport live_support(double frame_rate_hz) const override {
    if (!options_.causal) return Cleaner::live_support(frame_rate_hz);
    return {.warning = acts(frame_rate_hz) ? std::string() : nothing_to_do(frame_rate_hz)};
  }

  std::unique_ptr<LiveFilter> live(const TakeView& like) const override {
    if (!options_.causal) return Cleaner::live(like);
    const std::vector<Biquad> sections =
        acts(like.frame_rate_hz) ? design(like.frame_rate_hz) : std::vector<Biquad>{};
    return causal_filter(like, ButterworthTrack<Quat>(sections), ButterworthTrack<Vec3>(sections));
  }

 private:
  std::string nothing_to_do(double rate_hz) const {
    return cutoff_warning("cutoff_hz", options_.cutoff_hz, rate_hz) + "; nothing is filtered";
  }
  bool acts(double rate_hz) const { return is_below_nyquist(options_.cutoff_hz, rate_hz); }
  std::vector<Biquad> design(double rate_hz) const {
    return butterworth_lowpass(static_cast<int>(options_.order), options_.cutoff_hz, rate_hz);
  }

  ButterworthOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_butterworth(const ButterworthOptions& options) {
  butterworth_table().validate(options);
  return std::make_unique<Butterworth>(options);
}

Method butterworth_method() {
  return {
      "butterworth",
      "low-pass filter with a fixed cutoff, run forward and backward so that nothing is delayed",
      "Butterworth 1930; the usual filter of biomechanics (Winter 1974)",
      butterworth_table().specs(), [](const OptionValues& values) {
        return make_butterworth(butterworth_table().parse(values));
      }};
}

}  // namespace kinemend
