// Finds the floor and the contacts of feet for the page.
#include "report/page/stage.hpp"

#include <algorithm>
#include <numeric>

#include "base/quantiles.hpp"
#include "check/feet.hpp"
#include "kinemend/experimental/convert.hpp"
#include "kinemend/experimental/kinematics.hpp"

namespace kinemend::page {

namespace {

using check::BodyPoints, feet::along, feet::Up;

// Returns the level above which nearly all of the body stays in nearly all inspected frames.
template <class PointAt>
double lowest_level(std::size_t frames, std::size_t points, Up up, const PointAt& at) {
  // Frames are spread evenly over the take: for speed, not swept.
  constexpr std::size_t looked_at = 500;
  std::vector<double> lowest;
  const std::size_t count = std::min(frames, looked_at);
  for (std::size_t i = 0; i < count; ++i) {
    std::optional<double> low;
    for (std::size_t p = 0; p < points; ++p) {
      const std::optional<Vec3> point = at(i * frames / count, p);
      if (point) low = std::min(low.value_or(along(*point, up)), along(*point, up));
    }
    if (low) lowest.push_back(*low);
  }
  return quantile_of(lowest, 0.05);
}

// Finds the contacts and their floor, for a body in metres. `points`: index in the take of each of
// its points.
void find_feet(const BodyPoints& body, const std::vector<std::size_t>& points,
               double metres_per_unit, Stage& stage) {
  if (body.feet.empty()) return;
  const auto up = find_up(body);
  if (!up) return;
  stage.up = *up;
  std::vector<double> levels;
  for (const check::Contact& contact : check::find_contacts(body, *up)) {
    StageContact& added = stage.contacts.emplace_back();
    added.first_frame = contact.span.first;
    added.last_frame = contact.span.last;
    for (const std::size_t point : body.feet[contact.foot].points)
      added.points.push_back(points[point]);
    levels.push_back(along(contact.place, *up) / metres_per_unit);
  }
  if (!levels.empty()) stage.floor = median_of(levels);
}

std::vector<std::size_t> counted_up(std::size_t count) {
  std::vector<std::size_t> result(count);
  std::iota(result.begin(), result.end(), std::size_t{0});
  return result;
}

void stand_joints(const Take& clip, Stage& stage) {
  if (const double scale = likely_metres_per_unit(clip); scale > 0) {
    find_feet(check::body_points(clip, scale),
              counted_up(clip.joint_count() + clip.skeleton.end_sites.size()), scale, stage);
  }
  if (!stage.contacts.empty()) return;
  Pose pose;
  std::size_t posed = clip.frame_count();
  stage.floor = lowest_level(clip.frame_count(), clip.joint_count(), stage.up,
                             [&](std::size_t frame, std::size_t joint) -> std::optional<Vec3> {
                               if (posed != frame) pose = forward_kinematics(clip, frame);
                               posed = frame;
                               return pose.positions[joint];
                             });
}

void stand_markers(const Take& clip, Stage& stage) {
  std::vector<std::size_t> markers;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (clip.holds_positions(m)) markers.push_back(m);
  }
  if (const double scale = likely_metres_per_unit(clip); scale > 0)
    find_feet(check::body_points(clip, markers, scale), markers, scale, stage);
  if (!stage.contacts.empty()) return;
  stage.floor = lowest_level(clip.frame_count(), markers.size(), stage.up,
                             [&](std::size_t frame, std::size_t i) -> std::optional<Vec3> {
                               if (!clip.is_observed(frame, markers[i])) return std::nullopt;
                               return clip.position(frame, markers[i]);
                             });
}

}  // namespace

Stage stage_of(const Take& take) {
  Stage stage;
  stage.height = take.has_joints()        ? body_height(take.skeleton)
                 : take.frame_count() > 0 ? body_height(take)
                                          : 1;
  if (!(stage.height > 0)) stage.height = 1;
  if (take.frame_count() == 0) return stage;
  stage.up = {guess_up_axis(take), 1};
  if (take.has_joints())
    stand_joints(take, stage);
  else
    stand_markers(take, stage);
  return stage;
}

std::vector<StageContact> contacts_of(const FeetReport& report, const Take& clip) {
  const std::vector<Leg> legs = find_legs(clip.skeleton);
  std::vector<StageContact> contacts;
  for (const FootContact& contact : report.contacts) {
    if (contact.leg >= legs.size()) continue;
    const Leg& leg = legs[contact.leg];
    const bool is_toe = contact.part == FootPart::toe && leg.toe >= 0;
    contacts.push_back({{static_cast<std::size_t>(is_toe ? leg.toe : leg.ankle)},
                        contact.first_frame,
                        contact.last_frame});
  }
  return contacts;
}

}  // namespace kinemend::page
