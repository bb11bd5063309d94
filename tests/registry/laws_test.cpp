// Properties of every method in the table, with its default options.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinemend/clean.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/methods.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

class Every : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Cleaner> cleaner_ = make_cleaner(GetParam());

  Take cleaned(const Take& clip, const CleanSettings& settings = {}) const {
    return clean_take(clip, *cleaner_, settings).take;
  }
};

// Separate tests for methods that look ahead and for causal ones, which lag behind.
class EveryAhead : public Every {};
class EveryCausal : public Every {};

Take noisy_take() {
  Take clip = moving_take(240, 120);
  add_noise(clip, 1.5, 0.5, 1);
  return clip;
}

void expect_same(const Take& a, const Take& b) {
  EXPECT_EQ(a.rotations, b.rotations);
  EXPECT_EQ(a.positions, b.positions);
}

TEST_P(Every, GivesAValidClipOfTheSameShape) {
  const Take input = noisy_take();
  const Take output = cleaned(input);
  EXPECT_NO_THROW(output.validate());
  EXPECT_EQ(output.frame_count(), input.frame_count());
  EXPECT_EQ(output.frame_rate_hz, input.frame_rate_hz);
  EXPECT_EQ(output.skeleton.names, input.skeleton.names);
  EXPECT_EQ(output.observed, input.observed);
}

TEST_P(Every, KeepsATPoseAtTheStartOutOfTheMotion) {
  const Take motion = noisy_take();
  Take input = empty_take(1 + motion.frame_count(), 120);
  std::copy(motion.rotations.begin(), motion.rotations.end(),
            input.rotations.begin() + static_cast<std::ptrdiff_t>(input.joint_count()));
  std::copy(motion.positions.begin(), motion.positions.end(),
            input.positions.begin() + static_cast<std::ptrdiff_t>(input.point_count()));
  ASSERT_EQ(leading_calibration_frames(input), 1U);
  const Take output = cleaned(input);
  expect_same(slice(output, 0, 1), slice(input, 0, 1));
  expect_same(slice(output, 1, output.frame_count()), cleaned(motion));
}

TEST_P(Every, DoesNotMindTheSignOfQuaternions) {
  const Take input = noisy_take();
  Take flipped = input;
  Random random(2);
  for (Quat& q : flipped.rotations) {
    if (random.chance(0.5)) q = -q;
  }
  EXPECT_LT(max_angle_deg(cleaned(input), cleaned(flipped)), 1e-7);
}

// The lag is the shift d that best explains out(t) - truth(t) = -d v(t), in frames.
double lag_frames(const Take& truth, const Take& output) {
  double above = 0, below = 0;
  for (std::size_t f = 1; f + 1 < truth.frame_count(); ++f) {
    for (std::size_t j = 0; j < truth.joint_count(); ++j) {
      const Quat q = truth.rotation(f, j);
      const Vec3 velocity =
          0.5 * log(conjugate(truth.rotation(f - 1, j)) * truth.rotation(f + 1, j));
      above -= dot(log(conjugate(q) * output.rotation(f, j)), velocity);
      below += dot(velocity, velocity);
    }
  }
  return above / below;
}

TEST_P(EveryAhead, DoesNotShiftTheMotionInTime) {
  const Take truth = moving_take(240, 120);
  EXPECT_NEAR(lag_frames(truth, cleaned(noisy_take())), 0, 0.1);
}

TEST_P(EveryCausal, LagsByHalfAFrame) {
  const Take truth = moving_take(240, 120);
  EXPECT_NEAR(lag_frames(truth, cleaned(noisy_take())), 0.52, 0.25);
}

TEST_P(Every, LeavesAConstantTakeByteForByte) {
  Take clip = empty_take(100, 120);
  for (std::size_t f = 0; f < 100; ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j) clip.rotation(f, j) = motion_at(j, 0.37);
  }
  expect_same(cleaned(clip), clip);
}

TEST_P(Every, LeavesJointsThatWereNotAskedForByteForByte) {
  const Take input = noisy_take();
  CleanSettings settings;
  settings.joints = {"Spine"};
  const Take output = cleaned(input, settings);
  for (std::size_t f = 0; f < input.frame_count(); ++f) {
    for (std::size_t j = 0; j < input.joint_count(); ++j) {
      if (j == 1) continue;
      ASSERT_EQ(output.rotation(f, j), input.rotation(f, j)) << f << " " << j;
    }
  }
  EXPECT_EQ(output.positions, input.positions);
}

TEST_P(Every, LeavesWhatIsNotSelectedAloneAlsoWithoutThePipeline) {
  const Take input = noisy_take();
  Take output = input;
  Selection selection;
  selection.owners = {0, 1, 0, 1, 0, 0, 0};
  selection.root_position = false;
  clean_in_place(*cleaner_, output, selection);
  for (std::size_t f = 0; f < input.frame_count(); ++f) {
    for (const std::size_t j : {0, 2, 4, 5, 6}) {
      ASSERT_EQ(output.rotation(f, j), input.rotation(f, j)) << f << " " << j;
    }
  }
  EXPECT_EQ(output.positions, input.positions);
}

TEST_P(EveryAhead, KeepsASteadyTurnUpToBothEnds) {
  Take clip = empty_take(150, 120);
  for (std::size_t f = 0; f < 150; ++f) {
    const double t = static_cast<double>(f) / 120;
    clip.root_position(f) = {100 * t, 90, -30 * t};
    clip.rotation(f, 0) = exp((t - 0.6) * Vec3{0.5, 1.5, 0.2});
    clip.rotation(f, 1) = exp({0.3, -0.2, 0.9}) * exp(t * Vec3{-0.7, 0.2, 0.1});
    clip.rotation(f, 3) = from_euler({1.1 * t, 0, 0}, parse_rotation_order("X"));
  }
  const Take output = cleaned(clip);
  EXPECT_LT(max_angle_deg(output, clip), 0.05);
  for (std::size_t f = 0; f < 150; ++f) {
    ASSERT_LT(norm(output.root_position(f) - clip.root_position(f)), 0.05) << f;
  }
}

TEST_P(Every, TakesAnyNumberOfFrames) {
  // Measured: at most 5.5 degrees, but 12 for `butterworth` in two frames.
  const double bound = GetParam() == "butterworth" ? 14 : 7;
  for (const std::size_t frames : {0, 1, 2, 3, 4, 7}) {
    Take clip = moving_take(frames, 120);
    add_noise(clip, 1.5, 0.5, frames);
    const Take output = cleaned(clip);
    EXPECT_EQ(output.frame_count(), frames);
    EXPECT_NO_THROW(output.validate());
    EXPECT_LT(max_angle_deg(output, clip), bound) << frames;
  }
}

TEST_P(Every, GivesTheSameOnAnyNumberOfThreads) {
  Take clip = moving_take(1500, 120);  // enough frames to spread the work
  add_noise(clip, 1.5, 0.5, 3);
  const auto on_threads = [&](std::size_t count) {
    const ThreadLimit control(count);
    return cleaned(clip);
  };
  expect_same(on_threads(1), on_threads(4));
}

TEST_P(Every, OfStrengthZeroIsTheIdentity) {
  const Take input = noisy_take();
  CleanSettings settings;
  settings.strength = 0;
  expect_same(cleaned(input, settings), input);
}

TEST_P(Every, RespectsTheLargestChange) {
  Take input = noisy_take();
  input.rotation(100, 2) = input.rotation(100, 2) * exp({1, 0, 0});
  CleanSettings settings;
  settings.max_change_deg = 0.5;
  const Take output = cleaned(input, settings);
  EXPECT_LT(max_angle_deg(output, input), 0.5 + 1e-9);
  EXPECT_GT(max_angle_deg(output, input), 0.4);
}

TEST_P(Every, TakesNoNoticeOfWhatStandsInAGap) {
  Take zeros = noisy_take();
  zeros.observed.assign(zeros.rotations.size(), 1);
  for (std::size_t f = 100; f < 112; ++f) {
    zeros.observed[f * zeros.joint_count() + 2] = 0;
    zeros.rotation(f, 2) = {};
  }
  Take other = zeros;
  for (std::size_t f = 100; f < 112; ++f) other.rotation(f, 2) = exp({2, 1, 0.3});
  const Take a = cleaned(zeros), b = cleaned(other);
  for (std::size_t f = 0; f < a.frame_count(); ++f) {
    ASSERT_LT(angle_between(a.rotation(f, 2), b.rotation(f, 2)), 1e-9) << f;
  }
}

TEST_P(EveryAhead, GoesStraightThroughAGap) {
  const Take truth = moving_take(240, 120);
  Take clip = noisy_take();
  clip.observed.assign(clip.rotations.size(), 1);
  for (std::size_t f = 100; f < 112; ++f) {
    clip.observed[f * clip.joint_count() + 2] = 0;
    clip.rotation(f, 2) = {};
  }
  const Take result = cleaned(clip);
  // The chord over a tenth of a second of this motion is within 8 degrees of it. Measured: 9.2 for
  // `nonlocal`, at most 5.3 for the others.
  const double bound = GetParam() == "nonlocal" ? 10.5 : 6.5;
  for (std::size_t f = 0; f < truth.frame_count(); ++f) {
    ASSERT_LT(angle_between(result.rotation(f, 2), truth.rotation(f, 2)) * degrees_per_radian,
              bound)
        << f;
  }
}

// Causal methods are excluded, because their delays add up.
TEST_P(EveryAhead, ChangesLittleWhenRunAgain) {
  const Take input = noisy_take();
  const Take once = cleaned(input), twice = cleaned(once);
  EXPECT_LE(rms_angle_deg(once, twice), 0.25 * rms_angle_deg(input, once) + 1e-9);  // 0.18
}

TEST_P(Every, BeatsItsDamagedInputOnAWalk) {
  SynthOptions options;
  options.duration_s = 3;
  const Take truth = synthesize(options);
  Take damaged = truth;
  Random random(7);
  // Each method cleans the damage it is made for.
  double margin = GetParam() == "one-euro" ? 0.65 : 0.45;  // measured: 0.59, and 0.40 at most
  if (GetParam() == "hampel") {
    apply_damage(damaged, "outliers", {{"share", 0.01}, {"std_deg", 25.0}}, random);
    margin = 0.15;  // measured: 0.09
  } else {
    apply_damage(damaged, "gaussian", {{"std_deg", 1.5}}, random);
  }
  const double before = rms_angle_deg(truth, damaged);
  const double after = rms_angle_deg(truth, cleaned(damaged));
  EXPECT_LT(after, margin * before) << "before " << before << " degrees";
  RecordProperty("after_over_before", std::to_string(after / before));
}

std::vector<std::string> timed_method_names() {
  std::vector<std::string> names = other_method_names();
  std::erase_if(names, [](const std::string& name) {
    const std::vector<OptionSpec>& options = find_method(name).options;
    return std::none_of(options.begin(), options.end(), [](const OptionSpec& spec) {
      return spec.unit == "s" || spec.unit == "Hz";
    });
  });
  return names;
}

// Methods with options in seconds and hertz do the same to the same motion at every rate.
class EveryTimed : public Every {};

TEST_P(EveryTimed, GoesBySecondsNotByFrames) {
  const auto shaking = [](double rate_hz) {
    Take clip = moving_take(static_cast<std::size_t>(2 * rate_hz), rate_hz);
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      const double t = static_cast<double>(f) / rate_hz;
      clip.rotation(f, 2) = clip.rotation(f, 2) * exp({0.03 * std::sin(2 * pi * 13 * t), 0, 0});
    }
    return clip;
  };
  const Take fast = cleaned(shaking(120)), slow = cleaned(shaking(60));
  Take mislabelled = shaking(60);
  mislabelled.frame_rate_hz = 120;
  mislabelled = cleaned(mislabelled);
  double right = 0, wrong = 0;
  for (std::size_t f = 0; f < slow.frame_count(); ++f) {
    right += std::pow(angle_between(slow.rotation(f, 2), fast.rotation(2 * f, 2)), 2);
    wrong += std::pow(angle_between(mislabelled.rotation(f, 2), fast.rotation(2 * f, 2)), 2);
  }
  const auto frames = static_cast<double>(slow.frame_count());
  EXPECT_LT(std::sqrt(right / frames) * degrees_per_radian, 0.3);  // measured: 0.21
  EXPECT_LE(right, wrong);
}

INSTANTIATE_TEST_SUITE_P(Methods, Every, testing::ValuesIn(method_names()), test_name_of);
INSTANTIATE_TEST_SUITE_P(Methods, EveryAhead, testing::ValuesIn(other_method_names()),
                         test_name_of);
INSTANTIATE_TEST_SUITE_P(Methods, EveryCausal, testing::ValuesIn(causal_method_names()),
                         test_name_of);
INSTANTIATE_TEST_SUITE_P(Methods, EveryTimed, testing::ValuesIn(timed_method_names()),
                         test_name_of);

}  // namespace
}  // namespace kinemend::test
