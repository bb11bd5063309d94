// Tries the methods on observed spans and scores them beside what is usual.
#include "fill/joint_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/portable.hpp"
#include "fill/trials.hpp"

namespace kinemend::fill {

namespace {

using Methods = std::vector<const Method*>;

// The usual errors weigh as much as this many trials; chosen on the takes that docs/methods/fill.md
// names.
constexpr double usual_trials = 4;
// Differences below these sizes are ignored: a share of the skeleton's height, and degrees; not
// swept.
constexpr double grain_of_height = 1e-4, grain_deg = 0.01;
// A trial includes this much of the take on either side: the farthest cycle and its surroundings.
constexpr double reach_s = 17;

// Adds the straight line and the spline, by which the other methods are judged.
Methods with_references(std::span<const Method* const> methods) {
  Methods all(methods.begin(), methods.end());
  for (const char* name : {"slerp", "spline"}) {
    const Method* reference = &find_method(name, true);
    if (std::find(all.begin(), all.end(), reference) == all.end()) all.push_back(reference);
  }
  return all;
}

std::vector<Vec3> offsets(const Track& track, const std::vector<std::size_t>& frames,
                          const std::vector<Sample>& from) {
  std::vector<Vec3> result;
  result.reserve(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i)
    result.push_back(track.offset_from(from[i], frames[i]));
  return result;
}

std::vector<Sample> samples_at(const Track& track, const std::vector<std::size_t>& frames) {
  std::vector<Sample> result;
  result.reserve(frames.size());
  for (const std::size_t f : frames) result.push_back(track.sample(f));
  return result;
}

// Returns the methods' errors over an observed span.
Proposals try_on(const Track& track, FrameSpan span, TakeEnds ends, std::vector<std::size_t> frames,
                 const Methods& methods, const JointContext& context) {
  const auto reach = static_cast<std::size_t>(std::lround(reach_s * context.frame_rate_hz));
  Track part = hide_span(track, span, ends, reach + 2 * span.length(), context.frame_rate_hz);
  const std::size_t shift = part.first_frame - track.first_frame;
  const std::vector<Sample> truth = samples_at(track, frames);
  for (std::size_t& f : frames) f -= shift;
  Proposals errors(methods.size());
  std::size_t line = 0;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    if (methods[m]->joint_rules.kind == CandidateKind::line) line = m;
    if (fill_joint(*methods[m], part, {span.first - shift, span.last - shift}, context))
      errors[m] = offsets(part, frames, truth);
  }
  for (std::vector<Vec3>& of_method : errors) {
    if (of_method.empty()) of_method = errors[line];
  }
  return errors;
}

// Returns the logarithm of a method's usual square error relative to slerp's, interpolated between
// the lengths in the table.
double usual_log_square(const Method& method, double length_s) {
  const auto& lengths = usual_lengths_s;
  const double clamped = std::clamp(length_s, lengths.front(), lengths.back());
  const auto above = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, clamped);
  const auto k = static_cast<std::size_t>(above - lengths.begin());
  const double t =
      portable::log(clamped / lengths[k - 1]) / portable::log(lengths[k] / lengths[k - 1]);
  const auto& usual = method.joint_rules.usual_errors;
  return 2 * ((1 - t) * portable::log(usual[k - 1]) + t * portable::log(usual[k]));
}

void score(std::vector<JointProposal>& proposals, const Judgement& judgement, double weight,
           double length_s, bool at_end) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double measured_mean = 0, usual_mean = 0, count = 0;
  std::vector<double> measured(proposals.size()), usual(proposals.size());
  for (std::size_t c = 0; c < proposals.size(); ++c) {
    usual[c] = usual_log_square(*proposals[c].method, length_s);
    measured[c] = portable::log(judgement.squares()[c] + std::numeric_limits<double>::min());
    if (!std::isfinite(judgement.squares()[c])) continue;
    measured_mean += measured[c], usual_mean += usual[c], count += 1;
  }
  const double trust = weight / (weight + usual_trials);
  for (std::size_t c = 0; c < proposals.size(); ++c) {
    JointProposal& proposal = proposals[c];
    std::vector<double> alone(proposals.size());
    alone[c] = 1;
    proposal.expected_error = judgement.expected_error(alone);
    const CandidateKind kind = proposal.method->joint_rules.kind;
    if (kind == CandidateKind::line) {
      proposal.score = infinite;
      continue;
    }
    const bool is_short = length_s <= short_gap_s && !at_end;
    if (kind == CandidateKind::spline && is_short) measured[c] -= portable::log(clearly_better);
    proposal.score = trust * (measured[c] - measured_mean / count) +
                     (1 - trust) * (usual[c] - usual_mean / count);
  }
}

}  // namespace

std::vector<JointProposal> propose(const Track& track, FrameSpan gap,
                                   std::span<const Method* const> methods,
                                   const JointContext& context) {
  std::vector<JointProposal> proposals, impossible;
  Proposals filled;
  std::vector<CandidateKind> kinds;
  Methods able;
  const std::vector<std::size_t> frames = frames_of(gap, trial_frames);
  Track copy = track;
  std::vector<Sample> first;
  for (const Method* method : with_references(methods)) {
    if (track.is_position && !method->joint_rules.positions) continue;
    if (!fill_joint(*method, copy, gap, context)) {
      impossible.push_back({method});
      continue;
    }
    if (first.empty()) first = samples_at(copy, frames);
    proposals.push_back({method, values_in(copy, gap)});
    filled.push_back(offsets(copy, frames, first));
    kinds.push_back(method->joint_rules.kind);
    able.push_back(method);
  }
  const double length_s = static_cast<double>(gap.length()) / context.frame_rate_hz;
  TrialRoom room = room_around(gap, track.frames(), context.frame_rate_hz);
  std::copy_n(track.observed.begin() + static_cast<std::ptrdiff_t>(room.evidence.first),
              room.usable.size(), room.usable.begin());
  Trials trials;
  if (!able.empty()) {
    trials = try_out(room, [&](FrameSpan span, const std::vector<std::size_t>& compared) {
      return try_on(track, span, room.ends, compared, able, context);
    });
  }
  if (trials.products.empty()) {
    for (JointProposal& proposal : proposals)
      proposal.score = usual_log_square(*proposal.method, length_s);
  } else {
    const double grain =
        track.is_position ? grain_of_height * context.height : grain_deg * radians_per_degree;
    const double weight = trials.weight;
    const Judgement judgement(kinds, products_of(filled), std::move(trials), grain);
    score(proposals, judgement, weight, length_s, room.ends.any());
  }
  proposals.insert(proposals.end(), impossible.begin(), impossible.end());
  std::erase_if(proposals, [&](const JointProposal& proposal) {
    return std::find(methods.begin(), methods.end(), proposal.method) == methods.end();
  });
  for (JointProposal& proposal : proposals)
    if (!track.is_position) proposal.expected_error *= degrees_per_radian;
  std::stable_sort(
      proposals.begin(), proposals.end(), [](const JointProposal& a, const JointProposal& b) {
        return std::pair(a.values.empty(), a.score) < std::pair(b.values.empty(), b.score);
      });
  return proposals;
}

}  // namespace kinemend::fill
