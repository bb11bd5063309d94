#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "fill/local_regression.hpp"
#include "fill/marker_methods.hpp"

namespace kinemend::fill {

namespace {

constexpr std::string_view name = "auto";
constexpr double longest_curve_s = 0.1;
constexpr double longest_spline_s = 1;
constexpr std::size_t trials = 5;
constexpr std::size_t trial_frames = 12;
constexpr std::size_t least_companions = 3;
// Expected errors beyond this share of the body's radius are refused.
constexpr double largest_error = 0.1;

// Groups of companions, and how stiff the body is taken to be (shares of its radius).
constexpr std::array<std::size_t, 2> group_sizes = {6, 12};
constexpr std::array<double, 3> stiffnesses = {0.0015, 0.008,
                                               std::numeric_limits<double>::infinity()};
// Clean samples, and trembling ones.
constexpr std::array<double, 2> noises = {1e-4, 2e-2};

struct Proposal {
  std::vector<Vec3> positions;
  std::string_view method;
};

std::vector<std::size_t> frames_of(Span span, std::size_t most) {
  std::vector<std::size_t> frames(span.length());
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i] = span.first + i;
  return evenly(frames, most);
}

// All ways that a gap may be filled in, ready to be tried on other spans as well.
class Candidates {
 public:
  Candidates(const Samples& samples, const MarkerGap& gap, double radius)
      : samples_(samples),
        gap_(gap),
        companions_(companions_of(samples, gap, helpers_of(samples, gap))) {
    for (std::size_t s = 0; s < stiffnesses.size(); ++s) stiffness_[s] = stiffnesses[s] * radius;
    for (const std::size_t size : group_sizes) {
      if (companions_.size() < least_companions) break;
      if (!regressions_.empty() && companions_.size() <= group_sizes.front()) break;
      regressions_.emplace_back(samples, gap, companions_, size);
      if (!regressions_.back().usable()) regressions_.pop_back();
    }
    const bool inside = gap.span.first > 0 && gap.span.last + 1 < samples.frames;
    curves_ = inside && gap.span.length() <= samples.frames_in(longest_curve_s, 1);
  }

  bool any() const { return !regressions_.empty() || curves_; }
  bool has_curve() const { return curves_; }
  /// Whether its segment alone vouches for the marker.
  bool on_a_segment(double radius) const {
    return !regressions_.empty() &&
           companions_[least_companions - 1].spread <= segment_spread * radius;
  }
  std::vector<std::size_t> markers_used() const {
    if (regressions_.empty()) return {};
    const auto markers = regressions_.back().group().markers();
    return {markers.begin(), markers.end()};
  }

  std::vector<Proposal> proposals(Span span, const std::vector<std::size_t>& wanted) const {
    std::vector<Proposal> all;
    for (const LocalRegression& regression : regressions_) {
      const LocalRegression::Scene scene = regression.scene_of(span, wanted);
      const std::vector<LocalRegression::Rows> predictions = regression.predict(scene, stiffness_);
      for (const double noise : noises) {
        const Bridge bridge = regression.bridge_of(scene, {.noise = noise});
        for (std::size_t s = 0; s < predictions.size(); ++s) {
          all.push_back({LocalRegression::meet_ends(scene, bridge, predictions[s]),
                         std::isfinite(stiffness_[s]) ? "local-regression" : "rigid-body"});
        }
      }
    }
    if (curves_) all.push_back(curve(span, wanted));
    return all;
  }

 private:
  Proposal curve(Span span, const std::vector<std::size_t>& wanted) const {
    const std::vector<Vec3> whole = curve_positions(samples_, {gap_.marker, span}, Curve::cubic);
    Proposal proposal{{}, "spline"};
    for (const std::size_t f : wanted) proposal.positions.push_back(whole[f - span.first]);
    return proposal;
  }

  const Samples& samples_;
  MarkerGap gap_;
  std::vector<Companion> companions_;
  std::array<double, stiffnesses.size()> stiffness_{};
  std::vector<LocalRegression> regressions_;
  bool curves_ = false;
};

double mean_square(const Samples& samples, std::size_t marker,
                   const std::vector<std::size_t>& frames, const std::vector<Vec3>& positions) {
  double sum = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Vec3 error = positions[i] - samples.at(frames[i], marker);
    sum += dot(error, error);
  }
  return sum / static_cast<double>(frames.size());
}

// The mean square error of each candidate over spans of the take; empty where it has no room.
std::vector<double> try_out(const Samples& samples, const MarkerGap& gap,
                            const Candidates& candidates) {
  const std::vector<Span> spans = trial_spans(samples, gap, candidates.markers_used(), trials);
  std::vector<double> squares;
  for (const Span span : spans) {
    const std::vector<std::size_t> wanted = frames_of(span, trial_frames);
    const std::vector<Proposal> proposals = candidates.proposals(span, wanted);
    squares.resize(proposals.size());
    for (std::size_t c = 0; c < proposals.size(); ++c) {
      squares[c] += mean_square(samples, gap.marker, wanted, proposals[c].positions) /
                    static_cast<double>(spans.size());
    }
  }
  return squares;
}

// The proposals averaged by the inverse squares of their mean square errors.
Filling average(std::vector<Proposal> proposals, const std::vector<double>& squares) {
  const auto best =
      static_cast<std::size_t>(std::min_element(squares.begin(), squares.end()) - squares.begin());
  double total = 0;
  std::vector<double> weights;
  for (const double square : squares) {
    const double share = square > 0 ? squares[best] / square : 1;
    weights.push_back(share * share);
    total += weights.back();
  }
  Filling filling{std::vector<Vec3>(proposals[best].positions.size()),
                  std::string(proposals[best].method),
                  {},
                  std::sqrt(squares[best])};
  filling.is_evidence = proposals.size() > 1;
  for (std::size_t c = 0; c < proposals.size(); ++c) {
    for (std::size_t i = 0; i < filling.positions.size(); ++i) {
      filling.positions[i] += (weights[c] / total) * proposals[c].positions[i];
    }
  }
  return filling;
}

Filling without_support(const Samples& samples, const MarkerGap& gap,
                        const MarkerRequest& request) {
  Filling filling = fill_by_cycles(samples, gap, request);
  if (!filling.positions.empty()) return filling;
  if (request.lenient) {
    // A spline goes far astray in a long gap; a curve whose end velocities fade does not.
    const bool is_long = gap.span.length() > samples.frames_in(longest_spline_s, 1);
    return (is_long ? fill_by_hermite : fill_by_spline)(samples, gap, request);
  }
  filling = Filling::refused(name,
                             "too long for a curve, fewer than three other markers are seen "
                             "throughout the gap, and no other cycles are alike");
  filling.may_wait = true;
  return filling;
}

}  // namespace

Filling fill_by_auto(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request) {
  const double radius = samples.radius;
  const Candidates candidates(samples, gap, radius);
  if (!candidates.any()) return without_support(samples, gap, request);
  const std::vector<double> squares = try_out(samples, gap, candidates);
  std::vector<Proposal> proposals =
      candidates.proposals(gap.span, frames_of(gap.span, gap.span.length()));
  if (squares.empty()) {
    if (!request.lenient && !candidates.has_curve() && !candidates.on_a_segment(radius)) {
      return Filling::refused(name, "the marker is seen too little to try a method on it");
    }
    const Proposal& proposal =
        candidates.on_a_segment(radius) ? proposals.front() : proposals.back();
    return {proposal.positions, std::string(proposal.method)};
  }
  Filling filling = average(std::move(proposals), squares);
  // Without other markers there is no size to judge by; a curve is short.
  if (request.lenient || radius == 0 || filling.expected_error <= largest_error * radius) {
    return filling;
  }
  Filling refused = Filling::refused(
      filling.method, fmt::format("expected to be off by {:.3g}, more than a tenth of the body's "
                                  "radius of {:.3g}",
                                  filling.expected_error, radius));
  refused.expected_error = filling.expected_error;
  return refused;
}

}  // namespace kinemend::fill
