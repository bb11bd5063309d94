// Parses both ends of a range and converts seconds and frame numbers into frames of a take.
#include "frame_range.hpp"

#include <fmt/format.h>

#include <cmath>

#include "kinemend/extend/options.hpp"

namespace kinemend::cli {

namespace {

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorKind::usage, "--range: " + message);
}

[[noreturn]] void refuse_form(const std::string& text) {
  refuse(text + " is neither a range of frames (121:240) nor of seconds (1s:2.5s)");
}

struct End {
  std::optional<double> value;
  bool in_seconds = false;
};

End parse_end(std::string text, const std::string& whole) {
  End end;
  if (text.empty()) return end;
  if (text.back() == 's') {
    end.in_seconds = true;
    text.pop_back();
  }
  OptionSpec spec;
  spec.name = "range";
  spec.minimum = end.in_seconds ? 0 : -1e12;
  spec.maximum = 1e12;
  spec.default_value = end.in_seconds ? OptionValue(0.0) : OptionValue(std::int64_t{1});
  try {
    const OptionValue value = parse_option(spec, text);
    const auto* whole_number = std::get_if<std::int64_t>(&value);
    end.value = whole_number ? static_cast<double>(*whole_number) : std::get<double>(value);
  } catch (const Error&) {
    refuse_form(whole);
  }
  return end;
}

}  // namespace

FrameRange parse_range(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || text == ":") refuse_form(text);
  const End first = parse_end(text.substr(0, colon), text);
  const End last = parse_end(text.substr(colon + 1), text);
  if (first.value && last.value && first.in_seconds != last.in_seconds) refuse_form(text);
  if (first.value && last.value && *first.value > *last.value)
    refuse(text + " ends before it begins");
  return {first.in_seconds || last.in_seconds, first.value, last.value};
}

std::pair<std::size_t, std::size_t> frames_of(const FrameRange& range, std::size_t frame_count,
                                              double frame_rate_hz, std::int64_t first_frame) {
  const auto frames = static_cast<double>(frame_count);
  double first = 0;
  double last = frames - 1;
  if (range.in_seconds) {
    // A frame at an end, up to the rounding of the rate, belongs to the range.
    constexpr double slack = 1e-6;
    if (range.last && *range.last * frame_rate_hz > frames + slack)
      refuse(fmt::format("{} s is after the end of the take, {:.3f} s", *range.last,
                         frames / frame_rate_hz));
    if (range.first) first = std::ceil(*range.first * frame_rate_hz - slack);
    if (range.last) last = std::min(last, std::floor(*range.last * frame_rate_hz + slack));
  } else {
    const auto start = static_cast<double>(first_frame);
    for (const std::optional<double>& end : {range.first, range.last}) {
      if (end && (*end < start || *end > start + frames - 1)) {
        refuse(fmt::format("frame {} is outside {} to {}", *end, first_frame,
                           first_frame + static_cast<std::int64_t>(frame_count) - 1));
      }
    }
    if (range.first) first = *range.first - start;
    if (range.last) last = *range.last - start;
  }
  if (first > last || first >= frames)
    refuse(fmt::format("contains none of the {} frames of the take", frame_count));
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
}

}  // namespace kinemend::cli
