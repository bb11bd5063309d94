// Recognises headers, gathers their lines and parses them.
#include "live/live_header.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/bvh/bvh_hierarchy.hpp"
#include "io/bvh/bvh_text.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/frame_rate.hpp"

namespace kinemend {

namespace {

// The rate if a header states none, and a limit of the stack. Chosen by hand.
constexpr double rate_when_unknown_hz = 30;
constexpr std::size_t most_depth = 512;

// Returns the first word of a line, which distinguishes `Frames:` and `Frame Time:` from frames.
std::string_view first_word(std::string_view line) {
  std::size_t begin = 0;
  if (line.substr(0, 3) == "\xEF\xBB\xBF") begin = 3;
  while (begin < line.size() && is_space(line[begin])) ++begin;
  std::size_t end = begin;
  while (end < line.size() && !is_space(line[end]) && line[end] != ':' && line[end] != '{') ++end;
  return line.substr(begin, end - begin);
}

}  // namespace

LiveHeader read_live_header(std::string_view text, std::string_view name, double frame_rate_hz) {
  const SourceText source{name, text};
  Diagnostics diagnostics;
  BvhHeader read = read_bvh_header(source, diagnostics, most_depth, rate_when_unknown_hz);
  LiveHeader header;
  const auto piece = [&](ByteSpan span) { return text.substr(span.begin, span.size); };
  if (frame_rate_hz > 0) {
    header.frame_rate_hz = frame_rate_hz;
  } else if (read.frame_time_s > 0) {
    header.frame_rate_hz = rate_from_frame_time(read.frame_time_s, piece(read.frame_time));
    header.frame_time = piece(read.frame_time);
  } else {
    header.frame_rate_hz = rate_when_unknown_hz;
  }
  std::size_t channels = 0;
  for (const auto& own : read.skeleton.channels) channels += own.size();
  if (channels == 0) throw source.error_at(std::size_t{0}, "no joint has a channel");
  header.hierarchy = text.substr(0, text.rfind('}', read.hierarchy_end) + 1);
  header.frames = read.frames.value_or(0);
  header.skeleton = std::move(read.skeleton);
  for (const Diagnostic& diagnostic : diagnostics.entries()) {
    const bool is_of_rate =
        diagnostic.name == "frame_time_missing" || diagnostic.name == "frame_time_unusable";
    if (diagnostic.name == "frame_count_missing" || diagnostic.name == "motion_missing" ||
        (is_of_rate && frame_rate_hz > 0)) {
      continue;
    }
    header.repairs.push_back(
        fmt::format("{}:{}: {}", name, diagnostic.first_line, diagnostic.message));
  }
  return header;
}

bool begins_header(std::string_view line, bool surely) {
  const std::string_view word = first_word(line);
  return equal_ignoring_case(word, "HIERARCHY") || (!surely && equal_ignoring_case(word, "ROOT"));
}

bool is_marker_header(std::string_view line) { return first_word(line) == "MARKERS"; }

LiveHeader read_marker_header(std::string_view line, double frame_rate_hz) {
  // The limit of tables (io/table/marker_table.hpp), by definition.
  constexpr std::size_t most_markers = 16384;
  const auto fail = [](std::string_view what) {
    throw Error(ErrorKind::unreadable_input, fmt::format("header of markers: {}", what));
  };
  TextScanner scanner(line, 0);
  scanner.next();
  const std::string_view rate = scanner.next();
  LiveHeader header;
  const NumberToken token =
      rate.empty() ? NumberToken{} : read_number(rate.data(), rate.data() + rate.size());
  if (token.kind != TokenKind::number || !is_usable_frame_rate(token.value))
    fail(fmt::format("expected the rate in hertz after MARKERS, found {}", quote(rate)));
  header.frame_rate_hz = frame_rate_hz > 0 ? frame_rate_hz : token.value;
  std::string_view names = line.substr(scanner.position());
  while (!names.empty()) {
    const std::size_t end = std::min(names.find(','), names.size());
    std::string_view name = names.substr(0, end);
    names.remove_prefix(std::min(end + 1, names.size()));
    while (!name.empty() && is_space(name.front())) name.remove_prefix(1);
    while (!name.empty() && is_space(name.back())) name.remove_suffix(1);
    if (name.empty()) fail("a marker has no name");
    header.markers.emplace_back(name);
  }
  if (header.markers.empty()) fail("there are no names");
  if (header.markers.size() > most_markers) fail("there are too many names");
  return header;
}

HeaderLines::Next HeaderLines::take(std::string_view line) {
  const std::string_view word = first_word(line);
  // No line of a header begins with a number: its end was lost, or it was not a header.
  constexpr std::string_view firsts_of_numbers = "0123456789+-.";
  if (!word.empty() && firsts_of_numbers.find(word.front()) != firsts_of_numbers.npos)
    return Next::over;
  if (in_motion_ && !word.empty()) {
    if (equal_ignoring_case(word, "Frames")) {
      has_frames_ = true;
    } else if (equal_ignoring_case(word, "Frame") || equal_ignoring_case(word, "FrameTime")) {
      has_time_ = true;
    } else {
      return Next::over;
    }
  } else if (equal_ignoring_case(word, "MOTION")) {
    in_motion_ = true;
  }
  if (line.size() >= most_bytes_ - text_.size()) return Next::too_long;
  text_.append(line);
  text_ += '\n';
  return has_frames_ && has_time_ ? Next::complete : Next::more;
}

void HeaderLines::clear() {
  text_.clear();
  in_motion_ = has_frames_ = has_time_ = false;
}

}  // namespace kinemend
