#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

#include "fill/driver.hpp"
#include "fill/plan_rows.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/gap_plan.hpp"
#include "motion/name_pattern.hpp"

// What is asked for each gap of a take: by settings, or by the rows of a plan.
namespace kinemend {

namespace {

using fill::FilledGap, fill::GapRequest;

const std::vector<std::string>& names_of(const Clip& clip) { return clip.skeleton.names; }
const std::vector<std::string>& names_of(const MarkerClip& clip) { return clip.names; }

constexpr bool is_joints(const Clip& /*clip*/) { return true; }
constexpr bool is_joints(const MarkerClip& /*clip*/) { return false; }

std::size_t donor_for(const Clip& /*clip*/, const FillSettings& /*settings*/) {
  return fill::MarkerRequest::no_marker;
}
std::size_t donor_for(const MarkerClip& clip, const FillSettings& settings) {
  if (settings.donor.empty() && settings.method == "pattern")
    throw Error(ErrorKind::usage, "fill: the method pattern needs a donor");
  return fill::donor_of(clip, settings.donor);
}

template <class AnyClip>
std::vector<FilledGap> fill_by_settings(AnyClip& clip, const FillSettings& settings) {
  clip.validate();
  GapRequest request;
  request.method = &fill::find_method(settings.method, is_joints(clip));
  const std::vector<std::uint8_t> chosen =
      names_meant(names_of(clip), settings.names, is_joints(clip) ? "joint" : "marker");
  request.donor = donor_for(clip, settings);
  request.longest_gap_s = settings.longest_gap_s;
  request.fill_all = settings.fill_all;
  return fill::fill_asked(clip, [&](const Gap& gap, bool) {
    return chosen[gap.track] != 0 && fill::lies_within(gap, settings) ? &request : nullptr;
  });
}

// What a run found of the gap that the row asks for.
void tell_found(const FilledGap& filled, const std::vector<std::string>& names, PlannedGap& row) {
  row.filled_by = filled.outcome.method;
  row.expected_error = filled.outcome.expected_error;
  row.reason = filled.outcome.reason;
  row.evidence.clear();
  for (const std::size_t marker : filled.markers_used) row.evidence.push_back(names[marker]);
}

template <class AnyClip>
PlannedFill plan_by_settings(AnyClip& clip, const FillSettings& settings) {
  const std::vector<FilledGap> gaps = fill_by_settings(clip, settings);
  PlannedFill made{fill::report_of(gaps), {}};
  for (const FilledGap& filled : gaps) {
    PlannedGap row;
    row.gap = filled.outcome.gap;
    row.is_position = filled.outcome.is_position;
    row.verdict = !filled.outcome.filled ? GapVerdict::refuse
                  : settings.fill_all    ? GapVerdict::force
                                         : GapVerdict::fill;
    row.method = settings.method;
    row.donor = settings.donor;
    row.longest_gap_s = settings.longest_gap_s;
    tell_found(filled, names_of(clip), row);
    made.plan.push_back(std::move(row));
  }
  return made;
}

using RowKey = std::tuple<std::size_t, bool, std::size_t>;
RowKey key_of(const Gap& gap, bool is_position) {
  return {gap.track, is_position, gap.first_frame};
}

template <class AnyClip>
PlannedFill apply_plan(AnyClip& clip, std::span<const PlannedGap> plan) {
  clip.validate();
  fill::PlanRows rows(clip);
  std::map<RowKey, const PlannedGap*> by_gap;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (const std::string problem = rows.add(plan[i]); !problem.empty())
      throw Error(ErrorKind::usage, fmt::format("fill: gap {} of the plan: {}", i + 1, problem));
    by_gap.emplace(key_of(plan[i].gap, plan[i].is_position), &plan[i]);
  }
  const std::vector<FilledGap> gaps = fill::fill_asked(clip, rows.request_of());
  PlannedFill made{fill::report_of(gaps), {}};
  for (const FilledGap& filled : gaps) {
    PlannedGap row = *by_gap.at(key_of(filled.outcome.gap, filled.outcome.is_position));
    tell_found(filled, names_of(clip), row);
    made.plan.push_back(std::move(row));
  }
  return made;
}

// Which of the clip's positions is that of the joint: 0 of joint 0, k + 1 of translated joint k.
std::size_t position_index(const Clip& clip, std::size_t joint) {
  for (std::size_t k = 0; joint > 0 && k < clip.translated_joints.size(); ++k) {
    if (static_cast<std::size_t>(clip.translated_joints[k]) == joint) return k + 1;
  }
  return 0;
}

Vec3 position_of(const Clip& clip, std::size_t frame, std::size_t index) {
  if (index == 0) return clip.root_positions[frame];
  return clip.joint_translations[frame * clip.translated_joints.size() + index - 1];
}

double distance_in(const Clip& a, const Clip& b, const PlannedGap& row, std::size_t frame) {
  const std::size_t joint = row.gap.track;
  if (!row.is_position)
    return angle_between(a.rotation(frame, joint), b.rotation(frame, joint)) * degrees_per_radian;
  const std::size_t index = position_index(a, joint);
  return norm(position_of(a, frame, index) - position_of(b, frame, index));
}
double distance_in(const MarkerClip& a, const MarkerClip& b, const PlannedGap& row,
                   std::size_t frame) {
  return norm(a.position(frame, row.gap.track) - b.position(frame, row.gap.track));
}

template <class AnyClip>
double rms_distance(const AnyClip& a, const AnyClip& b, const PlannedGap& row) {
  double sum = 0;
  for (std::size_t f = row.gap.first_frame; f <= row.gap.last_frame; ++f) {
    const double distance = distance_in(a, b, row, f);
    sum += distance * distance;
  }
  return std::sqrt(sum / static_cast<double>(row.gap.length()));
}

// The plan with another method for every gap, by its rules.
std::vector<PlannedGap> with_method(const std::vector<PlannedGap>& plan, std::string_view method) {
  std::vector<PlannedGap> other;
  for (const PlannedGap& row : plan) {
    PlannedGap asked;
    asked.gap = row.gap;
    asked.is_position = row.is_position;
    asked.method = method;
    asked.donor = row.donor;
    if (method == "pattern" && row.donor.empty()) {
      asked.verdict = GapVerdict::refuse;
      asked.reason = "the row names no donor";
    }
    other.push_back(std::move(asked));
  }
  return other;
}

template <class AnyClip>
void preview(const AnyClip& clip, std::vector<PlannedGap>& plan) {
  for (PlannedGap& row : plan) row.previews.clear();
  AnyClip own = clip;
  std::map<RowKey, bool> is_filled;
  for (const GapOutcome& gap : apply_plan(own, plan).report.gaps)
    is_filled[key_of(gap.gap, gap.is_position)] = gap.filled;
  for (const FillMethod& method : fill_methods()) {
    if (!(is_joints(clip) ? method.joints : method.markers)) continue;
    AnyClip other = clip;
    std::map<RowKey, GapOutcome> outcomes;
    for (GapOutcome& gap : apply_plan(other, with_method(plan, method.name)).report.gaps)
      outcomes.emplace(key_of(gap.gap, gap.is_position), std::move(gap));
    for (PlannedGap& row : plan) {
      const GapOutcome& outcome = outcomes.at(key_of(row.gap, row.is_position));
      GapPreview shown{std::string(method.name), outcome.filled, outcome.reason, std::nullopt};
      if (outcome.filled && is_filled.at(key_of(row.gap, row.is_position)))
        shown.distance = rms_distance(own, other, row);
      row.previews.push_back(std::move(shown));
    }
  }
}

}  // namespace

std::string_view to_string(GapVerdict verdict) {
  switch (verdict) {
    case GapVerdict::fill:
      return "fill";
    case GapVerdict::force:
      return "force";
    case GapVerdict::refuse:
      break;
  }
  return "refuse";
}

FillReport fill_gaps(MarkerClip& clip, const FillSettings& settings) {
  return fill::report_of(fill_by_settings(clip, settings));
}
FillReport fill_gaps(Clip& clip, const FillSettings& settings) {
  return fill::report_of(fill_by_settings(clip, settings));
}

PlannedFill fill_with_plan(Clip& clip, const FillSettings& settings) {
  return plan_by_settings(clip, settings);
}
PlannedFill fill_with_plan(MarkerClip& clip, const FillSettings& settings) {
  return plan_by_settings(clip, settings);
}
PlannedFill fill_with_plan(Clip& clip, std::span<const PlannedGap> plan) {
  return apply_plan(clip, plan);
}
PlannedFill fill_with_plan(MarkerClip& clip, std::span<const PlannedGap> plan) {
  return apply_plan(clip, plan);
}

void preview_methods(const Clip& clip, std::vector<PlannedGap>& plan) { preview(clip, plan); }
void preview_methods(const MarkerClip& clip, std::vector<PlannedGap>& plan) { preview(clip, plan); }

}  // namespace kinemend
