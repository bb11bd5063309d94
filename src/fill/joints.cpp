// Fills gaps of joints: their rotations and positions. Each gap is filled by the method that trials
// on observed spans and the methods' usual errors favour.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "base/text.hpp"
#include "fill/driver.hpp"
#include "fill/judgement.hpp"
#include "fill/methods.hpp"
#include "motion/take.hpp"

namespace kinemend::fill {

namespace {

// One method's proposal for a gap of a track.
struct JointProposal {
  const Method* method = nullptr;
  std::vector<Vec3> values = {};  // of the span's frames; empty: the method cannot fill it
  double score = 0;               // least is best
  // Root mean square distance to the ground truth, file units or degrees; 0 if the take has no
  // observed span for a trial.
  double expected_error = 0;
};

using Methods = std::vector<const Method*>;

// The usual errors weigh as much as this many trials; chosen on the takes that
// docs/measured/fill.md names.
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
  const std::size_t reach = frames_in(reach_s, context.frame_rate_hz, 0);
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

// Fills the gap with each of the methods, and fills observed spans of the track (`trial_places`)
// as if they were gaps, at an end of the take if the gap is at one. In a trial that a method
// cannot fill, slerp's result is used.
//
// Returns the best first. The score is the logarithm of the expected mean square error
// (`Judgement`), with a bonus for the spline in short gaps. There are few trials, and shorter ones
// say less: they are averaged with four more that have the methods' usual errors
// (`JointRules::usual_errors`).
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

// `auto` refuses a filling with a larger expected error; the limit corresponds to an eighth of the
// radius of a marker's body.
constexpr double largest_error_deg = 12.5, largest_error_of_height = 0.0625;
// A sample within this many largest errors of the filling is not a spike. Not swept.
constexpr double joint_spike_errors = 1.6;
// With doubted samples beside a gap, a model reads this much on either side: more than the
// look-ahead that the paper's networks were trained for.
constexpr double around_model_s = 4;

// A track of the take with gaps. Joint 0 has position 0; translated joint k has position k + 1.
struct Source {
  std::size_t index = 0;  // joint or position
  bool is_position = false;
};

struct JointGaps {
  std::vector<Source> sources;
  std::vector<OpenGap> gaps;
};

// `first`: the take's frame at which the clip begins.
JointGaps gaps_of(const Take& clip, const RequestOf& request_of, std::size_t first) {
  JointGaps found;
  const auto append = [&](const std::vector<Gap>& gaps, bool is_position) {
    const std::size_t own = found.sources.size();
    for (const Gap& gap : gaps) {
      const std::size_t joint =
          !is_position || gap.track == 0
              ? gap.track
              : static_cast<std::size_t>(clip.translated_joints[gap.track - 1]);
      const GapRequest* request =
          request_of({joint, gap.first_frame + first, gap.last_frame + first}, is_position);
      if (request == nullptr) continue;
      if (found.sources.size() == own || found.sources.back().index != gap.track)
        found.sources.push_back({gap.track, is_position});
      found.gaps.push_back({{joint, gap.first_frame, gap.last_frame},
                            is_position,
                            found.sources.size() - 1,
                            request});
    }
  };
  append(find_gaps(clip), false);
  append(find_position_gaps(clip), true);
  return found;
}

// The result on the whole take of each model that is to fill some of its gaps.
using LearnedFillings = std::map<const LearnedFill*, LearnedFilling>;

LearnedFillings fillings_of(const Take& clip, const std::vector<OpenGap>& gaps) {
  LearnedFillings found;
  for (const OpenGap& gap : gaps) {
    const GapRequest& request = *gap.request;
    if (!request.method->about.learned || request.refusal || found.contains(request.learned))
      continue;
    found.emplace(request.learned, (*request.learned)(clip));
  }
  return found;
}

// Each gap is filled on its own, from observed samples only.
class JointTake : public GappedTake {
 public:
  JointTake(Take& clip, const std::vector<Source>& sources, LearnedFillings learned)
      : clip_(clip),
        sources_(sources),
        poses_(clip),
        context_{clip.frame_rate_hz, poses_, body_height(clip.skeleton)},
        tracks_(sources.size()),
        learned_(std::move(learned)) {
    frames = clip.frame_count();
    frame_rate_hz = clip.frame_rate_hz;
    never_seen = "none of its samples is observed";
    rests_on_doubted = true;
    for_each_index(sources.size(), [&](std::size_t i) {
      tracks_[i] = sources[i].is_position ? position_track(clip, sources[i].index)
                                          : rotation_track(clip, sources[i].index);
    });
  }

  Track around(const OpenGap& gap) const override {
    const Track& track = tracks_[gap.track];
    return part_of(track, surroundings(gap.span(), {}, doubt_reach(frame_rate_hz), frames));
  }

  std::string unit_of(const OpenGap& gap) const override {
    return gap.is_position ? unit_name(clip_.metres_per_unit) : "deg";
  }

  double spike_size(const OpenGap& gap) const override {
    return joint_spike_errors * largest_error(gap.is_position);
  }

  Filling fill(const OpenGap& gap, FrameSpan span) const override {
    const Track& own = tracks_[gap.track];
    const std::string left = left_to_auto(gap);
    const bool is_learned = gap.request->method->about.learned && left.empty();
    Filling filling = is_learned ? by_model(span, gap) : by_take(own, span, gap);
    filling.left_to_auto = left;
    return filling;
  }

  void store(const OpenGap& gap, const Filling& filling) override {
    const Track& track = tracks_[gap.track];
    const std::size_t index = sources_[gap.track].index;
    for (std::size_t f = gap.gap.first_frame; f <= gap.gap.last_frame; ++f) {
      const Vec3 value = filling.values[f - gap.gap.first_frame];
      if (!gap.is_position) {
        store_rotation(index, f, track.chart.rotation_of(f, value));
        continue;
      }
      clip_.position(f, index) = value;
      clip_.observed_positions[f * clip_.point_count() + index] = 1;
    }
  }

 private:
  // Returns why the requested model cannot fill the gap; empty if it can, or if no model is
  // requested.
  std::string left_to_auto(const OpenGap& gap) const {
    if (!gap.request->method->about.learned) return "";
    if (gap.is_position) return "the model fills no positions";
    return learned_.at(gap.request->learned).left_out[gap.gap.track];
  }

  Filling by_take(const Track& own, FrameSpan span, const OpenGap& gap) const {
    if (span.length() == gap.gap.length()) {
      Filling filling = chosen_of(own, span, gap);
      return filling.made() || !gap.request->fill_all ? filling : best_guess(own, span, filling);
    }
    const Track other = without_span(own, span, frame_rate_hz);
    Filling filling = chosen_of(other, span, gap);
    if (!own.is_position) say_in(own, other, span, filling.values);
    return filling;
  }

  // Converts the values from the vectors of `other` to those of `own`.
  static void say_in(const Track& own, const Track& other, FrameSpan span,
                     std::vector<Vec3>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t f = span.first + i;
      values[i] = own.chart.vector_of(f, other.chart.rotation_of(f, values[i]));
    }
  }

  // Doubted samples beside the gap are hidden from the model too. It then reads only the take
  // around the gap, which is faster.
  Filling by_model(FrameSpan span, const OpenGap& gap) const {
    Filling filling{{}, std::string(gap.request->method->about.name)};
    filling.reason = gap.request->fill_all ? "" : too_long(*gap.request->method, gap);
    if (!filling.reason.empty()) return filling;
    const std::size_t joint = gap.gap.track;
    const LearnedFill& model = *gap.request->learned;
    const Track& own = tracks_[gap.track];
    if (span.length() == gap.gap.length()) {
      filling.values = said_of(own, span, learned_.at(&model), 0);
      return filling;
    }
    const auto around = static_cast<std::size_t>(around_model_s * frame_rate_hz) + 1;
    const std::size_t first = span.first - std::min(span.first, around);
    const std::size_t last = std::min(frames - 1, span.last + around);
    Take part = slice(clip_, first, last + 1);
    for (std::size_t f = span.first; f <= span.last; ++f)
      part.observed[(f - first) * clip_.joint_count() + joint] = 0;
    const Track other = without_span(own, span, frame_rate_hz);
    filling.values = said_of(other, span, model(part), first);
    say_in(own, other, span, filling.values);
    return filling;
  }

  // Returns a model's result for the joint. `first`: the take's frame at which the result begins.
  std::vector<Vec3> said_of(Track track, FrameSpan span, const LearnedFilling& learned,
                            std::size_t first) const {
    const auto value_at = [&](std::size_t f) {
      return track.chart.vector_of(
          f, learned.rotations[(f - first) * clip_.joint_count() + track.joint]);
    };
    Guess guess{span.first, {}};
    if (!learned.is_guess) {
      for (std::size_t f = span.first; f <= span.last; ++f) guess.values.push_back(value_at(f));
      return guess.values;
    }
    const CurveSettings settings = context_.curve();
    const auto [from, to] = surroundings(span, {}, velocity_window(settings), frames);
    guess.first_frame = from;
    for (std::size_t f = from; f <= to; ++f) guess.values.push_back(value_at(f));
    place_guess(track, span, guess, settings);
    return values_in(track, span);
  }

  // Returns the best proposal that fills the span and is allowed, else the refusal of the best one.
  Filling chosen_of(const Track& track, FrameSpan span, const OpenGap& gap) const {
    const GapRequest& request = *gap.request;
    const std::string_view method = request.method->about.name;
    const bool is_auto = method == "auto" || request.method->about.learned;
    std::vector<const Method*> able = {request.method};
    if (is_auto) able = all_methods_;
    std::erase_if(able,
                  [&](const Method* m) { return track.is_position && !m->joint_rules.positions; });
    if (able.empty()) return Filling::refused(method, fmt::format("{} fills no positions", method));
    Filling refused;
    for (JointProposal& proposal : propose(track, span, able, context_)) {
      Filling filling{{}, std::string(proposal.method->about.name)};
      filling.expected_error = proposal.expected_error;
      if (!request.fill_all) filling.reason = refusal(proposal, gap);
      if (filling.reason.empty() && !proposal.values.empty()) {
        filling.values = std::move(proposal.values);
        return filling;
      }
      if (filling.reason.empty()) filling.reason = proposal.method->joint_rules.cannot;
      if (refused.method.empty()) refused = std::move(filling);
    }
    return refused;
  }

  // Returns why the rules forbid the method to fill the gap; empty if they allow it.
  std::string refusal(const JointProposal& proposal, const OpenGap& gap) const {
    if (std::string reason = too_long(*proposal.method, gap); !reason.empty()) return reason;
    const double largest = largest_error(gap.is_position);
    const Method& asked = *gap.request->method;
    const bool is_auto = asked.about.name == "auto" || asked.about.learned;
    if (is_auto && proposal.expected_error > largest) {
      const std::string unit = unit_of(gap);
      return fmt::format("the expected error of {}, {}, is above {}", proposal.method->about.name,
                         measure_text(proposal.expected_error, unit), measure_text(largest, unit));
    }
    return "";
  }

  std::string too_long(const Method& method, const OpenGap& gap) const {
    const JointRules& rules = method.joint_rules;
    const bool at_end = gap.gap.first_frame == 0 || gap.gap.last_frame + 1 == frames;
    const double rule = at_end ? rules.longest_at_end_s : rules.longest_s;
    const double own = gap.request->longest_gap_s;
    const double longest = own > 0 ? own : rule;
    const double length = static_cast<double>(gap.gap.length()) / frame_rate_hz;
    if (length > longest + 0.5 / frame_rate_hz) {
      return fmt::format("{:.3g} s is longer than the {:.3g} s that {} may fill{}", length, longest,
                         method.about.name, at_end ? " at an end of the take" : "");
    }
    return "";
  }

  Filling best_guess(Track track, FrameSpan span, const Filling& refused) const {
    if (!fill_with_curve(track, span, Curve::shape_preserving, context_.curve())) return refused;
    return {values_in(track, span), "pchip"};
  }

  void store_rotation(std::size_t joint, std::size_t frame, Quat rotation) {
    const RotationOrder order = clip_.skeleton.rotation_order(joint);
    if (order.count == 1 || order.count == 2) {
      rotation = from_euler(to_euler(rotation, order), order);
    }
    const Quat before = clip_.rotation(frame > 0 ? frame - 1 : frame, joint);
    clip_.rotation(frame, joint) = align_hemisphere(rotation, before);
    clip_.observed[frame * clip_.joint_count() + joint] = 1;
  }

  double largest_error(bool is_position) const {
    return is_position ? largest_error_of_height * context_.height : largest_error_deg;
  }

  Take& clip_;
  const std::vector<Source>& sources_;
  PoseRegression poses_;
  JointContext context_;
  std::vector<const Method*> all_methods_ = joint_methods();
  std::vector<Track> tracks_;
  LearnedFillings learned_;
};

std::vector<FilledGap> fill_motion(Take& clip, const RequestOf& request_of, std::size_t first,
                                   const Check& check) {
  const JointGaps found = gaps_of(clip, request_of, first);
  if (found.gaps.empty()) return {};
  JointTake take(clip, found.sources, fillings_of(clip, found.gaps));
  return fill_take(take, found.gaps, check);
}

}  // namespace

std::vector<OpenGap> open_joint_gaps(const Take& clip) {
  const GapRequest any;
  const auto ask = [&](const Gap&, bool) { return &any; };
  const std::size_t calibration = leading_calibration_frames(clip);
  std::vector<OpenGap> gaps;
  const auto append = [&](const Take& part, std::size_t first) {
    for (OpenGap open : gaps_of(part, ask, first).gaps) {
      open.gap.first_frame += first;
      open.gap.last_frame += first;
      gaps.push_back({open.gap, open.is_position});
    }
  };
  std::optional<Take> sliced;
  if (calibration > 0) append(slice(clip, 0, calibration), 0);
  append(frames_from(clip, calibration, sliced), calibration);
  return gaps;
}

std::vector<FilledGap> fill_asked_joints(Take& clip, const RequestOf& request_of,
                                         const Check& check) {
  const std::size_t calibration = leading_calibration_frames(clip);
  std::vector<FilledGap> found;
  on_motion(clip, calibration,
            [&](Take& motion) { found = fill_motion(motion, request_of, calibration, check); });
  if (calibration > 0) {
    for (FilledGap& filled : found) {
      filled.outcome.gap.first_frame += calibration;
      filled.outcome.gap.last_frame += calibration;
    }
    // The calibration pose is not part of the motion; its gaps are listed as refused.
    for (const OpenGap& open : gaps_of(slice(clip, 0, calibration), request_of, 0).gaps) {
      found.push_back({{open.gap, std::string(open.request->method->about.name), false,
                        "is part of the calibration pose", 0, open.is_position}});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const FilledGap& left, const FilledGap& right) {
    const GapOutcome &a = left.outcome, &b = right.outcome;
    return std::tie(a.gap.track, a.is_position, a.gap.first_frame) <
           std::tie(b.gap.track, b.is_position, b.gap.first_frame);
  });
  return found;
}

}  // namespace kinemend::fill
