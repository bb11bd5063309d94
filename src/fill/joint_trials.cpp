#include "fill/joint_trials.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fill/judgement.hpp"
#include "fill/samples.hpp"
#include "fill/trial_places.hpp"

namespace kinemend::fill {

namespace {

constexpr std::size_t most_frames = 12;  // of a span that are compared

using Methods = std::vector<const JointMethod*>;

// With the straight line and the spline, by which the others are judged.
Methods with_references(std::span<const JointMethod* const> methods) {
  Methods all(methods.begin(), methods.end());
  for (const char* name : {"slerp", "spline"}) {
    const JointMethod* reference = find_joint_method(name);
    if (std::find(all.begin(), all.end(), reference) == all.end()) all.push_back(reference);
  }
  return all;
}

CandidateKind kind_of(const JointMethod& method) {
  if (method.name == "slerp") return CandidateKind::line;
  if (method.name == "spline") return CandidateKind::spline;
  return method.name == "cyclic" || method.name == "pca" ? CandidateKind::model
                                                         : CandidateKind::curve;
}

// A length below which differences mean nothing, in the track's unit.
double grain_of(const JointTrack& track, const JointContext& context) {
  return track.is_position ? 1e-4 * context.height : 0.01 * radians_per_degree;
}

// The frames of a span in which proposals are compared.
std::vector<std::size_t> compared(FrameSpan span) {
  std::vector<std::size_t> frames(span.length());
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i] = span.first + i;
  return evenly(frames, most_frames);
}

std::vector<double> values_of(const JointTrack& track, FrameSpan span) {
  const auto at = [&](std::size_t frame) {
    return track.values.begin() + static_cast<std::ptrdiff_t>(3 * frame);
  };
  return {at(span.first), at(span.last + 1)};
}

// How far the track's samples are from `truth`, as vectors.
std::vector<Vec3> offsets(const JointTrack& track, const std::vector<std::size_t>& frames,
                          const std::vector<Quat>& rotations, const std::vector<Vec3>& positions) {
  std::vector<Vec3> result;
  result.reserve(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    result.push_back(track.is_position ? track.at(frames[i]) - positions[i]
                                       : log(conjugate(rotations[i]) * track.rotation(frames[i])));
  }
  return result;
}

// What stands in these frames of a track.
struct Standing {
  std::vector<Quat> rotations;
  std::vector<Vec3> positions;

  Standing(const JointTrack& track, const std::vector<std::size_t>& frames) {
    for (const std::size_t f : frames) {
      positions.push_back(track.at(f));
      if (!track.is_position) rotations.push_back(track.rotation(f));
    }
  }
};

// Products of the methods' errors over an observed span.
Eigen::MatrixXd try_span(const JointTrack& track, FrameSpan span, TakeEnds ends,
                         const Methods& methods, const JointContext& context) {
  // As far as another cycle may be, and what is compared around it.
  const auto reach = static_cast<std::size_t>(std::lround(17 * context.frame_rate_hz));
  JointTrack part = hide_span(track, span, ends, reach + 2 * span.length(), context.frame_rate_hz);
  const std::size_t shift = part.first_frame - track.first_frame;
  const FrameSpan hidden{span.first - shift, span.last - shift};
  std::vector<std::size_t> frames = compared(span);
  const Standing truth(track, frames);
  for (std::size_t& f : frames) f -= shift;
  std::vector<std::vector<Vec3>> errors(methods.size());
  std::size_t line = 0;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    if (kind_of(*methods[m]) == CandidateKind::line) line = m;
    if (methods[m]->fill(part, hidden, context))
      errors[m] = offsets(part, frames, truth.rotations, truth.positions);
  }
  for (std::vector<Vec3>& of_method : errors) {
    if (of_method.empty()) of_method = errors[line];
  }
  return products_of(errors, std::vector<Vec3>(frames.size()));
}

// How many trials that share no frame the spans amount to.
double independent(std::vector<FrameSpan> spans) {
  std::sort(spans.begin(), spans.end(),
            [](const FrameSpan& a, const FrameSpan& b) { return a.first < b.first; });
  std::size_t covered = 0, end = 0;
  for (const FrameSpan span : spans) {
    covered += span.last + 1 - std::min(span.last + 1, std::max(span.first, end));
    end = std::max(end, span.last + 1);
  }
  return spans.empty() ? 0 : static_cast<double>(covered) / static_cast<double>(spans[0].length());
}

struct JointTrials {
  Trials trials;
  double weight = 0;  ///< beside what is usual: trials of their own, fewer where they are shorter
};

JointTrials try_out(const JointTrack& track, FrameSpan gap, const Methods& methods,
                    const JointContext& context) {
  const auto minute = static_cast<std::size_t>(std::lround(60 * context.frame_rate_hz));
  const std::size_t reach = std::max(minute, 10 * gap.length());
  const std::size_t first = gap.first - std::min(gap.first, reach);
  const std::size_t end = std::min(track.observed.size(), gap.last + 1 + reach);
  const auto usable = std::span(track.observed).subspan(first, end - first);
  const TakeEnds ends{gap.first == 0, gap.last + 1 == track.observed.size()};
  const std::vector<FrameSpan> spans = trial_places(usable, first, gap);
  JointTrials result;
  result.trials.at_end = ends.at_start || ends.at_end;
  for (const FrameSpan span : spans)
    result.trials.products.push_back(try_span(track, span, ends, methods, context));
  if (spans.empty()) return result;
  double& longer = result.trials.longer;
  longer = static_cast<double>(gap.length()) / static_cast<double>(spans[0].length());
  result.weight = independent(spans) / (longer * longer);
  return result;
}

// The logarithm of a method's usual square error beside slerp's, between the lengths that are
// known.
double usual_log_square(const JointMethod& method, double length_s) {
  const auto& lengths = usual_lengths_s;
  const double clamped = std::clamp(length_s, lengths.front(), lengths.back());
  const auto above = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, clamped);
  const auto k = static_cast<std::size_t>(above - lengths.begin());
  const double t = std::log(clamped / lengths[k - 1]) / std::log(lengths[k] / lengths[k - 1]);
  return 2 *
         ((1 - t) * std::log(method.usual_errors[k - 1]) + t * std::log(method.usual_errors[k]));
}

void score(std::vector<JointProposal>& proposals, const Judgement& judgement, double weight,
           double length_s, bool at_end) {
  constexpr double usual_trials = 4;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double measured_mean = 0, usual_mean = 0, count = 0;
  std::vector<double> measured(proposals.size()), usual(proposals.size());
  for (std::size_t c = 0; c < proposals.size(); ++c) {
    usual[c] = usual_log_square(*proposals[c].method, length_s);
    measured[c] = std::log(judgement.squares()[c] + std::numeric_limits<double>::min());
    if (!std::isfinite(judgement.squares()[c])) continue;
    measured_mean += measured[c], usual_mean += usual[c], count += 1;
  }
  const double trust = weight / (weight + usual_trials);
  for (std::size_t c = 0; c < proposals.size(); ++c) {
    JointProposal& proposal = proposals[c];
    std::vector<double> alone(proposals.size());
    alone[c] = 1;
    proposal.expected_error = judgement.expected_error(alone);
    const CandidateKind kind = kind_of(*proposal.method);
    if (kind == CandidateKind::line) {
      proposal.score = infinite;
      continue;
    }
    const bool is_short = length_s <= short_gap_s && !at_end;
    if (kind == CandidateKind::spline && is_short) measured[c] -= std::log(clearly_better);
    proposal.score = trust * (measured[c] - measured_mean / count) +
                     (1 - trust) * (usual[c] - usual_mean / count);
  }
}

}  // namespace

std::vector<JointProposal> propose(const JointTrack& track, FrameSpan gap,
                                   std::span<const JointMethod* const> methods,
                                   const JointContext& context) {
  std::vector<JointProposal> proposals, impossible;
  std::vector<std::vector<Vec3>> filled;
  std::vector<CandidateKind> kinds;
  Methods able;
  const std::vector<std::size_t> frames = compared(gap);
  JointTrack copy = track;
  std::vector<Quat> rotations;
  std::vector<Vec3> positions;
  for (const JointMethod* method : with_references(methods)) {
    if (track.is_position && !method->positions) continue;
    if (!method->fill(copy, gap, context)) {
      impossible.push_back({method, {}, 0, 0});
      continue;
    }
    if (positions.empty()) {
      const Standing first(copy, frames);
      rotations = first.rotations, positions = first.positions;
    }
    proposals.push_back({method, values_of(copy, gap), 0, 0});
    filled.push_back(offsets(copy, frames, rotations, positions));
    kinds.push_back(kind_of(*method));
    able.push_back(method);
  }
  const double length_s = static_cast<double>(gap.length()) / context.frame_rate_hz;
  JointTrials tried = able.empty() ? JointTrials{} : try_out(track, gap, able, context);
  if (tried.trials.products.empty()) {
    for (JointProposal& proposal : proposals)
      proposal.score = usual_log_square(*proposal.method, length_s);
  } else {
    const Eigen::MatrixXd products = products_of(filled, std::vector<Vec3>(frames.size()));
    const Judgement judgement(kinds, products, std::move(tried.trials), grain_of(track, context));
    const bool at_end = gap.first == 0 || gap.last + 1 == track.observed.size();
    score(proposals, judgement, tried.weight, length_s, at_end);
  }
  proposals.insert(proposals.end(), impossible.begin(), impossible.end());
  std::erase_if(proposals, [&](const JointProposal& proposal) {
    return std::find(methods.begin(), methods.end(), proposal.method) == methods.end();
  });
  std::stable_sort(
      proposals.begin(), proposals.end(), [](const JointProposal& a, const JointProposal& b) {
        return std::pair(a.values.empty(), a.score) < std::pair(b.values.empty(), b.score);
      });
  return proposals;
}

}  // namespace kinemend::fill
