#include <algorithm>
#include <array>
#include <cmath>

#include "io/bvh_text.hpp"
#include "io/motion_columns.hpp"
#include "io/motion_rows.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

using Angles = std::array<double, 3>;

constexpr unsigned least_decimals = 4, most_decimals = 9;

double position_value(const Clip& clip, std::size_t frame,
                      const MotionColumns::Position& position) {
  const Vec3 vector = position.translated < 0
                          ? clip.root_positions[frame]
                          : clip.joint_translations[frame * clip.translated_joints.size() +
                                                    static_cast<std::size_t>(position.translated)];
  return position.axis == Axis::x ? vector.x : position.axis == Axis::y ? vector.y : vector.z;
}

// Which samples differ from what the document's text decodes to.
struct Changes {
  std::vector<std::uint8_t> rotations;  // F x J
  std::vector<std::size_t> kept_until;  // J: one past the last frame whose rotation is unchanged
  bool any = false;
};

class ChangeFinder {
 public:
  ChangeFinder(const Clip& clip, const BvhDocument& document)
      : clip_(clip),
        document_(document),
        columns_(document.skeleton),
        joints_(document.skeleton.joint_count()),
        previous_rotations_(document.first_rotations),
        previous_positions_(document.first_positions) {}

  Changes find() {
    const std::size_t width = columns_.count(), block = columns_.block_frames();
    changes_.rotations.resize(document_.frame_count * joints_);
    changes_.kept_until.resize(joints_);
    std::vector<double> rows(block * width);
    rotations_.resize(block * joints_);
    MotionRows source(document_.bytes.data() + document_.data_begin,
                      document_.bytes.data() + document_.data_end, document_.commas);
    for (std::size_t first = 0; first < document_.frame_count; first += block) {
      const std::size_t count = std::min(block, document_.frame_count - first);
      source.next(rows.data(), count * width);
      compare(first, count, rows.data());
    }
    return std::move(changes_);
  }

 private:
  void compare(std::size_t first, std::size_t count, double* rows) {
    columns_.decode_rotations(rows, count, rotations_.data());
    if (document_.has_gaps) {
      hold_rotations(rotations_.data(), count, joints_, previous_rotations_.data(), nullptr);
      hold_positions(rows, count, columns_, previous_positions_);
      previous_rotations_.assign(
          rotations_.begin() + static_cast<std::ptrdiff_t>((count - 1) * joints_),
          rotations_.begin() + static_cast<std::ptrdiff_t>(count * joints_));
      for (std::size_t i = 0; i < previous_positions_.size(); ++i) {
        previous_positions_[i] =
            rows[(count - 1) * columns_.count() + columns_.positions()[i].column];
      }
    }
    for (std::size_t f = 0; f < count; ++f) {
      compare_frame(first + f, rotations_.data() + f * joints_, rows + f * columns_.count());
    }
  }

  void compare_frame(std::size_t frame, const Quat* rotations, const double* row) {
    const Quat* const now = clip_.local_rotations.data() + frame * joints_;
    std::uint8_t* const changed = changes_.rotations.data() + frame * joints_;
    for (std::size_t j = 0; j < joints_; ++j) {
      const bool differs = !(now[j] == rotations[j]) && columns_.rotations()[j].order.count > 0;
      changed[j] = differs ? 1 : 0;
      changes_.any = changes_.any || differs;
      if (!differs) changes_.kept_until[j] = frame + 1;
    }
    for (const auto& position : columns_.positions()) {
      changes_.any = changes_.any || position_value(clip_, frame, position) != row[position.column];
    }
  }

  const Clip& clip_;
  const BvhDocument& document_;
  MotionColumns columns_;
  std::size_t joints_;
  std::vector<Quat> previous_rotations_;
  std::vector<double> previous_positions_;
  std::vector<Quat> rotations_;
  Changes changes_;
};

// On the same branch and turn, up to a change of a quarter turn.
bool near(const Angles& a, const Angles& b, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!(std::fabs(a[i] - b[i]) < pi / 2)) return false;
  }
  return true;
}

// The angles of one joint from frame to frame: those of the source and those written.
struct AngleTrack {
  Angles source{};
  Angles written{};
  bool source_known = false;
  bool started = false;

  // Angles of a changed sample. They continue the frame before. Only where the source itself jumps
  // (by a whole turn, or to its other branch) and a later frame keeps its digits, so that a jump
  // cannot be avoided, does it stay where it was.
  Angles follow(Quat rotation, RotationOrder order, const Angles* now, bool kept_later) const {
    const Angles rest{};
    if (!started) return to_euler_near(rotation, order, now != nullptr ? *now : rest);
    const Angles continued = to_euler_near(rotation, order, written);
    const bool may_jump =
        kept_later && now != nullptr && source_known && !near(*now, source, order.count);
    if (!may_jump || near(continued, *now, order.count)) return continued;
    const Angles on_source = to_euler_near(rotation, order, *now);
    return near(on_source, *now, order.count) ? on_source : continued;
  }
};

class Rewriter {
 public:
  Rewriter(const Clip& clip, const BvhDocument& document, const Changes& changes)
      : clip_(clip),
        document_(document),
        changes_(changes),
        columns_(document.skeleton),
        decimals_(std::clamp(document.decimals, least_decimals, most_decimals)),
        keep_below_(0.5 * std::pow(10.0, -static_cast<double>(decimals_))),
        tracks_(clip.joint_count()),
        replaced_(columns_.count()),
        values_(columns_.count()),
        tokens_(columns_.count()),
        held_positions_(document.first_positions),
        out_(document.bytes.size() + document.bytes.size() / 8 + 4096),
        copied_(document.bytes.data()) {}

  std::string rewrite() {
    if (clip_.frame_rate_hz != document_.frame_rate_hz) replace_frame_time();
    if (changes_.any) replace_values();
    const char* const end = document_.bytes.data() + document_.bytes.size();
    out_.append({copied_, static_cast<std::size_t>(end - copied_)});
    return std::move(out_).take();
  }

 private:
  void copy_until(const char* place) {
    out_.append({copied_, static_cast<std::size_t>(place - copied_)});
    copied_ = place;
  }

  void replace_frame_time() {
    copy_until(document_.bytes.data() + document_.frame_time.begin);
    out_.append(frame_time_text(clip_.frame_rate_hz));
    copied_ += document_.frame_time.size;
  }

  void replace_values() {
    MotionRows source(document_.bytes.data() + document_.data_begin,
                      document_.bytes.data() + document_.data_end, document_.commas);
    for (std::size_t f = 0; f < document_.frame_count; ++f) {
      source.next(values_.data(), values_.size(), tokens_.data());
      bool any = replace_positions(f);
      for (std::size_t j = 0; j < tracks_.size(); ++j) any = replace_rotation(f, j) || any;
      if (any) write_row();
    }
  }

  bool replace_positions(std::size_t frame) {
    bool any = false;
    std::size_t i = 0;
    for (const auto& position : columns_.positions()) {
      double& value = values_[position.column];
      if (document_.has_gaps) {
        if (!std::isnan(value)) held_positions_[i] = value;
        value = held_positions_[i++];
      }
      const double now = position_value(clip_, frame, position);
      if (now == value) continue;
      value = now;
      replaced_[position.column] = any = true;
    }
    return any;
  }

  bool replace_rotation(std::size_t frame, std::size_t joint) {
    const MotionColumns::Rotation& rotation = columns_.rotations()[joint];
    const std::size_t count = rotation.order.count;
    AngleTrack& track = tracks_[joint];
    Angles source{};
    bool known = true;
    for (std::size_t i = 0; i < count; ++i) {
      double degrees = values_[rotation.columns[i]];
      known = known && !std::isnan(degrees);
      // No digit after the point is left of an angle of so many turns.
      if (std::fabs(degrees) > 1e9) degrees = std::fmod(degrees, 360.0);
      source[i] = degrees * radians_per_degree;
    }
    bool any = false;
    if (changes_.rotations[frame * tracks_.size() + joint] != 0) {
      const bool kept_later = changes_.kept_until[joint] > frame;
      const Quat now = clip_.rotation(frame, joint);
      track.written = track.follow(now, rotation.order, known ? &source : nullptr, kept_later);
      track.started = true;
      for (std::size_t i = 0; i < count; ++i)
        any = replace_angle(rotation.columns[i], track.written[i]) || any;
    } else if (known) {
      track.written = source;
      track.started = true;
    }
    track.source = source;
    track.source_known = known;
    return any;
  }

  bool replace_angle(std::size_t column, double radians) {
    const double degrees = radians * degrees_per_radian;
    if (std::fabs(degrees - values_[column]) <= keep_below_) return false;
    values_[column] = degrees;
    replaced_[column] = true;
    return true;
  }

  void write_row() {
    for (std::size_t c = 0; c < values_.size(); ++c) {
      if (replaced_[c] == 0) continue;
      replaced_[c] = 0;
      copy_until(tokens_[c].begin);
      out_.append_fixed(values_[c], decimals_, document_.commas);
      copied_ = tokens_[c].end;
    }
  }

  const Clip& clip_;
  const BvhDocument& document_;
  const Changes& changes_;
  MotionColumns columns_;
  unsigned decimals_;
  double keep_below_;
  std::vector<AngleTrack> tracks_;
  std::vector<std::uint8_t> replaced_;
  std::vector<double> values_;
  std::vector<TokenSpan> tokens_;
  std::vector<double> held_positions_;
  TextBuffer out_;
  const char* copied_;
};

}  // namespace

std::string rewrite_bvh(const Clip& clip, const BvhDocument& document) {
  const Changes changes = ChangeFinder(clip, document).find();
  if (!changes.any && clip.frame_rate_hz == document.frame_rate_hz) return document.bytes;
  return Rewriter(clip, document, changes).rewrite();
}

}  // namespace kinemend
