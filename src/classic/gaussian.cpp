// The method `gaussian`: a Gaussian mean of each track, replaced by a local line fit where the
// window is cut.
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/portable.hpp"
#include "cleaner/live.hpp"
#include "cleaner/orientation_filter.hpp"
#include "cleaner/pieces.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/method_options.hpp"
#include "motion/rotation.hpp"

namespace kinemend {

namespace {

// Beyond this many standard deviations the mask is cut.
constexpr double mask_reach = 4;

const OptionTable<GaussianOptions>& gaussian_table() {
  static const OptionTable<GaussianOptions> result =
      OptionTable<GaussianOptions>().number(&GaussianOptions::width_s, "width_s", "s", 0, 1,
                                            "standard deviation of the Gaussian weights");
  return result;
}

std::size_t half_width(double sigma_frames) {
  return static_cast<std::size_t>(std::lround(mask_reach * sigma_frames));
}

// exp(-j^2 / (2 sigma^2)) for j = -k .. k, with k at most `most`.
std::vector<double> gaussian_values(double sigma_frames, std::size_t most) {
  const std::size_t k = std::min(half_width(sigma_frames), most);
  std::vector<double> values(2 * k + 1, 1.0);
  for (std::size_t j = 1; j <= k; ++j) {
    const double steps = static_cast<double>(j) / sigma_frames;
    values[k - j] = values[k + j] = portable::exp(-0.5 * steps * steps);
  }
  return values;
}

// The mask about frame i out of `frames`: the weights of a local straight-line fit, which preserve
// a straight line even if the window is cut. For a whole window they are the normalised Gaussian.
std::vector<double> mask_at(std::span<const double> values, std::span<const double> observed,
                            std::size_t i, std::size_t frames) {
  const std::size_t k = values.size() / 2;
  std::vector<double> mask(values.size(), 0.0);
  double s0 = 0, s1 = 0, s2 = 0;
  for (std::size_t m = 0; m < mask.size(); ++m) {
    if (i + m < k || i + m >= frames + k) continue;
    mask[m] = values[m] * (observed.empty() ? 1.0 : observed[i + m - k]);
    const double j = static_cast<double>(m) - static_cast<double>(k);
    s0 += mask[m];
    s1 += mask[m] * j;
    s2 += mask[m] * j * j;
  }
  const double determinant = s0 * s2 - s1 * s1;
  const bool line = s2 > 1e-12 && determinant > 1e-9 * s0 * s2;
  for (std::size_t m = 0; m < mask.size(); ++m) {
    const double j = static_cast<double>(m) - static_cast<double>(k);
    if (line) {
      mask[m] *= (s2 - s1 * j) / determinant;
    } else if (s0 > 0) {
      mask[m] /= s0;
    }
  }
  return mask;
}

// sum_r b_r w_{i+r}; b_r is zero if w does not exist.
Vec3 weigh_at(const VectorTrack& increments, std::span<const double> b, std::size_t i) {
  const std::size_t k = b.size() / 2;
  Vec3 sum;
  for (std::size_t r = 0; r < b.size(); ++r) {
    if (i + r >= k && i + r - k + 1 < increments.frames) sum += b[r] * increments[i + r - k];
  }
  return sum;
}

bool whole_window(std::span<const double> observed, std::size_t i, std::size_t k,
                  std::size_t frames) {
  if (i < k || i + k >= frames) return false;
  const auto cut = [](double weight) { return weight == 0; };
  return observed.empty() ||
         std::none_of(observed.begin() + static_cast<std::ptrdiff_t>(i - k),
                      observed.begin() + static_cast<std::ptrdiff_t>(i + k + 1), cut);
}

class GaussianFilter {
 public:
  GaussianFilter(double sigma_frames, std::size_t frames)
      : values_(gaussian_values(sigma_frames, frames)), frames_(frames), ends_(frames) {
    const std::size_t k = values_.size() / 2;
    inner_ = increment_weights(mask_at(values_, {}, k, 2 * k + 1));
    for (std::size_t i = 0; i < frames; ++i) {
      if (!whole_window({}, i, k, frames))
        ends_[i] = increment_weights(mask_at(values_, {}, i, frames));
    }
  }

  bool does_nothing() const { return values_.size() == 1; }

  template <class Sample>
  void operator()(Piece<Sample>& piece) const {
    filter_lanes(piece, [&](auto& track) { filter(track, lane_weights(piece)); });
  }

 private:
  // Samples of weight 0 are ignored; without weights all are 1.
  template <class Track>
  void filter(Track& track, const std::vector<double>& observed) const {
    const VectorTrack steps = increments(track);
    VectorTrack moves = weigh_increments(steps, inner_);
    // Masks at the ends are the same for all tracks that were measured throughout.
    const bool is_whole = observed.empty() && track.frames == frames_;
    for (std::size_t i = 0; i < track.frames; ++i) {
      if (whole_window(observed, i, values_.size() / 2, track.frames)) continue;
      moves.set(
          i,
          is_whole
              ? weigh_at(steps, ends_[i], i)
              : weigh_at(steps, increment_weights(mask_at(values_, observed, i, track.frames)), i));
    }
    turn(track, moves);
  }

  std::vector<double> values_;
  std::size_t frames_;
  std::vector<double> inner_;
  std::vector<std::vector<double>> ends_;  // one per frame of the take; empty away from its ends
};

// The whole mask; each increment is computed once.
template <class Sample>
class GaussianStep {
 public:
  explicit GaussianStep(std::span<const double> increment_weights)
      : weights_(increment_weights.begin(), increment_weights.end()),
        samples_(weights_.size() + 1),
        increments_(weights_.size()) {}

  Sample step(Sample newest) {
    const Sample before = samples_.samples().back();
    samples_.push(newest);
    if (weights_.empty()) return newest;
    increments_.push(difference(before, newest));
    Vec3 sum;
    const auto increments = increments_.samples();
    for (std::size_t r = 0; r < weights_.size(); ++r) sum += weights_[r] * increments[r];
    return moved(samples_.samples()[weights_.size() / 2], sum);
  }

 private:
  std::vector<double> weights_;
  SlidingWindow<Sample> samples_;
  SlidingWindow<Vec3> increments_;
};

class GaussianCleaner final : public Cleaner {
 public:
  explicit GaussianCleaner(const GaussianOptions& options) : options_(options) {
    gaussian_table().validate(options);
  }

  std::string_view name() const override { return "gaussian"; }
  OptionValues options() const override { return gaussian_table().values(options_); }

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& progress) const override {
    const GaussianFilter filter(sigma_frames(take.frame_rate_hz), take.frames);
    if (!filter.does_nothing()) filter_pieces(take, sink, progress, filter);
    return {};
  }

  LiveSupport live_support(double) const override { return {}; }

  std::unique_ptr<LiveFilter> live(const TakeView& like) const override {
    const double sigma = sigma_frames(like.frame_rate_hz);
    const std::size_t k = half_width(sigma);
    const std::vector<double> weights =
        increment_weights(mask_at(gaussian_values(sigma, k), {}, k, 2 * k + 1));
    return windowed_filter<GaussianStep>(
        like, k, [&](const Track&, auto sample) { return GaussianStep<decltype(sample)>(weights); },
        GaussianFilter(sigma, 2 * k + 1));
  }

 private:
  double sigma_frames(double frame_rate_hz) const {
    return options_.width_s * window_rate_hz(frame_rate_hz);
  }

  GaussianOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_gaussian(const GaussianOptions& options) {
  return std::make_unique<GaussianCleaner>(options);
}

Method gaussian_method() {
  return {"gaussian", "smoothing with Gaussian weights in time, made for rotations",
          "Lee & Shin 2002; Courty 2008, eq. 2-3", gaussian_table().specs(),
          [](const OptionValues& values) { return make_gaussian(gaussian_table().parse(values)); }};
}

}  // namespace kinemend
