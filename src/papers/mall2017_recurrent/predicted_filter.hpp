// Applies the outputs of a network of Mall et al. 2017 to a take, with the adjoint that training
// needs. Training and cleaning use the same functions; F frames of C channels in degrees, in
// floats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace kinemend {

/// Frames on either side of a frame that a predicted filter uses: 31 in all, at 120 Hz, as in Mall
/// et al. 2017 (section 3).
inline constexpr std::size_t predicted_filter_reach = 15;

/// How outputs o of a frame become its pose y; x is the measurement, s_c and m_c a scale and a mean
/// of channel c.
enum class FilterHead : std::uint8_t {
  gaussian,  ///< y = sum_tau w(tau) x(t + tau), w a Gaussian of deviation exp(o_c) frames
  biased,    ///< the same less s_c o_(C + c): section 3 of the paper, "b"
  shape,     ///< y = sum_tau softmax(o)(tau) x(t + tau), one shape for all channels (figure 3)
  residual,  ///< y = x + s_c o_c: no filter
  pose,      ///< y = m_c + s_c o_c: the decoder of EBD
};

/// Outputs per frame: C, 2 C, 31, C and C.
std::size_t filter_output_count(FilterHead head, std::size_t channels);

/// F x C. Deviations are clamped to between exp(-2.5) and exp(3) frames. Weights of frames beyond
/// the ends go to the others.
struct FilterSignal {
  std::size_t frames = 0, channels = 0;
  std::span<const float> values;  ///< F x C
  std::span<const float> scales;  ///< C
  std::span<const float> means;   ///< C; only `FilterHead::pose` uses them
};
void apply_predicted_filter(FilterHead head, const FilterSignal& signal,
                            std::span<const float> outputs, std::span<float> result);
/// The same for single frames; keeps its scratch and does not allocate.
class PredictedFilterRow {
 public:
  explicit PredictedFilterRow(std::size_t channels);
  ~PredictedFilterRow();
  /// `outputs` and `result` are those of frame `frame` of the signal.
  void apply(FilterHead head, const FilterSignal& signal, std::size_t frame,
             std::span<const float> outputs, std::span<float> result);

  class Gaussian;  ///< of a frame

 private:
  std::unique_ptr<Gaussian> gaussian_;
};
/// Computes the derivative by the outputs (F x O) from that by the result (F x C).
void predicted_filter_adjoint(FilterHead head, const FilterSignal& signal,
                              std::span<const float> outputs, std::span<const float> derivative,
                              std::span<float> gradient);

}  // namespace kinemend
