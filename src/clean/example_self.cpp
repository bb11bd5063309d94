#include "clean/example_self.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "base/quantiles.hpp"
#include "clean/example_rest.hpp"
#include "clean/prior_cleaning.hpp"
#include "kinemend/body.hpp"
#include "kinemend/error.hpp"
#include "priors/example_filter.hpp"
#include "priors/self_bases.hpp"
#include "priors/window_bases.hpp"

namespace kinemend {

namespace {

constexpr double welsch_deviations = 3;
constexpr double rejected_weight = 0.01;
// Degrees: a take with less noise is clean, and stays as `auto` leaves it.
constexpr double least_noise_deg = 0.1;

// `auto`'s opinion of spikes and gaps, else what was measured.
PoseMatrix without_spikes(const PriorWork& work) {
  PoseMatrix poses = work.channels.poses;
  for (std::size_t i = 0; i < poses.values.size(); ++i) {
    if (work.channels.observed[i] == 0 || work.suspect[i] != 0) {
      poses.values[i] = work.fallback.values[i];
    }
  }
  return poses;
}

class SelfExample final : public Cleaner {
 public:
  explicit SelfExample(const ExampleOptions& options) : options_(options) {}

  CleanTrace clean(Clip& clip, const Selection& selection) const override {
    const auto layout = layout_of(clip);
    if (!layout) return make_auto()->clean(clip, selection);
    return clean_with_prior(clip, selection, *layout, {}, options_.fill,
                            [this](PriorWork& work) { filter(work); });
  }

  MarkerTrace clean_markers(MarkerClip& clip, const MarkerSelection& selection) const override {
    const auto layout = layout_of(clip);
    if (!layout) return make_auto()->clean_markers(clip, selection);
    return clean_with_prior(clip, selection, *layout, {}, options_.fill,
                            [this](PriorWork& work) { filter(work); });
  }

 private:
  // None where nothing moves.
  template <class AnyClip>
  static std::optional<BodyLayout> layout_of(const AnyClip& clip) {
    try {
      BodyLayoutBuilder builder;
      builder.add(clip);
      return builder.finish();
    } catch (const Error&) {
      return std::nullopt;
    }
  }

  void filter(PriorWork& work) const {
    const std::vector<double> noise = example_noise(work);
    std::vector<double> levels = noise;
    if (median_of(levels) < least_noise_deg) {
      work.channels.poses = work.fallback;
      return;
    }
    PoseMatrix poses = without_spikes(work);
    const double rate_hz = work.channels.frame_rate_hz;
    ExamplePrior prior = self_bases(poses, rate_hz, noise);
    const std::size_t count = prior.bases.count;
    if (count == 0) {
      work.channels.poses = work.fallback;
      return;
    }
    ExampleTrace trace = refine(work, prior, noise, poses);
    // What is left of the noise hides less: the same number of patterns, now purer.
    const std::vector<double> residual = prior.bases.residual;
    prior = self_bases(poses, rate_hz, noise, count);
    prior.bases.residual = residual;
    trace = refine(work, prior, noise, poses);
    const WindowBases bases = bases_at_rate(prior.bases, prior.rate_hz, rate_hz, poses.frames);
    LinearExampleFilter expressible(bases, prior.bases.mean, poses.frames);
    smooth_rest(work, trace.weights, expressible, noise, poses);
    work.rejected.assign(poses.values.size(), 0);
    for (std::size_t i = 0; i < work.rejected.size(); ++i) {
      work.rejected[i] =
          work.channels.observed[i] != 0 && trace.weights.values[i] < rejected_weight ? 1 : 0;
    }
    work.channels.poses = std::move(poses);
  }

  ExampleTrace refine(const PriorWork& work, const ExamplePrior& prior,
                      const std::vector<double>& noise, PoseMatrix& poses) const {
    const WindowBases bases =
        bases_at_rate(prior.bases, prior.rate_hz, work.channels.frame_rate_hz, poses.frames);
    ExampleWeights weights = probable_weights(prior, bases, noise, welsch_deviations);
    for (std::size_t c = 0; c < noise.size(); ++c) {
      weights.welsch[c] =
          std::hypot(weights.welsch[c], welsch_deviations * std::sqrt(prior.bases.residual[c]));
    }
    ExampleSettings settings;
    settings.iterations = static_cast<std::size_t>(options_.iterations);
    settings.tolerance = options_.tolerance;
    return example_filter(poses, work.channels.poses, work.channels.observed, bases,
                          prior.bases.mean, weights, settings);
  }

  ExampleOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_self_example(const ExampleOptions& options) {
  return std::make_unique<SelfExample>(options);
}

}  // namespace kinemend
