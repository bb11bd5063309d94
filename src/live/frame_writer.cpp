// Writes headers and frames as BVH text or as lines of JSON.
#include "live/frame_writer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/bvh/bvh_text.hpp"

namespace kinemend {

namespace {

// Chosen by hand (docs/live.md).
constexpr unsigned value_decimals = 6, quaternion_decimals = 8;

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

void FrameWriter::append_json(Vec3 v) {
  append("[");
  append(v.x, value_decimals);
  append(",");
  append(v.y, value_decimals);
  append(",");
  append(v.z, value_decimals);
  append("]");
}

JointWriter::JointWriter(const LiveHeader& header, LiveFormat format)
    : header_(header),
      format_(format),
      columns_(header_.skeleton),
      angles_(header_.skeleton.joint_count()),
      row_(columns_.count()) {}

std::string JointWriter::header_text(std::size_t latency_frames) const {
  return format_ == LiveFormat::bvh ? bvh_header() : json_header(latency_frames);
}

std::string JointWriter::bvh_header() const {
  const std::string frame_time =
      header_.frame_time.empty() ? frame_time_text(header_.frame_rate_hz) : header_.frame_time;
  return fmt::format("{}\nMOTION\nFrames: {}\nFrame Time: {}\n", header_.hierarchy, header_.frames,
                     frame_time);
}

std::string JointWriter::json_header(std::size_t latency_frames) const {
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
  // Bytes of names that are not UTF-8 are replaced.
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
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
    if (rotation.order.count == 0 || is_gap(frame.rotations[j])) continue;
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
  const nlohmann::ordered_json json = {{"kinemend", "live/1"},
                                       {"frame_rate_hz", header_.frame_rate_hz},
                                       {"delay_frames", latency_frames},
                                       {"markers", header_.markers}};
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
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
    const bool seen = frame.observed.empty() || frame.observed[m] != 0;
    const Vec3 v = frame.positions[m];
    if (!seen) {
      append(json ? "null" : ",,");
    } else if (json) {
      append_json(v);
    } else {
      append(v.x, value_decimals);
      append(",");
      append(v.y, value_decimals);
      append(",");
      append(v.z, value_decimals);
    }
  }
  if (json) append("]}");
}

}  // namespace kinemend
