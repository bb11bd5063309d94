// Applies predicted filters of each kind to a frame, and computes their adjoints.
#include "papers/mall2017_recurrent/predicted_filter.hpp"

#include <algorithm>
#include <cassert>

#include "base/portable.hpp"
#include "nn/layers.hpp"

namespace kinemend {

namespace {

// Limits of the logarithm of a Gaussian's width in frames: from 0.08, which keeps a sample, to 20.
// Chosen by hand; networks have learned with them.
constexpr float least_log = -2.5F, most_log = 3.0F;
constexpr std::size_t taps = 2 * predicted_filter_reach + 1;

}  // namespace

// The Gaussian of each channel about one frame. Products give each weight from the one before,
// since exp(-(k + 1)^2 / 2 s^2) is exp(-k^2 / 2 s^2) r^(2 k + 1) with r = exp(-1 / 2 s^2).
class PredictedFilterRow::Gaussian {
 public:
  explicit Gaussian(std::size_t channels)
      : inverse_(channels),
        squared_(channels),
        weight_(channels),
        factor_(channels),
        total_(channels),
        mean_(channels),
        moment_(channels),
        spread_(channels) {}

  /// Filters frame t. With `wants_slope` also computes d result / d log deviation.
  void run(const FilterSignal& signal, const float* logs, std::size_t t, bool wants_slope) {
    const std::size_t channels = signal.channels;
    const float* here = signal.values.data() + t * channels;
    for (std::size_t c = 0; c < channels; ++c)
      inverse_[c] = -2 * std::clamp(logs[c], least_log, most_log);
    nn::activate(nn::Activation::exp, inverse_);
    for (std::size_t c = 0; c < channels; ++c) weight_[c] = -0.5F * inverse_[c];
    nn::activate(nn::Activation::exp, weight_);
    for (std::size_t c = 0; c < channels; ++c) {
      squared_[c] = weight_[c] * weight_[c];
      factor_[c] = weight_[c] * squared_[c];
      total_[c] = 1;
      mean_[c] = here[c];
      moment_[c] = spread_[c] = 0;
    }
    for (std::size_t k = 1; k <= predicted_filter_reach; ++k) {
      const float* before = k <= t ? here - k * channels : nullptr;
      const float* after = t + k < signal.frames ? here + k * channels : nullptr;
      if (before != nullptr) add(before, k, wants_slope);
      if (after != nullptr) add(after, k, wants_slope);
      if (before == nullptr && after == nullptr) break;
      for (std::size_t c = 0; c < channels; ++c) {
        weight_[c] *= factor_[c];
        factor_[c] *= squared_[c];
      }
    }
    for (std::size_t c = 0; c < channels; ++c) mean_[c] /= total_[c];
    if (!wants_slope) return;
    // d w_k / d log s = w_k k^2 / s^2 before normalising.
    for (std::size_t c = 0; c < channels; ++c) {
      const bool is_inside = logs[c] >= least_log && logs[c] <= most_log;
      const float inverse = is_inside ? inverse_[c] : 0;
      moment_[c] = inverse * (moment_[c] - spread_[c] * mean_[c]) / total_[c];
    }
  }
  const std::vector<float>& means() const { return mean_; }
  const std::vector<float>& slopes() const { return moment_; }

 private:
  void add(const float* row, std::size_t k, bool wants_slope) {
    const auto distance = static_cast<float>(k * k);
    for (std::size_t c = 0; c < weight_.size(); ++c) {
      total_[c] += weight_[c];
      mean_[c] += weight_[c] * row[c];
    }
    if (!wants_slope) return;
    for (std::size_t c = 0; c < weight_.size(); ++c) {
      moment_[c] += distance * weight_[c] * row[c];
      spread_[c] += distance * weight_[c];
    }
  }

  std::vector<float> inverse_, squared_, weight_, factor_, total_, mean_, moment_, spread_;
};

namespace {

// Softmax over the frames of the window that exist.
struct Shape {
  std::size_t first = 0, last = 0;  // taps
  float weights[taps] = {};
};

Shape shape_of(const float* outputs, std::size_t t, std::size_t frames) {
  Shape shape;
  shape.first = t < predicted_filter_reach ? predicted_filter_reach - t : 0;
  shape.last = std::min(taps, frames + predicted_filter_reach - t);
  const float most = *std::max_element(outputs + shape.first, outputs + shape.last);
  float sum = 0;
  for (std::size_t k = shape.first; k < shape.last; ++k)
    sum += shape.weights[k] = portable::exp(outputs[k] - most);
  for (std::size_t k = shape.first; k < shape.last; ++k) shape.weights[k] /= sum;
  return shape;
}

const float* row_at(const FilterSignal& signal, std::size_t t, std::size_t tap) {
  return signal.values.data() + (t + tap - predicted_filter_reach) * signal.channels;
}

void apply_shape(const FilterSignal& signal, const float* outputs, std::size_t t, float* result) {
  const Shape shape = shape_of(outputs, t, signal.frames);
  std::fill_n(result, signal.channels, 0.0F);
  for (std::size_t k = shape.first; k < shape.last; ++k) {
    const float* row = row_at(signal, t, k);
    for (std::size_t c = 0; c < signal.channels; ++c) result[c] += shape.weights[k] * row[c];
  }
}

void shape_adjoint(const FilterSignal& signal, const float* outputs, std::size_t t,
                   const float* derivative, float* gradient) {
  const Shape shape = shape_of(outputs, t, signal.frames);
  float products[taps] = {}, mean = 0;
  for (std::size_t k = shape.first; k < shape.last; ++k) {
    const float* row = row_at(signal, t, k);
    for (std::size_t c = 0; c < signal.channels; ++c) products[k] += derivative[c] * row[c];
    mean += shape.weights[k] * products[k];
  }
  for (std::size_t k = 0; k < taps; ++k) gradient[k] = shape.weights[k] * (products[k] - mean);
}

}  // namespace

std::size_t filter_output_count(FilterHead head, std::size_t channels) {
  if (head == FilterHead::shape) return taps;
  return head == FilterHead::biased ? 2 * channels : channels;
}

PredictedFilterRow::PredictedFilterRow(std::size_t channels)
    : gaussian_(std::make_unique<Gaussian>(channels)) {}
PredictedFilterRow::~PredictedFilterRow() = default;

void PredictedFilterRow::apply(FilterHead head, const FilterSignal& signal, std::size_t frame,
                               std::span<const float> outputs, std::span<float> result) {
  const std::size_t channels = signal.channels;
  if (head == FilterHead::shape) return apply_shape(signal, outputs.data(), frame, result.data());
  if (head == FilterHead::residual) {
    const float* x = signal.values.data() + frame * channels;
    for (std::size_t c = 0; c < channels; ++c) result[c] = x[c] + signal.scales[c] * outputs[c];
    return;
  }
  if (head == FilterHead::pose) {
    for (std::size_t c = 0; c < channels; ++c)
      result[c] = signal.means[c] + signal.scales[c] * outputs[c];
    return;
  }
  gaussian_->run(signal, outputs.data(), frame, false);
  std::copy(gaussian_->means().begin(), gaussian_->means().end(), result.begin());
  if (head == FilterHead::gaussian) return;
  for (std::size_t c = 0; c < channels; ++c) result[c] -= signal.scales[c] * outputs[channels + c];
}

void apply_predicted_filter(FilterHead head, const FilterSignal& signal,
                            std::span<const float> outputs, std::span<float> result) {
  const std::size_t channels = signal.channels, width = filter_output_count(head, channels);
  assert(outputs.size() == signal.frames * width && result.size() == signal.values.size());
  PredictedFilterRow row(channels);
  for (std::size_t t = 0; t < signal.frames; ++t)
    row.apply(head, signal, t, outputs.subspan(t * width, width),
              result.subspan(t * channels, channels));
}

void predicted_filter_adjoint(FilterHead head, const FilterSignal& signal,
                              std::span<const float> outputs, std::span<const float> derivative,
                              std::span<float> gradient) {
  const std::size_t channels = signal.channels, width = filter_output_count(head, channels);
  assert(outputs.size() == signal.frames * width && gradient.size() == outputs.size());
  PredictedFilterRow::Gaussian gaussian(channels);
  for (std::size_t t = 0; t < signal.frames; ++t) {
    const float* o = outputs.data() + t * width;
    const float* d = derivative.data() + t * channels;
    float* g = gradient.data() + t * width;
    if (head == FilterHead::shape) {
      shape_adjoint(signal, o, t, d, g);
    } else if (head == FilterHead::residual || head == FilterHead::pose) {
      for (std::size_t c = 0; c < channels; ++c) g[c] = signal.scales[c] * d[c];
    } else {
      gaussian.run(signal, o, t, true);
      for (std::size_t c = 0; c < channels; ++c) g[c] = d[c] * gaussian.slopes()[c];
      if (head == FilterHead::gaussian) continue;
      for (std::size_t c = 0; c < channels; ++c) g[channels + c] = -signal.scales[c] * d[c];
    }
  }
}

}  // namespace kinemend
