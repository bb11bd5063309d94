// Long takes, takes far from the origin, and takes that keep turning are cleaned as accurately as
// short ones.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "kinemend/extend/motion.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/methods.hpp"
#include "long_tests.hpp"
#include "motion/random_rotations.hpp"
#include "quality/quality.hpp"
#include "registry/takes.hpp"

namespace kinemend::quality {
namespace {

constexpr double rate_hz = 60, noise_deg = 1.5, noise_cm = 0.3;

Take take_to_turn(const char* motion, double duration_s) {
  return synthesize({.motion = motion, .duration_s = duration_s, .frame_rate_hz = rate_hz});
}

Take noisy(const Take& truth, std::uint64_t seed = 7) {
  Take clip = damaged(truth, noise_deg, 0, seed);
  Random random(seed + 1);
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    clip.root_position(f) += test::random_vector(random, noise_cm);
  return clip;
}

// Turns the whole take about the origin, or moves it.
Vec3 turned(Vec3 p, Vec3 speed_deg_s, double time_s) {
  return rotate(exp(radians_per_degree * time_s * speed_deg_s), p);
}
Take turned(Take clip, Vec3 speed_deg_s) {
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const double time_s = static_cast<double>(f) / clip.frame_rate_hz;
    clip.rotation(f, 0) = exp(radians_per_degree * time_s * speed_deg_s) * clip.rotation(f, 0);
    clip.root_position(f) = turned(clip.root_position(f), speed_deg_s, time_s);
  }
  return clip;
}
Take moved(Take clip, Vec3 by) {
  for (std::size_t f = 0; f < clip.frame_count(); ++f) clip.root_position(f) += by;
  return clip;
}
Take about_its_middle(const Take& clip) {
  Vec3 sum;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) sum += clip.root_position(f);
  return moved(clip, (-1 / static_cast<double>(clip.frame_count())) * sum);
}

struct Squares {
  double rotations = 0, positions = 0;  // summed over frames

  void add(const Take& a, const Take& b) {
    for (std::size_t i = 0; i < a.rotations.size(); ++i)
      rotations += std::pow(angle_between(a.rotations[i], b.rotations[i]), 2);
    for (std::size_t f = 0; f < a.frame_count(); ++f) {
      const Vec3 d = a.root_position(f) - b.root_position(f);
      positions += dot(d, d);
    }
  }
};
double growth(double after, double before) { return std::sqrt(after / before); }

class OfAnyMethod : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Cleaner> cleaner_ = make_cleaner(GetParam());

  Take cleaned(const Take& clip) const { return clean_take(clip, *cleaner_).take; }
  // A causal method lags behind travel, and more so at higher speed.
  bool is_causal() const { return test::runs_without_delay(*cleaner_); }
  // A filter with fixed weights commutes with turns; other methods measure, compare or choose anew.
  bool has_fixed_weights() const {
    for (const char* name : {"gaussian", "butterworth", "weighted-mean", "kalman"})
      if (GetParam() == name) return true;
    return false;
  }
  bool is_learned() const { return find_method(GetParam()).learned; }  // learned methods are slower
  std::vector<Vec3> speeds() const {
    if (is_learned()) return {{0, 60, 0}, {40, 0, 0}, {-20, 30, 20}};
    return {{0, 20, 0}, {0, 60, 0}, {60, 0, 0}, {-20, 30, 20}};
  }
  // Allowed growth of the rotation error. The atoms of `sparse` relate the legs to the pelvis, and
  // a root that leans far is unlike any pelvis; on real takes the growth is smaller.
  double rotation_limit(Vec3 speed_deg_s) const {
    return GetParam() == "sparse" && speed_deg_s.y == 0 ? 1.08 : 1.02;
  }
  // Allowed growth of the error of the root position.
  double position_limit() const {
    for (const char* name : {"butterworth", "hampel", "kalman"})
      if (GetParam() == name) return 1.02;
    for (const char* name : {"nonlocal", "wiener"})
      if (GetParam() == name) return 1.15;
    return GetParam() == "weighted-mean" ? 1.45 : 1.1;
  }
};

// The take turns about an axis through itself, as a person does who walks in a circle. A circling
// position would be another motion: walking at 1.2 m/s and turning by 60 degrees per second gives
// an acceleration of 2.5 m/s^2, as much as each step. A window average cuts that curve, and
// strengths chosen by evidence follow it; over many seeds the error of `auto` changes by -5 to 9 %
// per motion, less and more alike.
TEST_P(OfAnyMethod, TheErrorDoesNotDependOnHowTheTakeTurns) {
  if (GetParam() == "sparse" || GetParam() == "example") KINEMEND_LONG_TEST();
  Squares still;
  std::vector<Take> truths = {about_its_middle(take_to_turn("walk", 3)),
                              about_its_middle(take_to_turn("wave", 2)),
                              about_its_middle(take_to_turn("run", 2))};
  std::vector<Take> inputs, results;
  for (const Take& truth : truths) {
    inputs.push_back(noisy(truth));
    results.push_back(cleaned(inputs.back()));
    still.add(truth, results.back());
  }
  for (const Vec3 speed : speeds()) {
    Squares error, difference;
    for (std::size_t i = 0; i < truths.size(); ++i) {
      const Take result = cleaned(turned(inputs[i], speed));
      error.add(turned(truths[i], speed), result);
      difference.add(turned(results[i], speed), result);
    }
    const std::string text = fmt::format("{} {} {} degrees a second", speed.x, speed.y, speed.z);
    EXPECT_LT(growth(error.rotations, still.rotations), rotation_limit(speed)) << text;
    if (!is_causal()) {
      EXPECT_LT(growth(error.positions, still.positions), position_limit()) << text;
    }
    if (has_fixed_weights()) {
      EXPECT_LT(growth(difference.rotations, still.rotations), 0.02) << text;
    }
    RecordProperty(text, fmt::format("error {:.3f} {:.3f}, difference {:.3f} {:.3f}",
                                     growth(error.rotations, still.rotations),
                                     growth(error.positions, still.positions),
                                     growth(difference.rotations, still.rotations),
                                     growth(difference.positions, still.positions)));
  }
}

TEST_P(OfAnyMethod, TheErrorDoesNotDependOnWhereTheTakeStands) {
  const Take truth = about_its_middle(take_to_turn("walk", 3)), input = noisy(truth);
  const Vec3 far{1e6, -2e5, 5e5};  // ten kilometres away
  const Take near_result = cleaned(input), far_result = cleaned(moved(input, far));
  Squares error, difference;
  error.add(truth, near_result);
  difference.add(moved(near_result, far), far_result);
  EXPECT_LT(growth(difference.positions, error.positions), 0.01);
  EXPECT_LT(growth(difference.rotations, error.rotations), 0.001);
}

TEST_P(OfAnyMethod, TheErrorDoesNotGrowWithTheLengthOfTheTake) {
  if (GetParam() == "sparse") KINEMEND_LONG_TEST();
  for (const char* motion : {"turn", "stroll"}) {
    const Take once = take_to_turn(motion, 10), often = take_to_turn(motion, 50);
    Squares error_once, error_often;
    error_once.add(once, cleaned(noisy(once)));
    error_often.add(often, cleaned(noisy(often)));
    const double frames =
        static_cast<double>(often.frame_count()) / static_cast<double>(once.frame_count());
    EXPECT_LT(growth(error_often.rotations / frames, error_once.rotations), 1.05) << motion;
    if (!is_causal()) {
      EXPECT_LT(growth(error_often.positions / frames, error_once.positions), 1.05) << motion;
    }
  }
}

// Methods that look ahead. Only `learned` supports markers among those with a model.
class OfAnyMethodForMarkers : public OfAnyMethod {};

TEST_P(OfAnyMethodForMarkers, TurnAndStandAnywhere) {
  const Take truth = joint_markers(about_its_middle(take_to_turn("walk", 3)));
  Take input = truth;
  Random random(9);
  for (Vec3& p : input.positions) p += test::random_vector(random, noise_cm);
  const auto clean = [&](const Take& clip) { return clean_take(clip, *cleaner_).take; };
  const auto map = [&](Take clip, Vec3 speed, Vec3 shift) {
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      for (std::size_t m = 0; m < clip.marker_count(); ++m) {
        clip.position(f, m) =
            turned(clip.position(f, m), speed, static_cast<double>(f) / rate_hz) + shift;
      }
    }
    return clip;
  };
  const auto squares = [](const Take& a, const Take& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.positions.size(); ++i) {
      const Vec3 d = a.positions[i] - b.positions[i];
      sum += dot(d, d);
    }
    return sum;
  };
  const Take result = clean(input);
  const double still = squares(truth, result);
  const Vec3 far{1e6, -2e5, 5e5};
  EXPECT_LT(growth(squares(map(result, {}, far), clean(map(input, {}, far))), still), 1e-4);
  const bool cuts_curves = GetParam() == "median" || GetParam() == "weighted-mean";
  for (const Vec3 speed : {Vec3{0, 20, 0}, Vec3{0, 60, 0}, Vec3{40, 0, 0}}) {
    const double error = squares(map(truth, speed, {}), clean(map(input, speed, {})));
    EXPECT_LT(growth(error, still), cuts_curves ? 1.15 : 1.06) << speed.x << " " << speed.y;
  }
}

std::vector<std::string> with_models_that_ship() {
  std::vector<std::string> names;
  for (const Method& method : methods()) {
#if defined(KINEMEND_SANITIZED)
    if (method.learned) continue;  // their products take minutes
#endif
    if (method.name != "kalman-learned") names.push_back(method.name);
  }
  return names;
}

std::vector<std::string> methods_for_markers_that_turn() {
  std::vector<std::string> names = test::other_method_names();
#if !defined(KINEMEND_SANITIZED)
  names.push_back("learned");
#endif
  return names;
}

INSTANTIATE_TEST_SUITE_P(Turning, OfAnyMethod, testing::ValuesIn(with_models_that_ship()),
                         test::test_name_of);
INSTANTIATE_TEST_SUITE_P(Turning, OfAnyMethodForMarkers,
                         testing::ValuesIn(methods_for_markers_that_turn()), test::test_name_of);

}  // namespace
}  // namespace kinemend::quality
