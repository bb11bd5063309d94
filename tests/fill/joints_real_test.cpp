// Gaps made in real takes are filled, and the errors of the methods are compared.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "kinemend/extend/random.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/io.hpp"
#include "kinemend/take.hpp"

namespace kinemend {
namespace {

Take motion_of(const std::string& take) {
  const auto path = std::filesystem::path(KINEMEND_DATA_FOLDER) / "cmu/bvh" / (take + ".bvh");
  const Take clip = read_joints(path).take;
  return slice(clip, leading_calibration_frames(clip), clip.frame_count());
}

std::vector<std::size_t> moving_joints(const Take& clip) {
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    double farthest = 0;
    for (std::size_t f = 0; f < clip.frame_count(); f += 10)
      farthest = std::max(farthest, angle_between(clip.rotation(0, j), clip.rotation(f, j)));
    if (farthest > 0.05) joints.push_back(j);
  }
  return joints;
}

// Makes three gaps in each of five joints; returns an empty take if the take is too short.
Take damaged(const Take& clip, double gap_s, std::uint64_t seed) {
  const auto length = static_cast<std::size_t>(std::lround(gap_s * clip.frame_rate_hz));
  if (clip.frame_count() < length + 12) return {};
  Random random(seed);
  const std::vector<std::size_t> joints = moving_joints(clip);
  std::vector<NamedGap> gaps;
  for (int k = 0; k < 5; ++k) {
    const std::string& name = clip.skeleton.names[joints[random.below(joints.size())]];
    for (int g = 0; g < 3; ++g) {
      const std::size_t first = 5 + random.below(clip.frame_count() - length - 10);
      gaps.push_back({name, first, first + length - 1});
    }
  }
  Take result = clip;
  mark_gaps(result, gaps);
  for (std::size_t i = 0; i < result.observed.size(); ++i) {
    if (!result.observed[i]) result.rotations[i] = Quat{};
  }
  return result;
}

double mean_error_deg(const Take& truth, const Take& holed, const std::string& method) {
  Take clip = holed;
  FillSettings settings;
  settings.method = method;
  settings.fill_all = true;
  fill_gaps(clip, settings);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < holed.observed.size(); ++i) {
    if (holed.observed[i]) continue;
    sum += angle_between(clip.rotations[i], truth.rotations[i]) * degrees_per_radian;
    count += 1;
  }
  return sum / count;
}

// Mean geodesic errors by method, over takes and seeds.
std::map<std::string, double> errors_of(double gap_s) {
  std::map<std::string, double> sums;
  double count = 0;
  for (const char* take : {"35_01", "02_05", "09_03"}) {
    const Take truth = motion_of(take);
    for (const std::uint64_t seed : {100u, 101u, 102u, 103u}) {
      const Take holed = damaged(truth, gap_s, seed);
      if (holed.frame_count() == 0) continue;
      count += 1;
      for (const FillMethod& method : fill_methods()) {
        const std::string name(method.name);
        if (method.joints && !method.learned) sums[name] += mean_error_deg(truth, holed, name);
      }
    }
  }
  for (auto& [name, sum] : sums) {
    sum /= count;
    testing::Test::RecordProperty(name, std::to_string(sum));
  }
  return sums;
}

void expect_auto_is_best(double gap_s, double largest_error_deg) {
  const std::map<std::string, double> errors = errors_of(gap_s);
  for (const auto& [name, error] : errors)
    EXPECT_LE(errors.at("auto"), 1.05 * error) << "beside " << name;
  EXPECT_LT(errors.at("auto"), largest_error_deg);
}

TEST(FillJointsOfRealTakes, AutoIsAsGoodAsTheBestMethodForGapsOfATenthOfASecond) {
  expect_auto_is_best(0.1, 1.3);
}

TEST(FillJointsOfRealTakes, AutoIsAsGoodAsTheBestMethodForGapsOfAQuarterOfASecond) {
  expect_auto_is_best(0.25, 3.3);
}

TEST(FillJointsOfRealTakes, AutoIsAsGoodAsTheBestMethodForGapsOfASecond) {
  expect_auto_is_best(1.0, 7.5);
}

}  // namespace
}  // namespace kinemend
