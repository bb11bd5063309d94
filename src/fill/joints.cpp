#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "fill/beside_gap.hpp"
#include "fill/gap_range.hpp"
#include "fill/joint_trials.hpp"
#include "kinemend/error.hpp"
#include "kinemend/fill.hpp"
#include "motion/calibration.hpp"
#include "motion/name_pattern.hpp"

namespace kinemend {

namespace {

using fill::JointContext;
using fill::JointMethod;
using fill::JointProposal;
using fill::JointTrack;

// `auto` refuses what it expects to be farther from the truth than this.
constexpr double largest_error_deg = 12.5;
constexpr double largest_error_of_height = 0.0625;

std::vector<const JointMethod*> chosen_methods(const std::string& name) {
  std::vector<const JointMethod*> chosen;
  std::string known = "auto";
  for (const JointMethod& method : fill::joint_methods()) {
    if (name == "auto" || method.name == name) chosen.push_back(&method);
    known += fmt::format(", {}", method.name);
  }
  if (chosen.empty()) {
    throw Error(ErrorKind::usage,
                fmt::format("fill: expected a method for joints ({}), found \"{}\"", known, name));
  }
  return chosen;
}

// Fills the gaps of one track, each by itself.
class TrackFiller {
 public:
  TrackFiller(JointTrack track, const std::vector<const JointMethod*>& methods,
              const FillSettings& settings, const JointContext& context, double largest_error)
      : track_(std::move(track)),
        settings_(settings),
        context_(context),
        largest_error_(largest_error) {
    for (const JointMethod* method : methods) {
      if (method->positions || !track_.is_position) methods_.push_back(method);
    }
  }

  const JointTrack& track() const { return track_; }

  void fill(const Gap& gap, GapOutcome& outcome) {
    outcome.gap = gap;
    outcome.gap.track = track_.joint;
    outcome.is_position = track_.is_position;
    outcome.method = settings_.method;
    const FrameSpan span{gap.first_frame, gap.last_frame};
    if (span.length() == track_.observed.size()) {
      outcome.reason = "none of its samples is observed";
      return;
    }
    if (methods_.empty()) {
      outcome.reason = fmt::format("{} fills no positions", settings_.method);
    } else if (fill_without_doubted(span, outcome) || fill_span(span, outcome)) {
      return;
    }
    if (settings_.fill_all) fill_anyhow(span, outcome);
  }

 private:
  bool fill_span(FrameSpan span, GapOutcome& outcome) {
    const auto proposals = fill::propose(track_, span, methods_, context_);
    const JointProposal* chosen = choose(proposals, span, outcome);
    if (!chosen) return false;
    std::copy(chosen->values.begin(), chosen->values.end(),
              track_.values.begin() + static_cast<std::ptrdiff_t>(3 * span.first));
    return true;
  }

  // The best that fills the span and may; nullptr, with the reason, where there is none.
  const JointProposal* choose(const std::vector<JointProposal>& proposals, FrameSpan span,
                              GapOutcome& outcome) const {
    for (const JointProposal& proposal : proposals) {
      const std::string reason = settings_.fill_all ? "" : refusal(proposal, span);
      outcome.filled = !proposal.values.empty() && reason.empty();
      // That of the best method tells most.
      if (!outcome.filled && !outcome.reason.empty()) continue;
      outcome.method = proposal.method->name;
      outcome.expected_error = in_unit(proposal.expected_error);
      outcome.reason = reason.empty() ? std::string(proposal.method->cannot) : reason;
      if (!outcome.filled) continue;
      outcome.reason.clear();
      return &proposal;
    }
    return nullptr;
  }

  // How far two samples are from each other, in the track's unit.
  double distance(std::size_t frame, const JointTrack& other, Vec3 value) const {
    if (track_.is_position) return norm(track_.at(frame) - value);
    return angle_between(track_.rotation(frame), other.chart.rotation_of(frame, value));
  }

  fill::Doubt doubt_of(FrameSpan span) const {
    const auto leap = [&](std::size_t f) {
      const auto& seen = track_.observed;
      if (!seen[f - 1] || !seen[f] || !seen[f + 1]) return -1.0;
      return norm(track_.at(f - 1) - 2 * track_.at(f) + track_.at(f + 1));
    };
    return fill::doubt_beside(span, track_.observed.size(), context_.frame_rate_hz, spike_size(),
                              leap);
  }

  // What is nearer to a filling is no spike.
  double spike_size() const { return 1.6 * largest_error_; }

  // The track as if the span were missing.
  JointTrack without(FrameSpan span) const {
    JointTrack other = track_;
    std::fill_n(other.observed.begin() + static_cast<std::ptrdiff_t>(span.first), span.length(),
                std::uint8_t{0});
    if (track_.is_position) return other;
    other.chart =
        fill::make_rotation_chart(track_.chart.reference, other.observed, context_.frame_rate_hz);
    for (std::size_t f = 0; f < other.observed.size(); ++f) other.set(f, other.chart.path[f]);
    return other;
  }

  // Fills the span without the doubted samples beside it; false where there are none, and where
  // such a filling bears them out.
  bool fill_without_doubted(FrameSpan span, GapOutcome& outcome) {
    constexpr double expected_errors = 4;
    fill::Doubt doubt = doubt_of(span);
    for (int round = 0; round < 2 && doubt.any(); ++round) {
      const FrameSpan wider = doubt.widened(span);
      const JointTrack other = without(wider);
      const auto proposals = fill::propose(other, wider, methods_, context_);
      const JointProposal* chosen = choose(proposals, span, outcome);
      if (!chosen) break;
      const auto value = [&](std::size_t frame) {
        const double* v = &chosen->values[3 * (frame - wider.first)];
        return Vec3{v[0], v[1], v[2]};
      };
      const double far = std::max(spike_size(), expected_errors * chosen->expected_error);
      const auto is_far = [&](std::size_t frame) {
        return distance(frame, other, value(frame)) > far;
      };
      const fill::Doubt spikes{doubt.before > 0 && is_far(span.first - 1) ? doubt.before : 0,
                               doubt.behind > 0 && is_far(span.last + 1) ? doubt.behind : 0};
      const bool all = spikes.before == doubt.before && spikes.behind == doubt.behind;
      doubt = spikes;
      if (!all) continue;
      for (std::size_t f = span.first; f <= span.last; ++f) {
        track_.set(f, track_.is_position
                          ? value(f)
                          : track_.chart.vector_of(f, other.chart.rotation_of(f, value(f))));
      }
      return true;
    }
    outcome.filled = false;
    outcome.reason.clear();
    return false;
  }

  // Why the rules do not let the method fill the span; empty where they do.
  std::string refusal(const JointProposal& proposal, FrameSpan span) const {
    const JointMethod& method = *proposal.method;
    const bool at_end = span.first == 0 || span.last + 1 == track_.observed.size();
    const double rule = at_end ? method.longest_at_end_s : method.longest_s;
    const double longest = settings_.longest_gap_s > 0 ? settings_.longest_gap_s : rule;
    const double length = static_cast<double>(span.length()) / context_.frame_rate_hz;
    if (length > longest + 0.5 / context_.frame_rate_hz) {
      return fmt::format("{:.3g} s is longer than the {:.3g} s that {} may fill{}", length, longest,
                         method.name, at_end ? " at an end of the take" : "");
    }
    if (settings_.method == "auto" && proposal.expected_error > largest_error_) {
      return fmt::format("the expected error of {}, {:.3g}, is above {:.3g}", method.name,
                         in_unit(proposal.expected_error), in_unit(largest_error_));
    }
    return "";
  }

  void fill_anyhow(FrameSpan span, GapOutcome& outcome) {
    const JointMethod* method = fill::find_joint_method("pchip");
    if (!method->fill(track_, span, context_)) return;
    outcome.method = method->name;
    outcome.filled = true;
    outcome.reason.clear();
    outcome.expected_error = 0;
  }

  double in_unit(double error) const {
    return track_.is_position ? error : error * degrees_per_radian;
  }

  JointTrack track_;
  std::vector<const JointMethod*> methods_;
  const FillSettings& settings_;
  const JointContext& context_;
  double largest_error_;
};

// The gaps of one track.
struct Task {
  std::size_t track = 0;
  bool is_position = false;
  std::vector<Gap> gaps;
  std::vector<GapOutcome> outcomes;
  JointTrack filled;
};

// `first`: the frame of the take that the clip begins with.
std::vector<Task> tasks_of(const Clip& clip, const FillSettings& settings, std::size_t first) {
  const std::vector<std::uint8_t> chosen =
      names_meant(clip.skeleton.names, settings.names, "joint");
  std::vector<Task> tasks;
  const auto append = [&](const std::vector<Gap>& gaps, bool is_position) {
    for (const Gap& gap : gaps) {
      const std::size_t joint =
          !is_position || gap.track == 0
              ? gap.track
              : static_cast<std::size_t>(clip.translated_joints[gap.track - 1]);
      if (!chosen[joint] || !fill::lies_within(gap, first, settings)) continue;
      const bool is_new = tasks.empty() || tasks.back().track != gap.track ||
                          tasks.back().is_position != is_position;
      if (is_new) tasks.push_back({gap.track, is_position, {}, {}, {}});
      tasks.back().gaps.push_back(gap);
    }
  };
  append(find_gaps(clip), false);
  append(find_position_gaps(clip), true);
  return tasks;
}

void run_task(Task& task, const Clip& clip, const std::vector<const JointMethod*>& methods,
              const FillSettings& settings, const JointContext& context) {
  const double largest_error = task.is_position
                                   ? largest_error_of_height * skeleton_height(clip.skeleton)
                                   : largest_error_deg * radians_per_degree;
  TrackFiller filler(task.is_position ? fill::position_track(clip, task.track)
                                      : fill::rotation_track(clip, task.track),
                     methods, settings, context, largest_error);
  task.outcomes.resize(task.gaps.size());
  for (std::size_t g = 0; g < task.gaps.size(); ++g) filler.fill(task.gaps[g], task.outcomes[g]);
  task.filled = filler.track();
}

FillReport fill_motion(Clip& clip, const std::vector<const JointMethod*>& methods,
                       const FillSettings& settings, std::size_t first) {
  std::vector<Task> tasks = tasks_of(clip, settings, first);
  FillReport report;
  if (tasks.empty()) return report;
  // Every gap is filled from what was observed, whatever the order.
  const fill::PoseRegression poses(clip);
  const JointContext context{clip.frame_rate_hz, poses, skeleton_height(clip.skeleton)};
  tbb::parallel_for(std::size_t{0}, tasks.size(),
                    [&](std::size_t i) { run_task(tasks[i], clip, methods, settings, context); });
  for (const Task& task : tasks) {
    for (const GapOutcome& outcome : task.outcomes) {
      const FrameSpan span{outcome.gap.first_frame, outcome.gap.last_frame};
      if (outcome.filled) store_span(task.filled, span, clip);
      report.gaps.push_back(outcome);
    }
  }
  return report;
}

// The gaps of the calibration pose, which is no part of the motion.
void refuse_gaps(const Clip& calibration, const FillSettings& settings, FillReport& report) {
  for (Task& task : tasks_of(calibration, settings, 0)) {
    for (Gap gap : task.gaps) {
      if (task.is_position && gap.track > 0) {
        gap.track = static_cast<std::size_t>(calibration.translated_joints[gap.track - 1]);
      }
      report.gaps.push_back(
          {gap, settings.method, false, "is part of the calibration pose", 0, task.is_position});
    }
  }
}

}  // namespace

FillReport fill_gaps(Clip& clip, const FillSettings& settings) {
  clip.validate();
  const std::vector<const JointMethod*> methods = chosen_methods(settings.method);
  const std::size_t calibration = leading_calibration_frames(clip);
  FillReport report;
  on_motion(clip, calibration,
            [&](Clip& motion) { report = fill_motion(motion, methods, settings, calibration); });
  if (calibration > 0) {
    for (GapOutcome& outcome : report.gaps) {
      outcome.gap.first_frame += calibration;
      outcome.gap.last_frame += calibration;
    }
    refuse_gaps(slice(clip, 0, calibration), settings, report);
  }
  std::stable_sort(report.gaps.begin(), report.gaps.end(),
                   [](const GapOutcome& a, const GapOutcome& b) {
                     return std::tie(a.gap.track, a.is_position, a.gap.first_frame) <
                            std::tie(b.gap.track, b.is_position, b.gap.first_frame);
                   });
  return report;
}

}  // namespace kinemend
