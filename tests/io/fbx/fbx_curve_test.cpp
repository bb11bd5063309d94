#include "io/fbx/fbx_curve.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace kinemend {
namespace {

constexpr double second = 46186158000.0;

FbxCurve curve_of(std::vector<double> seconds, std::vector<double> values,
                  std::vector<FbxKeyShape> shapes) {
  FbxCurve curve;
  std::vector<std::int64_t> times;
  for (const double s : seconds) times.push_back(static_cast<std::int64_t>(s * second));
  curve.times = std::make_shared<const std::vector<std::int64_t>>(times);
  curve.values = std::move(values);
  curve.shapes = std::move(shapes);
  return curve;
}

double at(const FbxCurve& curve, double seconds) {
  std::size_t cursor = 0;
  return fbx_value_at(curve, static_cast<std::int64_t>(seconds * second), second, cursor);
}

FbxKeyShape cubic(float right, float next_left) {
  FbxKeyShape shape;
  shape.kind = FbxKeyShape::cubic;
  shape.right_slope = right;
  shape.next_left_slope = next_left;
  return shape;
}

FbxKeyShape of_kind(FbxKeyShape::Kind kind) {
  FbxKeyShape shape;
  shape.kind = kind;
  return shape;
}

TEST(FbxCurve, CubicKeysAreTheHermitePolynomialOfTheirSlopes) {
  // p(x) = h00 p0 + h10 m0 + h01 p1 + h11 m1 with x = (t - 1) / 2 and slopes times the step of 2 s.
  const FbxCurve curve = curve_of({1, 3}, {4, 10}, {cubic(5, -3)});
  EXPECT_NEAR(at(curve, 1.5), 0.84375 * 4 + 0.140625 * 10 + 0.15625 * 10 + -0.046875 * -6, 1e-9);
  EXPECT_NEAR(at(curve, 2), 0.5 * 4 + 0.125 * 10 + 0.5 * 10 - 0.125 * -6, 1e-9);
  EXPECT_DOUBLE_EQ(at(curve, 1), 4);
  EXPECT_DOUBLE_EQ(at(curve, 3), 10);
}

TEST(FbxCurve, ConstantAndLinearKeysDoWhatTheySay) {
  const FbxCurve curve =
      curve_of({0, 1, 2, 3}, {1, 3, 5, 9},
               {of_kind(FbxKeyShape::constant), of_kind(FbxKeyShape::constant_next),
                of_kind(FbxKeyShape::linear), of_kind(FbxKeyShape::linear)});
  EXPECT_DOUBLE_EQ(at(curve, 0.75), 1);
  EXPECT_DOUBLE_EQ(at(curve, 1), 3);
  EXPECT_DOUBLE_EQ(at(curve, 1.25), 5);
  EXPECT_DOUBLE_EQ(at(curve, 2.25), 6);
}

TEST(FbxCurve, WeightedTangentsAreBezierCurves) {
  FbxKeyShape shape = cubic(2, -1);
  shape.right_weight = 0.6f;
  shape.next_left_weight = 0.2f;
  const FbxCurve curve = curve_of({0, 2}, {1, 3}, {shape});
  const double w0 = static_cast<double>(0.6f), w1 = static_cast<double>(0.2f);
  for (const double s : {0.1, 0.35, 0.5, 0.8}) {
    const double r = 1 - s, b1 = 3 * r * r * s, b2 = 3 * r * s * s, b3 = s * s * s;
    const double time = 2 * (b1 * w0 + b2 * (1 - w1) + b3);
    const double value = r * r * r * 1 + b1 * (1 + 2 * w0 * 2) + b2 * (3 + 1 * w1 * 2) + b3 * 3;
    EXPECT_NEAR(at(curve, time), value, 1e-8) << s;
  }
}

TEST(FbxCurve, AutomaticTangentsPassThroughTheNeighbours) {
  const FbxCurve curve = curve_of({0, 1, 2, 3}, {0, 1, 4, 5}, {of_kind(FbxKeyShape::cubic_auto)});
  // Both inner keys have slope 2.
  EXPECT_NEAR(at(curve, 1.5), 0.5 * (1 + 4) + 0.125 * 2 - 0.125 * 2, 1e-9);
  // Between the first two keys, the curve is level at the first.
  EXPECT_NEAR(at(curve, 0.5), 0.5 * (0 + 1) + 0.125 * 0 - 0.125 * 2, 1e-9);
}

TEST(FbxCurve, TensionOfOneStopsAtTheKey) {
  FbxKeyShape shape = of_kind(FbxKeyShape::cubic_tcb);
  shape.right_slope = 1;
  const FbxCurve curve = curve_of({0, 1, 2}, {0, 8, 0}, {shape});
  EXPECT_NEAR(at(curve, 0.5), 4, 1e-9);
  EXPECT_NEAR(at(curve, 0.25), 8 * (3 * 0.0625 - 2 * 0.015625), 1e-9);
}

TEST(FbxCurve, BeyondTheKeysACurveDoesWhatItsExtrapolationSays) {
  FbxCurve curve = curve_of({1, 2}, {10, 14}, {of_kind(FbxKeyShape::linear)});
  EXPECT_DOUBLE_EQ(at(curve, 0.25), 10);
  EXPECT_DOUBLE_EQ(at(curve, 7), 14);
  curve.before = curve.after = {'R', -1};
  EXPECT_NEAR(at(curve, 2.25), 11, 1e-7);
  EXPECT_NEAR(at(curve, 0.75), 13, 1e-7);
  curve.before = curve.after = {'M', -1};
  EXPECT_NEAR(at(curve, 2.25), 13, 1e-7);
  EXPECT_NEAR(at(curve, 3.25), 11, 1e-7);
  EXPECT_NEAR(at(curve, 0.75), 11, 1e-7);
  curve.before = curve.after = {'A', -1};
  EXPECT_NEAR(at(curve, 3.5), 14 + 4 + 2, 1e-7);
  EXPECT_NEAR(at(curve, 0.5), 8, 1e-7);
  curve.before = curve.after = {'K', -1};
  EXPECT_NEAR(at(curve, 3), 18, 1e-7);
  EXPECT_NEAR(at(curve, 0), 6, 1e-7);
}

TEST(FbxCurve, RepetitionsEnd) {
  FbxCurve curve = curve_of({0, 1}, {0, 1}, {of_kind(FbxKeyShape::linear)});
  curve.after = {'A', 2};
  EXPECT_NEAR(at(curve, 2.5), 2.5, 1e-7);
  EXPECT_NEAR(at(curve, 9), 3, 1e-7);
}

TEST(FbxCurve, TheOrderOfTimesDoesNotMatter) {
  const FbxCurve curve =
      curve_of({0, 1, 2, 3, 4}, {0, 1, 4, 9, 16}, {of_kind(FbxKeyShape::linear)});
  std::size_t cursor = 0;
  for (const double t : {3.5, 0.5, 2.5, 2.5, 0.0, 4.0, 1.5}) {
    const auto ticks = static_cast<std::int64_t>(t * second);
    std::size_t fresh = 0;
    EXPECT_DOUBLE_EQ(fbx_value_at(curve, ticks, second, cursor),
                     fbx_value_at(curve, ticks, second, fresh));
  }
}

}  // namespace
}  // namespace kinemend
