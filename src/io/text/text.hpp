// Tools that all readers and writers of text share: lines, words, errors with their place, repairs,
// signs that a file was cut off (as by a full disk or a broken transfer), and a text under
// construction.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

#include "base/text.hpp"
#include "io/text/number.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

/// Returns the line (from 1) of byte `offset`. A line ends with LF, CR LF or CR, also mixed. Lines
/// are counted only for messages, so that reading pays nothing for it.
std::size_t line_at(std::string_view text, std::size_t offset);

/// Returns the end of the first line of a text: LF, CR LF or CR; LF if the text has one line.
std::string_view line_ending_of(std::string_view text);

bool equal_ignoring_case(std::string_view a, std::string_view b);

/// How often a repair was made, and the place of the first one: an offset or a pointer.
template <class Place>
struct CountedRepair {
  std::size_t count = 0;
  Place first{};

  void add(Place place) {
    if (count++ == 0) first = place;
  }
};

/// The bytes of a word, a cell or a number.
struct TokenSpan {
  const char* begin = nullptr;
  const char* end = nullptr;
};

/// A text with its name, for readers, and the list in which they note repairs.
struct SourceText {
  std::string_view name;
  std::string_view bytes;
  bool strict = false;
  Diagnostics* diagnostics = nullptr;  ///< null: repairs are not listed

  std::size_t offset_of(const char* place) const {
    return static_cast<std::size_t>(place - bytes.data());
  }

  Error error_at(std::size_t offset, std::string_view message) const;
  Error error_at(const char* place, std::string_view message) const {
    return error_at(offset_of(place), message);
  }

  /// Notes a repair, unless `count` is 0; throws `ErrorKind::quality_limit` when the reading is
  /// strict.
  void note(std::string_view kind, std::size_t offset, std::string_view message,
            std::size_t count = 1) const;
  void note(std::string_view kind, const char* place, std::string_view message,
            std::size_t count = 1) const {
    if (count > 0) note(kind, offset_of(place), message, count);
  }
  template <class Place>
  void note(std::string_view kind, const CountedRepair<Place>& repair,
            std::string_view message) const {
    note(kind, repair.first, message, repair.count);
  }
};

/// Returns the text without white space at either end.
std::string_view without_spaces_around(std::string_view text);
/// Notes a repair of a file without lines, `count` times; throws `ErrorKind::quality_limit` when
/// the reading is strict.
void note_repair(std::string_view file, bool strict, Diagnostics& diagnostics,
                 std::string_view kind, std::string_view message, std::size_t count = 1);

/// Walks over the words of a text: runs of bytes between white space; each brace is a separate
/// word. Comments (# or //, to the end of the line) between words are skipped and counted.
class TextScanner {
 public:
  TextScanner(std::string_view bytes, std::size_t position) : bytes_(bytes), position_(position) {}

  /// Returns the next word, empty at the end, without moving past it.
  std::string_view peek();
  /// Returns the next word and moves past it.
  std::string_view next();
  /// Moves past the next word if it is `word` in any case.
  bool accept(std::string_view word);
  /// Returns the rest of the line, or the next line if the rest is blank, up to a brace, without
  /// white space at either end. Empty if a brace is next.
  std::string_view name();
  /// Returns the rest of the line, up to a brace, without moving past it.
  std::string_view rest_of_line() const;

  /// Returns the place of the next word, after a call of `peek`.
  std::size_t position() const { return position_; }
  void move_to(std::size_t position) { position_ = position; }
  std::size_t comments() const { return comments_; }
  std::size_t first_comment() const { return first_comment_; }

 private:
  void skip_blanks();
  std::size_t line_end(std::size_t from) const;

  std::string_view bytes_;
  std::size_t position_;
  std::size_t comments_ = 0;
  std::size_t first_comment_ = 0;
};

/// Whether the word can be the start of a number, such as `-`, `1.` or `2.5e-`.
bool may_start_number(std::string_view word);

/// Which lines the last one is compared with.
enum class LikeLines : unsigned char { all, same_first_word };

/// Whether the last number of `rows` may have lost digits: no white space follows it, and it has
/// fewer digits after the point than the last number of each of the lines before it (100 at most, 3
/// at least). Numbers end at white space and at `separator`.
bool last_number_may_be_cut(std::string_view rows, CommaStyle commas, char separator = ' ',
                            LikeLines like = LikeLines::all);

/// Text under construction.
class TextBuffer {
 public:
  explicit TextBuffer(std::size_t expected) { text_.resize(expected); }

  void append(std::string_view piece) {
    make_room(piece.size());
    // The common case is one space between two numbers.
    if (piece.size() == 1) {
      text_[used_] = piece[0];
    } else {
      piece.copy(text_.data() + used_, piece.size());
    }
    used_ += piece.size();
  }
  void append_fixed(double value, unsigned decimals, CommaStyle commas = CommaStyle::none);
  void append_shortest(double value, CommaStyle commas = CommaStyle::none);
  /// Appends `lead` and the shortest digits, for each value.
  void append_each(std::string_view lead, std::initializer_list<double> values) {
    for (const double value : values) {
      append(lead);
      append_shortest(value);
    }
  }
  std::string take() && {
    text_.resize(used_);
    return std::move(text_);
  }

 private:
  template <class Write>
  void append_number(double value, CommaStyle commas, Write write);
  void make_room(std::size_t count) {
    if (text_.size() - used_ < count) text_.resize(text_.size() + text_.size() / 2 + count);
  }

  std::string text_;
  std::size_t used_ = 0;
};

}  // namespace kinemend
