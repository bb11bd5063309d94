#include <fmt/format.h>
#include <fnmatch.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "fill/joint_trials.hpp"
#include "kinemend/error.hpp"
#include "kinemend/fill.hpp"

namespace kinemend {

namespace {

using fill::JointContext;
using fill::JointMethod;
using fill::JointTrack;
using fill::Span;
using fill::Trial;

// `auto` refuses what it expects to be farther from the truth than this, on average.
constexpr double largest_error_deg = 10;
constexpr double largest_error_of_height = 0.05;

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

std::vector<std::uint8_t> chosen_joints(const Clip& clip, const std::vector<std::string>& names) {
  std::vector<std::uint8_t> chosen(clip.joint_count(), names.empty() ? 1 : 0);
  for (const std::string& pattern : names) {
    bool found = false;
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      const std::string& name = clip.skeleton.names[j];
      if (name != pattern && fnmatch(pattern.c_str(), name.c_str(), 0) != 0) continue;
      chosen[j] = 1;
      found = true;
    }
    if (!found) {
      throw Error(ErrorKind::usage, fmt::format("fill: no joint matches \"{}\" (the take has {})",
                                                pattern, fmt::join(clip.skeleton.names, ", ")));
    }
  }
  return chosen;
}

// Gaps of the same kind are tried once: lengths within a quarter of each other, all at an end or
// none.
struct Kind {
  std::size_t length = 0;
  bool at_end = false;
  friend bool operator<(const Kind& a, const Kind& b) {
    return std::tie(a.length, a.at_end) < std::tie(b.length, b.at_end);
  }
};

Kind kind_of(const JointTrack& track, Span span) {
  std::size_t length = 1;
  while (length < span.length()) length += std::max<std::size_t>(1, length / 4);
  return {length, span.first == 0 || span.last + 1 == track.observed.size()};
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
    const Span span{gap.first_frame, gap.last_frame};
    if (span.length() == track_.observed.size()) {
      outcome.reason = "none of its samples is observed";
      return;
    }
    if (methods_.empty()) {
      outcome.reason = fmt::format("{} fills no positions", settings_.method);
    }
    if (!methods_.empty()) {
      for (const Trial& trial : trials_of(kind_of(track_, span))) {
        if (try_one(trial, span, outcome)) return;
      }
    }
    if (settings_.fill_all) fill_anyhow(span, outcome);
  }

 private:
  // Best first.
  const std::vector<Trial>& trials_of(Kind kind) {
    const auto [found, is_new] = trials_.try_emplace(kind);
    if (is_new) {
      found->second = try_methods(track_, kind.length, kind.at_end, methods_, context_);
    }
    return found->second;
  }

  bool try_one(const Trial& trial, Span span, GapOutcome& outcome) {
    const std::string reason = settings_.fill_all ? "" : refusal(trial, span);
    if (reason.empty() && trial.method->fill(track_, span, context_)) {
      outcome.method = trial.method->name;
      outcome.filled = true;
      outcome.reason.clear();
      outcome.expected_error = trial.spans > 0 ? in_unit(trial.error) : 0;
      return true;
    }
    if (outcome.reason.empty()) {  // that of the best method tells most
      outcome.method = trial.method->name;
      outcome.reason = reason.empty() ? std::string(trial.method->cannot) : reason;
      outcome.expected_error = trial.spans > 0 ? in_unit(trial.error) : 0;
    }
    return false;
  }

  // Why the rules do not let the method fill the span; empty where they do.
  std::string refusal(const Trial& trial, Span span) const {
    const bool at_end = kind_of(track_, span).at_end;
    const double rule = at_end ? trial.method->longest_at_end_s : trial.method->longest_s;
    const double longest = settings_.longest_gap_s > 0 ? settings_.longest_gap_s : rule;
    const double length = static_cast<double>(span.length()) / context_.frame_rate_hz;
    if (length > longest + 0.5 / context_.frame_rate_hz) {
      return fmt::format("{:.3g} s is longer than the {:.3g} s that {} may fill{}", length, longest,
                         trial.method->name, at_end ? " at an end of the take" : "");
    }
    if (settings_.method == "auto" && trial.error > largest_error_) {
      return fmt::format("the expected error of {}, {:.3g}, is above {:.3g}", trial.method->name,
                         in_unit(trial.error), in_unit(largest_error_));
    }
    return "";
  }

  void fill_anyhow(Span span, GapOutcome& outcome) {
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
  std::map<Kind, std::vector<Trial>> trials_;
};

// The gaps of one track.
struct Task {
  std::size_t track = 0;
  bool is_position = false;
  std::vector<Gap> gaps;
  std::vector<GapOutcome> outcomes;
  JointTrack filled;
};

std::vector<Task> tasks_of(const Clip& clip, const std::vector<std::uint8_t>& chosen) {
  std::vector<Task> tasks;
  const auto append = [&](const std::vector<Gap>& gaps, bool is_position) {
    for (const Gap& gap : gaps) {
      const std::size_t joint =
          !is_position || gap.track == 0
              ? gap.track
              : static_cast<std::size_t>(clip.translated_joints[gap.track - 1]);
      if (!chosen[joint]) continue;
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
                       const FillSettings& settings) {
  std::vector<Task> tasks = tasks_of(clip, chosen_joints(clip, settings.names));
  FillReport report;
  if (tasks.empty()) return report;
  // Every gap is filled from what was observed, whatever the order.
  const fill::PoseRegression poses(clip);
  const JointContext context{clip.frame_rate_hz, poses};
  tbb::parallel_for(std::size_t{0}, tasks.size(),
                    [&](std::size_t i) { run_task(tasks[i], clip, methods, settings, context); });
  for (const Task& task : tasks) {
    for (const GapOutcome& outcome : task.outcomes) {
      const Span span{outcome.gap.first_frame, outcome.gap.last_frame};
      if (outcome.filled) store_span(task.filled, span, clip);
      report.gaps.push_back(outcome);
    }
  }
  return report;
}

// The gaps of the calibration pose, which is no part of the motion.
void refuse_gaps(const Clip& calibration, const FillSettings& settings, FillReport& report) {
  for (Task& task : tasks_of(calibration, chosen_joints(calibration, settings.names))) {
    for (Gap gap : task.gaps) {
      if (task.is_position && gap.track > 0) {
        gap.track = static_cast<std::size_t>(calibration.translated_joints[gap.track - 1]);
      }
      report.gaps.push_back(
          {gap, settings.method, false, "is part of the calibration pose", 0, task.is_position});
    }
  }
}

template <class Values>
void put_back(const Values& part, Values& whole) {
  std::copy(part.begin(), part.end(), whole.end() - static_cast<std::ptrdiff_t>(part.size()));
}

}  // namespace

FillReport fill_gaps(Clip& clip, const FillSettings& settings) {
  clip.validate();
  const std::vector<const JointMethod*> methods = chosen_methods(settings.method);
  const std::size_t calibration = leading_calibration_frames(clip);
  FillReport report;
  if (calibration == 0) {
    report = fill_motion(clip, methods, settings);
  } else {
    Clip motion = slice(clip, calibration, clip.frame_count());
    report = fill_motion(motion, methods, settings);
    put_back(motion.root_positions, clip.root_positions);
    put_back(motion.local_rotations, clip.local_rotations);
    put_back(motion.joint_translations, clip.joint_translations);
    put_back(motion.observed, clip.observed);
    put_back(motion.observed_positions, clip.observed_positions);
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
