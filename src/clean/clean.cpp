#include "kinemend/clean.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "clean/changes.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

void check_number(const char* name, double value, double maximum) {
  if (value >= 0 && value <= maximum) return;
  throw Error(ErrorKind::usage, fmt::format("{}: {} is outside 0 to {}", name, value, maximum));
}

void check_settings(const CleanSettings& settings, std::size_t frames) {
  check_number("strength", settings.strength, 1);
  check_number("max_change_deg", settings.max_change_deg, 180);
  check_number("peak_loss_limit", settings.peak_loss_limit, 1);
  if (!settings.range) return;
  const auto [first, last] = *settings.range;
  if (first > last || last >= frames) {
    throw Error(ErrorKind::usage,
                fmt::format("range: frames {} to {} are not in a take of frames 0 to {}", first,
                            last, frames == 0 ? 0 : frames - 1));
  }
}

// Sets the marks of the joints that a name or shell pattern means.
void mark_joints(const Skeleton& skeleton, const std::string& pattern, std::uint8_t mark,
                 std::vector<std::uint8_t>& marks) {
  bool matched = false;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    const std::string& name = skeleton.names[j];
    if (name != pattern && fnmatch(pattern.c_str(), name.c_str(), 0) != 0) continue;
    marks[j] = mark;
    matched = true;
  }
  if (!matched) {
    throw Error(ErrorKind::usage, fmt::format("no joint matches \"{}\" (the joints are {})",
                                              pattern, fmt::join(skeleton.names, ", ")));
  }
}

Selection make_selection(const Clip& clip, const CleanSettings& settings) {
  Selection selection = Selection::all(clip);
  if (!settings.joints.empty()) {
    std::fill(selection.joints.begin(), selection.joints.end(), std::uint8_t{0});
    for (const auto& pattern : settings.joints) {
      mark_joints(clip.skeleton, pattern, 1, selection.joints);
    }
  }
  for (const auto& pattern : settings.exclude) {
    mark_joints(clip.skeleton, pattern, 0, selection.joints);
  }
  selection.root_position = settings.root_position && clip.joint_count() > 0 &&
                            selection.joints[0] != 0 && clip.skeleton.has_position_channels(0);
  return selection;
}

template <class T>
void put_back(std::vector<T>& whole, const std::vector<T>& part, std::size_t first_frame,
              std::size_t width) {
  std::copy(part.begin(), part.end(),
            whole.begin() + static_cast<std::ptrdiff_t>(first_frame * width));
}

}  // namespace

CleanResult clean_clip(const Clip& clip, const Cleaner& cleaner, const CleanSettings& settings,
                       std::string method_name) {
  const auto start = std::chrono::steady_clock::now();
  check_settings(settings, clip.frame_count());
  const Selection selection = make_selection(clip, settings);

  CleanResult result;
  CleanReport& report = result.report;
  report.method = std::move(method_name);
  report.frames = clip.frame_count();
  report.frame_rate_hz = clip.frame_rate_hz;
  report.calibration_frames = leading_calibration_frames(clip);
  const std::size_t first = report.calibration_frames;

  Clip motion = slice(clip, first, clip.frame_count());
  const CleanTrace trace = cleaner.clean(motion, selection);
  const auto weights = frame_weights(settings, clip.frame_count(), first, clip.frame_rate_hz);
  const Changes changes = blend_changes(clip, first, selection, settings, weights, trace, motion);
  write_report(clip, first, motion, changes, trace, settings, report);

  if (first == 0) {
    motion.source = clip.source;
    result.clip = std::move(motion);
  } else {
    result.clip = clip;
    put_back(result.clip.local_rotations, motion.local_rotations, first, clip.joint_count());
    put_back(result.clip.root_positions, motion.root_positions, first, 1);
    put_back(result.clip.joint_translations, motion.joint_translations, first,
             clip.translated_joints.size());
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace kinemend
