// Finds frames that repeat or contain only zeros, and the rate that repeats indicate.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "check/checks.hpp"
#include "check/runs.hpp"

namespace kinemend::check {

namespace {

// Whether a frame equals the previous one to the precision of text.
bool repeats(const Take& clip, std::size_t frame) {
  // Text writers round to this; not swept.
  constexpr double same_angle = 1e-7;  // radians
  const Vec3 step = clip.root_position(frame) - clip.root_position(frame - 1);
  if (norm(step) > 1e-9 * (1 + norm(clip.root_position(frame)))) return false;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    if (angle_between(clip.rotation(frame - 1, j), clip.rotation(frame, j)) > same_angle)
      return false;
  }
  for (std::size_t k = 1; k < clip.point_count(); ++k) {
    if (!(clip.position(frame, k) == clip.position(frame - 1, k))) return false;
  }
  return true;
}

bool repeats(const Take& clip, const std::vector<std::size_t>& markers, std::size_t frame) {
  std::size_t seen = 0;
  for (const std::size_t m : markers) {
    if (clip.is_observed(frame, m) != clip.is_observed(frame - 1, m)) return false;
    if (!clip.is_observed(frame, m)) continue;
    if (!(clip.position(frame, m) == clip.position(frame - 1, m))) return false;
    ++seen;
  }
  return seen > 0;
}

// If most of every second step repeats, the take was converted from half the rate (or a third).
void report_low_rate(const std::vector<std::uint8_t>& repeated, CheckReport& report) {
  for (const std::size_t stride : {2, 3, 4, 5}) {
    for (std::size_t phase = 0; phase < stride; ++phase) {
      std::size_t as_expected = 0;
      for (std::size_t t = 1; t < repeated.size(); ++t)
        as_expected += (repeated[t] != 0) == (t % stride != phase);
      if (static_cast<double>(as_expected) < 0.95 * static_cast<double>(repeated.size() - 1))
        continue;
      report.findings.push_back(
          {FindingKind::rate, Severity::serious, "", 0, repeated.size() - 1,
           report.frame_rate_hz / static_cast<double>(stride), "Hz",
           fmt::format("only one frame in {} is new: the motion was captured at {:.6g} Hz", stride,
                       report.frame_rate_hz / static_cast<double>(stride))});
      return;
    }
  }
}

void report_repeats(const std::vector<std::uint8_t>& repeated, CheckReport& report) {
  // Shorter takes say nothing about their rate. Chosen by hand, not swept.
  constexpr std::size_t fewest_frames = 10;
  const auto count = static_cast<std::size_t>(std::count(repeated.begin(), repeated.end(), 1));
  if (repeated.size() < fewest_frames || count == 0) return;
  if (count + 1 == repeated.size()) {
    report.findings.push_back({FindingKind::repeated_frames, Severity::note, "", 0,
                               repeated.size() - 1, static_cast<double>(count), "frames",
                               "nothing moves: every frame is the same"});
    return;
  }
  if (3 * count >= repeated.size()) {
    const std::size_t before = report.findings.size();
    report_low_rate(repeated, report);
    if (report.findings.size() > before) return;
  }
  for (const FrameSpan& run :
       runs_where(repeated.size(), [&](std::size_t t) { return repeated[t] != 0; })) {
    const auto length = static_cast<double>(run.length());
    report.findings.push_back(
        {FindingKind::repeated_frames,
         length >= 0.5 * report.frame_rate_hz ? Severity::serious : Severity::warning, "",
         run.first, run.last, length, "frames",
         run.length() == 1 ? "the frame is equal to the one before"
                           : "the frames are equal to the one before"});
  }
}

bool is_zero(const Take& clip, std::size_t frame) {
  if (norm(clip.root_position(frame)) > 0) return false;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    if (angle_between(clip.rotation(frame, j), {}) > 1e-9) return false;
  }
  return true;
}

}  // namespace

void check_frames(const Take& clip, CheckReport& report) {
  const std::size_t frames = clip.frame_count();
  if (frames < 2) return;
  std::vector<std::uint8_t> repeated(frames);
  for (std::size_t t = 1; t < frames; ++t)
    repeated[t] = repeats(clip, t) && !(is_zero(clip, t) && is_zero(clip, t - 1));
  report_repeats(repeated, report);
}

void check_zero_frames(const Take& clip, CheckReport& report) {
  const std::size_t frames = clip.frame_count();
  const std::vector<FrameSpan> zeros =
      runs_where(frames, [&](std::size_t t) { return is_zero(clip, t); });
  for (const FrameSpan& run : zeros) {
    // A take of zeros only does not move, and one such frame at the start is a pose.
    const bool is_pose = run.last == 0 && report.calibration_frames > 0;
    if (is_pose || run.length() == frames) continue;
    report.findings.push_back({FindingKind::zero_frames, Severity::serious, "", run.first, run.last,
                               static_cast<double>(run.length()), "frames",
                               "every channel is zero"});
  }
}

void check_frames(const Take& clip, const std::vector<std::size_t>& markers, CheckReport& report) {
  const std::size_t frames = clip.frame_count();
  if (frames < 2) return;
  std::vector<std::uint8_t> repeated(frames);
  for (std::size_t t = 1; t < frames; ++t) repeated[t] = repeats(clip, markers, t);
  report_repeats(repeated, report);
}

}  // namespace kinemend::check
