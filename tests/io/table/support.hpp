// Fixtures and text replacement shared by the tests of tables.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "io/support.hpp"

namespace kinemend::test {

inline std::string trc_fixture(const std::string& name) {
  return read_file(std::filesystem::path(KINEMEND_TEST_FIXTURES) / "trc" / name);
}

inline Take read_trc(std::string bytes) {
  ReadOptions options;
  options.format = "trc";
  return read_take(std::move(bytes), "take.trc", options).take;
}

/// Replaces `from`, which the text holds once.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  EXPECT_EQ(text.find(from, at + 1), text.npos) << from;
  return text.replace(at, from.size(), to);
}

}  // namespace kinemend::test
