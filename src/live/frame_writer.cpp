#include "live/frame_writer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/bvh/bvh_text.hpp"

namespace kinemend {

namespace {

constexpr unsigned value_decimals = 6, quaternion_decimals = 8;

}  // namespace

FrameWriter::FrameWriter(const LiveHeader& header, LiveFormat format)
    : header_(header),
      format_(format),
      columns_(header_.skeleton),
      angles_(header_.skeleton.joint_count()),
      row_(columns_.count()) {
  line_.reserve(32 * (columns_.count() + 4 * angles_.size()));
}

std::string FrameWriter::header_text(std::size_t latency_frames) const {
  return format_ == LiveFormat::bvh ? bvh_header() : json_header(latency_frames);
}

std::string FrameWriter::bvh_header() const {
  const std::string frame_time =
      header_.frame_time.empty() ? frame_time_text(header_.frame_rate_hz) : header_.frame_time;
  return fmt::format("{}\nMOTION\nFrames: {}\nFrame Time: {}\n", header_.hierarchy, header_.frames,
                     frame_time);
}

std::string FrameWriter::json_header(std::size_t latency_frames) const {
  const Skeleton& skeleton = header_.skeleton;
  nlohmann::ordered_json json = {{"kinemend", "live/1"},
                                 {"frame_rate_hz", header_.frame_rate_hz},
                                 {"delay_frames", latency_frames},
                                 {"joints", skeleton.names},
                                 {"parents", skeleton.parents}};
  for (const Vec3& offset : skeleton.offsets)
    json["offsets"].push_back({offset.x, offset.y, offset.z});
  json["translated"] = nlohmann::ordered_json::array();
  for (const std::int32_t joint : columns_.translated_joints()) json["translated"].push_back(joint);
  // Names in no encoding that is known are shown as far as they go.
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void FrameWriter::start_near(const std::vector<double>& values) {
  row_ = values;
  for (std::size_t j = 0; j < angles_.size(); ++j) {
    const MotionColumns::Rotation& rotation = columns_.rotations()[j];
    for (std::size_t i = 0; i < rotation.order.count; ++i) {
      // Of an angle of so many turns no digit after the point would be left.
      constexpr double most_degrees = 1e9;
      const double degrees = values[rotation.columns[i]];
      angles_[j][i] = (std::fabs(degrees) > most_degrees ? std::fmod(degrees, 360.0) : degrees) *
                      radians_per_degree;
    }
  }
}

std::string_view FrameWriter::write(const Frame& frame, std::int64_t number) {
  line_.clear();
  if (format_ == LiveFormat::bvh) {
    write_values(frame);
  } else {
    write_json(frame, number);
  }
  line_ += '\n';
  return line_;
}

void FrameWriter::write_values(const Frame& frame) {
  const auto put = [&](std::size_t column, double value) {
    if (std::isfinite(value)) row_[column] = value;
  };
  for (const MotionColumns::Position& position : columns_.positions()) {
    put(position.column,
        component(frame.positions[frame_index(position.translated)], position.axis));
  }
  for (std::size_t j = 0; j < angles_.size(); ++j) {
    const MotionColumns::Rotation& rotation = columns_.rotations()[j];
    if (rotation.order.count == 0 || is_gap(frame.rotations[j])) continue;
    angles_[j] = to_euler_near(frame.rotations[j], rotation.order, angles_[j]);
    for (std::size_t i = 0; i < rotation.order.count; ++i)
      put(rotation.columns[i], angles_[j][i] * degrees_per_radian);
  }
  for (std::size_t c = 0; c < row_.size(); ++c) {
    if (c > 0) line_ += ' ';
    append(row_[c], value_decimals);
  }
}

void FrameWriter::write_json(const Frame& frame, std::int64_t number) {
  fmt::format_to(std::back_inserter(line_), "{{\"frame\":{},\"root\":", number);
  append(frame.positions.front());
  line_ += ",\"rotations\":[";
  for (std::size_t j = 0; j < frame.rotations.size(); ++j) {
    const Quat q = frame.rotations[j];
    line_ += j > 0 ? ",[" : "[";
    for (const double value : {q.w, q.x, q.y, q.z}) {
      append(value, quaternion_decimals);
      line_ += ',';
    }
    line_.back() = ']';
  }
  line_ += ']';
  if (frame.positions.size() > 1) {
    line_ += ",\"translations\":[";
    for (std::size_t i = 1; i < frame.positions.size(); ++i) {
      append(frame.positions[i]);
      line_ += ',';
    }
    line_.back() = ']';
  }
  line_ += '}';
}

void FrameWriter::append(Vec3 v) {
  line_ += '[';
  for (const double value : {v.x, v.y, v.z}) {
    append(value, value_decimals);
    line_ += ',';
  }
  line_.back() = ']';
}

void FrameWriter::append(double value, unsigned decimals) {
  std::array<char, fixed_number_room> text;
  const double finite = std::isfinite(value) ? value : 0;
  line_.append(text.data(), write_fixed(text.data(), finite, decimals));
}

}  // namespace kinemend
