// Gathers the facts of a take for its report, and describes the repairs of its reader.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "kinemend/experimental/frame_numbers.hpp"
#include "kinemend/experimental/text.hpp"
#include "kinemend/report.hpp"
#include "report/texts.hpp"

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

const char* noun_of(TakeKind kind) { return kind == TakeKind::markers ? "marker" : "joint"; }

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

}  // namespace kinemend
