// Chooses the smoother of each axis by its likelihood under coloured noise and blends the result
// in.
#include "methods/auto/coloured_smoothing.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "kinemend/experimental/frame_rate.hpp"
#include "kinemend/experimental/signal.hpp"
#include "motion/component.hpp"
#include "signal/coloured_noise.hpp"

namespace kinemend {

namespace {

// Candidates. The range of `SmoothingTuning::models`, in fewer steps for speed; not swept.
constexpr signal::CutoffGrid smoothing_cutoffs{0.003, 50, 24};

class ColouredSmoothing {
 public:
  ColouredSmoothing(VectorTracks& tracks, const SampleMarks& missing, const NoiseSpectrum& spectrum,
                    double scale, std::span<const double> shares, double frame_rate_hz,
                    const ColourTuning& tuning)
      : tracks_(tracks),
        missing_(missing),
        correlation_(spectrum.correlation),
        shares_(shares),
        frame_rate_hz_(frame_rate_hz),
        is_slow_(spectrum.is_slow),
        tuning_(tuning) {
    for (std::size_t n = 0; n < tracks.tracks(); ++n) {
      Vec3 deviations = scale * spectrum.deviations[n];
      for (std::size_t axis = 0; axis < 3 && shares[n] > 0; ++axis) {
        const double deviation = std::max(component_of(deviations, axis), least_noise);
        channels_.push_back(3 * n + axis);
        variance_.push_back(deviation * deviation);
      }
    }
    // Orders of differences, as of `signal::ModelGrid`; under slow noise only the smoothest.
    constexpr std::size_t all_orders[] = {1, 2, 3}, smooth_order[] = {3};
    candidates_ = signal::models_of_orders(is_slow_ ? std::span<const std::size_t>(smooth_order)
                                                    : std::span<const std::size_t>(all_orders),
                                           smoothing_cutoffs, tracks.frames(), frame_rate_hz);
  }

  void run(ShareProgress* progress) {
    if (candidates_.empty()) return;
    models_.resize(channels_.size());
    const std::size_t blocks =
        (channels_.size() + signal::block_channels - 1) / signal::block_channels;
    if (progress) progress->begin_part(0.65, blocks);
    for_each_parallel(blocks, channels_.size() * tracks_.frames() * candidates_.size(),
                      [&](std::size_t b) {
                        choose_models(b * signal::block_channels);
                        if (progress) progress->step();
                      });
    if (progress) progress->begin_part(0.75, models_.size() / signal::block_channels + 1);
    signal::for_each_of_one_order(models_, [&](const std::vector<std::size_t>& members) {
      smooth(members);
      if (progress) progress->step();
    });
  }

 private:
  static constexpr double least_noise = 1e-4;  // degrees, against division by zero

  std::span<Vec3> track(std::size_t i) { return tracks_.track(channels_[i] / 3); }

  void gather(std::span<const std::size_t> members, signal::ChannelBlock& y,
              signal::NoisePrecision& precision) {
    for (std::size_t k = 0; k < members.size(); ++k) {
      const std::size_t channel = channels_[members[k]];
      const std::span<Vec3> values = tracks_.track(channel / 3);
      for (std::size_t t = 0; t < values.size(); ++t)
        y(t, k) = component_of(values[t], channel % 3);
      precision.set_channel(k, correlation_, missing_.track(channel / 3));
    }
  }

  void choose_models(std::size_t first) {
    std::vector<std::size_t> members;
    for (std::size_t i = first; i < std::min(first + signal::block_channels, channels_.size()); ++i)
      members.push_back(i);
    signal::ChannelBlock y(tracks_.frames());
    signal::NoisePrecision precision(tracks_.frames());
    gather(members, y, precision);
    signal::BlockRow least;
    least.fill(std::numeric_limits<double>::infinity());
    for (const signal::SmoothingModel& model : candidates_) {
      const signal::ColouredEvidence evidence = signal::evidence_of(y, precision, model);
      for (std::size_t k = 0; k < members.size(); ++k) {
        const double variance = variance_[members[k]];
        const double misfit = evidence.squares[k] / variance + evidence.logarithms[k] +
                              evidence.differences[k] * portable::log(variance);
        if (!(misfit < least[k])) continue;
        least[k] = misfit;
        models_[members[k]] = model;
      }
    }
  }

  void smooth(const std::vector<std::size_t>& members) {
    const std::size_t frames = tracks_.frames();
    signal::ChannelBlock y(frames);
    signal::NoisePrecision precision(frames);
    gather(members, y, precision);
    std::vector<double> variance;
    std::vector<signal::SmoothingModel> models;
    for (std::size_t k = 0; k < members.size(); ++k) {
      variance.push_back(variance_[members[k]]);
      models.push_back(models_[members[k]]);
      for (std::size_t t = 0; t < frames; ++t) {
        precision.weight(t, k) /= variance[k];
        precision.coupling(t, k) /= variance[k];
      }
    }
    signal::AdaptiveSettings settings;
    settings.share_of_constant = tuning_.share_of_constant;
    if (is_slow_) settings.iterations = 0;
    signal::ChannelBlock x = signal::smooth_adaptively(
        y, precision.weight, variance, models, frame_rate_hz_, settings, &precision.coupling);
    if (is_slow_) remove_trembling(x);
    for (std::size_t k = 0; k < members.size(); ++k) {
      const std::size_t channel = channels_[members[k]];
      const double share = shares_[channel / 3];
      const std::span<Vec3> values = tracks_.track(channel / 3);
      for (std::size_t t = 0; t < frames; ++t)
        component_of(values[t], channel % 3) = y(t, k) + share * (x(t, k) - y(t, k));
    }
  }

  // Slow noise has a floor of fast noise that its model lacks. A Gaussian removes its remainder
  // above about 5 Hz.
  void remove_trembling(signal::ChannelBlock& x) const {
    PoseMatrix rows(x.frames, signal::block_channels);
    rows.values.swap(x.values);
    gaussian_filter(rows, tuning_.trembling_s * window_rate_hz(frame_rate_hz_));
    rows.values.swap(x.values);
  }

  VectorTracks& tracks_;
  const SampleMarks& missing_;
  double correlation_;
  std::span<const double> shares_;
  double frame_rate_hz_;
  bool is_slow_;
  const ColourTuning& tuning_;
  std::vector<std::size_t> channels_;  // track * 3 + axis, of smoothed tracks
  std::vector<double> variance_;       // of the noise on each of them
  std::vector<signal::SmoothingModel> candidates_, models_;
};

}  // namespace

void smooth_coloured(VectorTracks& tracks, const SampleMarks& missing,
                     const NoiseSpectrum& spectrum, double scale, std::span<const double> shares,
                     double frame_rate_hz, ShareProgress* progress, const ColourTuning& tuning) {
  if (tracks.frames() < 4) return;
  ColouredSmoothing(tracks, missing, spectrum, scale, shares, frame_rate_hz, tuning).run(progress);
}

}  // namespace kinemend
