// Sums the steps of the body in the drifting direction and lets the place wander.
#include "lab/damage/drift.hpp"

#include "lab/damage/coloured_noise.hpp"

namespace kinemend::corrupt {

Drift drifted(const std::vector<Vec3>& centres, double rate_hz, Axis up, double heading_deg,
              double place, const Random& random) {
  const Vec3 vertical{up == Axis::x ? 1.0 : 0, up == Axis::y ? 1.0 : 0, up == Axis::z ? 1.0 : 0};
  const Vec3 first{up == Axis::x ? 0.0 : 1, up == Axis::x ? 1.0 : 0, 0};
  const Vec3 second = cross(vertical, first);
  const auto heading = random_path(centres.size(), rate_hz, random.fork(0));
  const auto along = random_path(centres.size(), rate_hz, random.fork(1));
  const auto aside = random_path(centres.size(), rate_hz, random.fork(2));
  Drift drift;
  Vec3 walked;
  for (std::size_t f = 0; f < centres.size(); ++f) {
    const Quat turn = exp(heading_deg * radians_per_degree * heading[f] * vertical);
    walked = f == 0 ? centres[0] : walked + rotate(turn, centres[f] - centres[f - 1]);
    drift.headings.push_back(turn);
    drift.places.push_back(walked + place * (along[f] * first + aside[f] * second));
  }
  return drift;
}

}  // namespace kinemend::corrupt
