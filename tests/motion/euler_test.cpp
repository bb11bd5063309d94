// Tests of Euler angles in every order, against SciPy and at gimbal lock.
#include <gmock/gmock.h>

#include <algorithm>

#include "base/csv.hpp"
#include "kinemend/error.hpp"
#include "motion/clips.hpp"

namespace kinemend {
namespace {

using test::degree;
using test::random_rotation;
using test::random_vector;
using Angles = std::array<double, 3>;

// The product of three turns, straight from the definition.
Quat turns(const Angles& angles, RotationOrder order) {
  Quat q;
  for (std::size_t i = 0; i < order.count; ++i) {
    Vec3 axis;
    (order.axes[i] == Axis::x ? axis.x : order.axes[i] == Axis::y ? axis.y : axis.z) = angles[i];
    q = q * exp(axis);
  }
  return q;
}

double largest_change(const Angles& a, const Angles& b, std::size_t count = 3) {
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, std::fabs(a[i] - b[i]));
  return largest;
}

TEST(EulerOrders, AreTwelveAndNamedByTheirLetters) {
  std::vector<std::string> names;
  for (const RotationOrder order : all_rotation_orders()) {
    names.push_back(to_string(order));
    EXPECT_EQ(parse_rotation_order(names.back()), order);
  }
  EXPECT_THAT(names, testing::UnorderedElementsAre("XYX", "XYZ", "XZX", "XZY", "YXY", "YXZ", "YZX",
                                                   "YZY", "ZXY", "ZXZ", "ZYX", "ZYZ"));
  EXPECT_EQ(to_string(parse_rotation_order("zx")), "ZX");
}

TEST(EulerOrders, RefuseOtherLetters) {
  for (const char* text : {"", "XX", "XYY", "XYZX", "ABC", "X Y", "XYW"}) {
    EXPECT_THROW(parse_rotation_order(text), Error) << text;
  }
}

TEST(Euler, AgreesWithScipyInAllOrders) {
  const auto rows = test::read_csv("rotation/euler_orders.csv");
  ASSERT_EQ(rows.size(), 60u);
  for (const auto& row : rows) {
    const RotationOrder order = parse_rotation_order(row[0]);
    const Angles angles{std::stod(row[1]), std::stod(row[2]), std::stod(row[3])};
    const Quat expected{std::stod(row[4]), std::stod(row[5]), std::stod(row[6]), std::stod(row[7])};
    EXPECT_LT(angle_between(from_euler(angles, order), expected), 1e-14) << row[0];
  }
}

TEST(Euler, GivesTheRotationBackOnAGridThatHoldsEveryGimbalLock) {
  double worst = 0;
  for (const RotationOrder order : all_rotation_orders()) {
    for (int a = -4; a <= 4; ++a) {
      for (int b = -4; b <= 4; ++b) {
        for (int c = -4; c <= 4; ++c) {
          const Quat q = turns({a * 45 * degree, b * 45 * degree, c * 45 * degree}, order);
          for (const Quat sign : {q, -q}) {
            worst = std::max(worst, angle_between(from_euler(to_euler(sign, order), order), q));
          }
        }
      }
    }
  }
  EXPECT_LT(worst, 1e-14);
}

TEST(Euler, GivesRandomRotationsBackWhateverTheAnglesBefore) {
  Random random(1);
  for (const RotationOrder order : all_rotation_orders()) {
    for (int i = 0; i < 2000; ++i) {
      const Quat q = random_rotation(random);
      const Vec3 p = random_vector(random, 10);
      const Angles found = to_euler_near(q, order, {p.x, p.y, p.z});
      ASSERT_LT(angle_between(from_euler(found, order), q), 5e-14);
    }
  }
}

TEST(Euler, NearGimbalLockGivesTheRotationBack) {
  Random random(2);
  for (const RotationOrder order : all_rotation_orders()) {
    const double lock = order.axes[0] == order.axes[2] ? 0 : pi / 2;
    for (const double off : {0.0, 1e-16, 1e-12, 0.9e-9, 1.1e-9, 1e-7, 1e-6, 1e-4}) {
      for (const double side : {-1.0, 1.0}) {
        const Angles angles{random.uniform(-3, 3), lock + side * off, random.uniform(-3, 3)};
        const Quat q = turns(angles, order);
        const double allowed = off < 1e-9 ? 2 * off + 1e-14 : 1e-14;
        EXPECT_LT(angle_between(from_euler(to_euler(q, order), order), q), allowed)
            << to_string(order) << " " << off;
      }
    }
  }
}

// Tries all angles with the same rotation: both branches and whole turns.
double least_largest_change(const Angles& angles, RotationOrder order, const Angles& previous) {
  const bool proper = order.axes[0] == order.axes[2];
  const Angles other{angles[0] + pi, proper ? -angles[1] : pi - angles[1], angles[2] + pi};
  double best = 1e9;
  for (const Angles& branch : {angles, other}) {
    for (int a = -4; a <= 4; ++a) {
      for (int b = -4; b <= 4; ++b) {
        for (int c = -4; c <= 4; ++c) {
          best = std::min(best, largest_change({branch[0] + 2 * pi * a, branch[1] + 2 * pi * b,
                                                branch[2] + 2 * pi * c},
                                               previous));
        }
      }
    }
  }
  return best;
}

TEST(EulerNear, ChangesLeastOfAllAnglesWithThisRotation) {
  Random random(3);
  for (const RotationOrder order : all_rotation_orders()) {
    for (int i = 0; i < 60; ++i) {
      const Vec3 a = random_vector(random, 2), p = random_vector(random, 2);
      const Angles angles{a.x, a.y, a.z}, previous{p.x, p.y, p.z};
      const Angles found = to_euler_near(turns(angles, order), order, previous);
      EXPECT_NEAR(largest_change(found, previous), least_largest_change(angles, order, previous),
                  1e-9);
    }
  }
}

TEST(EulerNear, KeepsAnglesThatAreRightAlready) {
  Random random(4);
  for (const RotationOrder order : all_rotation_orders()) {
    for (int i = 0; i < 100; ++i) {
      const Vec3 a = random_vector(random, 3);
      const Angles angles{a.x, a.y, a.z};
      EXPECT_LT(largest_change(to_euler_near(turns(angles, order), order, angles), angles), 1e-11);
    }
  }
}

TEST(EulerNear, InGimbalLockKeepsAnglesThatAreRightAlready) {
  Random random(5);
  for (const RotationOrder order : all_rotation_orders()) {
    const double lock = order.axes[0] == order.axes[2] ? 0 : pi / 2;
    for (int turn = -3; turn <= 3; ++turn) {
      const Angles angles{random.uniform(-9, 9), lock + turn * pi, random.uniform(-9, 9)};
      EXPECT_LT(largest_change(to_euler_near(turns(angles, order), order, angles), angles), 1e-11)
          << to_string(order) << " " << turn;
    }
  }
}

TEST(EulerNear, InGimbalLockSplitsTheChangeBetweenTheLockedAngles) {
  for (const RotationOrder order : all_rotation_orders()) {
    const double lock = order.axes[0] == order.axes[2] ? 0 : pi / 2;
    const Angles before{0.4, lock, -0.3};
    const Angles found = to_euler_near(turns({0.5, lock, -0.3}, order), order, before);
    EXPECT_NEAR(std::fabs(found[0] - before[0]), 0.05, 1e-12) << to_string(order);
    EXPECT_NEAR(std::fabs(found[2] - before[2]), 0.05, 1e-12) << to_string(order);
  }
}

TEST(EulerNear, FollowsAPathThroughGimbalLockAndWholeTurns) {
  // The middle angle passes through gimbal lock, the first one makes whole turns, and the branch
  // never changes.
  for (const RotationOrder order : all_rotation_orders()) {
    Angles found{0.1, 0.55, -0.2};
    for (int f = 0; f <= 600; ++f) {
      const double t = static_cast<double>(f) / 600;
      const Angles truth{0.1 + 14 * t, 0.55 + 2.3 * t, -0.2 + 0.3 * std::sin(9 * t)};
      found = to_euler_near(turns(truth, order), order, found);
      ASSERT_LT(largest_change(found, truth), 1e-9) << to_string(order) << " frame " << f;
    }
  }
}

TEST(EulerNear, WithNoiseAcrossGimbalLockMakesNoJumpOfATurn) {
  Random random(6);
  for (const RotationOrder order : all_rotation_orders()) {
    Angles found{};
    for (int f = 0; f < 600; ++f) {
      const double t = static_cast<double>(f) / 600;
      const double middle =
          order.axes[0] == order.axes[2] ? 0.2 * std::sin(12 * t) : pi / 2 + 0.2 * std::sin(12 * t);
      const Quat q =
          turns({0.5 * t, middle, 0.3}, order) * exp(random_vector(random, 0.5 * degree));
      const Angles next = to_euler_near(q, order, found);
      ASSERT_LT(angle_between(from_euler(next, order), q), 1e-13);
      // In gimbal lock a small turn may need a large change of two angles: they share a quarter
      // turn, never more than a half.
      if (f > 0) {
        ASSERT_LT(largest_change(next, found), pi / 2 + 0.05) << to_string(order) << " frame " << f;
      }
      found = next;
    }
  }
}

TEST(Hinge, FindsItsAngleAndContinuesIt) {
  const RotationOrder order = parse_rotation_order("Y");
  double previous = 0;
  for (int f = 0; f <= 100; ++f) {
    const double angle = 0.2 * f;
    const Angles found = to_euler_near(test::about_y(angle), order, {previous, 0, 0});
    EXPECT_NEAR(found[0], angle, 1e-12);
    previous = found[0];
  }
}

TEST(Hinge, IsTheNearestOfAllItsAngles) {
  Random random(7);
  for (const char* axis : {"X", "Y", "Z"}) {
    const RotationOrder order = parse_rotation_order(axis);
    for (int i = 0; i < 100; ++i) {
      const Quat q = random_rotation(random);
      const double best = angle_between(from_euler(to_euler(q, order), order), q);
      for (int step = 0; step < 360; ++step) {
        ASSERT_GE(angle_between(from_euler({step * degree, 0, 0}, order), q), best - 1e-12);
      }
    }
  }
}

TEST(Saddle, IsTheNearestOfAllItsAngles) {
  Random random(8);
  for (const char* axes : {"XY", "YX", "YZ", "ZY", "ZX", "XZ"}) {
    const RotationOrder order = parse_rotation_order(axes);
    for (int i = 0; i < 12; ++i) {
      const Quat q = random_rotation(random);
      const double best = angle_between(from_euler(to_euler(q, order), order), q);
      for (int a = 0; a < 360; a += 4) {
        for (int b = 0; b < 360; b += 4) {
          ASSERT_GE(angle_between(from_euler({a * degree, b * degree, 0}, order), q), best - 1e-12)
              << axes;
        }
      }
    }
  }
}

TEST(Saddle, FindsAnglesThatItCanReachAndContinuesThem) {
  for (const char* axes : {"XY", "YX", "YZ", "ZY", "ZX", "XZ"}) {
    const RotationOrder order = parse_rotation_order(axes);
    Angles found{0.2, -0.5, 0};
    for (int f = 0; f <= 400; ++f) {
      const double t = static_cast<double>(f) / 400;
      const Angles truth{0.2 + 13 * t, -0.5 + 4 * t, 0};
      found = to_euler_near(turns(truth, order), order, found);
      ASSERT_LT(largest_change(found, truth, 2), 1e-9) << axes << " frame " << f;
    }
  }
}

TEST(Euler, OfAJointWithoutAxesIsNothing) {
  const RotationOrder none;
  EXPECT_EQ(to_euler(test::about_x(1), none), Angles{});
  EXPECT_EQ(from_euler({1, 2, 3}, none), Quat{});
}

}  // namespace
}  // namespace kinemend
