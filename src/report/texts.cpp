// Gathers the facts of a take for its report, and describes its noise, its source and the repairs
// of its reader in words.
#include "report/texts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/text.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/report.hpp"

namespace kinemend {

namespace {

std::string counted_message(const Diagnostic& diagnostic) {
  const std::string times =
      diagnostic.count > 1 ? fmt::format(" ({} times)", grouped(diagnostic.count)) : "";
  return diagnostic.message + times;
}

bool places_are_bytes(std::string_view format) { return format == "c3d"; }

}  // namespace

std::string contents_without_markers(const Take& clip) {
  if (clip.marker_count() > 0) return "";
  for (const SourceFact& fact : clip.source.facts) {
    if (fact.name == "analog frames")
      return counted(std::stoul(fact.text), "analog frame") + ", no points";
    if (fact.name == "rotations") return "rotations of " + fact.text + ", no points";
  }
  return "no points";
}

TakeFacts take_facts(const Take& take) {
  TakeFacts facts;
  facts.format = take.source.format;
  if (take.source.animations.size() > 1) facts.animation = take.source.animation;
  facts.tracks = take.owner_names();
  facts.frames = take.frame_count();
  facts.first_frame = first_frame_number(take);
  facts.frame_rate_hz = take.frame_rate_hz;
  if (take.has_joints()) {
    facts.unit = unit_name(take.metres_per_unit);
    facts.metres_per_unit = take.metres_per_unit;
  } else {
    facts.kind = TakeKind::markers;
    facts.unit = take.unit;
    facts.metres_per_unit = metres_per_unit(take.unit);
    facts.contents = contents_without_markers(take);
  }
  return facts;
}

std::string diagnostic_text(std::string_view format, const Diagnostic& diagnostic) {
  if (diagnostic.first_line == 0) return counted_message(diagnostic);
  return fmt::format("{} {}: {}", places_are_bytes(format) ? "byte" : "line", diagnostic.first_line,
                     counted_message(diagnostic));
}

std::string diagnostic_line(const SourceInfo& source, const Diagnostic& diagnostic) {
  if (diagnostic.first_line == 0 || places_are_bytes(source.format))
    return source.name + ": " + diagnostic_text(source.format, diagnostic);
  return fmt::format("{}:{}: {}", source.name, diagnostic.first_line, counted_message(diagnostic));
}

std::string shown_name(const TakeFacts& take) {
  const std::string name = take.input == "-" ? "standard input" : printable(take.input);
  return take.animation.empty() ? name : fmt::format("{} ({})", name, printable(take.animation));
}

std::string advice_of(const Leftover& leftover, const TakeFacts& take) {
  constexpr std::string_view stand_in = "TAKE";
  std::string advice = leftover.mend;
  // A take that was never in a file has no path.
  if (take.input.empty()) return advice;
  const std::string path = printable(take.input);
  for (std::size_t at = advice.find(stand_in); at != std::string::npos;
       at = advice.find(stand_in, at + path.size()))
    advice.replace(at, stand_in.size(), path);
  return advice;
}

std::string written_text(const TakeFacts& take) {
  return take.output == "-" ? "" : "; written to " + printable(take.output);
}

namespace {

// Noise is called slow from this correlation on; the frequencies are given for this share of it.
// Chosen by hand, not swept.
constexpr double slow_correlation = 0.7, shown_share = 0.9;

std::string colour_words(const NoiseCharacter& noise, double frame_rate_hz) {
  if (noise.correlation == 0) return "white";
  return fmt::format("{}, {:.0f} % below {} Hz",
                     noise.correlation < slow_correlation ? "coloured" : "slow", 100 * shown_share,
                     figure(noise.frequency_of_share(shown_share, frame_rate_hz)));
}

}  // namespace

std::string source_words(const TakeSource& source) {
  if (source.source == Source::unknown) return source.reason;
  return fmt::format("{} ({})", to_string(source.source), source.reason);
}

std::string noise_words(const NoiseCharacter& noise, TakeKind kind, std::string_view unit,
                        double frame_rate_hz) {
  const bool is_of_tracks = (kind == TakeKind::joints) == (noise.space == Space::rotation);
  const std::string lead = is_of_tracks ? "" : "positions: ";
  const std::string_view shown = is_of_tracks ? unit : std::string_view();
  if (noise.is_expected && noise.correlation > 0)
    return fmt::format(
        "{}about {} per axis, {}; the model expects it, the take alone does not show it", lead,
        measure_text(noise.strength, shown), colour_words(noise, frame_rate_hz));
  if (noise.is_expected)
    return fmt::format(
        "{}about {}, slow; the model expects it, as in markerless video; the take alone does not "
        "show it. Cleaning improves velocities; poses change little",
        lead, measure_text(noise.strength, shown));
  std::string words = fmt::format("{}{} per axis, {}", lead, measure_text(noise.strength, shown),
                                  colour_words(noise, frame_rate_hz));
  if (noise.frames_per_sample == 1) return words;
  const double rate_hz = frame_rate_hz / noise.frames_per_sample;
  if (noise.is_interpolated)
    return words + fmt::format("; {} Hz samples joined by lines", figure(rate_hz));
  return words + fmt::format("; {} Hz samples, each held for {} frames", figure(rate_hz),
                             figure(noise.frames_per_sample));
}

// Contacts are counted in seconds, because a stand that is found in slivers is not found.
std::string stand_words(const StandingTime& time) {
  if (time.found_s > 0) {
    return fmt::format("stand for {:.1f} s, about {:.1f} s expected, confidence {:.2f}",
                       time.found_s, time.expected_s, time.confidence);
  }
  return time.expected_s > 0 ? fmt::format("no contacts found; about {:.1f} s of standing expected",
                                           time.expected_s)
                             : std::string("no contacts found");
}

}  // namespace kinemend
