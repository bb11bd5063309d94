#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "kinemend/pose_matrix.hpp"
#include "priors/pattern_penalty.hpp"
#include "priors/window_bases.hpp"

// Motion that stays close to what was measured and follows learned patterns (Lou & Chai 2010,
// sections 3.1 to 3.5).
namespace kinemend {

/// The linear filter of eq. 7 on all sliding windows: each frame becomes the mean of what the
/// windows over it make of it.
class LinearExampleFilter {
 public:
  /// `mean`: of each channel (L). `frames`: of the sequences, at least `bases.frames`, or 0.
  LinearExampleFilter(const WindowBases& bases, std::span<const double> mean, std::size_t frames);

  /// `poses`: frames x L.
  void filter(PoseMatrix& poses);

 private:
  std::vector<double> mean_;
  std::optional<PatternPenalty> patterns_;
};

/// How the objective is brought down. Both only ever lower it.
enum class ExampleSolver : std::uint8_t {
  conjugate_gradients,  ///< some steps on each weighted least-squares problem, coefficients and
                        ///< motion at once
  alternation           ///< the paper's: best coefficients (eq. 13), then best motion (eq. 15)
};

/// Weights of the objective (eq. 16), each L values, in the units of the channels:
///
///   sum_tl alpha_tl b_l rho(z_l(t) - y_l(t)) + sum_s min_c (sum lambda_l (z_s - E c)_l^2
///       + sum_k v_k c_k^2) + limit_weight |z - project(z)|^2
///
/// with rho(r) = p_l^2 / 2 (1 - exp(-r^2 / p_l^2)). The paper has b_l = 1, one p, one lambda,
/// v_k = 0 and no limits. Scaling data and p by s scales the result by s.
struct ExampleWeights {
  std::vector<double> data;          ///< b_l > 0
  std::vector<double> welsch;        ///< p_l > 0; infinite: least squares
  std::vector<double> prior;         ///< lambda_l > 0
  std::vector<double> coefficients;  ///< v_k >= 0, K; empty: none
};

struct ExampleSettings {
  ExampleSolver solver = ExampleSolver::conjugate_gradients;
  std::size_t iterations = 50;  ///< of the weights, at most
  double tolerance = 1e-4;      ///< stop where an iteration gains less than this share
  /// p is this many times as large at first and comes down to its value: the objective then has no
  /// far minima in which outliers hold each other.
  double first_welsch = 1;
  double limit_weight = 0;
  /// The nearest allowed poses, of any frames: asked for some of them at a time, from several
  /// threads.
  std::function<void(const PoseMatrix& poses, PoseMatrix& nearest)> project{};
};

struct ExampleTrace {
  std::vector<double> objective;  ///< before the first iteration and behind each
  PoseMatrix weights;             ///< F x L: exp(-r^2 / p^2) of the last; 0 where not observed
};

/// Minimises the objective. `poses` holds the first guess and becomes the result (it lends its room
/// on the way); `measured` is y,
/// `observed` alpha (F x L, 0 or 1; empty: all), `mean` the channels' means (L), from which the
/// patterns are measured. F is at least `bases.frames`.
ExampleTrace example_filter(PoseMatrix& poses, const PoseMatrix& measured,
                            std::span<const std::uint8_t> observed, const WindowBases& bases,
                            std::span<const double> mean, const ExampleWeights& weights,
                            const ExampleSettings& settings = {});

}  // namespace kinemend
