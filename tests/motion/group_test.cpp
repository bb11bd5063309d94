// Tests of the properties of rotations: group, exponential and logarithm, angles, and slerp.
#include <gtest/gtest.h>

#include <limits>

#include "motion/clips.hpp"
#include "motion/rotation.hpp"

namespace kinemend {
namespace {

using test::random_rotation;
using test::random_vector;

// Test elements: identity, near identity, half turns, near half turns, ordinary and random ones.
std::vector<Quat> elements() {
  std::vector<Quat> list{{}, {-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}, normalized({0, 1, 1, 1})};
  const Vec3 axis = (1 / norm(Vec3{1, -2, 0.5})) * Vec3{1, -2, 0.5};
  for (const double angle :
       {1e-11, 1e-8, 1e-5, 1e-3, 0.1, 1.0, 3.0, pi - 1e-3, pi - 1e-8, pi - 1e-11, pi}) {
    list.push_back(exp(angle * axis));
    list.push_back(exp(Vec3{0, -angle, 0}));
  }
  Random random(1);
  for (int i = 0; i < 20; ++i) list.push_back(random_rotation(random));
  return list;
}

double distance(Quat a, Quat b) { return std::min(norm(a + -b), norm(a + b)); }

TEST(Axes, UnitVectorsHaveOneComponent) {
  Vec3 sum;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    EXPECT_EQ(norm(unit_vector(axis)), 1);
    EXPECT_EQ(component(unit_vector(axis), axis), 1);
    component_of(sum, axis) += component(Vec3{1, 2, 3}, axis);
  }
  EXPECT_EQ(sum, (Vec3{1, 2, 3}));
}

TEST(RotationGroup, HasInverseAndIdentity) {
  for (const Quat q : elements()) {
    EXPECT_LT(distance(q * conjugate(q), {}), 1e-15);
    EXPECT_EQ(q * Quat{}, q);
    EXPECT_EQ(Quat{} * q, q);
  }
}

TEST(RotationGroup, IsAssociativeAndActsAsAGroup) {
  const auto list = elements();
  const Vec3 v{0.3, -2, 1};
  for (std::size_t i = 0; i + 2 < list.size(); ++i) {
    const Quat a = list[i], b = list[i + 1], c = list[i + 2];
    EXPECT_LT(norm((a * b) * c + -(a * (b * c))), 2e-15);
    EXPECT_LT(norm(rotate(a * b, v) - rotate(a, rotate(b, v))), 1e-14);
    EXPECT_LT(norm(rotate(conjugate(a), rotate(a, v)) - v), 1e-14);
    EXPECT_LT(norm(rotate(a, v) - rotate(-a, v)), 1e-15);
  }
}

TEST(RotationGroup, RotatesAsRodriguesSays) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Vec3 w = random_vector(random, 2), v = random_vector(random);
    const double angle = norm(w);
    const Vec3 k = (1 / angle) * w;
    const Vec3 expected = std::cos(angle) * v + std::sin(angle) * cross(k, v) +
                          (dot(k, v) * (1 - std::cos(angle))) * k;
    EXPECT_LT(norm(rotate(exp(w), v) - expected), 1e-14);
  }
}

TEST(RotationGroup, TurnsByTheRightHand) {
  EXPECT_LT(norm(rotate(test::about_z(pi / 2), {1, 0, 0}) - Vec3{0, 1, 0}), 1e-15);
  EXPECT_LT(norm(rotate(test::about_x(pi / 2), {0, 1, 0}) - Vec3{0, 0, 1}), 1e-15);
  EXPECT_LT(norm(rotate(test::about_y(pi / 2), {0, 0, 1}) - Vec3{1, 0, 0}), 1e-15);
}

TEST(RotationGroup, KeepsItsNormOverNineThousandProducts) {
  Random random(3);
  std::vector<Quat> factors;
  for (int i = 0; i < 90; ++i) factors.push_back(random_rotation(random));
  Quat product;
  for (int i = 0; i < 9000; ++i) product = product * factors[static_cast<std::size_t>(i % 90)];
  EXPECT_NEAR(norm(product), 1, 1e-11);
}

TEST(ExpLog, AreInverseOnEveryElement) {
  for (const Quat q : elements()) EXPECT_LT(distance(exp(log(q)), q), 1e-15) << q.w << " " << q.x;
}

TEST(ExpLog, AreInverseOnVectorsUpToAHalfTurn) {
  const Vec3 axis = (1 / norm(Vec3{3, 1, -2})) * Vec3{3, 1, -2};
  for (const double angle :
       {0.0, 1e-300, 1e-20, 1e-11, 1e-8, 1e-5, 1e-4, 1e-3, 0.5, 2.0, 3.0, pi - 1e-3, pi - 1e-8}) {
    const Vec3 v = angle * axis;
    EXPECT_LT(norm(log(exp(v)) - v), 4e-16 * (1 + angle)) << angle;
    if (angle > 0) {
      EXPECT_LT(norm(log(exp(v)) - v) / angle, 1e-7) << "relative, at " << angle;
    }
  }
}

TEST(ExpLog, OfSmallVectorsKeepAllDigits) {
  for (const double angle : {1e-11, 1e-8, 1e-6, 9.9e-5, 1.1e-4}) {
    const Vec3 v = log(exp({angle, 0, 0}));
    EXPECT_NEAR(v.x / angle, 1, 4e-16) << angle;
    EXPECT_NEAR(angle_between({}, exp({0, 0, angle})) / angle, 1, 4e-16) << angle;
  }
}

TEST(ExpLog, AtExactlyAHalfTurnIsEitherSignOfTheAxis) {
  for (const Quat q : {Quat{0, 0, 1, 0}, Quat{-0.0, 0, 1, 0}, exp({0, pi, 0})}) {
    const Vec3 v = log(q);
    EXPECT_NEAR(std::fabs(v.y), pi, 1e-15);
    EXPECT_EQ(v.x, 0);
    EXPECT_EQ(v.z, 0);
  }
}

TEST(ExpLog, OfManyTurnsComesBackAsTheShortestVector) {
  // |v| = 30 is 4 turns and 4.867 rad, which equals 1.416 rad in the other direction.
  const Vec3 axis = (1 / norm(Vec3{1, 2, 3})) * Vec3{1, 2, 3};
  EXPECT_LT(norm(log(exp(30 * axis)) - (30 - 10 * pi) * axis), 1e-14);
  EXPECT_LE(norm(log(exp(30 * axis))), pi);
}

TEST(ExpLog, TakeBothSignsOfAQuaternionForTheSame) {
  for (const Quat q : elements()) {
    if (std::fabs(q.w) < 1e-9) continue;
    EXPECT_EQ(log(q), log(-q));
  }
}

TEST(ExpLog, CommuteWithARotationOfTheFrame) {
  // Log(r q r^-1) = r Log(q)
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const Quat q = exp(random_vector(random, 0.8)), r = random_rotation(random);
    EXPECT_LT(norm(log(r * q * conjugate(r)) - rotate(r, log(q))), 1e-14);
  }
}

TEST(AngleBetween, IsAMetricThatRotationsLeaveAlone) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const Quat a = random_rotation(random), b = random_rotation(random),
               c = random_rotation(random);
    EXPECT_NEAR(angle_between(a, b), angle_between(b, a), 1e-15);
    EXPECT_LE(angle_between(a, c), angle_between(a, b) + angle_between(b, c) + 1e-15);
    EXPECT_NEAR(angle_between(c * a, c * b), angle_between(a, b), 1e-14);
    EXPECT_NEAR(angle_between(a * c, b * c), angle_between(a, b), 1e-14);
    EXPECT_NEAR(angle_between(a, -b), angle_between(a, b), 1e-15);
    EXPECT_NEAR(angle_between(a, b), norm(log(conjugate(a) * b)), 1e-14);
  }
}

TEST(AngleBetween, IsExactlyZeroForEqualRotations) {
  for (const Quat q : elements()) {
    EXPECT_EQ(angle_between(q, q), 0.0);
    EXPECT_EQ(angle_between(q, -q), 0.0);
  }
}

TEST(Slerp, GoesAlongTheShortestArcAtConstantSpeed) {
  Random random(6);
  for (int i = 0; i < 100; ++i) {
    const Quat a = random_rotation(random), b = random_rotation(random);
    const double whole = angle_between(a, b);
    for (const double t : {0.0, 0.25, 0.5, 0.9, 1.0}) {
      const Quat q = slerp(a, b, t);
      EXPECT_NEAR(angle_between(a, q), t * whole, 1e-14);
      EXPECT_NEAR(angle_between(q, b), (1 - t) * whole, 1e-14);
      EXPECT_NEAR(norm(q), 1, 1e-14);
    }
    EXPECT_LT(angle_between(slerp(a, b, 0.3), slerp(b, a, 0.7)), 1e-14);
  }
}

TEST(AlignHemispheres, MakesNeighboursNearAndKeepsTheRotations) {
  Random random(7);
  std::vector<Quat> track, aligned;
  for (int f = 0; f < 100; ++f) {
    for (int j = 0; j < 3; ++j) {
      const Quat q = exp(0.1 * static_cast<double>(f) * Vec3{0.3, 0.5 * j, -0.4});
      track.push_back(random.chance(0.5) ? q : -q);
    }
  }
  aligned = track;
  align_hemispheres(std::span(aligned).subspan(1), 3);  // the second of three joints
  for (std::size_t i = 0; i < track.size(); ++i) {
    if (i % 3 != 1) {
      EXPECT_EQ(aligned[i], track[i]) << "other joints stay";
      continue;
    }
    EXPECT_TRUE(aligned[i] == track[i] || aligned[i] == -track[i]);
    if (i >= 3) {
      EXPECT_GT(dot(aligned[i], aligned[i - 3]), 0);
    }
  }
  EXPECT_EQ(aligned[1], track[1]) << "the first sample keeps its sign";
}

TEST(Normalized, HasUnitNormAndIsTheIdentityWhereThereIsNoDirection) {
  EXPECT_EQ(normalized({0, 0, 0, 0}), Quat{});
  EXPECT_NEAR(norm(normalized({3, -4, 12, 84})), 1, 1e-15);
  EXPECT_NEAR(norm(normalized({1e-200, 0, 1e-200, 0})), 1, 1e-15)
      << "squares of the components underflow";
  EXPECT_NEAR(norm(normalized({1e200, 0, 1e200, 0})), 1, 1e-15)
      << "squares of the components overflow";
}

TEST(WrapAngle, LandsInTheHalfOpenInterval) {
  EXPECT_EQ(wrap_angle(180, 180), -180);
  EXPECT_EQ(wrap_angle(-180, 180), -180);
  EXPECT_EQ(wrap_angle(190, 180), -170);
  EXPECT_EQ(wrap_angle(-540, 180), -180);
  EXPECT_EQ(wrap_angle(359, 180), -1);
  EXPECT_NEAR(wrap_angle(7, pi), 7 - 2 * pi, 1e-15);
}

}  // namespace
}  // namespace kinemend
