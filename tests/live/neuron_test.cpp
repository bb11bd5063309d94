// Tests of the BVH broadcast of Axis Neuron: its lines, with and without displacement, and avatars.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <iterator>
#include <sstream>

#include "kinemend/extend/sessions.hpp"
#include "kinemend/methods.hpp"
#include "live/live_lines.hpp"

namespace kinemend::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string neuron_line(std::size_t values, double first, const std::string& before = "0 Char00") {
  std::string line = before;
  for (std::size_t i = 0; i < values; ++i)
    line += fmt::format(" {:.2f}", first + 0.1 * static_cast<double>(i % 50));
  return line + " ||";
}

struct NeuronRelay {
  explicit NeuronRelay(const std::string& skeleton = {}) : cleaner(make_cleaner("one-euro")) {
    LiveOptions options;
    options.neuron = true;
    options.strength = 0;
    options.skeleton = skeleton;
    session = std::make_unique<LiveSession>(*cleaner, options, [this](const LivePiece& piece) {
      if (piece.is_header) headers.emplace_back(piece.text);
      if (!piece.is_header) frames.emplace_back(piece.text);
    });
  }
  std::unique_ptr<Cleaner> cleaner;
  std::unique_ptr<LiveSession> session;
  std::vector<std::string> headers, frames;
};

std::vector<double> numbers_of(const std::string& line) {
  std::istringstream words(line);
  return {std::istream_iterator<double>(words), {}};
}

TEST(NeuronLines, HaveTheSkeletonOfFiftyNineJoints) {
  for (const bool displaced : {false, true}) {
    const Skeleton skeleton = read_live_header(neuron_skeleton(displaced), "neuron", 0).skeleton;
    EXPECT_EQ(skeleton.joint_count(), 59);
    for (std::size_t j = 1; j < 59; ++j) EXPECT_EQ(skeleton.channels[j].size(), displaced ? 6 : 3);
    EXPECT_EQ(skeleton.names[7], "Spine");
    EXPECT_EQ(skeleton.names[13], "RightShoulder");
    EXPECT_EQ(skeleton.names[17], "RightHandThumb1");
    EXPECT_EQ(skeleton.names[20], "RightInHandIndex");
    EXPECT_EQ(skeleton.names[36], "LeftShoulder");
    EXPECT_EQ(skeleton.names[58], "LeftHandPinky3");
    EXPECT_NEAR(body_height(skeleton), 175, 15);
  }
}

TEST(NeuronLines, BecomeFramesWithoutAHeader) {
  for (const std::size_t values : {std::size_t{180}, std::size_t{354}}) {
    NeuronRelay relay;
    // Lines arrive several at once and cut at any byte.
    const std::string text =
        neuron_line(values, 1) + "\r\n" + neuron_line(values, 2) + neuron_line(values, 3);
    for (std::size_t at = 0; at < text.size(); at += 700) relay.session->feed(text.substr(at, 700));
    ASSERT_EQ(relay.frames.size(), 3);
    ASSERT_EQ(relay.headers.size(), 1);
    const std::vector<double> got = numbers_of(relay.frames[1]);
    ASSERT_EQ(got.size(), values);
    EXPECT_NEAR(got[0], 2, 1e-6);
    EXPECT_NEAR(got[4], 2.4, 1e-4);
    EXPECT_EQ(relay.session->joint_count(), 59);
    EXPECT_EQ(relay.session->counts().malformed, 0);
  }
}

TEST(NeuronLines, MayHaveAReferenceAndANameWithSpaces) {
  NeuronRelay relay;
  relay.session->feed(neuron_line(180, 1, "0 My Avatar 9 9 9 9 9 9"));
  ASSERT_EQ(relay.frames.size(), 1);
  EXPECT_NEAR(numbers_of(relay.frames[0])[0], 1, 1e-6);
}

TEST(NeuronLines, OfOtherAvatarsAreLeftOut) {
  NeuronRelay relay;
  relay.session->feed(neuron_line(180, 1) + neuron_line(180, 5, "1 Char01") + neuron_line(180, 2));
  EXPECT_EQ(relay.frames.size(), 2);
  EXPECT_THAT(relay.session->take_notes(), testing::Contains(HasSubstr("ignored avatar 1")));
}

TEST(NeuronLines, MayChangeTheirForm) {
  NeuronRelay relay;
  relay.session->feed(neuron_line(180, 1) + neuron_line(354, 2) + neuron_line(354, 3));
  relay.session->finish();
  EXPECT_EQ(relay.headers.size(), 2);
  EXPECT_EQ(relay.frames.size(), 3);
}

TEST(NeuronLines, OfNoFormAreCounted) {
  NeuronRelay relay;
  relay.session->feed("||0 Char00 1 2 3||" + neuron_line(180, 1) + neuron_line(100, 1) +
                      neuron_line(180, 2));
  relay.session->finish();
  EXPECT_EQ(relay.session->counts().malformed, 2);
  EXPECT_EQ(relay.session->counts().frames_in, 2);
}

}  // namespace
}  // namespace kinemend::test
