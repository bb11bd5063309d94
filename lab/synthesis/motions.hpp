// The motions of artificial takes, as functions of time.
#pragma once

#include <functional>
#include <string_view>

#include "kinemend/extend/random.hpp"
#include "lab/synthesis/body.hpp"

namespace kinemend::synth {

/// A motion in continuous time, seconds from 0.
using Motion = std::function<Posture(double)>;

/// Returns a motion of the table `synth_motions()`, except `spin`. It does not depend on
/// `duration_s`, which only sets how far the motion is prepared. `body` must outlive the motion.
Motion make_motion(std::string_view name, const Body& body, double duration_s,
                   const Random& random);

Motion walk(const Body& body, double duration_s, Random random);
Motion run(const Body& body, double duration_s, Random random);
/// Walks in circles: the heading passes 360 degrees within about 5 s and continues.
Motion turn(const Body& body, double duration_s, Random random);
/// Walks, turns about and waves on the way back.
Motion stroll(const Body& body, double duration_s, Random random);

Motion still(const Body& body, Random random);
Motion wave(const Body& body, Random random);
Motion clap(const Body& body, Random random);
Motion punch(const Body& body, Random random);
/// Counter-movement jumps on the spot, one every 2.8 s.
Motion jump(const Body& body, Random random);
/// A jump down from a box of 40 cm, once.
Motion landing(const Body& body, Random random);

/// Returns the right arm from hanging to waving and back, at `weight` 0..1.
ArmAngles waving_arm(const ArmAngles& hanging, double time_s, double weight);

}  // namespace kinemend::synth
