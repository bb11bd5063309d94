// What recorded a take, which says what kinds of noise are likely in it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend {

struct Take;

/// What recorded the motion of a take. `Take::source`, in contrast, is the file that holds it.
enum class Source : std::uint8_t {
  /// Nobody says. Methods take out what the take itself shows to be noise.
  unknown,
  /// Markers that several cameras see, and skeletons solved from them. As `unknown`: noise of such
  /// systems shows in the take.
  optical,
  /// Inertial or magnetic sensors on the body. Slow noise is likely, and methods that know it take
  /// it out.
  suit,
  /// Pose estimation from video, of one or several cameras, without markers. As `suit`.
  video,
  /// Skeletons from a depth camera. As `suit`.
  depth,
  /// Keys set by hand. There is no measurement and so no noise: `auto` and `learned` change nothing
  /// but gaps.
  keyframed
};

/// "unknown", "optical", ...
std::string_view to_string(Source source);
/// The source of that name. Errors: `ErrorKind::usage` for any other name, with the one that may
/// have been meant, and those there are.
Source parse_source(std::string_view name);
/// The names of all sources, `unknown` last.
std::vector<std::string> source_names();

/// Whether noise that does not show from frame to frame is likely: true of video, depth and suit.
bool expects_slow_noise(Source source) noexcept;

/// The source that counts for a take, and why.
struct TakeSource {
  Source source = Source::unknown;
  /// "given", "not known", or where the file says it: "read from the file, software: Vicon Nexus".
  std::string reason = "not known";

  friend bool operator==(const TakeSource&, const TakeSource&) = default;
};

/// `given`, where it is not `unknown`; otherwise what the take's file says of the program that
/// recorded it. A program that also edits or solves the motion of other systems says nothing.
TakeSource source_of(const Take& take, Source given = Source::unknown);

}  // namespace kinemend
