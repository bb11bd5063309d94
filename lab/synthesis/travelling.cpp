// Motions that travel: walking, running, circles, and a stroll.
#include <cmath>
#include <memory>
#include <utility>

#include "lab/synthesis/gait.hpp"
#include "lab/synthesis/motions.hpp"

namespace kinemend::synth {

namespace {

Motion gait_motion(std::shared_ptr<const Gait> gait) {
  return [gait = std::move(gait)](double time_s) { return gait->posture(time_s); };
}

}  // namespace

Motion walk(const Body& body, double duration_s, Random random) {
  const Wander drift(random, 2.0, 0.0004, 0.002);  // in cycles a centimetre
  const auto heading = [drift](double s) { return drift(s); };
  return gait_motion(std::make_shared<Gait>(body, walk_data(), heading, duration_s, random));
}

Motion run(const Body& body, double duration_s, Random random) {
  const Wander drift(random, 1.5, 0.0002, 0.001);
  const auto heading = [drift](double s) { return drift(s); };
  return gait_motion(std::make_shared<Gait>(body, run_data(), heading, duration_s, random));
}

Motion turn(const Body& body, double duration_s, Random random) {
  const double radius = random.uniform(80, 95);
  const double direction = random.chance(0.5) ? 1 : -1;
  const double bend_cm = 80;
  // This is the integral of a curvature that rises from 0 to 1 / radius over the bend's length.
  const auto heading = [=](double s) {
    return direction * degrees_per_radian / radius * smooth_hinge(s - 60, bend_cm / 2);
  };
  return gait_motion(std::make_shared<Gait>(body, walk_data(), heading, duration_s, random));
}

Motion stroll(const Body& body, double duration_s, Random random) {
  // Chosen by hand, not swept.
  constexpr double straight_cm = 250, bend_cm = 400, turn_deg = 195;
  const Wander drift(random, 1.5, 0.0004, 0.002);
  const auto heading = [drift](double s) {
    const double lap = straight_cm + bend_cm;
    const double laps = std::floor(s / lap);
    const double turned = s < 0 ? 0 : laps + ramp(s - laps * lap, straight_cm, lap);
    return turn_deg * turned + drift(s);
  };
  const auto gait = std::make_shared<Gait>(body, walk_data(), heading, duration_s, random);
  return [gait](double time_s) {
    // Chosen by hand, not swept.
    constexpr double period_s = 9;
    Posture p = gait->posture(time_s);
    const double t = time_s - period_s * std::floor(time_s / period_s);
    const double weight = ramp(t, 4.8, 5.6) * ramp(t, 8.2, 7.4);
    p.arms[1] = waving_arm(p.arms[1], time_s, weight);
    return p;
  };
}

}  // namespace kinemend::synth
