// Fixtures, clips and error messages shared by the tests of readers and writers.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/io.hpp"

namespace kinemend::test {

inline std::filesystem::path fixture(const std::string& name) {
  return std::filesystem::path(KINEMEND_TEST_FIXTURES) / "bvh" / name;
}

inline std::vector<std::filesystem::path> fixtures_in(const std::string& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(fixture(folder)))
    paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  EXPECT_GT(paths.size(), 20u) << folder << ": fixtures are missing";
  return paths;
}

/// Returns the message of the error that `action` throws, or "no error".
template <class Action>
std::string message_of(Action&& action, ErrorKind kind) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  return "no error";
}

inline std::string read_error(std::string bytes, const ReadOptions& options = {},
                              ErrorKind kind = ErrorKind::unreadable_input) {
  return message_of([&] { read_joints(std::move(bytes), "take.bvh", options); }, kind);
}

inline Take read_text(std::string bytes) { return read_joints(std::move(bytes), "take.bvh").take; }

/// Rotation for Euler angles in degrees.
inline Quat rotation_of(std::array<double, 3> degrees, const char* order) {
  for (double& angle : degrees) angle *= radians_per_degree;
  return from_euler(degrees, parse_rotation_order(order));
}

inline void expect_same_motion(const Take& a, const Take& b, double tolerance) {
  ASSERT_EQ(a.joint_count(), b.joint_count());
  ASSERT_EQ(a.frame_count(), b.frame_count());
  ASSERT_EQ(a.translated_joints, b.translated_joints);
  for (std::size_t i = 0; i < a.rotations.size(); ++i) {
    ASSERT_LE(angle_between(a.rotations[i], b.rotations[i]), tolerance) << "sample " << i;
  }
  for (std::size_t f = 0; f < a.frame_count(); ++f) {
    for (std::size_t i = 0; i < a.point_count(); ++i) {
      ASSERT_LE(norm(a.position(f, i) - b.position(f, i)), tolerance)
          << "frame " << f << ", track " << i;
    }
  }
}

/// The channel values of a BVH text, row by row, parsed by the C library.
inline std::vector<std::vector<double>> rows_of(const std::string& text, std::size_t channels) {
  std::size_t at = text.find('\n', text.find("Frame Time"));
  if (at == text.npos) at = text.find('\r', text.find("Frame Time"));
  std::vector<std::vector<double>> rows;
  const char* p = text.c_str() + at;
  for (char* end = nullptr;; p = end) {
    const double value = std::strtod(p, &end);
    if (end == p) return rows;
    if (rows.empty() || rows.back().size() == channels) rows.emplace_back();
    rows.back().push_back(value);
  }
}

}  // namespace kinemend::test
