// Names the system that recorded a take, which decides what kinds of noise are likely in it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend {

struct Take;

/// The kind of system that recorded the motion of a take. `Take::source`, in contrast, is the file
/// that holds it.
enum class Source : std::uint8_t {
  /// The source is not known. Methods remove the noise that the take itself shows.
  unknown,
  /// Markers that several cameras see, and skeletons solved from them. As `unknown`: noise of such
  /// systems shows in the take.
  optical,
  /// Inertial or magnetic sensors on the body. Slow noise is likely, and methods that know it
  /// remove it.
  suit,
  /// Pose estimation from video, of one or several cameras, without markers. As `suit`.
  video,
  /// Skeletons from a depth camera. As `suit`.
  depth,
  /// Keys set by hand. They contain no measurement noise, so `auto` and `learned` change only gaps.
  keyframed
};

/// "unknown", "optical", ...
std::string_view to_string(Source source);
/// Returns the source of that name. Errors: `ErrorKind::usage` for an unknown name; the message
/// suggests the most similar name and lists all names.
Source parse_source(std::string_view name);
/// The names of all sources, `unknown` last.
std::vector<std::string> source_names();

/// Whether noise that is too slow to show from frame to frame is likely: true for video, depth and
/// suit.
bool expects_slow_noise(Source source) noexcept;

/// The source that is used for a take, and why.
struct TakeSource {
  Source source = Source::unknown;
  /// "given", "not known", or the place in the file: "read from the file, software: Vicon Nexus".
  std::string reason = "not known";

  friend bool operator==(const TakeSource&, const TakeSource&) = default;
};

/// Returns `given` if it is not `unknown`, else the source that the take's file implies by naming
/// the program that recorded it. A program that also edits or solves the motion of other systems
/// implies no source.
TakeSource source_of(const Take& take, Source given = Source::unknown);

}  // namespace kinemend
