// Tests of contacts with the floor, against the footfalls of the gait generator.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "feet/support.hpp"
#include "kinemend/error.hpp"

namespace kinemend {
namespace {

using test::joint_of;
using test::synthetic_clip;
using test::track_of;

constexpr std::array<const char*, 2> sides{"Left", "Right"};

// The point about which the synthetic heel turns: below and behind the ankle, on the floor (y = 0)
// while the foot is level.
std::vector<Vec3> true_heels(const Take& clip, std::size_t leg) {
  const std::string side = sides[leg];
  double ankle_height = 0, flattest = 2;
  std::vector<Pose> poses;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    poses.push_back(forward_kinematics(clip, f));
    const std::size_t foot = joint_of(clip, side + "Foot");
    const double height = poses[f].positions[foot].y;
    const double pitch = std::fabs(rotate(poses[f].rotations[foot], {0, 0, 1}).y);
    if (height > 12 || pitch >= flattest) continue;
    flattest = pitch;
    ankle_height = height;
  }
  std::vector<Vec3> heels;
  for (const Pose& pose : poses) {
    const std::size_t foot = joint_of(clip, side + "Foot");
    const Vec3 offset{0, -ankle_height, -0.035 * body_height(clip.skeleton)};
    heels.push_back(pose.positions[foot] + rotate(pose.rotations[foot], offset));
  }
  return heels;
}

// 1 in frames where the part stands: almost still and almost at its lowest height.
std::vector<std::uint8_t> truth(const Take& clip, std::size_t leg, FootPart part) {
  const std::vector<Vec3> track = part == FootPart::toe
                                      ? track_of(clip, std::string(sides[leg]) + "ToeBase")
                                      : true_heels(clip, leg);
  double lowest = track[0].y;
  for (const Vec3 p : track) lowest = std::min(lowest, p.y);
  std::vector<std::uint8_t> down(track.size());
  for (std::size_t f = 0; f < track.size(); ++f) {
    const std::size_t a = f == 0 ? 0 : f - 1, b = std::min(f + 1, track.size() - 1);
    const double speed =
        clip.frame_rate_hz * norm(track[b] - track[a]) / static_cast<double>(b - a);
    down[f] = speed < 3 && track[f].y < lowest + 0.5;
  }
  return down;
}

struct Score {
  double precision = 0, recall = 0;
};

// Counts found frames within `slack_s` of a true one, and true frames that were found.
Score score(const Take& clean, const std::vector<FootContact>& contacts, double slack_s = 0.035) {
  const auto slack = static_cast<std::ptrdiff_t>(std::ceil(slack_s * clean.frame_rate_hz));
  double found = 0, right = 0, there = 0, caught = 0;
  for (std::size_t leg = 0; leg < 2; ++leg) {
    for (const FootPart part : {FootPart::heel, FootPart::toe}) {
      const std::vector<std::uint8_t> down = truth(clean, leg, part);
      std::vector<std::uint8_t> said(down.size());
      for (const FootContact& c : contacts) {
        if (c.leg != leg || c.part != part) continue;
        for (std::size_t f = c.first_frame; f <= c.last_frame; ++f) said[f] = 1;
      }
      for (std::size_t f = 0; f < down.size(); ++f) {
        const auto first = std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(f) - slack);
        const auto last = std::min(static_cast<std::ptrdiff_t>(down.size()) - 1,
                                   static_cast<std::ptrdiff_t>(f) + slack);
        const bool near = std::any_of(down.begin() + first, down.begin() + last + 1,
                                      [](std::uint8_t d) { return d != 0; });
        found += said[f], right += said[f] && near;
        there += down[f], caught += down[f] && said[f];
      }
    }
  }
  return {right / std::max(found, 1.0), caught / std::max(there, 1.0)};
}

TEST(FindContacts, AgreesWithTheWalkersOwnFootfalls) {
  for (const double rate : {24.0, 30.0, 60.0, 120.0, 240.0}) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      const Take clip = synthetic_clip("walk", 8, rate, seed);
      const Score found = score(clip, find_contacts(clip));
      EXPECT_GT(found.precision, 0.95) << rate << " Hz, seed " << seed;
      EXPECT_GT(found.recall, 0.85) << rate << " Hz, seed " << seed;
    }
  }
}

TEST(FindContacts, SeesThroughADegreeOfJitter) {
  for (const double rate : {60.0, 120.0}) {
    const Take clip = synthetic_clip("walk", 8, rate);
    const Score found = score(clip, find_contacts(test::with_noise(clip, 1.0)), 0.07);
    EXPECT_GT(found.precision, 0.95) << rate << " Hz";
    EXPECT_GT(found.recall, 0.6) << rate << " Hz";
  }
}

TEST(FindContacts, SeesTheStandsOfARunnerThroughWhatAFilterLeaves) {
  ContactSettings thresholds;
  thresholds.finder = ContactFinder::thresholds;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Take clip = synthetic_clip("run", 6, 120, seed);
    const Score clean = score(clip, find_contacts(clip), 0.07);
    EXPECT_GT(clean.precision, 0.95) << "seed " << seed;
    const Take noisy = test::with_smooth_noise(clip, 1.0, seed);
    const Score found = score(clip, find_contacts(noisy, thresholds), 0.07);
    EXPECT_GT(found.precision, 0.9) << "seed " << seed;
    EXPECT_GT(found.recall, 0.6) << "seed " << seed;
  }
}

TEST(FindContacts, KnowsNeitherAxesNorUnitsNorTheFloorsHeight) {
  const Take clip = synthetic_clip("walk", 6);
  const std::vector<FootContact> plain = find_contacts(clip);
  const Quat upright = exp({pi / 2, 0, 0});  // y up to z up
  EXPECT_EQ(find_contacts(test::moved(clip, upright, {10, -20, 333})), plain);
  EXPECT_EQ(find_contacts(test::moved(clip, Quat{}, {0, -5, 0}, 0.01)), plain);
  EXPECT_EQ(find_contacts(test::moved(clip, exp({0, 0.7, 0}), {}, 12.3)), plain);
}

TEST(FindContacts, LeavesTheFloorWithTheFeet) {
  const Take clip = synthetic_clip("jump", 6);
  const std::vector<Vec3> toes = track_of(clip, "LeftToeBase");
  double lowest = 1e9;
  for (const Vec3 p : toes) lowest = std::min(lowest, p.y);
  std::size_t standing = 0;
  for (const FootContact& c : find_contacts(clip)) {
    for (std::size_t f = c.first_frame; f <= c.last_frame; ++f)
      EXPECT_LT(toes[f].y, lowest + 5) << "frame " << f;
    standing += c.last_frame - c.first_frame + 1;
  }
  EXPECT_GT(standing, clip.frame_count());
}

TEST(FindContacts, StandsOnABoxToo) {
  const Take clip = synthetic_clip("landing", 4);
  const std::vector<Vec3> toes = track_of(clip, "LeftToeBase");
  bool high = false, low = false;
  for (const FootContact& c : find_contacts(clip)) {
    high = high || toes[c.first_frame].y > 30;
    low = low || toes[c.first_frame].y < 10;
  }
  EXPECT_TRUE(high);
  EXPECT_TRUE(low);
}

TEST(FindContacts, HoldsAStandingBodyThroughout) {
  const Take clip = synthetic_clip("still", 5);
  const std::vector<FootContact> contacts = find_contacts(clip);
  ASSERT_EQ(contacts.size(), 4u);
  for (const FootContact& c : contacts)
    EXPECT_GT(c.last_frame - c.first_frame + 1, clip.frame_count() * 9 / 10);
}

TEST(FindContacts, CountsFromTheFirstFrameOfTheTake) {
  const std::vector<FootContact> plain = find_contacts(synthetic_clip("walk", 6));
  std::vector<FootContact> later =
      find_contacts(synthetic_clip("walk", 6, 120, 1, true));  // a T-pose first
  for (FootContact& c : later) --c.first_frame, --c.last_frame;
  EXPECT_EQ(later, plain);
}

TEST(FindContacts, FindsNoneWithoutFeetFramesOrUp) {
  EXPECT_TRUE(find_contacts(synthetic_clip("spin", 2)).empty());
  Take clip = synthetic_clip("walk", 1);
  EXPECT_TRUE(find_contacts(slice(clip, 0, 1)).empty());
  const Quat lying = exp({pi / 4, 0, 0});
  EXPECT_TRUE(find_contacts(test::moved(clip, lying, {})).empty());
  ContactSettings settings;
  settings.begin_height = 0.05;
  EXPECT_THROW(find_contacts(clip, settings), Error);
}

}  // namespace
}  // namespace kinemend
