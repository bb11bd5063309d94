#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fill/local_regression.hpp"
#include "fill/marker_methods.hpp"

namespace kinemend::fill {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double longest_curve_s = 0.5;
constexpr std::size_t trials = 8;
constexpr std::size_t least_companions = 3;
// Expected errors beyond this share of the body's radius are refused.
constexpr double largest_error = 0.1;

// Stiffness as shares of the body's radius.
constexpr std::array<double, 4> stiffness_shares = {0.004, 0.012, 0.04, infinite};

// The candidates: the regressions, then the curve.
using Guesses = std::vector<std::vector<Vec3>>;

class Candidates {
 public:
  Candidates(const Samples& samples, const MarkerGap& gap, double radius)
      : samples_(samples), gap_(gap), regression_(samples, gap, helpers_of(samples, gap)) {
    for (const double share : stiffness_shares) stiffness_.push_back(share * radius);
    regresses_ = regression_.usable() && regression_.group().markers().size() >= least_companions;
    const bool inside = gap.span.first > 0 && gap.span.last + 1 < samples.frames;
    curves_ =
        inside && static_cast<double>(gap.span.length()) <= longest_curve_s * samples.frame_rate_hz;
  }

  bool any() const { return regresses_ || curves_; }
  bool regresses() const { return regresses_; }
  std::vector<std::size_t> companions() const {
    if (!regresses_) return {};
    const auto markers = regression_.group().markers();
    return {markers.begin(), markers.end()};
  }

  Guesses guess(Span span, const std::vector<std::size_t>& wanted) const {
    Guesses guesses;
    if (regresses_) guesses = regression_.predict(span, wanted, stiffness_);
    if (curves_) {
      const std::vector<Vec3> whole = curve_positions(samples_, {gap_.marker, span}, Curve::cubic);
      std::vector<Vec3> chosen;
      for (const std::size_t f : wanted) chosen.push_back(whole[f - span.first]);
      guesses.push_back(std::move(chosen));
    }
    return guesses;
  }

  std::string_view name(std::size_t candidate) const {
    if (regresses_ && candidate + 1 < stiffness_.size()) return "local-regression";
    return regresses_ && candidate + 1 == stiffness_.size() ? "rigid-body" : "spline";
  }

 private:
  const Samples& samples_;
  MarkerGap gap_;
  LocalRegression regression_;
  std::vector<double> stiffness_;
  bool regresses_ = false;
  bool curves_ = false;
};

std::vector<std::size_t> frames_of(Span span, std::size_t most) {
  std::vector<std::size_t> frames(span.length());
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i] = span.first + i;
  return evenly(frames, most);
}

std::vector<Vec3> average(const Guesses& guesses, const std::vector<double>& weights) {
  std::vector<Vec3> mean(guesses.front().size());
  for (std::size_t c = 0; c < guesses.size(); ++c) {
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += weights[c] * guesses[c][i];
  }
  return mean;
}

}  // namespace

Filling fill_by_auto(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request) {
  const double radius = body_radius(samples);
  const Candidates candidates(samples, gap, radius);
  if (!candidates.any()) {
    Filling refused = Filling::refused(
        "auto", "no other markers are seen with it, and it is too long for a curve");
    refused.may_wait = true;
    return refused;
  }
  std::vector<double> squares;
  std::vector<Guesses> tried;
  const std::vector<Span> spans = trial_spans(samples, gap, candidates.companions(), trials);
  for (const Span span : spans) {
    const std::vector<std::size_t> wanted = frames_of(span, 16);
    const Guesses guesses = candidates.guess(span, wanted);
    squares.resize(guesses.size());
    for (std::size_t c = 0; c < guesses.size(); ++c) {
      double sum = 0;
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        const Vec3 error = guesses[c][i] - samples.at(wanted[i], gap.marker);
        sum += dot(error, error);
      }
      squares[c] += sum / static_cast<double>(wanted.size());
    }
  }
  const Guesses guesses = candidates.guess(gap.span, frames_of(gap.span, gap.span.length()));
  if (squares.empty()) squares.assign(guesses.size(), 1);
  std::vector<double> weights;
  double sum = 0;
  for (const double square : squares) {
    weights.push_back(1 / (square * square + 1e-300));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  Filling filling;
  filling.positions = average(guesses, weights);
  const auto best =
      static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
  filling.method = candidates.name(best);
  filling.expected_error =
      spans.empty() ? 0 : std::sqrt(squares[best] / static_cast<double>(spans.size()));
  if (!request.lenient && filling.expected_error > largest_error * radius) {
    Filling refused = Filling::refused(
        filling.method,
        fmt::format(
            "the expected error of {:.3g} is more than a tenth of the body's radius of {:.3g}",
            filling.expected_error, radius));
    refused.expected_error = filling.expected_error;
    return refused;
  }
  return filling;
}

}  // namespace kinemend::fill
