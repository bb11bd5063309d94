// Walks over the channel values of a text, a frame at a time, and finds the faulty line if the
// values do not form whole frames.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/text/text.hpp"

namespace kinemend {

/// The findings of a reader besides the values.
struct RowFindings {
  unsigned most_decimals = 0;
  CountedRepair<const char*> gaps;  ///< values that are not finite
  CountedRepair<const char*> comments;
  std::vector<const char*> joins;  ///< starts of numbers that have no blank before them (`0.0-7.5`)
};

/// Walks over channel values, a frame at a time. Line ends, white space and comments between values
/// are skipped.
class MotionRows {
 public:
  MotionRows(const char* begin, const char* end, CommaStyle commas);

  /// Reads the next `count` (at least 1) values; a value that is not finite becomes NaN. Returns
  /// how many were read before the end of the text or a word that is not a number, to which
  /// `position()` then points. `tokens`, unless null, receives the place of each value.
  std::size_t next(double* values, std::size_t count, TokenSpan* tokens = nullptr);

  /// Returns the first byte of the next word, after a row was read.
  const char* position() const { return position_; }
  /// Returns the end of the last value.
  const char* last_end() const { return last_end_; }
  bool at_end() const { return position_ == end_; }
  /// Whether a line ended between the last row and `position()`.
  bool at_line_start() const;

  const RowFindings& found() const { return found_; }

 private:
  template <bool keep_tokens>
  std::size_t read(double* values, std::size_t count, TokenSpan* tokens);
  bool read_rare(const char*& p, NumberToken& token);
  bool read_joined(const char* p, NumberToken& token);
  const char* skip(const char* p) const;

  const char* end_;
  const char* position_;
  const char* last_end_;
  PlainPlaces plain_places_;
  CommaStyle commas_;
  RowFindings found_;
  const char* joined_until_ = nullptr;  // the end of a word of several numbers
};

/// A line with a wrong number of values.
struct LineFault {
  const char* place = nullptr;
  std::size_t expected = 0;
  std::size_t found = 0;
};

std::string to_string(const LineFault& fault);

/// Finds the faulty line if values do not form whole frames. Frames may be wrapped over lines. If
/// most lines hold exactly one frame, a line that starts inside a frame shows that an earlier line
/// is short or long: that line is the fault. If most lines hold another number of values, and there
/// are `declared_frames` lines, the first of them is the fault. Empty if the text can be read as
/// frames wrapped over lines.
std::optional<LineFault> find_line_fault(const char* begin, const char* end, CommaStyle commas,
                                         std::size_t channels,
                                         std::optional<std::size_t> declared_frames);

}  // namespace kinemend
