#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

#include "io/bvh.hpp"
#include "io/bvh_document.hpp"
#include "io/bvh_hierarchy.hpp"
#include "io/memory_limit.hpp"
#include "io/motion_columns.hpp"
#include "io/motion_lines.hpp"
#include "io/motion_rows.hpp"
#include "io/text.hpp"

namespace kinemend {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double rate_when_unknown_hz = 30;

class MotionReader {
 public:
  MotionReader(const SourceText& text, Diagnostics& diagnostics, const BvhHeader& header,
               Clip& clip, BvhDocument& document)
      : text_(text),
        diagnostics_(diagnostics),
        header_(header),
        clip_(clip),
        document_(document),
        columns_(clip.skeleton),
        joints_(clip.joint_count()) {}

  void read() {
    clip_.translated_joints.assign(columns_.translated_joints().begin(),
                                   columns_.translated_joints().end());
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
    reserve(header_.frames.value_or(0));
    const std::size_t rest = read_rows(rows);
    check_end(rows, rest);
    note_repairs(rows);
    fill_leading_gaps();
    document_.data_end = static_cast<std::size_t>(rows.last_end() - text_.bytes.data());
    document_.decimals = rows.most_decimals();
    keep_first_frame(rows);
  }

 private:
  std::size_t frames() const { return clip_.frame_count(); }
  std::size_t bytes_per_frame() const {
    return joints_ * sizeof(Quat) + (1 + clip_.translated_joints.size()) * sizeof(Vec3);
  }

  void note_count(std::string_view message) {
    note_repair(text_, diagnostics_, "frame_count_mismatch", header_.frame_count.begin, message);
  }

  // A wrong count is repaired; one that is wrong beyond belief is a sign that the rest is not to be
  // trusted either.
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
          fmt::format("expected {} channel values; commas may be decimal or stand between values",
                      columns_.count()));
    }
    return style;
  }

  // For `expected` frames, but never for more than the file can hold.
  void reserve(std::size_t expected) {
    const auto most = static_cast<std::size_t>(end_ - begin_) / (2 * columns_.count()) + 1;
    const std::size_t affordable = memory_limit(text_.bytes.size()) / bytes_per_frame();
    const std::size_t count = std::min({expected, most, affordable});
    clip_.local_rotations.reserve(count * joints_);
    clip_.root_positions.reserve(count);
    clip_.joint_translations.reserve(count * clip_.translated_joints.size());
  }

  // Returns how many values are left over after the last whole frame.
  std::size_t read_rows(MotionRows& rows) {
    const std::size_t width = columns_.count(), block = columns_.block_frames();
    std::vector<double> values(block * width);
    std::size_t filled = 0, gaps_before = 0, rest = 0;
    do {
      rest = rows.next(values.data() + filled * width, width);
      if (rest == width) {
        ++filled;
        uneven_lines_ = uneven_lines_ || !(rows.at_line_start() || rows.at_end());
      }
      if (filled == block || (rest < width && filled > 0)) {
        store(values.data(), filled, rows.gaps() > gaps_before);
        gaps_before = rows.gaps();
        filled = 0;
      }
    } while (rest == width);
    return rest;
  }

  void store(double* values, std::size_t count, bool with_gaps) {
    const std::size_t first = frames();
    if ((first + count) * bytes_per_frame() > memory_limit(text_.bytes.size())) {
      throw text_.error_at(
          header_.data_begin,
          fmt::format("{} joints with {} channels: too much memory for a file of {} bytes", joints_,
                      columns_.count(), text_.bytes.size()));
    }
    // More frames than declared: room for all there can be, at once rather than by doubling.
    if ((first + count) * joints_ > clip_.local_rotations.capacity()) {
      reserve(std::numeric_limits<std::size_t>::max());
    }
    clip_.local_rotations.resize((first + count) * joints_);
    Quat* const rotations = clip_.local_rotations.data() + first * joints_;
    columns_.decode_rotations(values, count, rotations);
    if (with_gaps) hold(values, count, rotations);
    store_positions(values, count);
  }

  void hold(double* values, std::size_t count, Quat* rotations) {
    const std::size_t first = frames();
    clip_.observed.resize((first + count) * joints_, 1);
    const std::vector<Quat> unknown(first == 0 ? joints_ : 0, Quat{not_a_number, 0, 0, 0});
    hold_rotations(rotations, count, joints_, first == 0 ? unknown.data() : rotations - joints_,
                   clip_.observed.data() + first * joints_);
    std::vector<double> previous;
    for (const auto& position : columns_.positions()) {
      previous.push_back(first == 0 ? not_a_number : position_value(first - 1, position));
    }
    hold_positions(values, count, columns_, previous);
  }

  double& position_value(std::size_t frame, const MotionColumns::Position& position) {
    Vec3& vector = position.translated < 0
                       ? clip_.root_positions[frame]
                       : clip_.joint_translations[frame * clip_.translated_joints.size() +
                                                  static_cast<std::size_t>(position.translated)];
    return position.axis == Axis::x ? vector.x : position.axis == Axis::y ? vector.y : vector.z;
  }

  void store_positions(const double* values, std::size_t count) {
    const std::size_t first = frames();
    const auto& offsets = clip_.skeleton.offsets;
    clip_.root_positions.resize(first + count, offsets[0]);
    for (std::size_t f = 0; f < count && !clip_.translated_joints.empty(); ++f) {
      for (const std::int32_t joint : clip_.translated_joints) {
        clip_.joint_translations.push_back(offsets[static_cast<std::size_t>(joint)]);
      }
    }
    for (std::size_t f = 0; f < count; ++f) {
      for (const auto& position : columns_.positions()) {
        position_value(first + f, position) = values[f * columns_.count() + position.column];
      }
    }
  }

  void check_end(const MotionRows& rows, std::size_t rest) {
    const bool wanted = frames() < header_.frames.value_or(frames() == 0 ? 1 : 0);
    if (!rows.at_end() && (rest > 0 || wanted)) {
      TextScanner scanner(text_.bytes,
                          static_cast<std::size_t>(rows.position() - text_.bytes.data()));
      const std::string_view found = scanner.peek();
      throw text_.error_at(scanner.position(),
                           fmt::format("expected a number, found {}", quote(found)));
    }
    const bool wrong_count = header_.frames && *header_.frames != frames();
    if (rest > 0 || uneven_lines_ || wrong_count) {
      const auto fault = find_line_fault(begin_, rows.position(), document_.commas,
                                         columns_.count(), header_.frames);
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
      note_repair(text_, diagnostics_, "trailing_text",
                  static_cast<std::size_t>(rows.position() - text_.bytes.data()),
                  "text after the last frame");
    }
  }

  void note_repairs(const MotionRows& rows) {
    const auto note = [&](const char* place, std::size_t count, std::string_view kind,
                          std::string_view message) {
      if (count == 0) return;
      note_repair(text_, diagnostics_, kind, static_cast<std::size_t>(place - text_.bytes.data()),
                  message, count);
    };
    if (rows.gaps() > 0 && rows.gaps() == frames() * columns_.count()) {
      throw text_.error_at(rows.first_gap(), "no channel value is a finite number");
    }
    note(rows.first_gap(), rows.gaps(), "value_not_finite",
         "a channel value is no finite number: held from a neighbouring frame");
    note(rows.first_comment(), rows.comments(), "comment_skipped",
         "a comment, which the format does not have");
    if (document_.commas == CommaStyle::decimal)
      note(begin_, 1, "decimal_comma", "numbers have decimal commas");
    if (document_.commas == CommaStyle::separator)
      note(begin_, 1, "comma_separator", "commas stand between values");
  }

  // Samples before the first finite one take its value; without any, the rest pose.
  void fill_leading_gaps() {
    if (clip_.observed.empty()) return;
    clip_.observed.resize(frames() * joints_, 1);
    for (std::size_t j = 0; j < joints_; ++j) {
      std::size_t known = 0;
      while (known < frames() && is_gap(clip_.rotation(known, j))) ++known;
      const Quat value = known < frames() ? clip_.rotation(known, j) : Quat{};
      for (std::size_t f = 0; f < known; ++f) clip_.rotation(f, j) = value;
    }
    for (const auto& position : columns_.positions()) {
      std::size_t known = 0;
      while (known < frames() && std::isnan(position_value(known, position))) ++known;
      const double value =
          known < frames() ? position_value(known, position) : offset_value(position);
      for (std::size_t f = 0; f < known; ++f) position_value(f, position) = value;
    }
    const auto& observed = clip_.observed;
    if (std::find(observed.begin(), observed.end(), 0) == observed.end()) clip_.observed.clear();
  }

  double offset_value(const MotionColumns::Position& position) const {
    const std::int32_t joint =
        position.translated < 0
            ? 0
            : clip_.translated_joints[static_cast<std::size_t>(position.translated)];
    const Vec3 offset = clip_.skeleton.offsets[static_cast<std::size_t>(joint)];
    return position.axis == Axis::x ? offset.x : position.axis == Axis::y ? offset.y : offset.z;
  }

  void keep_first_frame(const MotionRows& rows) {
    document_.has_gaps = rows.gaps() > 0;
    if (!document_.has_gaps) return;
    document_.first_rotations.assign(
        clip_.local_rotations.begin(),
        clip_.local_rotations.begin() + static_cast<std::ptrdiff_t>(joints_));
    for (const auto& position : columns_.positions())
      document_.first_positions.push_back(position_value(0, position));
  }

  const SourceText& text_;
  Diagnostics& diagnostics_;
  const BvhHeader& header_;
  Clip& clip_;
  BvhDocument& document_;
  MotionColumns columns_;
  std::size_t joints_;
  const char* begin_ = nullptr;
  const char* end_ = nullptr;
  bool uneven_lines_ = false;
};

}  // namespace

int sniff_bvh(std::string_view head) {
  if (head.substr(0, 3) == "\xEF\xBB\xBF") head.remove_prefix(3);
  TextScanner scanner(head, 0);
  const std::string_view word = scanner.next();
  if (equal_ignoring_case(word, "HIERARCHY")) return 100;
  return equal_ignoring_case(word, "ROOT") ? 60 : 0;
}

TakeResult read_bvh(std::string bytes, std::string_view name, const ReadOptions& options) {
  const auto document = std::make_shared<BvhDocument>();
  document->bytes = std::move(bytes);
  const SourceText text{name, document->bytes, options.strict};
  TakeResult result;
  const BvhHeader header = read_bvh_header(text, result.diagnostics, options.max_depth);
  Clip& clip = result.take.emplace<Clip>();
  clip.skeleton = header.skeleton;
  clip.frame_rate_hz =
      header.frame_time_s > 0
          ? rate_from_frame_time(header.frame_time_s, document->text(header.frame_time))
          : rate_when_unknown_hz;
  MotionReader(text, result.diagnostics, header, clip, *document).read();
  document->skeleton = clip.skeleton;
  document->frame_rate_hz = clip.frame_rate_hz;
  document->frame_count = clip.frame_count();
  document->hierarchy_end = header.hierarchy_end;
  document->frame_time = header.frame_time;
  clip.source = {std::string(name), "bvh", document};
  return result;
}

}  // namespace kinemend
