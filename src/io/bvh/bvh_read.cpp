// Reads BVH files as takes of joints, and repairs damage.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

#include "base/parallel.hpp"
#include "io/bvh/bvh.hpp"
#include "io/bvh/bvh_hierarchy.hpp"
#include "io/motion/clip_rows.hpp"
#include "io/motion/motion_columns.hpp"
#include "io/motion/motion_document.hpp"
#include "io/motion/motion_rows.hpp"
#include "io/text/text.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

// Chosen by hand (docs/formats/bvh.md).
constexpr double bvh_rate_when_unknown_hz = 30;

class MotionReader {
 public:
  MotionReader(const SourceText& text, const ReadOptions& options, const BvhHeader& header,
               Take& clip, BvhDocument& document)
      : text_(text),
        progress_(options.progress),
        header_(header),
        clip_(clip),
        document_(document),
        clip_rows_(clip, offset_replacing_frames(clip.skeleton), text.bytes.size()),
        columns_(clip_rows_.columns()) {}

  void read() {
    document_.data_begin = document_.data_end = header_.data_begin;
    if (!header_.has_motion) return;
    if (columns_.count() == 0) {
      if (header_.frames.value_or(0) > 0)
        note_count("the joints have no channels: the take has no frames");
      return;
    }
    check_declared_count();
    begin_ = text_.bytes.data() + header_.data_begin;
    end_ = text_.bytes.data() + text_.bytes.size();
    document_.commas = find_comma_style();
    MotionRows rows(begin_, end_, document_.commas);
    clip_rows_.reserve(header_.frames.value_or(0), most_frames());
    const std::size_t rest = read_rows(rows);
    const bool is_cut = row_begin_ != nullptr && ends_in_row(rows, rest);
    if (is_cut) {
      note_cut();
    } else {
      check_end(rows, rest);
    }
    note_repairs(rows);
    clip_rows_.finish(document_, rows.found().gaps.count > 0);
    document_.data_end = text_.offset_of(is_cut ? row_begin_ : rows.last_end());
    document_.decimals = rows.found().most_decimals;
    if (is_cut) leave_out_cut_row();
    separate_numbers(document_, rows.found().joins);
  }

 private:
  std::size_t frames() const { return clip_rows_.frames(); }
  std::size_t most_frames() const {
    return static_cast<std::size_t>(end_ - begin_) / (2 * columns_.count()) + 1;
  }

  void note_count(std::string_view message) {
    text_.note("frame_count_mismatch", header_.frame_count.begin, message);
  }

  // A wrong count is repaired; a count that is impossibly large shows that the rest of the file
  // cannot be trusted.
  void check_declared_count() const {
    const double least_bytes = 2.0 * static_cast<double>(header_.frames.value_or(0)) *
                               static_cast<double>(columns_.count());
    const std::size_t rest = text_.bytes.size() - header_.data_begin;
    if (least_bytes > 64.0 * static_cast<double>(rest + 1024)) {
      throw text_.error_at(header_.frame_count.begin,
                           fmt::format("{} frames of {} channel values cannot be in {} bytes",
                                       *header_.frames, columns_.count(), rest));
    }
  }

  CommaStyle find_comma_style() const {
    if (std::memchr(begin_, ',', static_cast<std::size_t>(end_ - begin_)) == nullptr)
      return CommaStyle::none;
    TextScanner scanner(text_.bytes, header_.data_begin);
    scanner.peek();
    const std::string_view line = scanner.rest_of_line();
    const CommaStyle style = comma_style(line, columns_.count());
    if (style == CommaStyle::none && line.find(',') != line.npos) {
      throw text_.error_at(
          scanner.position(),
          fmt::format("expected {} channel values; commas may be decimal points or separate values",
                      columns_.count()));
    }
    return style;
  }

  struct Block {
    std::vector<double> values;
    std::size_t frames = 0;
    const char* end = nullptr;
  };

  // Reads numbers while the numbers of the previous block become rotations. Returns how many values
  // are left over after the last whole frame.
  std::size_t read_rows(MotionRows& rows) {
    // A block is stored before the block four places behind it is read, which reuses its slot.
    std::array<Block, 4> blocks;
    std::size_t rest = columns_.count();
    const auto read = [&](std::size_t slot) {
      if (rest < columns_.count()) return false;
      rest = read_block(rows, blocks[slot]);
      return true;
    };
    PieceStages stages;
    stages.append = [&](std::size_t slot) { store(blocks[slot]); };
    for_each_piece(blocks.size(), read, stages);
    return rest;
  }

  // Returns how many values the last row has; at the end it may be fewer than the columns.
  std::size_t read_block(MotionRows& rows, Block& block) {
    const std::size_t width = columns_.count();
    block.values.resize(columns_.block_frames() * width);
    block.frames = 0;
    std::size_t count = width;
    while (block.frames < columns_.block_frames()) {
      row_begin_ = rows.position();
      count = rows.next(block.values.data() + block.frames * width, width);
      const bool is_last = count == width && rows.last_end() == end_;
      if (is_last && rows_read_ > 0 && last_value_may_be_cut()) count = 0;
      if (count < width) break;
      ++rows_read_;
      ++block.frames;
      uneven_lines_ = uneven_lines_ || !(rows.at_line_start() || rows.at_end());
    }
    block.end = rows.position();
    return count;
  }

  void store(Block& block) {
    if (block.frames == 0) return;
    const std::size_t wanted = frames() + block.frames;
    if (!clip_rows_.fits(wanted)) {
      throw text_.error_at(
          header_.data_begin,
          fmt::format("{} joints with {} channels: too much memory for a file of {} bytes",
                      clip_.joint_count(), columns_.count(), text_.bytes.size()));
    }
    // The file has more frames than declared: reserves memory for all possible frames at once
    // instead of doubling.
    if (wanted * clip_.joint_count() > clip_.rotations.capacity()) {
      clip_rows_.reserve(std::numeric_limits<std::size_t>::max(), most_frames());
    }
    clip_rows_.append(block.values.data(), block.frames);
    progress_.reach(static_cast<double>(block.end - begin_) / static_cast<double>(end_ - begin_));
  }

  bool last_value_may_be_cut() {
    value_is_cut_ =
        last_number_may_be_cut({begin_, static_cast<std::size_t>(end_ - begin_)}, document_.commas);
    return value_is_cut_;
  }

  // Finds the faulty line in the rows up to `end`, which leave over `rest` values. If the number of
  // frames is as declared, frames may be wrapped over lines, even over the same number of lines.
  std::optional<LineFault> line_fault(const char* end, std::size_t rest) const {
    const bool as_declared = rest == 0 && header_.frames == frames();
    return find_line_fault(begin_, end, document_.commas, columns_.count(),
                           as_declared ? std::nullopt : header_.frames);
  }

  // Whether the file was cut off in the last row and all rows before it are complete.
  bool ends_in_row(const MotionRows& rows, std::size_t rest) const {
    if (frames() == 0) return false;
    // The output ends before the row and must be readable too.
    if (value_is_cut_) return !line_fault(row_begin_, 0);
    const bool in_word =
        !rows.at_end() && std::none_of(rows.position(), end_, is_space) &&
        may_start_number({rows.position(), static_cast<std::size_t>(end_ - rows.position())});
    if (!in_word && (rest == 0 || !rows.at_end())) return false;
    if (in_word && rest == 0 && frames() >= header_.frames.value_or(0)) return false;
    // A short line with a line end, or an earlier short line, is another fault.
    const bool ends_with_line = is_line_end(end_[-1]);
    const char* const whole = ends_with_line ? rows.last_end() : row_begin_;
    return !find_line_fault(begin_, whole, document_.commas, columns_.count(), std::nullopt) &&
           !line_fault(row_begin_, 0);
  }

  void note_cut() {
    text_.note("file_cut", row_begin_,
               fmt::format("the file ends in the middle of frame {}: the {} before it {} read",
                           frames() + 1, frames() == 1 ? "frame" : "frames",
                           frames() == 1 ? "is" : "are"));
    if (header_.frames && *header_.frames < frames())
      note_count(fmt::format("Frames: says {}, the file holds {}", *header_.frames, frames()));
  }

  // Removes the cut row from the document and writes the actual number of frames over the old
  // number, so that outputs are complete.
  void leave_out_cut_row() {
    document_.bytes.resize(text_.offset_of(row_begin_));
    // If the row starts within a word, the bytes end with a number that would look cut.
    if (!is_space(document_.bytes.back())) document_.bytes += '\n';
    std::string count = std::to_string(frames());
    if (!header_.frames || count.size() > header_.frame_count.size) return;
    count.resize(header_.frame_count.size, ' ');
    document_.bytes.replace(header_.frame_count.begin, header_.frame_count.size, count);
  }

  void check_end(const MotionRows& rows, std::size_t rest) {
    const bool wanted = frames() < header_.frames.value_or(frames() == 0 ? 1 : 0);
    if (!rows.at_end() && (rest > 0 || wanted)) {
      TextScanner scanner(text_.bytes, text_.offset_of(rows.position()));
      const std::string_view found = scanner.peek();
      throw text_.error_at(scanner.position(),
                           fmt::format("expected a number, found {}", quote(found)));
    }
    const bool wrong_count = header_.frames && *header_.frames != frames();
    if (rest > 0 || uneven_lines_ || wrong_count || value_is_cut_) {
      const auto fault = line_fault(value_is_cut_ ? row_begin_ : rows.position(), rest);
      if (fault) throw text_.error_at(fault->place, to_string(*fault));
    }
    if (rest > 0) {
      throw text_.error_at(rows.last_end(), to_string(LineFault{nullptr, columns_.count(), rest}));
    }
    if (wanted && frames() == 0 && header_.frames) {
      throw text_.error_at(rows.position(),
                           fmt::format("expected {} frames, found none", *header_.frames));
    }
    if (wrong_count)
      note_count(fmt::format("Frames: says {}, the file holds {}", *header_.frames, frames()));
    if (!rows.at_end()) {
      text_.note("trailing_text", rows.position(), "text after the last frame");
    }
  }

  void note_repairs(const MotionRows& rows) {
    const auto& [decimals, gaps, comments, joins] = rows.found();
    if (gaps.count > 0 && gaps.count == frames() * columns_.count())
      throw text_.error_at(gaps.first, "every channel value is not finite");
    text_.note("value_not_finite", gaps,
               "a channel value is not finite: held from a neighbouring frame");
    note_joined_numbers(text_, joins);
    text_.note("comment_skipped", comments, "comments are not part of the format: skipped");
    if (document_.commas == CommaStyle::decimal)
      text_.note("decimal_comma", begin_, "numbers have decimal commas");
    if (document_.commas == CommaStyle::separator)
      text_.note("comma_separator", begin_, "commas separate the values");
  }

  const SourceText& text_;
  ShareProgress progress_;
  const BvhHeader& header_;
  Take& clip_;
  BvhDocument& document_;
  ClipRows clip_rows_;
  const MotionColumns& columns_;
  const char* begin_ = nullptr;
  const char* end_ = nullptr;
  const char* row_begin_ = nullptr;  // beginning of the row that was read last
  std::size_t rows_read_ = 0;
  bool uneven_lines_ = false;
  bool value_is_cut_ = false;  // the last value may have lost digits
};

}  // namespace

int sniff_bvh(std::string_view head) {
  head = without_byte_order_mark(head);
  TextScanner scanner(head, 0);
  const std::string_view word = scanner.next();
  if (equal_ignoring_case(word, "HIERARCHY")) return 100;
  return equal_ignoring_case(word, "ROOT") ? 60 : 0;
}

TakeResult read_bvh(std::string bytes, std::string_view name, const ReadOptions& options) {
  const auto document = std::make_shared<BvhDocument>();
  document->bytes = std::move(bytes);
  TakeResult result;
  const SourceText text{name, document->bytes, options.strict, &result.diagnostics};
  const double unknown_rate_hz =
      options.frame_rate_hz > 0 ? options.frame_rate_hz : bvh_rate_when_unknown_hz;
  const BvhHeader header = read_bvh_header(text, options.max_depth, unknown_rate_hz);
  Take& clip = result.take;
  clip.skeleton = header.skeleton;
  clip.frame_rate_hz =
      header.frame_time_s > 0
          ? rate_from_frame_time(header.frame_time_s, document->text(header.frame_time))
          : unknown_rate_hz;
  MotionReader(text, options, header, clip, *document).read();
  document->skeleton = clip.skeleton;
  document->frame_rate_hz = clip.frame_rate_hz;
  document->frame_count = clip.frame_count();
  document->hierarchy_end = header.hierarchy_end;
  document->frame_time = header.frame_time;
  document->frame_time_is_none = header.frame_time_is_none;
  document->frame_time_is_unusable = header.frame_time.size > 0 && !(header.frame_time_s > 0);
  if (header.frames != clip.frame_count()) document->wrong_frame_count = header.frame_count;
  clip.source = {std::string(name), "bvh", document};
  return result;
}

}  // namespace kinemend
