// Parses lines of joints and markers, holds values that are missing, and writes headers and frames.
#include "live/frame_lines.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/bvh/bvh.hpp"
#include "io/held_samples.hpp"
#include "io/motion/motion_rows.hpp"
#include "motion/rotation.hpp"

namespace kinemend {

namespace {

// Returns the first word and removes it from the line.
std::string_view take_word(std::string_view& line) {
  const char* const end = line.data() + line.size();
  const char* const begin = skip_space(line.data(), end);
  const char* const stop = std::find_if(begin, end, is_space);
  line = {stop, static_cast<std::size_t>(end - stop)};
  return {begin, static_cast<std::size_t>(stop - begin)};
}

bool begins_like_a_number(std::string_view line) {
  const char* const end = line.data() + line.size();
  const char* const begin = skip_space(line.data(), end);
  if (begin == end) return false;
  constexpr std::string_view firsts = "0123456789+-.nNiI";
  return firsts.find(*begin) != firsts.npos;
}

}  // namespace

FrameReader::Read FrameReader::read(std::string_view line) {
  values_found_ = 0;
  for (std::size_t i = 0; i < skipped_words_; ++i) take_word(line);
  std::int64_t number = 0;
  if (numbered_) {
    constexpr double most = 0x1p53;  // still exact
    const std::string_view word = take_word(line);
    if (word.empty()) return Read::text;
    const NumberToken token = read_number(word);
    const bool whole = token.kind == TokenKind::number && token.end == word.data() + word.size() &&
                       std::fabs(token.value) < most && token.value == std::floor(token.value);
    if (!whole) return begins_like_a_number(word) ? Read::number : Read::text;
    number = static_cast<std::int64_t>(token.value);
  }
  const Read read = read_values(line);
  if (read == Read::frame) number_ = number;
  return read;
}

JointReader::JointReader(const Skeleton& skeleton, bool numbered, std::size_t skipped_words)
    : FrameReader(numbered, skipped_words),
      columns_(skeleton),
      position_frames_(offset_replacing_frames(skeleton)),
      rotations_(skeleton.joint_count()),
      line_(columns_.count()) {
  row_.resize(columns_.count());
  frame_.rotations.resize(skeleton.joint_count());
  frame_.observed.reserve(skeleton.joint_count());
  for (const PositionFrame& position : position_frames_) frame_.positions.push_back(position.rest);
  for (const MotionColumns::Position& position : columns_.positions()) {
    row_[position.column] =
        component(frame_.positions[frame_index(position.translated)], position.axis);
  }
}

FrameReader::Read JointReader::read_values(std::string_view line) {
  if (!begins_like_a_number(line)) return Read::text;
  const CommaStyle commas =
      line.find(',') == line.npos ? CommaStyle::none : comma_style(line, columns_.count());
  MotionRows rows(line.data(), line.data() + line.size(), commas);
  values_found_ = rows.next(line_.data(), line_.size());
  if (values_found_ < line_.size()) return Read::values;
  if (!rows.at_end()) {
    ++values_found_;
    return Read::values;
  }
  gaps_ = rows.found().gaps.count;
  take_rotations();
  take_positions();
  return Read::frame;
}

void JointReader::take_rotations() {
  columns_.decode_rotations(line_.data(), 1, rotations_.data());
  frame_.observed.clear();
  if (gaps_ > 0) frame_.observed.resize(rotations_.size(), 1);
  for (std::size_t j = 0; j < rotations_.size(); ++j) {
    if (is_missing(rotations_[j])) {
      frame_.observed[j] = 0;
      continue;
    }
    frame_.rotations[j] = rotations_[j];
  }
  for (std::size_t c = 0; c < row_.size(); ++c) {
    if (!std::isnan(line_[c])) row_[c] = line_[c];
  }
}

void JointReader::take_positions() {
  for (const MotionColumns::Position& position : columns_.positions()) {
    component_of(frame_.positions[frame_index(position.translated)], position.axis) =
        row_[position.column];
  }
}

MarkerReader::MarkerReader(std::size_t markers, bool numbered, std::size_t skipped_words)
    : FrameReader(numbered, skipped_words), line_(3 * markers) {
  row_.resize(3 * markers);
  frame_.positions.resize(markers);
  frame_.observed.resize(markers);
}

FrameReader::Read MarkerReader::read_values(std::string_view line) {
  constexpr std::string_view firsts = ",0123456789+-.nNiI";
  const char* const end = line.data() + line.size();
  const char* p = skip_space(line.data(), end);
  if (p != end && firsts.find(*p) == firsts.npos) return Read::text;
  std::size_t gaps = 0;
  for (;; ++p) {
    const char* const stop = std::find(p, end, ',');
    p = skip_space(p, stop);
    double value = std::numeric_limits<double>::quiet_NaN();
    if (p != stop) {
      const NumberToken token = read_sample(p, stop, CommaStyle::separator);
      if (token.kind == TokenKind::text || token.kind == TokenKind::comment ||
          skip_space(token.end, stop) != stop) {
        return Read::values;
      }
      gaps += token.kind == TokenKind::not_finite ? 1 : 0;
      if (token.kind == TokenKind::number) value = token.value;
    }
    if (values_found_ == line_.size()) {
      ++values_found_;
      return Read::values;
    }
    line_[values_found_++] = value;
    p = stop;
    if (p == end) break;
  }
  if (values_found_ < line_.size()) return Read::values;
  gaps_ = gaps;
  row_ = line_;
  for (std::size_t m = 0; m < frame_.positions.size(); ++m) {
    const Vec3 v{row_[3 * m], row_[3 * m + 1], row_[3 * m + 2]};
    const bool seen = !std::isnan(v.x) && !std::isnan(v.y) && !std::isnan(v.z);
    frame_.observed[m] = seen ? 1 : 0;
    if (seen) frame_.positions[m] = v;
  }
  return Read::frame;
}

namespace {

// Chosen by hand (docs/live.md).
constexpr unsigned value_decimals = 6, quaternion_decimals = 8;

nlohmann::ordered_json begun_header(const LiveHeader& header, std::size_t latency_frames) {
  return {{"kinemend", "live/1"},
          {"frame_rate_hz", header.frame_rate_hz},
          {"delay_frames", latency_frames}};
}

// Bytes of names that are not UTF-8 are replaced.
std::string line_of(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string_view FrameWriter::write(const Frame& frame, std::int64_t number) {
  line_.clear();
  append_frame(frame, number);
  line_ += '\n';
  return line_;
}

void FrameWriter::append(double value, unsigned decimals) {
  std::array<char, fixed_number_room> text;
  const double finite = std::isfinite(value) ? value : 0;
  line_.append(text.data(), write_fixed(text.data(), finite, decimals));
}

void FrameWriter::append(Vec3 v) {
  append(v.x, value_decimals);
  append(",");
  append(v.y, value_decimals);
  append(",");
  append(v.z, value_decimals);
}

void FrameWriter::append_json(Vec3 v) {
  append("[");
  append(v);
  append("]");
}

JointWriter::JointWriter(const LiveHeader& header, LiveFormat format)
    : header_(header),
      format_(format),
      columns_(header_.skeleton),
      angles_(header_.skeleton.joint_count()),
      row_(columns_.count()) {}

std::string JointWriter::header_text(std::size_t latency_frames) const {
  if (format_ == LiveFormat::bvh) {
    return fmt::format(
        "{}\nMOTION\nFrames: {}\nFrame Time: {}\n", header_.hierarchy, header_.frames,
        header_.frame_time.empty() ? frame_time_text(header_.frame_rate_hz) : header_.frame_time);
  }
  const Skeleton& skeleton = header_.skeleton;
  nlohmann::ordered_json json = begun_header(header_, latency_frames);
  json["joints"] = skeleton.names;
  json["parents"] = skeleton.parents;
  for (const Vec3& offset : skeleton.offsets)
    json["offsets"].push_back({offset.x, offset.y, offset.z});
  json["translated"] = nlohmann::ordered_json::array();
  for (const std::int32_t joint : columns_.translated_joints()) json["translated"].push_back(joint);
  return line_of(json);
}

void JointWriter::start_near(const std::vector<double>& values) {
  row_ = values;
  for (std::size_t j = 0; j < angles_.size(); ++j) {
    const MotionColumns::Rotation& rotation = columns_.rotations()[j];
    for (std::size_t i = 0; i < rotation.order.count; ++i) {
      // An angle of more turns would have no digits after the decimal point. Chosen by hand.
      constexpr double most_degrees = 1e9;
      const double degrees = values[rotation.columns[i]];
      angles_[j][i] = (std::fabs(degrees) > most_degrees ? std::fmod(degrees, 360.0) : degrees) *
                      radians_per_degree;
    }
  }
}

void JointWriter::append_frame(const Frame& frame, std::int64_t number) {
  if (format_ == LiveFormat::bvh) {
    append_values(frame);
  } else {
    append_json_frame(frame, number);
  }
}

void JointWriter::append_values(const Frame& frame) {
  const auto put = [&](std::size_t column, double value) {
    if (std::isfinite(value)) row_[column] = value;
  };
  for (const MotionColumns::Position& position : columns_.positions()) {
    put(position.column,
        component(frame.positions[frame_index(position.translated)], position.axis));
  }
  for (std::size_t j = 0; j < angles_.size(); ++j) {
    const MotionColumns::Rotation& rotation = columns_.rotations()[j];
    if (rotation.order.count == 0 || is_missing(frame.rotations[j])) continue;
    angles_[j] = to_euler_near(frame.rotations[j], rotation.order, angles_[j]);
    for (std::size_t i = 0; i < rotation.order.count; ++i)
      put(rotation.columns[i], angles_[j][i] * degrees_per_radian);
  }
  for (std::size_t c = 0; c < row_.size(); ++c) {
    if (c > 0) append(" ");
    append(row_[c], value_decimals);
  }
}

void JointWriter::append_json_frame(const Frame& frame, std::int64_t number) {
  append("{\"frame\":");
  append(static_cast<double>(number), 0);
  append(",\"root\":");
  append_json(frame.positions.front());
  append(",\"rotations\":[");
  for (std::size_t j = 0; j < frame.rotations.size(); ++j) {
    const Quat q = frame.rotations[j];
    append(j > 0 ? ",[" : "[");
    append(q.w, quaternion_decimals);
    for (const double value : {q.x, q.y, q.z}) {
      append(",");
      append(value, quaternion_decimals);
    }
    append("]");
  }
  append("]");
  for (std::size_t i = 1; i < frame.positions.size(); ++i) {
    append(i == 1 ? ",\"translations\":[" : ",");
    append_json(frame.positions[i]);
  }
  append(frame.positions.size() > 1 ? "]}" : "}");
}

std::string MarkerWriter::header_text(std::size_t latency_frames) const {
  if (format_ == LiveFormat::bvh) {
    return fmt::format("MARKERS {} {}\n", header_.frame_rate_hz, fmt::join(header_.markers, ","));
  }
  nlohmann::ordered_json json = begun_header(header_, latency_frames);
  json["markers"] = header_.markers;
  return line_of(json);
}

void MarkerWriter::append_frame(const Frame& frame, std::int64_t number) {
  const bool json = format_ == LiveFormat::jsonl;
  if (json) {
    append("{\"frame\":");
    append(static_cast<double>(number), 0);
    append(",\"positions\":[");
  }
  for (std::size_t m = 0; m < frame.positions.size(); ++m) {
    if (m > 0) append(",");
    const bool seen = frame.is_observed(m);
    const Vec3 v = frame.positions[m];
    if (!seen) {
      append(json ? "null" : ",,");
    } else if (json) {
      append_json(v);
    } else {
      append(v);
    }
  }
  if (json) append("]}");
}

}  // namespace kinemend
