// The method `auto` for markers: averages several ways to fill a gap, weighted by trials.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/measure.hpp"
#include "fill/local_regression.hpp"
#include "fill/marker_methods.hpp"
#include "fill/trials.hpp"

namespace kinemend::fill {

namespace {

constexpr std::string_view name = "auto";

// Chosen on the takes that docs/methods/fill.md names. Both are shares of the body's radius: larger
// expected errors are refused, and smaller ones are raised to the least.
constexpr double largest_error = 0.125, least_error = 1e-4;
constexpr std::array<std::size_t, 2> group_sizes = {6, 12};  // of companions
constexpr std::array<double, 2> noises = {1e-4, 2e-2};       // clean samples, and jittery ones
// Splines go far astray in longer gaps; a curve whose end velocities fade does not. Not swept.
constexpr double longest_spline_s = 1;

// All ways to fill a gap, which can also be tried on other spans.
class Candidates {
 public:
  Candidates(const Samples& samples, const MarkerGap& gap)
      : samples_(samples),
        companions_(companions_of(samples, gap, helpers_of(samples, gap))),
        stiffness_(stiffnesses_of(samples.radius)) {
    for (const std::size_t size : group_sizes) {
      if (companions_.size() < least_companions) break;
      if (!regressions_.empty() && companions_.size() <= group_sizes.front()) break;
      regressions_.emplace_back(samples, gap, companions_, size);
      if (!regressions_.back().usable()) regressions_.pop_back();
    }
    for (std::size_t i = 0; i < noises.size() * regressions_.size(); ++i) {
      for (const double stiffness : stiffness_)
        add(CandidateKind::model, std::isfinite(stiffness) ? "local-regression" : "rigid-body");
    }
    is_short_ = gap.span.length() <= samples.frames_in(short_gap_s, 1);
    if (!is_short_ && kinds_.empty()) return;
    const bool is_inside = !gap.ends.any();
    has_spline_ =
        is_short_ || (is_inside && gap.span.length() <= samples.frames_in(longest_curve_s, 1));
    if (has_spline_) add(is_short_ ? CandidateKind::spline : CandidateKind::curve, "spline");
    add(CandidateKind::line, "");
  }

  bool any() const { return !kinds_.empty(); }
  /// Whether the gap is so short that a spline may fill it without a trial.
  bool is_short() const { return is_short_; }
  /// Whether the marker's own segment has enough companions to predict it without a trial.
  bool on_a_segment() const {
    return !regressions_.empty() &&
           companions_[least_companions - 1].spread <= segment_spread * samples_.radius;
  }
  std::vector<std::size_t> markers_used() const {
    if (regressions_.empty()) return {};
    const auto markers = regressions_.back().group().markers();
    return {markers.begin(), markers.end()};
  }
  const std::vector<CandidateKind>& kinds() const { return kinds_; }
  std::string_view method(std::size_t candidate) const { return methods_[candidate]; }
  std::size_t spline() const { return kinds_.size() - 2; }

  /// Returns the positions in the requested frames, for each candidate.
  Proposals proposals(const MarkerGap& gap, const std::vector<std::size_t>& wanted) const {
    Proposals all;
    for (const LocalRegression& regression : regressions_) {
      const LocalRegression::Scene scene = regression.scene_of(gap, wanted);
      const std::vector<Rows> predictions = regression.predict(scene, stiffness_);
      for (const double noise : noises) {
        const Bridge bridge = regression.bridge_of(scene, {.noise = noise});
        for (const Rows& prediction : predictions)
          all.push_back(LocalRegression::meet_ends(scene, bridge, prediction));
      }
    }
    if (kinds_.empty()) return all;
    for (const Curve curve : {Curve::cubic, Curve::linear}) {
      if (curve == Curve::cubic && !has_spline_) continue;
      const std::vector<Vec3> whole = curve_positions(samples_, gap, curve);
      all.emplace_back();
      for (const std::size_t f : wanted) all.back().push_back(whole[f - gap.span.first]);
    }
    return all;
  }

 private:
  void add(CandidateKind kind, std::string_view method) {
    kinds_.push_back(kind);
    methods_.push_back(method);
  }

  const Samples& samples_;
  std::vector<Companion> companions_;
  std::array<double, 3> stiffness_;
  std::vector<LocalRegression> regressions_;
  std::vector<CandidateKind> kinds_;
  std::vector<std::string_view> methods_;
  bool is_short_ = false, has_spline_ = false;
};

Proposals offsets_from(Proposals proposals, const std::vector<Vec3>& origin) {
  for (std::vector<Vec3>& proposal : proposals) {
    for (std::size_t i = 0; i < origin.size(); ++i) proposal[i] = proposal[i] - origin[i];
  }
  return proposals;
}

Trials try_candidates(const Samples& samples, const MarkerGap& gap, const Candidates& candidates) {
  const std::vector<std::size_t> used = candidates.markers_used();
  TrialRoom room = room_around(gap.span, samples.frames, samples.frame_rate_hz);
  for (const std::size_t f : frames_showing(samples, gap, used))
    room.usable[f - room.evidence.first] = 1;
  return try_out(room, [&](FrameSpan span, const std::vector<std::size_t>& frames) {
    std::vector<Vec3> truth;
    truth.reserve(frames.size());
    for (const std::size_t f : frames) truth.push_back(samples.at(f, gap.marker));
    return offsets_from(candidates.proposals({gap.marker, span, room.ends}, frames), truth);
  });
}

// Returns the average of the proposals for a gap, weighted by the trials.
Filling average(const Samples& samples, const MarkerGap& gap, const Candidates& candidates,
                const Proposals& proposals, const Trials& trials) {
  const Judgement judgement(candidates.kinds(),
                            products_of(offsets_from(proposals, proposals.front())), trials,
                            least_error * samples.radius);
  const std::vector<double> weights = judgement.weights(clearly_better);
  std::map<std::string_view, double> shares;
  Filling filling{std::vector<Vec3>(gap.span.length())};
  for (std::size_t c = 0; c < proposals.size(); ++c) {
    shares[candidates.method(c)] += weights[c];
    for (std::size_t i = 0; i < filling.values.size(); ++i)
      filling.values[i] += weights[c] * proposals[c][i];
  }
  filling.method = std::max_element(shares.begin(), shares.end(), [](const auto& a, const auto& b) {
                     return a.second < b.second;
                   })->first;
  filling.expected_error = judgement.expected_error(weights);
  filling.is_evidence = candidates.kinds().front() == CandidateKind::model;
  if (filling.is_evidence) filling.markers_used = candidates.markers_used();
  return filling;
}

Filling without_support(const Samples& samples, const MarkerGap& gap,
                        const MarkerRequest& request) {
  Filling filling = fill_marker_by_cycles(samples, gap, request);
  if (filling.made()) return filling;
  if (request.lenient) {
    const bool is_long = gap.span.length() > samples.frames_in(longest_spline_s, 1);
    return is_long ? fill_by_curve(samples, gap, request, Curve::hermite, "hermite")
                   : fill_by_curve(samples, gap, request, Curve::cubic, "spline");
  }
  return Filling::refused(name,
                          "too long for a curve, fewer than three other markers are seen "
                          "throughout the gap, and no other cycles are alike",
                          true);
}

}  // namespace

Filling fill_by_auto(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request) {
  const Candidates candidates(samples, gap);
  if (!candidates.any()) return without_support(samples, gap, request);
  const Proposals proposals = candidates.proposals(gap, frames_of(gap.span));
  const Trials trials = try_candidates(samples, gap, candidates);
  if (trials.products.empty()) {
    if (!request.lenient && !candidates.is_short() && !candidates.on_a_segment()) {
      return Filling::refused(name, "the marker is seen too little to try a method on it");
    }
    const std::size_t chosen =
        candidates.on_a_segment() || !candidates.is_short() ? 0 : candidates.spline();
    Filling filling{proposals[chosen], std::string(candidates.method(chosen))};
    if (candidates.kinds()[chosen] == CandidateKind::model)
      filling.markers_used = candidates.markers_used();
    return filling;
  }
  Filling filling = average(samples, gap, candidates, proposals, trials);
  // Without other markers there is no size to judge the error by; a curve fills short gaps only.
  const double radius = samples.radius;
  if (request.lenient || radius == 0 || filling.expected_error <= largest_error * radius) {
    return filling;
  }
  Filling refused = Filling::refused(
      filling.method,
      fmt::format("the expected error of {} is above {}, an eighth of the radius of "
                  "the marker set",
                  measure_text(filling.expected_error, samples.unit),
                  measure_text(largest_error * radius, samples.unit)));
  refused.expected_error = filling.expected_error;
  return refused;
}

}  // namespace kinemend::fill
