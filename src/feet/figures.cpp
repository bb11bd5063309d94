// Measures slides, depths and knee pops of a motion.
#include "feet/steps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/portable.hpp"
#include "feet/clean_legs.hpp"
#include "feet/floor.hpp"
#include "motion/calibration.hpp"

namespace kinemend {

namespace feet {

namespace {

double knee_bend_deg(const LegPose& pose) {
  const Vec3 thigh = pose.knee_at - pose.hip_at, shank = pose.ankle_at - pose.knee_at;
  return portable::atan2(norm(cross(thigh, shank)), dot(thigh, shank)) * degrees_per_radian;
}

double largest_knee_pop_deg(const LegMotion& motion) {
  double largest = 0;
  for (std::size_t l = 0; l < motion.legs(); ++l) {
    double before = 0, now = 0;
    for (std::size_t f = 0; f < motion.frames; ++f) {
      const double next = knee_bend_deg(motion.pose(f, l));
      if (f >= 2) largest = std::max(largest, std::fabs(next - 2 * now + before));
      before = now;
      now = next;
    }
  }
  return largest;
}

}  // namespace

std::vector<double> level_offsets(const Soles& soles) {
  std::vector<double> offsets(soles.points.size());
  for (std::size_t p = 0; p < offsets.size(); ++p) {
    const std::size_t other = p ^ 1;
    if (soles.has[other] == 0) continue;
    offsets[p] = std::max(0.0, soles.points[p].level - soles.points[other].level);
  }
  return offsets;
}

FeetFigures figures_of(const LegMotion& motion, const std::vector<FootContact>& contacts, Up up,
                       const std::vector<double>& offsets) {
  FeetFigures figures;
  figures.knee_pop_deg = largest_knee_pop_deg(motion);
  std::vector<Vec3> places;
  std::size_t steps = 0;
  for (const FootContact& c : contacts) {
    const auto at = [&](std::size_t frame) {
      return motion.pose(frame, c.leg).sole_at(motion.models[c.leg], c.part);
    };
    const Vec3 start = at(c.first_frame);
    Vec3 before = start, sum = start;
    for (std::size_t f = c.first_frame + 1; f <= c.last_frame; ++f) {
      const Vec3 now = at(f);
      figures.slide += norm(level_part(now - before, up));
      figures.most_slide = std::max(figures.most_slide, norm(level_part(now - start, up)));
      ++steps;
      before = now;
      sum += now;
    }
    const auto count = static_cast<double>(c.last_frame - c.first_frame + 1);
    places.push_back((1 / count) * sum - offsets[Soles::point_of(c)] * up.direction());
  }
  if (steps > 0) figures.slide /= static_cast<double>(steps);
  for (const double depth : depths_below_floor(places, up, close_to_floor * motion.height,
                                               motion.height / usual_height_m))
    figures.sink = std::max(figures.sink, depth);
  return figures;
}

}  // namespace feet

FeetFigures feet_figures(const Take& clip, const std::vector<FootContact>& contacts) {
  const std::size_t first = leading_calibration_frames(clip);
  std::optional<Take> part;
  const Take& motion = frames_from(clip, first, part);
  feet::LegMotion legs = feet::leg_motion(motion, find_legs(clip.skeleton));
  feet::check_contacts(contacts, legs, first);
  const std::optional<feet::Up> up = feet::up_of(legs, std::nullopt);
  if (!up) return {};
  feet::set_heels(motion, *up, legs);
  const std::vector<double> offsets = feet::level_offsets(feet::find_soles(legs, *up, {}));
  std::vector<FootContact> own = contacts;
  feet::shift_contacts(own, first, 0);
  return feet::figures_of(legs, own, *up, offsets);
}

}  // namespace kinemend
