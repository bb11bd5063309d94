// Bodies of random shapes give finite channels or an error, and nothing else.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "body/body_takes.hpp"
#include "kinemend/error.hpp"

namespace kinemend {
namespace {

using namespace body_test;

constexpr std::array names{
    "Hips",       "Spine",   "Neck",     "Head",     "LeftArm",   "RightArm", "LeftUpLeg",
    "RightUpLeg", "LeftLeg", "RightLeg", "LeftFoot", "RightFoot", "",         "L",
    "::",         "Bip01",   "joint",    "LeftHand", "Chest",     "LFHD"};

std::size_t below(Random& random, std::size_t count) {
  return static_cast<std::size_t>(random.uniform() * static_cast<double>(count)) % count;
}

std::vector<std::uint8_t> some(Random& random, std::size_t count) {
  std::vector<std::uint8_t> marks;
  for (std::size_t i = 0; i < count; ++i) marks.push_back(below(random, 4) == 0 ? 0 : 1);
  return marks;
}

Take random_clip(Random& random) {
  Take clip;
  clip.frame_rate_hz = 60;
  const std::size_t joints = 1 + below(random, 16), frames = below(random, 20);
  for (std::size_t j = 0; j < joints; ++j) {
    const bool root = j == 0 || below(random, 15) == 0;
    const auto parent = root ? -1 : static_cast<std::int32_t>(below(random, j));
    const bool turns = below(random, 6) != 0;
    clip.skeleton.add_joint(
        names[below(random, names.size())], parent,
        below(random, 3) == 0 ? Vec3{} : normal_vector(random, 10),
        turns ? make_channels(j == 0, parse_rotation_order("ZXY")) : std::vector<Channel>{});
  }
  const auto size = static_cast<double>(below(random, 3));
  for (std::size_t f = 0; f < frames; ++f) clip.positions.push_back(normal_vector(random, size));
  for (std::size_t i = 0; i < frames * joints; ++i)
    clip.rotations.push_back(exp(normal_vector(random, size)));
  clip.observed = some(random, frames * joints);
  clip.observed_positions = some(random, frames);
  clip.validate();
  return clip;
}

Take random_markers(Random& random) {
  std::vector<std::string> markers(below(random, 12));
  for (std::string& name : markers) name = names[below(random, names.size())];
  Take clip = make_marker_take(markers, below(random, 20), 60);
  clip.observed = some(random, clip.positions.size());
  const auto size = static_cast<double>(below(random, 3));
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    if (clip.observed[i] != 0) clip.positions[i] = normal_vector(random, size);
  }
  clip.validate();
  return clip;
}

// Returns whether the second take matches the body learned from the first one.
bool survives(const Take& learned, Take clip) {
  try {
    const BodyLayout layout = layout_of(learned);
    const BodyMatch match = match_body(layout, clip);
    const BodyChannels channels = encode_body(clip, layout, match);
    for (const double v : channels.poses.values) EXPECT_TRUE(std::isfinite(v));
    decode_body(encode_body(clip, layout, match, channels), layout, match, clip);
    clip.validate();
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    return false;
  }
}

TEST(RandomBodies, GiveFiniteChannelsOrAnError) {
  Random random(11);
  int joints = 0, markers = 0;
  for (int i = 0; i < 300; ++i) {
    const Take clip = random_clip(random);
    joints += survives(clip, clip) + survives(clip, random_clip(random));
    const Take marker_clip = random_markers(random);
    markers += survives(marker_clip, marker_clip) + survives(marker_clip, random_markers(random));
  }
  EXPECT_GT(joints, 100);
  EXPECT_GT(markers, 50);
}

}  // namespace
}  // namespace kinemend
