// Decodes the frames of a document again with the reader's repairs, chooses new values in the order
// of the frames, and writes blocks of the text in parallel.
#include "io/motion/motion_document.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "io/held_samples.hpp"
#include "motion/rotation.hpp"

namespace kinemend {

namespace {

/// A block of frames of a document's text. Position columns are repaired; angles are as in the
/// file, in degrees.
struct SourceBlock {
  std::size_t first = 0;  ///< frame
  std::size_t count = 0;  ///< frames
  std::size_t width = 0;  ///< values of a frame
  std::size_t joints = 0;
  std::vector<double> values;
  std::vector<TokenSpan> places;
  std::vector<Quat> turns;

  const double* row(std::size_t frame) const { return values.data() + frame * width; }
  const TokenSpan* tokens(std::size_t frame) const { return places.data() + frame * width; }
  const Quat* rotations(std::size_t frame) const { return turns.data() + frame * joints; }
};

/// Decodes the frames of a document's text as its reader did, a block at a time.
class SourceFrames {
 public:
  explicit SourceFrames(const MotionDocument& document)
      : document_(document),
        columns_(document.skeleton),
        last_rotations_(document.first_rotations),
        last_positions_(document.first_positions),
        text_(document.rows()) {}

  const MotionColumns& columns() const { return columns_; }

  /// Reads the next block, reusing its memory; false after the last.
  bool next(SourceBlock& block) {
    block.first = next_;
    block.count = std::min(columns_.block_frames(), document_.frame_count - next_);
    block.width = columns_.count();
    block.joints = document_.skeleton.joint_count();
    if (block.count == 0) return false;
    next_ += block.count;
    block.values.resize(block.count * block.width);
    block.places.resize(block.count * block.width);
    block.turns.resize(block.count * block.joints);
    text_->next(block.values.data(), block.count, block.places.data());
    columns_.decode_rotations(block.values.data(), block.count, block.turns.data());
    if (document_.has_gaps) hold(block);
    return true;
  }

 private:
  // Replaces each value that is not finite by the value of the frame before.
  void hold(SourceBlock& block) {
    for (std::size_t f = 0; f < block.count; ++f) {
      for (std::size_t j = 0; j < block.joints; ++j) {
        Quat& turn = block.turns[f * block.joints + j];
        if (is_missing(turn)) turn = last_rotations_[j];
        last_rotations_[j] = turn;
      }
      for (std::size_t i = 0; i < last_positions_.size(); ++i) {
        double& value = block.values[f * block.width + columns_.positions()[i].column];
        if (std::isnan(value)) value = last_positions_[i];
        last_positions_[i] = value;
      }
    }
  }

  const MotionDocument& document_;
  MotionColumns columns_;
  std::size_t next_ = 0;  // frame
  std::vector<Quat> last_rotations_;
  std::vector<double> last_positions_;
  std::unique_ptr<RowReader> text_;
};

using Angles = std::array<double, 3>;

// All values of a source, and which rotations the clip keeps.
struct SourceTable {
  SourceTable(const Take& clip, const MotionDocument& document) {
    const std::size_t joints = clip.joint_count();
    SourceFrames source(document);
    SourceBlock block;
    width = source.columns().count();
    while (source.next(block)) {
      values.insert(values.end(), block.values.begin(), block.values.end());
      const Quat* const now = clip.rotations.data() + block.first * joints;
      for (std::size_t i = 0; i < block.count * joints; ++i) {
        kept.push_back(now[i] == block.rotations(0)[i] ? 1 : 0);
      }
    }
  }

  std::size_t width = 0;
  std::vector<double> values;      // F x channels
  std::vector<std::uint8_t> kept;  // F x J
};

// Whether two triples of angles differ by less than a quarter turn, and so are on the same branch
// and turn.
bool near(const Angles& a, const Angles& b, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!(std::fabs(a[i] - b[i]) < pi / 2)) return false;
  }
  return true;
}

// The angles last written for a joint, and their frame plus one.
struct WrittenAngles {
  Angles angles{};
  std::size_t frames = 0;
};

// A changed sample in the text.
struct Replacement {
  std::size_t column = 0;
  double value = 0;
  TokenSpan place;
};

// A group of frames of the text while it is rewritten.
struct Piece {
  SourceBlock source;
  std::string_view text;                  // source text from the end of the block before
  std::vector<Replacement> replacements;  // in the order of the text
  std::string rewritten;

  void write(unsigned decimals, CommaStyle commas) {
    TextBuffer out(text.size() + text.size() / 8 + fixed_number_room);
    const char* copied = text.data();
    const auto copy_until = [&](const char* place) {
      out.append({copied, static_cast<std::size_t>(place - copied)});
    };
    for (const Replacement& replacement : replacements) {
      copy_until(replacement.place.begin);
      out.append_fixed(replacement.value, decimals, commas);
      copied = replacement.place.end;
    }
    copy_until(text.data() + text.size());
    rewritten = std::move(out).take();
  }
};

class MotionRewriter {
 public:
  MotionRewriter(const Take& clip, const MotionDocument& document)
      : clip_(clip),
        document_(document),
        source_(document),
        decimals_(document.written_decimals()),
        keep_below_(0.5 * portable::pow(10.0, -static_cast<double>(decimals_))),
        written_(clip.joint_count()),
        row_before_(source_.columns().count()),
        copied_(document.bytes.data()) {}

  // A frame's angles depend on the previous frame's, so they are chosen in order; numbers are read
  // and written in parallel.
  std::string rewrite(const std::vector<DocumentEdit>& edits) {
    // For speed, not swept.
    constexpr std::size_t pieces_at_once = 16;
    std::string out;
    out.reserve(document_.bytes.size() + document_.bytes.size() / 8 + 4096);
    for (const DocumentEdit& edit : edits) {
      out.append(text_until(document_.bytes.data() + edit.place.begin));
      out.append(edit.text);
      copied_ += edit.place.size;
    }
    // A piece is written before the piece `pieces_at_once` behind it is read, which reuses its
    // slot.
    std::vector<Piece> pieces(pieces_at_once);
    const auto read = [&](std::size_t slot) {
      Piece& piece = pieces[slot];
      if (!source_.next(piece.source)) return false;
      piece.text = text_until(end_of(piece.source));
      return true;
    };
    PieceStages stages;
    stages.choose = [&](std::size_t slot) { replace_samples(pieces[slot]); };
    stages.write = [&](std::size_t slot) { pieces[slot].write(decimals_, document_.commas); };
    stages.append = [&](std::size_t slot) { out.append(pieces[slot].rewritten); };
    for_each_piece(pieces.size(), read, stages);
    out.append(text_until(document_.bytes.data() + document_.bytes.size()));
    return out;
  }

 private:
  // The known angles when the angles of a changed sample are chosen; null if unknown.
  struct AngleContext {
    std::size_t frame = 0;
    std::size_t joint = 0;
    const Angles* written_before = nullptr;  // angles written for the frame before
    const Angles* source_before = nullptr;   // angles of the frame before in the source
    const Angles* source = nullptr;
  };

  std::string_view text_until(const char* place) {
    const char* const begin = std::exchange(copied_, place);
    return {begin, static_cast<std::size_t>(place - begin)};
  }

  const char* end_of(const SourceBlock& block) const {
    if (block.width == 0) return copied_;
    const TokenSpan* const last = block.tokens(block.count - 1);
    return std::max_element(last, last + block.width,
                            [](TokenSpan a, TokenSpan b) { return a.end < b.end; })
        ->end;
  }

  void replace_samples(Piece& piece) {
    const SourceBlock& source = piece.source;
    piece.replacements.clear();
    for (std::size_t f = 0; f < source.count; ++f) {
      replacements_.clear();
      rewrite_frame(source, f);
      if (document_.has_gaps) replace_position_gaps(source, f);
      put_in_order(source.tokens(f));
      piece.replacements.insert(piece.replacements.end(), replacements_.begin(),
                                replacements_.end());
    }
    const double* const last = source.row(source.count - 1);
    row_before_.assign(last, last + source.width);
  }

  void rewrite_frame(const SourceBlock& source, std::size_t block_frame) {
    const std::size_t frame = source.first + block_frame, joints = clip_.joint_count();
    const double* const row = source.row(block_frame);
    replace_positions(frame, row);
    const Quat* const before = source.rotations(block_frame);
    const Quat* const now = clip_.rotations.data() + frame * joints;
    const double* const row_before =
        block_frame > 0 ? source.row(block_frame - 1) : row_before_.data();
    for (std::size_t j = 0; j < joints; ++j) {
      if (!(now[j] == before[j]) || (document_.has_gaps && holds_gap(j, row)))
        replace_rotation(frame, j, row, row_before);
    }
  }

  // Whether the source has a value that is not finite, which is always replaced, whatever the clip
  // holds.
  bool holds_gap(std::size_t joint, const double* row) const {
    const MotionColumns::Rotation& rotation = source_.columns().rotations()[joint];
    Angles ignored{};
    return !source_angles(rotation, row, ignored);
  }

  // The rows hold repaired positions; only the text shows which values were not finite.
  void replace_position_gaps(const SourceBlock& source, std::size_t block_frame) {
    const double* const row = source.row(block_frame);
    const TokenSpan* const tokens = source.tokens(block_frame);
    for (const MotionColumns::Position& position : source_.columns().positions()) {
      const auto [begin, end] = tokens[position.column];
      if (read_sample(begin, end, document_.commas).kind != TokenKind::not_finite) continue;
      const auto is_here = [&](const Replacement& r) { return r.column == position.column; };
      if (std::none_of(replacements_.begin(), replacements_.end(), is_here))
        replacements_.push_back({position.column, row[position.column], {}});
    }
  }

  // The columns of a joint are adjacent, so each run of them is one position.
  void replace_positions(std::size_t frame, const double* row) {
    const auto positions = source_.columns().positions();
    for (std::size_t i = 0, end = 0; i < positions.size(); i = end) {
      const std::int32_t translated = positions[i].translated;
      const PositionFrame& in_file = document_.position_frames[frame_index(translated)];
      Vec3 before = in_file.rest;
      for (end = i; end < positions.size() && positions[end].translated == translated; ++end) {
        component_of(before, positions[end].axis) = row[positions[end].column];
      }
      const Vec3 now = position_of(clip_, frame, translated);
      if (now == in_file.to_clip(before)) continue;
      const Vec3 wanted = in_file.to_file(now);
      for (; i < end; ++i) {
        const double value = component(wanted, positions[i].axis);
        if (value != row[positions[i].column]) replace(row, positions[i].column, value, 1);
      }
    }
  }

  // Reads the source's angles; returns false if a value is missing.
  static bool source_angles(const MotionColumns::Rotation& rotation, const double* row,
                            Angles& angles) {
    bool known = true;
    for (std::size_t i = 0; i < rotation.order.count; ++i) {
      double degrees = row[rotation.columns[i]];
      known = known && !std::isnan(degrees);
      // An angle of this many turns has no digits left after the point.
      if (std::fabs(degrees) > 1e9) degrees = std::fmod(degrees, 360.0);
      angles[i] = degrees * radians_per_degree;
    }
    return known;
  }

  void replace_rotation(std::size_t frame, std::size_t joint, const double* row,
                        const double* row_before) {
    const MotionColumns::Rotation& rotation = source_.columns().rotations()[joint];
    WrittenAngles& written = written_[joint];
    Angles source{}, source_before{};
    AngleContext context{frame, joint};
    if (source_angles(rotation, row, source)) context.source = &source;
    if (frame > 0 && source_angles(rotation, row_before, source_before)) {
      context.source_before = &source_before;
    }
    const Angles* const last_written = written.frames > 0 ? &written.angles : nullptr;
    const bool changed_before = written.frames > 0 && written.frames == frame;
    context.written_before =
        changed_before || context.source_before == nullptr ? last_written : context.source_before;
    written = {choose_angles(rotation.order, context), frame + 1};
    for (std::size_t i = 0; i < rotation.order.count; ++i) {
      replace(row, rotation.columns[i], written.angles[i] * degrees_per_radian,
              document_.degrees_per_value);
    }
  }

  // Chooses angles that continue the frame before. If the source itself jumps (by a whole turn, or
  // to its other branch), and a later frame that keeps its digits would need a jump anyway, the
  // jump stays in its place.
  Angles choose_angles(RotationOrder order, const AngleContext& context) {
    const Quat rotation = clip_.rotation(context.frame, context.joint);
    const Angles rest{};
    if (context.written_before == nullptr) {
      return to_euler_near(rotation, order, context.source != nullptr ? *context.source : rest);
    }
    const Angles continued = to_euler_near(rotation, order, *context.written_before);
    const bool source_jumps = context.source != nullptr && context.source_before != nullptr &&
                              !near(*context.source, *context.source_before, order.count);
    if (!source_jumps || near(continued, *context.source, order.count)) return continued;
    if (!meets_a_jump(context, continued)) return continued;
    const Angles on_source = to_euler_near(rotation, order, *context.source);
    return near(on_source, *context.source, order.count) ? on_source : continued;
  }

  // Whether angles that continue `angles` without a jump differ from the digits of the next frame
  // that keeps them. Few takes need this, and the table requires reading the text again.
  bool meets_a_jump(const AngleContext& context, Angles angles) {
    // For speed, not swept.
    constexpr std::size_t most_frames_ahead = 256;
    if (!table_) table_.emplace(clip_, document_);
    const std::size_t joints = clip_.joint_count();
    const std::size_t end = std::min(document_.frame_count, context.frame + most_frames_ahead);
    const MotionColumns::Rotation& rotation = source_.columns().rotations()[context.joint];
    for (std::size_t f = context.frame + 1; f < end; ++f) {
      angles = to_euler_near(clip_.rotation(f, context.joint), rotation.order, angles);
      Angles kept{};
      if (table_->kept[f * joints + context.joint] != 0 &&
          source_angles(rotation, table_->values.data() + f * table_->width, kept)) {
        return !near(angles, kept, rotation.order.count);
      }
    }
    return false;
  }

  // Replaces a value, unless the old digits express it as accurately as the written decimals can.
  // `unit`: the size of the file's unit.
  void replace(const double* row, std::size_t column, double value, double unit) {
    if (std::fabs(value - row[column]) <= keep_below_ * unit) return;
    replacements_.push_back({column, value / unit, {}});
  }

  // Sorts replacements in the order of the text, which may differ from the order of the columns.
  void put_in_order(const TokenSpan* tokens) {
    for (Replacement& replacement : replacements_) replacement.place = tokens[replacement.column];
    const auto by_place = [](const Replacement& a, const Replacement& b) {
      return a.place.begin < b.place.begin;
    };
    if (!std::is_sorted(replacements_.begin(), replacements_.end(), by_place)) {
      std::sort(replacements_.begin(), replacements_.end(), by_place);
    }
  }

  const Take& clip_;
  const MotionDocument& document_;
  SourceFrames source_;
  unsigned decimals_;
  double keep_below_;
  std::vector<WrittenAngles> written_;
  std::optional<SourceTable> table_;
  std::vector<double> row_before_;
  std::vector<Replacement> replacements_;  // replacements of one frame
  const char* copied_;                     // end of the source text that has been copied
};

}  // namespace

std::string rewrite_motion(const Take& clip, const MotionDocument& document,
                           const std::vector<DocumentEdit>& edits) {
  return MotionRewriter(clip, document).rewrite(edits);
}

unsigned MotionDocument::written_decimals() const {
  // Chosen by hand.
  constexpr unsigned least = 4, least_of_radians = 6, most = 9;
  return std::clamp(decimals, degrees_per_value == 1 ? least : least_of_radians, most);
}

std::vector<double> MotionDocument::channel_values() const {
  std::vector<double> values;
  SourceFrames source(*this);
  SourceBlock block;
  values.reserve(frame_count * source.columns().count());
  while (source.next(block)) {
    values.insert(values.end(), block.values.begin(), block.values.end());
  }
  return values;
}

void note_joined_numbers(const SourceText& text, const std::vector<const char*>& places) {
  text.note("numbers_joined", places.empty() ? nullptr : places[0],
            "two numbers have no blank between them: the sign starts the second", places.size());
}

void separate_numbers(MotionDocument& document, const std::vector<const char*>& places) {
  if (places.empty()) return;
  std::string separated;
  separated.reserve(document.bytes.size() + places.size());
  std::size_t copied = 0, added = 0;
  for (const char* const p : places) {
    const auto place = static_cast<std::size_t>(p - document.bytes.data());
    if (place >= document.data_end) break;
    separated.append(document.bytes, copied, place - copied);
    separated += ' ';
    copied = place;
    ++added;
  }
  separated.append(document.bytes, copied);
  document.bytes = std::move(separated);
  document.data_end += added;
}

}  // namespace kinemend
