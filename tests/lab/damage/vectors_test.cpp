// Tests of damages on markers and vectors, without a skeleton.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "lab/damage/damage_support.hpp"

namespace kinemend {
namespace {

using test::moving_humanoid;

// The positions of the joints as markers, some missing, and one track that is not a position.
Take markers(std::size_t frames = 400) {
  const Take clip = moving_humanoid(frames);
  const std::size_t joints = clip.joint_count();
  std::vector<std::string> names = clip.skeleton.names;
  names.emplace_back("LKneeAngles");
  Take result = make_marker_take(names, frames, clip.frame_rate_hz);
  const std::vector<Vec3> positions = joint_positions(clip);
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t m = 0; m < joints; ++m) {
      if (m == 3 && f >= 50 && f < 90) continue;
      result.position(f, m) = positions[f * joints + m];
      result.observed[f * names.size() + m] = 1;
    }
    result.position(f, joints) = {1, 2, static_cast<double>(f)};
    result.observed[f * names.size() + joints] = 1;
  }
  result.is_position.assign(names.size(), 1);
  result.is_position[joints] = 0;
  result.unit = "cm";
  return result;
}

using test::damaged;

// All joints of a clip as rotation vectors in degrees.
VectorMotion rotation_vectors(const Take& clip) {
  VectorMotion motion;
  motion.values = PoseMatrix(clip.frame_count(), 3 * clip.joint_count());
  for (std::size_t i = 0; i < clip.rotations.size(); ++i) {
    const Vec3 v = degrees_per_radian * log(clip.rotations[i]);
    motion.values.values[3 * i] = v.x;
    motion.values.values[3 * i + 1] = v.y;
    motion.values.values[3 * i + 2] = v.z;
  }
  motion.observed.assign(clip.rotations.size(), 1);
  motion.frame_rate_hz = clip.frame_rate_hz;
  motion.names = clip.skeleton.names;
  motion.is_rotation.assign(clip.joint_count(), 1);
  for (const std::int32_t parent : clip.skeleton.parents) motion.is_root.push_back(parent < 0);
  motion.per_radian = degrees_per_radian;
  return motion;
}

Quat rotation_of(const VectorMotion& motion, std::size_t sample) {
  const double* v = &motion.values.values[3 * sample];
  return exp(radians_per_degree * Vec3{v[0], v[1], v[2]});
}

class DamageOfVectors : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Table, DamageOfVectors, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const Damage& damage : damages()) {
                             if (damage.apply_to_vectors != nullptr) names.push_back(damage.name);
                           }
                           return names;
                         }()),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

TEST_P(DamageOfVectors, GivesMarkersTheSameForTheSameSeedAndOthersForAnother) {
  const Take clean = markers();
  const Take first = damaged(clean, GetParam(), {}, 7).clip;
  const Take again = damaged(clean, GetParam(), {}, 7).clip;
  EXPECT_EQ(first.positions, again.positions);
  EXPECT_EQ(first.observed, again.observed);
  EXPECT_NE(first.positions, clean.positions);
  if (GetParam() == "held" || GetParam() == "upsampled") return;  // these damages are deterministic
  EXPECT_NE(first.positions, damaged(clean, GetParam(), {}, 8).clip.positions);
}

TEST_P(DamageOfVectors, LeavesWhatIsMissingAndWhatIsNoPositionAlone) {
  const Take clean = markers();
  const auto [clip, report] = damaged(clean, GetParam());
  clip.validate();
  std::size_t samples = 0, changed = 0;
  double square = 0, largest = 0, distances = 0;
  const double radius = body_height(clean) / 4;
  for (std::size_t f = 0; f < clean.frame_count(); ++f) {
    for (std::size_t m = 0; m < clean.marker_count(); ++m) {
      const bool moves = clean.holds_positions(m) && clean.is_observed(f, m);
      if (!moves) {
        EXPECT_EQ(clip.position(f, m), clean.position(f, m));
        EXPECT_EQ(clip.is_observed(f, m), clean.is_observed(f, m));
        continue;
      }
      ++samples;
      changed += !clip.is_observed(f, m) || !(clip.position(f, m) == clean.position(f, m));
      if (!clip.is_observed(f, m)) continue;
      const double distance = norm(clip.position(f, m) - clean.position(f, m));
      distances += distance * distance;
      const double angle = distance / radius * degrees_per_radian;
      square += angle * angle;
      largest = std::max(largest, angle);
    }
  }
  EXPECT_EQ(report.samples, samples);
  EXPECT_EQ(report.samples_damaged, changed);
  EXPECT_GT(changed, 0u);
  const bool loses = GetParam() == "gaps" || GetParam() == "long-gap";
  if (loses) return;  // the report includes the values in gaps; the sums here do not
  EXPECT_NEAR(report.rms_deg, std::sqrt(square / samples), 1e-9 * report.max_deg);
  EXPECT_NEAR(report.max_deg, largest, 1e-9 * largest);
  EXPECT_NEAR(report.rms_position, std::sqrt(distances / samples), 1e-9 * report.max_deg);
}

TEST_P(DamageOfVectors, TouchesNamedTracksOnlyAndGivesThemTheSameAsAmongOthers) {
  if (GetParam() == "long-gap") GTEST_SKIP() << "places its gaps among those that may have one";
  const Take clean = markers();
  const Take all = damaged(clean, GetParam()).clip;
  const Take some = damaged(clean, GetParam(), {{"joints", std::string("Left*")}}).clip;
  for (std::size_t f = 0; f < clean.frame_count(); ++f) {
    for (std::size_t m = 0; m < clean.marker_count(); ++m) {
      const bool meant = clean.names[m].starts_with("Left");
      if (!meant) {
        EXPECT_EQ(some.position(f, m), clean.position(f, m)) << clean.names[m];
      } else if (GetParam() != "snr") {  // its power depends on the named tracks
        EXPECT_EQ(some.position(f, m), all.position(f, m)) << clean.names[m];
      }
    }
  }
}

// Rotation vectors are damaged as rotations: with the same seed, a clip and its vectors stay equal.
TEST(DamageOfRotationVectors, IsThatOfTheRotations) {
  Take clip = moving_humanoid(300);
  for (auto& channels : clip.skeleton.channels) channels.clear();  // no restrictions
  const OptionValues with_root = {{"root", true}};
  const std::vector<std::pair<std::string, OptionValues>> cases = {
      {"gaussian", {}}, {"uniform", {}},       {"ar1", {}},
      {"bias", {}},     {"sinusoid", {}},      {"outliers", {{"share", 0.2}, {"std_deg", 90.0}}},
      {"impulse", {}},  {"frozen", with_root}, {"gaps", with_root}};
  for (const auto& [name, values] : cases) {
    const Take expected = test::damaged(clip, name, values, 5).clip;
    VectorMotion motion = rotation_vectors(clip);
    Random random(5);
    apply_damage(motion, name, values, random);
    for (std::size_t i = 0; i < clip.rotations.size(); ++i) {
      ASSERT_LT(angle_between(rotation_of(motion, i), expected.rotations[i]), 1e-7)
          << name << " " << i;
      const bool seen = expected.observed.empty() || expected.observed[i] != 0;
      ASSERT_EQ(motion.observed[i] != 0, seen) << name;
    }
  }
}

TEST(DamageOfRotationVectors, StaysWithVectorsBeyondAHalfTurn) {
  VectorMotion motion = rotation_vectors(moving_humanoid(200));
  for (std::size_t f = 0; f < 200; ++f) motion.values(f, 0) = 200 + 0.5 * static_cast<double>(f);
  for (std::size_t f = 0; f < 200; ++f) motion.values(f, 1) = motion.values(f, 2) = 0;
  const PoseMatrix before = motion.values;
  Random random(1);
  apply_damage(motion, "gaussian", {{"std_deg", 1.0}}, random);
  for (std::size_t f = 0; f < 200; ++f) EXPECT_NEAR(motion.values(f, 0), before(f, 0), 6);
}

TEST(DamageOfMarkers, HasTheSizeThatIsAskedFor) {
  const Take clean = markers(2000);
  const double radius = body_height(clean) / 4;
  const auto deviation = [&](const Take& clip) {
    std::vector<double> differences;
    for (std::size_t f = 0; f < clean.frame_count(); ++f) {
      const Vec3 d = clip.position(f, 5) - clean.position(f, 5);
      differences.insert(differences.end(), {d.x, d.y, d.z});
    }
    return test::deviation_of(differences);
  };
  // 6,000 draws have a deviation of 1 %.
  EXPECT_NEAR(deviation(damaged(clean, "gaussian", {{"std_deg", 2.0}}).clip),
              2 * radians_per_degree * radius, 0.04 * 2 * radians_per_degree * radius);
  EXPECT_NEAR(deviation(damaged(clean, "position-noise", {{"std_cm", 0.5}}).clip), 0.5, 0.02);
  Take in_mm = clean;
  in_mm.unit = "mm";
  EXPECT_NEAR(deviation(damaged(in_mm, "position-noise", {{"std_cm", 0.5}}).clip), 5, 0.2);
}

TEST(DamageOfMarkers, HasTheSignalToNoiseRatioThatIsAskedFor) {
  const Take clean = markers();
  const Take noisy = damaged(clean, "snr", {{"snr_db", 10.0}}).clip;
  double signal = 0, noise = 0;
  for (std::size_t f = 0; f < clean.frame_count(); ++f) {
    Vec3 mean;
    double count = 0;
    for (std::size_t m = 0; m + 1 < clean.marker_count(); ++m) {
      if (!clean.is_observed(f, m)) continue;
      mean += clean.position(f, m);
      ++count;
    }
    for (std::size_t m = 0; m + 1 < clean.marker_count(); ++m) {
      if (!clean.is_observed(f, m)) continue;
      const Vec3 p = clean.position(f, m) - (1 / count) * mean;
      const Vec3 d = noisy.position(f, m) - clean.position(f, m);
      signal += dot(p, p);
      noise += dot(d, d);
    }
  }
  EXPECT_NEAR(10 * std::log10(signal / noise), 10, 0.2);
}

TEST(DamageOfMarkers, LosesThemInGapsAndHoldsWhatWasLastSeenWhereFrozen) {
  const Take clean = markers();
  const Take lost =
      damaged(clean, "gaps", {{"start_probability", 0.05}, {"mean_length_s", 0.1}}).clip;
  std::size_t missing = 0;
  for (std::size_t i = 0; i < clean.observed.size(); ++i) {
    if (clean.observed[i] == 0 || lost.observed[i] != 0) continue;
    ++missing;
    EXPECT_EQ(lost.positions[i], Vec3{});
  }
  EXPECT_GT(missing, clean.observed.size() / 10);
  const Take frozen = damaged(clean, "frozen", {{"share", 0.5}}).clip;
  EXPECT_EQ(frozen.observed, clean.observed);
  for (std::size_t f = 0; f < clean.frame_count(); ++f) {
    if (frozen.is_observed(f, 3)) {
      EXPECT_GT(norm(frozen.position(f, 3)), 1) << f;
    }
  }
}

TEST(DamageOfMarkers, RefusesWhatNeedsASkeletonAndNamesThatAreNotThere) {
  const Take clean = markers();
  for (const Damage& damage : damages()) {
    if (damage.apply_to_vectors != nullptr) continue;
    EXPECT_EQ(damage.name, "gaussian-log");
    EXPECT_THROW(damaged(clean, damage.name), Error);
  }
  EXPECT_THROW(damaged(clean, "gaussian", {{"joints", std::string("Tail*")}}), Error);
  EXPECT_THROW(damaged(clean, "gausian"), Error);
}

}  // namespace
}  // namespace kinemend
