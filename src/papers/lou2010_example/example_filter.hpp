// Finds the motion that stays close to the measurements and follows learned patterns (Lou & Chai
// 2010, sections 3.1 to 3.5). A long sequence is cut into overlapping stretches, so that memory
// does not grow with its length.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/extend/frames.hpp"
#include "papers/lou2010_example/filter_bases.hpp"
#include "papers/lou2010_example/pattern_penalty.hpp"

namespace kinemend {

/// Long sequences are filtered in overlapping stretches of one length, so that memory is
/// independent of their length. Stretches begin where windows begin; the last one may reach less
/// than a hop beyond the end.
class Stretches {
 public:
  /// Cuts a sequence of `frames`, at least `bases.frames`. `margin_windows`: windows at each end of
  /// a stretch that take the neighbour's result.
  Stretches(const WindowBases& bases, std::size_t frames, std::size_t margin_windows);

  std::size_t count() const noexcept { return count_; }
  /// The length of every stretch.
  std::size_t frames() const noexcept { return length_; }
  /// The first frame of a stretch, and the end of its frames that are in the sequence.
  std::size_t begin(std::size_t stretch) const;
  std::size_t end(std::size_t stretch) const;
  /// The stretch gives the frames [first(s), first(s + 1)) of the result.
  std::size_t first(std::size_t stretch) const;

 private:
  std::size_t frames_, length_, hop_, count_ = 1;
};

/// The linear filter of eq. 7 on all sliding windows: each frame becomes the mean of the
/// projections of all windows over it. `mean`: L, one per channel. F is at least `bases.frames`, or
/// 0.
PoseMatrix filter_linearly(const PoseMatrix& poses, WindowBases bases,
                           std::span<const double> mean);

/// Methods of minimisation. Each step decreases the objective.
enum class ExampleSolver : std::uint8_t {
  conjugate_gradients,  ///< some steps on each weighted least-squares problem, coefficients and
                        ///< motion at once
  alternation           ///< the paper's: best coefficients (eq. 13), then best motion (eq. 15)
};

/// Weights of the objective (eq. 16), each L values, in the units of the channels:
///
///   sum_tl alpha_tl b_l rho(z_l(t) - y_l(t)) + sum_s min_c (sum lambda_l (z_s - E c)_l^2
///       + sum_k v_k c_k^2)
///
/// with rho(r) = p_l^2 / 2 (1 - exp(-r^2 / p_l^2)). The paper has b_l = 1, one p, one lambda,
/// v_k = 0. Scaling data and p by s scales the result by s.
struct ExampleWeights {
  std::vector<double> data;          ///< b_l > 0
  std::vector<double> welsch;        ///< p_l > 0; infinite: least squares
  std::vector<double> prior;         ///< lambda_l > 0
  std::vector<double> coefficients;  ///< v_k >= 0, K; empty: none
};

struct ExampleSettings {
  ExampleSolver solver = ExampleSolver::conjugate_gradients;
  std::size_t iterations = 50;  ///< of the weights, at most
  double tolerance = 1e-4;      ///< stops when an iteration gains less than this share
  /// Initial factor of p, which decreases to 1: the objective then has no distant local minima in
  /// which outliers support each other.
  double first_welsch = 1;
};

/// Minimises the objective. `poses` holds the first guess and becomes the result; `measured` is y,
/// `observed` alpha (F x L, 0 or 1; empty: all), `mean` the channels' means (L), to which the
/// patterns are relative. F is at least `bases.frames`. Beyond about 260,000 samples the take is
/// processed in stretches, which overlap by four windows. Returns the objective (of the last
/// stretch) before the first iteration and after each.
std::vector<double> example_filter(PoseMatrix& poses, const PoseMatrix& measured,
                                   std::span<const std::uint8_t> observed, WindowBases bases,
                                   std::span<const double> mean, const ExampleWeights& weights,
                                   const ExampleSettings& settings = {});

/// F x L: exp(-r^2 / p^2), weight of each sample (eq. 15); 0 if not observed.
PoseMatrix welsch_weights(const PoseMatrix& poses, const PoseMatrix& measured,
                          std::span<const std::uint8_t> observed, std::span<const double> welsch);

}  // namespace kinemend
