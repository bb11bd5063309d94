// Counts values line by line, and finds the first line that is too short or too long.
#include "io/motion/motion_lines.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace kinemend {

namespace {

struct Line {
  const char* begin = nullptr;
  std::size_t values = 0;
};

// Walks over the lines with values; blank lines and comments are skipped.
class ValueLines {
 public:
  ValueLines(const char* begin, const char* end, CommaStyle commas)
      : p_(begin), end_(end), commas_(commas) {}

  bool next(Line& line) {
    while (p_ != end_) {
      const char* const stop = std::find_if(p_, end_, is_line_end);
      line = {skip_space(p_, stop), 0};
      count_values(line, stop);
      p_ = stop == end_ ? end_ : stop + 1;
      if (line.values > 0) return true;
    }
    return false;
  }

 private:
  void count_values(Line& line, const char* stop) const {
    bool inside = false;
    for (const char* p = line.begin; p != stop; ++p) {
      const bool blank = is_space(*p) || (commas_ == CommaStyle::separator && *p == ',');
      if (!blank && !inside && (*p == '#' || (*p == '/' && p + 1 != stop && p[1] == '/'))) return;
      line.values += !blank && !inside ? values_in_word(p, stop) : 0;
      inside = !blank;
    }
  }

  std::size_t values_in_word(const char* p, const char* stop) const {
    const char* end = p;
    while (end != stop && !is_space(*end) && !(commas_ == CommaStyle::separator && *end == ','))
      ++end;
    return numbers_in_word({p, static_cast<std::size_t>(end - p)});
  }

  const char* p_;
  const char* end_;
  CommaStyle commas_;
};

// Finds the first line of the first group of lines that does not hold whole frames.
std::optional<LineFault> find_uneven_group(ValueLines lines, std::size_t channels) {
  Line line, first;
  std::size_t sum = 0;
  while (lines.next(line)) {
    if (sum == 0) {
      first = line;
    } else if (line.values == channels) {
      return LineFault{first.begin, channels, sum < channels ? sum : first.values};
    }
    sum = (sum + line.values) % channels == 0 ? 0 : sum + line.values;
  }
  if (sum == 0) return std::nullopt;
  return LineFault{first.begin, channels, sum < channels ? sum : first.values};
}

}  // namespace

std::string to_string(const LineFault& fault) {
  return fmt::format("expected {} channel values, found {}", fault.expected, fault.found);
}

std::optional<LineFault> find_line_fault(const char* begin, const char* end, CommaStyle commas,
                                         std::size_t channels,
                                         std::optional<std::size_t> declared_frames) {
  std::size_t lines = 0, even = 0, like_first = 0;
  Line line, first;
  for (ValueLines all(begin, end, commas); all.next(line); ++lines) {
    if (lines == 0) first = line;
    even += line.values == channels ? 1 : 0;
    like_first += line.values == first.values ? 1 : 0;
  }
  if (2 * even > lines) return find_uneven_group(ValueLines(begin, end, commas), channels);
  if (first.values != channels && 2 * like_first > lines && declared_frames == lines) {
    return LineFault{first.begin, channels, first.values};
  }
  return std::nullopt;
}

}  // namespace kinemend
