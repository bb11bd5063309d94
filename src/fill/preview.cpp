// Shows the result of every method on the gaps of a plan.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "fill/methods.hpp"
#include "fill/plan.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/gap_plan.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace {

fill::GapKey key_of(const PlannedGap& row) { return fill::key_of(row.gap, row.is_position); }

double distance_in(const Take& a, const Take& b, const PlannedGap& row, std::size_t frame) {
  const std::size_t track = row.gap.track;
  if (a.has_joints() && !row.is_position)
    return angle_between(a.rotation(frame, track), b.rotation(frame, track)) * degrees_per_radian;
  const std::size_t point = a.has_joints() ? point_of_joint(a, track).value_or(0) : track;
  return norm(a.position(frame, point) - b.position(frame, point));
}

double rms_distance(const Take& a, const Take& b, const PlannedGap& row) {
  double sum = 0;
  for (std::size_t f = row.gap.first_frame; f <= row.gap.last_frame; ++f) {
    const double distance = distance_in(a, b, row, f);
    sum += distance * distance;
  }
  return std::sqrt(sum / static_cast<double>(row.gap.length()));
}

// Returns the row with another method and its default limits.
PlannedGap with_method(const PlannedGap& row, std::string_view method) {
  PlannedGap asked;
  asked.gap = row.gap;
  asked.is_position = row.is_position;
  asked.method = method;
  asked.donor = row.donor;
  if (method == "pattern" && row.donor.empty()) {
    asked.verdict = GapVerdict::refuse;
    asked.reason = "the row names no donor";
  }
  return asked;
}

std::vector<std::string> methods_of(const Take& clip, const FillModels& models) {
  std::vector<std::string> names;
  for (const FillMethod& method : fill_methods()) {
    if (!(clip.has_joints() ? method.joints : method.markers)) continue;
    const LearnedFill* model =
        method.learned ? fill::model_of(fill::find_method(method.name, true), models) : nullptr;
    if (!method.learned || *model) names.emplace_back(method.name);
  }
  return names;
}

// A filled take, and the outcome of each gap.
struct Tried {
  Take clip;
  std::map<fill::GapKey, GapOutcome> outcomes = {};

  Tried(const Take& gapped, std::span<const PlannedGap> plan, const FillCheck& check,
        const FillModels& models)
      : clip(gapped) {
    for (GapOutcome& gap : fill_with_plan(clip, plan, check, models).report.gaps)
      outcomes.emplace(fill::key_of(gap.gap, gap.is_position), std::move(gap));
  }
};

// Compares the result of `other` on the row's gap with that of the row's own method.
GapPreview compared(std::string_view method, const Tried& own, const Tried& other,
                    const PlannedGap& row) {
  const GapOutcome& outcome = other.outcomes.at(key_of(row));
  GapPreview preview{std::string(method), outcome.filled, outcome.reason, std::nullopt};
  if (outcome.filled && own.outcomes.at(key_of(row)).filled)
    preview.distance = rms_distance(own.clip, other.clip, row);
  return preview;
}

// ---- curves of one gap

using Values = std::vector<std::optional<Vec3>>;

RotationOrder order_of(const Take& clip, std::size_t joint) {
  const RotationOrder order = clip.skeleton.rotation_order(joint);
  return order.count > 0 ? order : parse_rotation_order("ZXY");
}

std::vector<std::string> axes_of(const Take& clip, const PlannedGap& row) {
  if (!clip.has_joints() || row.is_position) return {"X", "Y", "Z"};
  std::vector<std::string> axes;
  for (const char axis : to_string(order_of(clip, row.gap.track))) axes.emplace_back(1, axis);
  return axes;
}

Values joint_values(const Take& clip, const PlannedGap& row, std::size_t first, std::size_t last) {
  Values values;
  const std::size_t joint = row.gap.track, index = point_of_joint(clip, joint).value_or(0);
  const RotationOrder order = order_of(clip, joint);
  std::array<double, 3> angles{};
  for (std::size_t f = first; f <= last; ++f) {
    const bool is_seen =
        row.is_position ? clip.is_position_observed(f, index) : clip.is_observed(f, joint);
    if (!is_seen) {
      values.emplace_back();
    } else if (row.is_position) {
      values.emplace_back(clip.position(f, index));
    } else {
      angles = to_euler_near(clip.rotation(f, joint), order, angles);
      values.emplace_back(degrees_per_radian * Vec3{angles[0], angles[1], angles[2]});
    }
  }
  return values;
}

Values values_of(const Take& clip, const PlannedGap& row, std::size_t first, std::size_t last) {
  if (clip.has_joints()) return joint_values(clip, row, first, last);
  Values values;
  for (std::size_t f = first; f <= last; ++f) {
    values.emplace_back();
    if (clip.is_observed(f, row.gap.track)) values.back() = clip.position(f, row.gap.track);
  }
  return values;
}

}  // namespace

void preview_methods(const Take& clip, std::vector<PlannedGap>& plan, const FillCheck& check,
                     const FillModels& models) {
  for (PlannedGap& row : plan) row.previews.clear();
  const Tried own(clip, plan, check, models);
  for (const std::string& method : methods_of(clip, models)) {
    std::vector<PlannedGap> asked;
    asked.reserve(plan.size());
    for (const PlannedGap& row : plan) asked.push_back(with_method(row, method));
    const Tried other(clip, asked, check, models);
    for (PlannedGap& row : plan) row.previews.push_back(compared(method, own, other, row));
  }
}

GapCurves preview_curves(const Take& clip, std::span<const PlannedGap> plan, std::size_t row,
                         const FillCheck& check, const FillModels& models) {
  // Chosen by hand.
  constexpr double around_s = 0.5;         // shown on either side
  constexpr std::size_t least_around = 8;  // frames
  if (row >= plan.size())
    throw Error(ErrorKind::usage, fmt::format("fill: the plan has {} rows", plan.size()));
  const Gap& gap = plan[row].gap;
  const auto half_second = static_cast<std::size_t>(around_s * clip.frame_rate_hz);
  const std::size_t around = std::max(least_around, std::min(gap.length(), half_second));
  GapCurves made;
  made.first_frame = gap.first_frame - std::min(gap.first_frame, around);
  made.last_frame = std::min(clip.frame_count() - 1, gap.last_frame + around);
  made.axes = axes_of(clip, plan[row]);
  const Tried own(clip, plan, check, models);
  std::vector<PlannedGap> asked(plan.begin(), plan.end());
  const auto add = [&](const Tried& other, GapPreview preview) {
    made.curves.push_back({std::move(preview), other.outcomes.at(key_of(plan[row])).expected_error,
                           values_of(other.clip, plan[row], made.first_frame, made.last_frame)});
  };
  for (const std::string& method : methods_of(clip, models)) {
    asked[row] = with_method(plan[row], method);
    const Tried other(clip, asked, check, models);
    GapPreview preview = compared(method, own, other, plan[row]);
    if (preview.filled || asked[row].verdict == GapVerdict::refuse) {
      add(other, std::move(preview));
      continue;
    }
    asked[row].verdict = GapVerdict::force;
    const Tried forced(clip, asked, check, models);
    // If the method cannot fill the gap at all, `forced` holds the result of another one.
    const bool is_own = method == "auto" || forced.outcomes.at(key_of(plan[row])).method == method;
    add(is_own ? forced : other, std::move(preview));
  }
  return made;
}

}  // namespace kinemend
