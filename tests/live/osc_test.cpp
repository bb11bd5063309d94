// Tests of reading OSC packets: messages, nested bundles, broken sizes, and floats replaced in
// place.
#include "live/osc.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <random>

#include "live/osc_packets.hpp"

namespace kinemend::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> addresses(const std::string& packet) {
  std::vector<OscMessage> messages;
  if (!read_osc(packet, messages)) return {"unreadable"};
  std::vector<std::string> names;
  for (const OscMessage& message : messages) names.emplace_back(message.address);
  return names;
}

TEST(OscPacket, HasTheMessagesOfNestedBundlesInOrder) {
  const std::string one = osc_message("/one", "i", osc_number(1));
  const std::string two = osc_message("/two", "");
  const std::string three = osc_message("/three", "s", osc_text("abcd"));
  EXPECT_THAT(addresses(one), ElementsAre("/one"));
  EXPECT_THAT(addresses(osc_bundle({one, osc_bundle({two, one}, 7, 9), three})),
              ElementsAre("/one", "/two", "/one", "/three"));
  EXPECT_THAT(addresses(osc_bundle({})), IsEmpty());
}

TEST(OscPacket, TellsWhereArgumentsBeginAndEnd) {
  const std::string packet = osc_bundle(
      {osc_message("/a", ""), osc_message("/bcd", "sf", osc_text("name") + osc_real(1.5F))});
  std::vector<OscMessage> messages;
  ASSERT_TRUE(read_osc(packet, messages));
  const OscMessage& message = messages.at(1);
  EXPECT_EQ(message.types, "sf");
  EXPECT_EQ(message.end, packet.size());
  EXPECT_EQ(osc_string(packet, message.arguments, message.end), "name");
  EXPECT_EQ(osc_float(packet, message.arguments + osc_string_bytes(4)), 1.5F);
}

TEST(OscPacket, TakesAMessageWithoutTypes) {
  std::vector<OscMessage> messages;
  ASSERT_TRUE(read_osc(osc_text("/old") + osc_number(7), messages));
  EXPECT_EQ(messages.at(0).types, "");
  EXPECT_EQ(messages.at(0).arguments, 8);
}

TEST(OscPacket, IsRefusedWhereASizeOrAStringIsWrong) {
  const std::string message = osc_message("/one", "i", osc_number(1));
  for (const std::string& packet :
       {std::string(), std::string("/on"), std::string("/one"), std::string("one\0", 4),
        message + "x", osc_text("/one") + ",iii", osc_text("#bundle"),
        osc_text("#bundle") + osc_number(0), osc_bundle({}) + osc_number(8) + osc_text("/a"),
        osc_bundle({}) + osc_number(2) + osc_text("/a"),
        osc_bundle({}) + osc_number(0) + osc_text("/a"),
        osc_bundle({}) + osc_number(0xFFFFFFFC) + osc_text("/a"),
        osc_bundle({}) + std::string("\0\0\0", 3), osc_bundle({message, "abc"})}) {
    EXPECT_THAT(addresses(packet), ElementsAre("unreadable"));
  }
}

TEST(OscPacket, IsRefusedWhereBundlesAreTooDeepAndLeavesTheListAsItWas) {
  std::string packet = osc_message("/one", "");
  for (std::size_t depth = 0; depth < most_osc_depth; ++depth)
    packet = osc_bundle({osc_message("/two", ""), packet});
  std::vector<OscMessage> messages;
  EXPECT_TRUE(read_osc(packet, messages));
  EXPECT_EQ(messages.size(), most_osc_depth + 1);
  EXPECT_FALSE(read_osc(osc_bundle({packet}), messages));
  EXPECT_EQ(messages.size(), most_osc_depth + 1);
}

TEST(OscPacket, KeepsEveryOtherByteWhereAFloatIsReplaced) {
  const std::string before =
      osc_bundle({osc_message("/a", "ff", osc_real(1) + osc_real(2))}, 0x12345678, 0x9ABCDEF0);
  for (const float value : {0.0F, -0.25F, 1e-40F, std::numeric_limits<float>::infinity()}) {
    std::string packet = before;
    set_osc_float(packet, before.size() - 4, value);
    EXPECT_EQ(osc_float(packet, before.size() - 4), value);
    EXPECT_EQ(packet, before.substr(0, before.size() - 4) + osc_real(value));
  }
}

TEST(OscPacket, StaysInItsBytesWhateverTheyAre) {
  std::mt19937 random(1);
  const std::string good =
      osc_bundle({osc_message("/VMC/Ext/Bone/Pos", "sf", osc_text("Hips") + osc_real(1)),
                  osc_bundle({osc_message("/b", "s", osc_text("x"))})});
  for (int round = 0; round < 20000; ++round) {
    std::string packet = good.substr(0, random() % 2 == 0 ? good.size() : random() % good.size());
    for (std::uint32_t change = random() % 6; change > 0 && !packet.empty(); --change)
      packet[random() % packet.size()] = static_cast<char>(random() % 3 == 0 ? random() : 0);
    std::vector<OscMessage> messages;
    read_osc(packet, messages);
    for (const OscMessage& message : messages) {
      ASSERT_LE(message.arguments, message.end);
      ASSERT_LE(message.end, packet.size());
      ASSERT_TRUE(message.address.starts_with('/'));
      osc_string(packet, message.arguments, message.end);
    }
  }
}

}  // namespace
}  // namespace kinemend::test
