// Fills gaps of markers. The method `auto` averages several ways to fill a gap, weighted by trials.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/text.hpp"
#include "fill/driver.hpp"
#include "fill/judgement.hpp"
#include "fill/methods.hpp"
#include "fill/regression.hpp"
#include "fill/samples.hpp"
#include "kinemend/error.hpp"
#include "motion/names.hpp"

namespace kinemend::fill {

namespace {

// A sample beside a gap is a spike if it is farther from a filling without it than this share of
// the body's radius. Not swept.
constexpr double spike_share = 0.1;
// A gap is refilled if one of this many steadiest companions was missing in it. Not swept.
constexpr std::size_t steadiest = 8;

// `unlabelled`: whether unlabelled markers are evidence.
Samples samples_of(const Take& clip, const std::vector<std::uint8_t>& seen, bool unlabelled) {
  Samples samples;
  samples.frames = clip.frame_count();
  samples.markers = clip.marker_count();
  samples.frame_rate_hz = clip.frame_rate_hz;
  samples.first_frame = clip.first_frame;
  samples.positions = clip.positions;
  samples.measured = clip.observed;
  samples.seen = seen;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (clip.holds_positions(m) && (unlabelled || !is_unlabelled(clip.names[m])))
      samples.bodies.push_back(m);
  }
  samples.unit = clip.unit;
  samples.radius = body_radius(samples);
  return samples;
}

// The fillings of one round are evidence for the next.
class MarkerTake : public GappedTake {
 public:
  MarkerTake(Take& clip, const std::vector<OpenGap>& gaps)
      : clip_(clip), gaps_(gaps), seen_(clip.observed) {
    frames = clip.frame_count();
    frame_rate_hz = clip.frame_rate_hz;
    never_seen = "the marker is never seen";
    unlabelled_ = std::any_of(gaps.begin(), gaps.end(), [&](const OpenGap& gap) {
      return gap.request->unlabelled || is_unlabelled(clip.names[gap.track]);
    });
  }

  Track around(const OpenGap& gap) const override {
    return track_around(samples_, {gap.track, gap.span()});
  }

  std::string unit_of(const OpenGap&) const override { return clip_.unit; }

  double spike_size(const OpenGap&) const override { return spike_share * samples_.radius; }

  // Fills by the method; a request to fill all falls back to the best guess if the method cannot.
  Filling fill(const OpenGap& gap, FrameSpan span) const override {
    const Method& method = *gap.request->method;
    const GapRequest& request = *gap.request;
    const double length_s = static_cast<double>(gap.gap.length()) / frame_rate_hz;
    if (!request.fill_all && request.longest_gap_s > 0 && length_s > request.longest_gap_s) {
      return Filling::refused(method.about.name,
                              fmt::format("the gap of {:.2f} s is longer than {:.2f} s", length_s,
                                          request.longest_gap_s));
    }
    const MarkerGap asked{gap.track, span};
    Filling filling = fill_marker(method, samples_, asked, request);
    if (filling.made() || !request.fill_all) return filling;
    return fill_by_auto(samples_, asked, request);
  }

  void begin_round() override { samples_ = samples_of(clip_, seen_, unlabelled_); }

  void learn(const OpenGap& gap, const Filling& filling) override {
    for (std::size_t i = 0; i < filling.values.size(); ++i) {
      const std::size_t frame = gap.gap.first_frame + i;
      clip_.position(frame, gap.track) = filling.values[i];
      seen_[frame * clip_.marker_count() + gap.track] = filling.is_evidence ? 1 : 0;
    }
  }

  // A gap gains if a steady companion was missing in it, because the companion's filling is
  // evidence now.
  bool gains(const OpenGap& gap) const override {
    const FrameSpan span = gap.span();
    const bool overlaps = std::any_of(gaps_.begin(), gaps_.end(), [&](const OpenGap& other) {
      return other.track != gap.track && other.gap.first_frame <= span.last &&
             span.first <= other.gap.last_frame;
    });
    if (!overlaps) return false;
    const MarkerGap asked{gap.track, span};
    const auto companions = companions_of(samples_, asked, helpers_of(samples_, asked));
    for (std::size_t k = 0; k < std::min(steadiest, companions.size()); ++k) {
      for (std::size_t f = span.first; f <= span.last; ++f) {
        if (!clip_.is_observed(f, companions[k].marker)) return true;
      }
    }
    return false;
  }

  void store(const OpenGap& gap, const Filling&) override {
    for (std::size_t f = gap.gap.first_frame; f <= gap.gap.last_frame; ++f) {
      const std::size_t sample = f * clip_.marker_count() + gap.track;
      clip_.observed[sample] = 1;
      if (!clip_.residuals.empty()) clip_.residuals[sample] = 0;
    }
  }

 private:
  Take& clip_;
  const std::vector<OpenGap>& gaps_;
  std::vector<std::uint8_t> seen_;  // F x M: observed, or filled in an earlier round
  Samples samples_;
  bool unlabelled_ = false;
};

}  // namespace

std::size_t donor_of(const Take& clip, const std::string& name) {
  if (name.empty()) return GapRequest::no_marker;
  std::int32_t donor = clip.find(name);
  if (donor < 0) {
    const std::vector<std::uint8_t> meant = names_meant(clip.names, name);
    if (std::count(meant.begin(), meant.end(), 1) == 1)
      donor = static_cast<std::int32_t>(std::find(meant.begin(), meant.end(), 1) - meant.begin());
  }
  if (donor < 0) {
    throw Error(ErrorKind::usage, fmt::format("fill: there is no donor \"{}\" (the take has {})",
                                              name, fmt::join(clip.names, ", ")));
  }
  return static_cast<std::size_t>(donor);
}

std::vector<OpenGap> open_marker_gaps(const Take& clip) {
  std::vector<OpenGap> gaps;
  for (const Gap& gap : find_gaps(clip)) gaps.push_back({gap});
  return gaps;
}

std::vector<FilledGap> fill_asked_markers(Take& clip, const RequestOf& request_of,
                                          const Check& check) {
  std::vector<OpenGap> gaps;
  for (const Gap& gap : find_gaps(clip)) {
    if (const GapRequest* request = request_of(gap, false))
      gaps.push_back({gap, false, gap.track, request});
  }
  MarkerTake take(clip, gaps);
  return fill_take(take, gaps, check);
}

namespace {

constexpr std::string_view name = "auto";

// Chosen on the takes that docs/measured/fill.md names. Both are shares of the body's radius:
// larger expected errors are refused, and smaller ones are raised to the least.
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

Filling without_support(const Samples& samples, const MarkerGap& gap, const GapRequest& request) {
  Filling filling = fill_marker_by_cycles(samples, gap, request);
  if (filling.made()) return filling;
  if (request.fill_all) {
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

Filling fill_by_auto(const Samples& samples, const MarkerGap& gap, const GapRequest& request) {
  const Candidates candidates(samples, gap);
  if (!candidates.any()) return without_support(samples, gap, request);
  const Proposals proposals = candidates.proposals(gap, frames_of(gap.span));
  const Trials trials = try_candidates(samples, gap, candidates);
  if (trials.products.empty()) {
    if (!request.fill_all && !candidates.is_short() && !candidates.on_a_segment()) {
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
  if (request.fill_all || radius == 0 || filling.expected_error <= largest_error * radius) {
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
