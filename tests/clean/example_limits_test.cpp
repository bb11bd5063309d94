#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <variant>
#include <vector>

#include "kinemend/corrupt.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/synth.hpp"
#include "kinemend/train.hpp"

namespace kinemend::test {
namespace {

Clip walk(std::uint64_t seed, double duration_s) {
  SynthOptions options{.motion = "walk", .duration_s = duration_s, .frame_rate_hz = 30};
  options.seed = seed;
  return synthesize(options);
}

// The left elbow stays in what it does in this take, two degrees more on each side.
std::size_t limit_elbow(Clip& clip) {
  const auto elbow = static_cast<std::size_t>(clip.skeleton.find("LeftForeArm"));
  const RotationOrder order = clip.skeleton.rotation_order(elbow);
  std::vector<ChannelLimit> limits(3, {1e9, -1e9});
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const auto angles = to_euler(clip.rotation(f, elbow), order);
    for (std::size_t a = 0; a < 3; ++a) {
      limits[a].minimum = std::min(limits[a].minimum, angles[a] * degrees_per_radian - 2);
      limits[a].maximum = std::max(limits[a].maximum, angles[a] * degrees_per_radian + 2);
    }
  }
  clip.skeleton.limits.resize(clip.joint_count());
  clip.skeleton.limits[elbow] = limits;
  return elbow;
}

double most_beyond(const Clip& clip, std::size_t joint) {
  const RotationOrder order = clip.skeleton.rotation_order(joint);
  double most = 0;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const auto angles = to_euler(clip.rotation(f, joint), order);
    for (std::size_t a = 0; a < 3; ++a) {
      const ChannelLimit& limit = clip.skeleton.limits[joint][a];
      const double angle = angles[a] * degrees_per_radian;
      most = std::max({most, limit.minimum - angle, angle - limit.maximum});
    }
  }
  return most;
}

// Five frames in six hundred, in which the elbow bends the wrong way.
TEST(ExampleLimits, DrawAnElbowBackThatNoiseBentBackwards) {
  const std::vector<Clip> training = {walk(1, 6), walk(2, 6), walk(3, 6)};
  const auto model = std::make_shared<const Model>(train_model(
      "example", {training.size(),
                  [&](std::size_t i) { return std::variant<Clip, MarkerClip>(training[i]); }}));
  Clip input = walk(4, 20);
  const std::size_t elbow = limit_elbow(input);
  Random random(5);
  apply_damage(input, "gaussian", {{"std_deg", 2.0}}, random);
  for (std::size_t f = 300; f < 305; ++f) {
    input.rotation(f, elbow) =
        from_euler({-0.5, -0.5, -0.5}, input.skeleton.rotation_order(elbow)) *
        input.rotation(f, elbow);
  }
  const auto beyond_with = [&](double weight) {
    ExampleOptions options;
    options.limits = weight;
    options.welsch_deg = 30;  // so that the bent elbow is no outlier
    Clip result = input;
    make_example(options, model)->clean(result, Selection::all(result));
    return most_beyond(result, elbow);
  };
  const double without = beyond_with(0), soft = beyond_with(1), hard = beyond_with(500);
  EXPECT_GT(most_beyond(input, elbow), 10);
  EXPECT_GT(without, 0.5) << soft << " " << hard;
  EXPECT_LT(soft, without + 0.1);
  EXPECT_LT(hard, 0.8 * without);
}

}  // namespace
}  // namespace kinemend::test
