// Walking and running along a path.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "lab/synthesis/body.hpp"
#include "lab/synthesis/curves.hpp"
#include "lab/synthesis/gait_data.hpp"
#include "lab/synthesis/path.hpp"

namespace kinemend::synth {

/// Walking or running along a path. The normative angles place the feet relative to the pelvis, and
/// the pelvis moves so that the standing foot stays in place. The legs absorb the rest (a
/// centimetre or two). In stance the foot turns about the heel, rests flat, then turns about the
/// ball, each at a fixed place. In swing the correction runs from one stance to the next with two
/// continuous derivatives.
class Gait {
 public:
  /// `heading_deg`: function of the distance in cm. `duration_s`: determines the length of the
  /// path.
  Gait(const Body& body, const GaitData& data, std::function<double(double)> heading_deg,
       double duration_s, Random random);

  Posture posture(double time_s) const;
  /// Returns the strides since time 0, counted from a contact of the left foot.
  double strides(double time_s) const;

 private:
  struct Footprint {
    Vec3 ball;  // the ball joint, foot flat
    double yaw_deg = 0;
  };
  // The displacement of the normative ankle at one end of a swing, with its derivatives by strides.
  struct Correction {
    Vec3 value, slope, curvature;
  };
  struct Swing {
    Correction from, to;
  };
  struct Side {
    std::vector<Footprint> footprints;  // for strides first_stride_, first_stride_ + 1, ...
    std::vector<Swing> swings;
  };

  void fit_pelvis();
  void lower_pelvis_into_reach();
  void lay_footprints(const Random& random);
  double mid_stance() const;
  double stride_number(std::size_t index) const;
  double foot_pitch(double phase) const;
  double toe_extension(double phase) const;
  double distance(double strides) const;
  double crouch_in_turn(double distance) const;
  Posture pelvis_posture(double strides) const;
  Posture upper_body(double strides, double time_s, Posture posture) const;
  Vec3 normative_ankle(double strides, std::size_t side, const Posture& pelvis) const;
  Vec3 standing_ankle(const Footprint& print, double phase) const;
  Correction correction(double strides, std::size_t side, std::size_t index) const;
  Vec3 swing_correction(const Swing& swing, double phase) const;
  Footprint footprint(std::size_t side, double stride, Random random) const;
  FootPlace foot(double strides, std::size_t side, const Posture& pelvis) const;

  const Body& body_;
  const GaitData& data_;
  PeriodicCurve hip_, knee_, ankle_;
  StepCurve height_, pace_;  // cm; cm a stride
  double ball_ahead_ = 0;    // ahead of the pelvis at mid stance
  double drop_ = 0;
  double stride_s_;
  double first_strides_;  // at time 0
  Wander tempo_, knee_wander_, trunk_wander_, twist_wander_, nod_wander_, look_wander_;
  std::array<Wander, 2> shoulder_wander_, elbow_wander_, wrist_wander_;
  Path path_;
  std::int64_t first_stride_ = 0;
  std::array<Side, 2> sides_;
};

}  // namespace kinemend::synth
