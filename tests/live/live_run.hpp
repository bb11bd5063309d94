// Runs a live session and keeps its output.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/sessions.hpp"
#include "kinemend/io.hpp"
#include "kinemend/methods.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {

struct LiveRun {
  explicit LiveRun(const Cleaner& cleaner, const LiveOptions& options = {})
      : session(cleaner, options, [this](const LivePiece& piece) {
          text += piece.text;
          headers += piece.is_header ? 1 : 0;
          if (!piece.is_header) lines.emplace_back(piece.text);
        }) {}

  /// Feeds the bytes in chunks of `piece` bytes.
  void feed(std::string_view bytes, std::size_t piece = 1000) {
    for (; !bytes.empty(); bytes.remove_prefix(std::min(piece, bytes.size())))
      session.feed(bytes.substr(0, piece));
  }
  const LiveCounts& counts() const { return session.counts(); }

  std::string text;
  std::vector<std::string> lines;  ///< frames
  std::size_t headers = 0;
  LiveSession session;
};

/// Header and frames of a BVH stream.
struct StreamText {
  std::string header;
  std::vector<std::string> frames;  ///< each with its newline

  std::string text() const {
    std::string all = header;
    for (const std::string& frame : frames) all += frame;
    return all;
  }
};

inline StreamText stream_text(const Take& clip) {
  const std::string bytes = write_take(clip);
  const std::size_t motion = bytes.find('\n', bytes.find("Frame Time:")) + 1;
  StreamText stream{bytes.substr(0, motion), {}};
  for (std::size_t at = motion; at < bytes.size();) {
    const std::size_t end = bytes.find('\n', at) + 1;
    stream.frames.push_back(bytes.substr(at, end - at));
    at = end;
  }
  return stream;
}

inline Take noisy_clip(std::size_t frames) {
  Take clip = moving_take(frames, 120);
  add_noise(clip, 1.5, 0.5, 1);
  return clip;
}

inline Take read_bvh_text(const std::string& text) { return read_joints(text, "live.bvh").take; }

/// Largest difference of rotations, radians, and of positions.
inline std::pair<double, double> difference(const Take& a, const Take& b) {
  EXPECT_EQ(a.frame_count(), b.frame_count());
  double turn = 0, way = 0;
  for (std::size_t f = 0; f < std::min(a.frame_count(), b.frame_count()); ++f) {
    for (std::size_t j = 0; j < a.joint_count(); ++j)
      turn = std::max(turn, angle_between(a.rotation(f, j), b.rotation(f, j)));
    for (std::size_t i = 0; i < std::min(a.point_count(), b.point_count()); ++i)
      way = std::max(way, norm(a.position(f, i) - b.position(f, i)));
  }
  return {turn, way};
}

/// Tolerances for six decimals of degrees and of file units.
inline constexpr double digits_rad = 1e-7, digits_units = 2e-6;

}  // namespace kinemend::test
