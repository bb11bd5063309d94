#include "base/bytes.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace kinemend {
namespace {

TEST(Bytes, WordsAreReadAndWrittenInBothByteOrders) {
  const std::string bytes("\x01\x02\xFE\xFF", 4);
  EXPECT_EQ(read_word<std::uint32_t>(bytes.data(), false), 0xFFFE0201u);
  EXPECT_EQ(read_word<std::uint32_t>(bytes.data(), true), 0x0102FEFFu);
  EXPECT_EQ(read_word<std::uint16_t>(bytes.data() + 2, true), 0xFEFFu);
  for (const bool big_endian : {false, true}) {
    std::string written;
    append_word(written, read_word<std::uint32_t>(bytes.data(), big_endian), big_endian);
    EXPECT_EQ(written, bytes);
    append_word(written, std::uint64_t{0x8000000000000001}, big_endian);
    ASSERT_EQ(written.size(), 12u);
    EXPECT_EQ(read_word<std::uint64_t>(written.data() + 4, big_endian), 0x8000000000000001u);
  }
}

}  // namespace
}  // namespace kinemend
