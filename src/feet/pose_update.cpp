// Solves for the most likely turns of root and legs in each frame.
#include "feet/pose_update.hpp"

#include <Eigen/Dense>

#include <cmath>

#include "feet/leg_solver.hpp"

namespace kinemend::feet {

namespace {

// Standard deviations of a part from its place, in body heights: of standing feet, which roll and
// whose skin moves, and the addition while the correction fades. Chosen on walks, runs and dances
// that no table uses (docs/feet-details.md).
constexpr double contact_deviation = 0.003, fading_deviation = 0.03;
// Square radians of a joint for a square body height of a part: from the mean squares of the
// levers, with half of the error in the place itself. Chosen on the same takes.
constexpr double squares_per_part = 5;
// Rounds of Gauss and Newton (docs/feet-details.md), turn and shift of a root, and turns of hip,
// knee and ankle.
constexpr int rounds = 3;
constexpr Eigen::Index root_unknowns = 6, leg_unknowns = 9;

Eigen::Vector3d eigen(Vec3 v) { return {v.x, v.y, v.z}; }
Vec3 vector_of(const Eigen::VectorXd& values, Eigen::Index first) {
  return {values[first], values[first + 1], values[first + 2]};
}

// Returns d (turn x arm) / d turn.
Eigen::Matrix3d by_turn(Vec3 arm) {
  Eigen::Matrix3d matrix;
  matrix << 0, arm.z, -arm.y, -arm.z, 0, arm.x, arm.y, -arm.x, 0;
  return matrix;
}

// Returns the projection on the axes about which a joint's channels turn.
Eigen::Matrix3d free_axes(const LegJoint& joint, Quat parent, Quat own) {
  if (joint.order.count >= 3) return Eigen::Matrix3d::Identity();
  if (joint.order.count == 0) return Eigen::Matrix3d::Zero();
  const Eigen::Vector3d first =
      eigen(rotate(parent * joint.rest, axis_vector(joint.order.axes[0])));
  Eigen::Matrix3d projection = first * first.transpose();
  if (joint.order.count == 1) return projection;
  Eigen::Vector3d last = eigen(rotate(own, axis_vector(joint.order.axes[1])));
  last -= first.dot(last) * first;
  if (last.norm() > 0) projection += last * last.transpose() / last.squaredNorm();
  return projection;
}

// A part in ground contact.
struct Standing {
  std::size_t leg = 0;
  Vec3 at, target;
  double variance = 0;
};

class Update {
 public:
  Update(const LegMotion& motion, std::size_t frame, const std::vector<PartCorrection>& parts,
         const PoseUncertainty& uncertainty)
      : motion_(motion), frame_(frame) {
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const double weight = parts[p].weight[frame];
      const std::size_t leg = p / 2;
      if (!(weight > 0) || uncertainty.legs[leg] == 0) continue;
      const Vec3 at = pose(leg).sole_at(motion.models[leg], static_cast<FootPart>(p % 2));
      const double sure = contact_deviation * motion.height;
      const double faded = fading_deviation * motion.height;
      standing_.push_back({leg, at, at + parts[p].shift[frame],
                           sure * sure + faded * faded * (1 - weight) / weight});
    }
    if (!standing_.empty()) set_variances(uncertainty);
  }

  PoseUpdate solve() const {
    PoseUpdate update;
    if (standing_.empty()) return update;
    const auto rows = static_cast<Eigen::Index>(3 * standing_.size());
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(rows, variances_.cols());
    for (std::size_t i = 0; i < standing_.size(); ++i)
      set_slopes(standing_[i], slopes.middleRows<3>(static_cast<Eigen::Index>(3 * i)));
    Eigen::MatrixXd shared(variances_.cols(), rows);  // P J^T
    for (Eigen::Index first = 0; first < variances_.cols(); first += 3)
      shared.middleRows<3>(first) =
          variances_.middleCols<3>(first) * slopes.middleCols<3>(first).transpose();
    Eigen::MatrixXd covariance = slopes * shared;
    for (std::size_t i = 0; i < standing_.size(); ++i) {
      covariance.diagonal().segment<3>(static_cast<Eigen::Index>(3 * i)).array() +=
          standing_[i].variance;
    }
    const Eigen::LDLT<Eigen::MatrixXd> factors(covariance);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(variances_.cols()), rest(rows);
    for (int round = 0; round < rounds; ++round) {
      rest = slopes * x;
      for (std::size_t i = 0; i < standing_.size(); ++i)
        rest.segment<3>(static_cast<Eigen::Index>(3 * i)) +=
            eigen(standing_[i].target - moved(standing_[i], x));
      x = shared * factors.solve(rest);
    }
    update.root_shift = vector_of(x, 0);
    update.root_turn = vector_of(x, 3);
    for (std::size_t l = 0; l < motion_.legs(); ++l) {
      const Eigen::Index first = unknowns_of(l);
      update.legs.push_back(
          {vector_of(x, first), vector_of(x, first + 3), vector_of(x, first + 6)});
    }
    return update;
  }

 private:
  const LegPose& pose(std::size_t leg) const { return motion_.pose(frame_, leg); }
  Vec3 root_at() const { return motion_.carrier.found ? motion_.carrier.at[frame_] : Vec3{}; }
  static Eigen::Index unknowns_of(std::size_t leg) {
    return root_unknowns + leg_unknowns * static_cast<Eigen::Index>(leg);
  }

  void set_variances(const PoseUncertainty& uncertainty) {
    variances_ = Eigen::Matrix3Xd::Zero(3, unknowns_of(motion_.legs()));
    const auto set = [&](Eigen::Index first, double deviation, const Eigen::Matrix3d& axes) {
      variances_.middleCols<3>(first) = deviation * deviation * axes;
    };
    set(0, uncertainty.root_position, Eigen::Matrix3d::Identity());
    set(3, uncertainty.root_rotation, Eigen::Matrix3d::Identity());
    for (std::size_t l = 0; l < motion_.legs(); ++l) {
      if (uncertainty.legs[l] == 0) continue;
      const LegModel& model = motion_.models[l];
      const LegPose& own = pose(l);
      const Eigen::Index first = unknowns_of(l);
      const double deviation = uncertainty.joint_rotation;
      set(first, deviation, free_axes(model.hip, own.hip_parent, own.hip));
      set(first + 3, deviation, free_axes(model.knee, own.knee_parent, own.knee));
      set(first + 6, deviation, free_axes(model.ankle, own.ankle_parent, own.ankle));
    }
  }

  void set_slopes(const Standing& part, Eigen::Ref<Eigen::MatrixXd> slopes) const {
    const LegPose& own = pose(part.leg);
    const Eigen::Index first = unknowns_of(part.leg);
    slopes.middleCols<3>(0) = Eigen::Matrix3d::Identity();
    slopes.middleCols<3>(3) = by_turn(part.at - root_at());
    slopes.middleCols<3>(first) = by_turn(part.at - own.hip_at);
    slopes.middleCols<3>(first + 3) = by_turn(part.at - own.knee_at);
    slopes.middleCols<3>(first + 6) = by_turn(part.at - own.ankle_at);
  }

  // Returns the position of the part after the turns x.
  Vec3 moved(const Standing& part, const Eigen::VectorXd& x) const {
    const LegPose& own = pose(part.leg);
    const Eigen::Index first = unknowns_of(part.leg);
    Vec3 arm = rotate(exp(vector_of(x, first + 6)), part.at - own.ankle_at);
    arm = rotate(exp(vector_of(x, first + 3)), own.ankle_at - own.knee_at + arm);
    arm = rotate(exp(vector_of(x, first)), own.knee_at - own.hip_at + arm);
    arm = rotate(exp(vector_of(x, 3)), own.hip_at - root_at() + arm);
    return root_at() + vector_of(x, 0) + arm;
  }

  const LegMotion& motion_;
  std::size_t frame_;
  std::vector<Standing> standing_;
  Eigen::Matrix3Xd variances_;  // 3 x 3 for each three unknowns
};

}  // namespace

double joint_deviation(const std::vector<PartCorrection>& parts, double height) {
  double sum = 0, count = 0;
  for (const PartCorrection& part : parts) {
    for (std::size_t f = 0; f < part.shift.size(); ++f) {
      if (part.weight[f] < 1) continue;
      sum += dot(part.shift[f], part.shift[f]);
      count += 3;
    }
  }
  return count > 0 ? std::sqrt(squares_per_part * sum / count) / height : 0;
}

PoseUpdate update_by_contacts(const LegMotion& motion, std::size_t frame,
                              const std::vector<PartCorrection>& parts,
                              const PoseUncertainty& uncertainty) {
  return Update(motion, frame, parts, uncertainty).solve();
}

}  // namespace kinemend::feet
