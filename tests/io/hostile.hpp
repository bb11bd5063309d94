// Tests that hold for any bytes in any format. Each new fixture is cut and patched at every place.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "counted_memory.hpp"
#include "io/mended.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/io.hpp"
#include "long_tests.hpp"

namespace kinemend::test {

inline constexpr std::size_t memory_allowed = 50u << 20;

inline std::vector<std::filesystem::path> fixture_paths(const std::string& format) {
  std::vector<std::filesystem::path> paths;
  for (const char* folder : {"good", "bad", "found"}) {
    const auto path = std::filesystem::path(KINEMEND_TEST_FIXTURES) / format / folder;
    if (!std::filesystem::exists(path)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(path))
      paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  EXPECT_GT(paths.size(), 10u) << format << ": fixtures are missing";
  return paths;
}

inline std::vector<std::string> fixture_bytes(const std::string& format) {
  std::vector<std::string> all;
  for (const auto& path : fixture_paths(format)) all.push_back(read_file(path));
  return all;
}

/// An unrepaired take is written back byte for byte. A repaired one is written in full length with
/// finite numbers, and from then on byte for byte.
inline void expect_written_back(const TakeResult& result, const std::string& bytes,
                                const std::string& format, const ReadOptions& options) {
  const std::string written = write_take(result.take, format);
  if (!was_mended(result.diagnostics) || written == bytes) {
    ASSERT_EQ(written, bytes);
  } else {
    ASSERT_EQ(write_take(read_take(written, "take." + format, options).take, format), written);
  }
}

/// Any bytes give a valid take that is written back, or a one-line error that names the file.
/// `options` holds what the format needs beside the file.
inline void expect_take_or_error(const std::string& bytes, const std::string& format,
                                 ReadOptions options = {}) {
  const std::string name = "take." + format;
  options.format = format;
  const std::size_t peak = peak_memory([&] {
    try {
      const TakeResult result = read_take(bytes, name, options);
      result.take.validate();
      ASSERT_NO_FATAL_FAILURE(expect_written_back(result, bytes, format, options));
    } catch (const Error& error) {
      const std::string message = error.what();
      ASSERT_EQ(error.kind(), ErrorKind::unreadable_input) << message;
      ASSERT_EQ(message.substr(0, name.size() + 1), name + ":") << message;
      ASSERT_EQ(message.find_first_of("\r\n"), message.npos);
    }
  });
  ASSERT_LT(peak, memory_allowed);
}

/// Sanitised code is ten times slower, so it looks at every fifth place; the release build and the
/// fuzzers look at all.
inline std::size_t step_between_places() {
#if defined(KINEMEND_SANITIZED)
  return runs_long_tests() ? 1 : 5;
#else
  return 1;
#endif
}

inline void expect_sane_when_cut_at_any_length(const std::string& format,
                                               const ReadOptions& options = {}) {
  const std::size_t step = step_between_places();
  for (const std::string& bytes : fixture_bytes(format)) {
    for (std::size_t length = 0; length <= bytes.size(); length += step) {
      ASSERT_NO_FATAL_FAILURE(expect_take_or_error(bytes.substr(0, length), format, options))
          << length;
    }
  }
}

/// `likely` are bytes with a meaning in the format.
inline void expect_sane_when_patched_at_any_byte(const std::string& format,
                                                 const std::string& likely,
                                                 const ReadOptions& options = {}) {
  Random random(99);
  const std::size_t step = step_between_places();
  for (const std::string& bytes : fixture_bytes(format)) {
    for (std::size_t at = 0; at < bytes.size(); at += step) {
      std::string patched = bytes;
      const std::size_t count = 1 + random.below(3);
      for (std::size_t i = 0; i < count && at + i < bytes.size(); ++i) {
        patched[at + i] = random.chance(0.7) ? likely[random.below(likely.size())]
                                             : static_cast<char>(random.below(256));
      }
      ASSERT_NO_FATAL_FAILURE(expect_take_or_error(patched, format, options)) << at;
    }
  }
}

inline void expect_sane_when_pieces_move(const std::string& format,
                                         const ReadOptions& options = {}) {
  Random random(100);
  const auto all = fixture_bytes(format);
  for (int i = 0; i < 3000; ++i) {
    std::string bytes = all[random.below(all.size())];
    const std::string& other = all[random.below(all.size())];
    if (bytes.empty() || other.empty()) continue;
    const std::size_t from = random.below(other.size());
    bytes.insert(random.below(bytes.size()), other.substr(from, random.below(200)));
    ASSERT_NO_FATAL_FAILURE(expect_take_or_error(bytes, format, options)) << i;
  }
}

/// Limit of processor time in seconds. A reader that exceeds it does not take time in proportion to
/// its file. Sanitised code is ten times slower.
#if defined(KINEMEND_SANITIZED)
inline constexpr double verdict_s = 20;
#else
inline constexpr double verdict_s = 2;
#endif

/// Large invalid files are read or refused within `verdict_s` and in little memory.
inline void expect_quick_verdicts(const std::string& format,
                                  const std::vector<std::pair<const char*, std::string>>& files,
                                  ReadOptions options = {}) {
  options.format = format;
  for (const auto& [title, bytes] : files) {
    SCOPED_TRACE(title);
    const std::clock_t start = std::clock();
    const std::size_t peak = peak_memory([&, text = bytes]() mutable {
      try {
        const Take take = read_take(std::move(text), "take." + format, options).take;
        take.validate();
      } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.substr(0, 6 + format.size()), "take." + format + ":") << message;
      }
    });
    EXPECT_LT(peak, memory_allowed);
    EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, verdict_s);
  }
}

inline std::string repeated(const std::string& piece, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += piece;
  return text;
}

}  // namespace kinemend::test
