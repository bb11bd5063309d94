// Writes drawings as SVG, in few bytes, and computes points and bones of poses.
#include "report/drawing.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <utility>

#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/pages.hpp"
#include "motion/rotation.hpp"

namespace kinemend {

namespace {

long in_tenths(double value) { return std::lround(10 * value); }

// Returns the bytes of the UTF-8 character that begins here; 0 for bytes that are not UTF-8.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xC2 && first < 0xE0 ? 2
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  if (length == 0 || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  // Rejects overlong forms, surrogate halves, and code points beyond the last one.
  const bool is_odd = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xED && byte(1) >= 0xA0) ||
                      (first == 0xF0 && byte(1) < 0x90) || (first == 0xF4 && byte(1) >= 0x90);
  return is_odd ? 0 : length;
}

}  // namespace

void check_frame_counts(std::string_view drawing, const Take& before, const Take& after) {
  if (before.frame_count() == after.frame_count()) return;
  throw Error(ErrorKind::usage, fmt::format("{}: {} frames before and {} after", drawing,
                                            before.frame_count(), after.frame_count()));
}

std::string xml_escaped(std::string_view text) {
  constexpr std::string_view replacement = "\xEF\xBF\xBD";
  std::string result;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const std::string_view character = text.substr(0, length == 0 ? 1 : length);
    text.remove_prefix(character.size());
    if (length == 0 || (length == 1 && static_cast<unsigned char>(character[0]) < 0x20)) {
      result += replacement;
    } else if (character == "&") {
      result += "&amp;";
    } else if (character == "<") {
      result += "&lt;";
    } else if (character == ">") {
      result += "&gt;";
    } else if (character == "\"") {
      result += "&quot;";
    } else {
      result += character;
    }
  }
  return result;
}

Svg::Svg(double width, double height, std::string_view title)
    : text_(fmt::format(
          "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
          "height=\"{1}\" role=\"img\" aria-label=\"{2}\">\n<title>{2}</title>\n",
          width, height, title)) {}

void Svg::open_group(std::string_view attributes) { text_ += fmt::format("<g {}>\n", attributes); }

void Svg::close_group() { text_ += "</g>\n"; }

void Svg::raw(std::string_view element) { text_.append(element).append("\n"); }

void Svg::rectangle(double x, double y, double width, double height, std::string_view attributes) {
  text_ += fmt::format("<rect x=\"{:.6g}\" y=\"{:.6g}\" width=\"{:.6g}\" height=\"{:.6g}\" {}/>\n",
                       x, y, width, height, attributes);
}

void Svg::circle(Point centre, double radius, std::string_view attributes) {
  text_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}/>\n", centre.x,
                       centre.y, radius, attributes);
}

void Svg::text(double x, double y, std::string_view attributes, std::string_view content) {
  text_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, attributes, content);
}

void Svg::line(Point from, Point to, std::string_view attributes) {
  path({{from, to}}, attributes);
}

void Svg::path(const std::vector<std::vector<Point>>& lines, std::string_view attributes) {
  text_ += "<path d=\"";
  for (const auto& points : lines) append_line(points);
  text_ += fmt::format("\" {}/>\n", attributes);
}

std::string Svg::finish() && { return std::move(text_) + "</svg>\n"; }

// Writes the shortest form: no zero before the point, none after it.
void Svg::append_number(long tenths) {
  if (tenths < 0) text_ += '-';
  const long size = std::labs(tenths);
  if (size >= 10 || size == 0) text_.append(fmt::format("{}", size / 10));
  if (size % 10 != 0) text_.append(fmt::format(".{}", size % 10));
}

void Svg::append_pair(long x, long y) {
  append_number(x);
  if (y >= 0) text_ += ' ';
  append_number(y);
}

void Svg::append_line(const std::vector<Point>& points) {
  if (points.empty()) return;
  long x = in_tenths(points[0].x), y = in_tenths(points[0].y);
  text_ += 'M';
  append_pair(x, y);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const long next_x = in_tenths(points[i].x), next_y = in_tenths(points[i].y);
    if (i == 1) {
      text_ += 'l';
    } else if (next_x >= x) {
      text_ += ' ';
    }
    append_pair(next_x - x, next_y - y);
    x = next_x;
    y = next_y;
  }
}

namespace {

Poses poses_of_joints(const Take& clip, const std::vector<std::size_t>& frames) {
  Poses poses;
  const Skeleton& skeleton = clip.skeleton;
  for (std::size_t j = 1; j < skeleton.joint_count(); ++j) {
    if (skeleton.parents[j] >= 0)
      poses.bones.emplace_back(static_cast<std::size_t>(skeleton.parents[j]), j);
  }
  for (std::size_t e = 0; e < skeleton.end_sites.size(); ++e) {
    poses.bones.emplace_back(static_cast<std::size_t>(skeleton.end_sites[e].parent),
                             skeleton.joint_count() + e);
  }
  for (const std::size_t frame : frames) {
    const Pose pose = forward_kinematics(clip, frame);
    auto& points = poses.moments.emplace_back(pose.positions.begin(), pose.positions.end());
    for (const EndSite& end : skeleton.end_sites) {
      const auto parent = static_cast<std::size_t>(end.parent);
      points.emplace_back(pose.positions[parent] + rotate(pose.rotations[parent], end.offset));
    }
  }
  return poses;
}

}  // namespace

Poses poses_of(const Take& clip, const std::vector<std::size_t>& frames) {
  if (clip.has_joints()) return poses_of_joints(clip, frames);
  Poses poses;
  for (const std::size_t frame : frames) {
    auto& points = poses.moments.emplace_back();
    for (std::size_t m = 0; m < clip.marker_count(); ++m) {
      const bool is_seen = clip.is_observed(frame, m) && clip.holds_positions(m);
      points.push_back(is_seen ? std::optional(clip.position(frame, m)) : std::nullopt);
    }
  }
  return poses;
}

Range range_of(const std::vector<std::optional<Vec3>>& points, std::size_t axis) {
  Range range;
  for (const auto& point : points) {
    if (point) range.add(component(*point, axis));
  }
  return range;
}

}  // namespace kinemend
