// Draws whole takes: poses from left to right, and the motion before and after side by side.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/pages.hpp"
#include "motion/rotation.hpp"
#include "report/drawing.hpp"

namespace kinemend {

namespace {

using Point = Svg::Point;

// Chosen by hand.
constexpr double strip_width = 960, height = 240, ground = 206, tallest = 176;  // pixels

/// The plane that is drawn, and its scale.
struct View {
  std::size_t across = 0, up = 1;
  double floor = 0, scale = 1;
};

// Returns the axis beside `up` along which the size is larger.
std::size_t broader_axis(const std::array<double, 3>& sizes, std::size_t up) {
  const std::size_t one = (up + 1) % 3, other = (up + 2) % 3;
  return sizes[one] >= sizes[other] ? one : other;
}

View view_of(const Poses& poses, std::size_t up, double slot) {
  View view;
  view.up = up;
  std::array<double, 3> broad{};
  Range heights;
  for (const auto& points : poses.moments) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      broad[axis] = std::max(broad[axis], range_of(points, axis).size());
    const Range own = range_of(points, up);
    if (own.low > own.high) continue;
    heights.add(own.low);
    heights.add(own.high);
  }
  view.across = broader_axis(broad, up);
  view.floor = heights.low <= heights.high ? heights.low : 0;
  const double high = std::max(heights.size(), 1e-9);
  view.scale = std::min(tallest / high, 1.15 * slot / std::max(broad[view.across], 1e-9));
  return view;
}

// `middle`: horizontal middle of the pose.
Point drawn(Vec3 p, const View& view, double middle, double x) {
  return {x + view.scale * (component(p, view.across) - middle),
          ground - view.scale * (component(p, view.up) - view.floor)};
}

void draw_pose(Svg& svg, const Poses& poses, const std::vector<std::optional<Vec3>>& points,
               const View& view, double middle, double x, std::string_view ink) {
  if (poses.bones.empty()) {
    for (const auto& point : points) {
      if (point) svg.circle(drawn(*point, view, middle, x), 2.2, fmt::format("fill=\"{}\"", ink));
    }
    return;
  }
  std::vector<std::vector<Point>> lines;
  for (const auto& [from, to] : poses.bones)
    lines.push_back({drawn(*points[from], view, middle, x), drawn(*points[to], view, middle, x)});
  svg.path(
      lines,
      fmt::format("fill=\"none\" stroke-linecap=\"round\" stroke=\"{}\" stroke-width=\"2\"", ink));
}

std::vector<std::size_t> moments_of(std::size_t frame_count, FrameSpanToDraw span,
                                    std::size_t poses) {
  std::vector<std::size_t> frames;
  if (frame_count == 0) return frames;
  const std::size_t last = std::min(span.second, frame_count - 1),
                    first = std::min(span.first, last);
  const std::size_t count = std::min(poses, last - first + 1);
  for (std::size_t i = 0; i < count; ++i)
    frames.push_back(count == 1 ? first : first + i * (last - first) / (count - 1));
  return frames;
}

}  // namespace

std::string film_strip_svg(const Take& before, const Take* after, FrameSpanToDraw span,
                           std::size_t count) {
  if (after != nullptr) check_frame_counts("film strip", before, *after);
  const std::vector<std::size_t> frames = moments_of(before.frame_count(), span, count);
  Svg svg(strip_width, height, "poses");
  svg.open_group(inks::font);
  svg.line({20, ground + 3}, {strip_width - 20, ground + 3}, "stroke=\"#dee2e6\"");
  if (frames.empty()) {
    svg.text(strip_width / 2, height / 2,
             fmt::format("text-anchor=\"middle\" fill=\"{}\"", inks::quiet), "no frames");
  } else {
    const double slot = (strip_width - 40) / static_cast<double>(frames.size());
    const Take& last = after != nullptr ? *after : before;
    const Poses poses = poses_of(last, frames);
    const Poses old_poses = after != nullptr ? poses_of(before, frames) : Poses();
    const View view = view_of(poses, static_cast<std::size_t>(guess_up_axis(last)), slot);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const double x = 20 + slot * (static_cast<double>(i) + 0.5);
      const double middle = range_of(poses.moments[i], view.across).middle();
      if (after != nullptr)
        draw_pose(svg, old_poses, old_poses.moments[i], view, middle, x, inks::before);
      draw_pose(svg, poses, poses.moments[i], view, middle, x, inks::after);
      svg.text(x, height - 12, fmt::format("text-anchor=\"middle\" fill=\"{}\"", inks::quiet),
               fmt::format("{}", frame_number(frames[i], first_frame_number(before))));
    }
  }
  svg.close_group();
  return std::move(svg).finish();
}

namespace {

// Chosen by hand.
constexpr double picture_width = 960, between = 20;                                // pixels
constexpr double tallest_body = 300, shortest_body = 120, above = 34, below = 26;  // pixels
constexpr double shown_hz = 30;
// A minute of motion takes about 2 MB of text.
constexpr std::size_t most_moments = 1800;

struct Camera {
  std::size_t across = 0, up = 1;
  Range sides, heights;
  double scale = 1, height = shortest_body;
};

// Returns a fixed camera, so that a sliding foot is seen to slide.
Camera camera_of(const Poses& poses, std::size_t up, double width) {
  Camera camera;
  camera.up = up;
  std::array<Range, 3> ranges;
  for (const auto& points : poses.moments) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Range own = range_of(points, axis);
      if (own.low > own.high) continue;
      ranges[axis].add(own.low);
      ranges[axis].add(own.high);
    }
  }
  camera.across = broader_axis({ranges[0].size(), ranges[1].size(), ranges[2].size()}, up);
  camera.sides = ranges[camera.across];
  camera.heights = ranges[up];
  const double broad = std::max(camera.sides.size(), 1e-9);
  const double high = std::max(camera.heights.size(), 1e-9);
  camera.scale = std::min(tallest_body / high, (width - 2 * between) / broad);
  camera.height = std::clamp(camera.scale * camera.heights.size(), shortest_body, tallest_body);
  return camera;
}

struct MotionPanel {
  double left = 0, width = 0;
};

// Writes coordinates in whole tenths of a pixel, which keeps the text short.
void append_point(std::string& text, char step, const Vec3& p, const Camera& camera,
                  const MotionPanel& panel) {
  const double x = panel.left + panel.width / 2 +
                   camera.scale * (component(p, camera.across) - camera.sides.middle());
  const double low = camera.heights.low <= camera.heights.high ? camera.heights.low : 0;
  const double y = above + camera.height - camera.scale * (component(p, camera.up) - low);
  const auto tenths = [](double value) { return std::lround(10 * std::clamp(value, -1e4, 1e4)); };
  fmt::format_to(std::back_inserter(text), "{}{} {}", step, tenths(x), tenths(y));
}

std::string pose_path(const Poses& poses, const std::vector<std::optional<Vec3>>& points,
                      const Camera& camera, const MotionPanel& panel) {
  std::string text;
  for (const auto& [from, to] : poses.bones) {
    append_point(text, 'M', *points[from], camera, panel);
    append_point(text, 'L', *points[to], camera, panel);
  }
  if (poses.bones.empty()) {
    for (const auto& point : points) {
      if (!point) continue;
      append_point(text, 'M', *point, camera, panel);
      text += "h0";
    }
  }
  // An animation does not accept an empty path.
  return text.empty() ? "M0 0" : text;
}

void draw_panel(Svg& svg, const Poses& poses, const Camera& camera, const MotionPanel& panel,
                double seconds, std::string_view ink, std::string_view name) {
  const double floor = above + camera.height + 3;
  svg.line({panel.left, floor}, {panel.left + panel.width, floor}, "stroke=\"#ced4da\"");
  // Marks on the floor, a fifth of the body's height apart, make foot slide visible.
  const double step = std::max(camera.heights.size() * camera.scale / 5, 8.0);
  for (double x = panel.left + step / 2; x < panel.left + panel.width; x += step)
    svg.line({x, floor}, {x, floor + 6}, "stroke=\"#ced4da\"");
  svg.text(panel.left + 8, 20, fmt::format("fill=\"{}\" font-weight=\"600\"", ink), name);

  std::string values;
  for (const auto& points : poses.moments) {
    if (!values.empty()) values += ';';
    values += pose_path(poses, points, camera, panel);
  }
  const std::string first = values.substr(0, values.find(';'));
  svg.raw(fmt::format(
      "<svg x=\"{0}\" width=\"{1}\" height=\"{2}\" viewBox=\"{3} 0 {4} {5}\">"
      "<path fill=\"none\" stroke=\"{6}\" stroke-width=\"{7}\" stroke-linecap=\"round\" "
      "d=\"{8}\"><animate attributeName=\"d\" dur=\"{9:.3f}s\" calcMode=\"discrete\" "
      "repeatCount=\"indefinite\" values=\"{10}\"/></path></svg>",
      panel.left, panel.width, floor + below, 10 * panel.left, 10 * panel.width,
      10 * (floor + below), ink, poses.bones.empty() ? 50 : 28, first, seconds, values));
}

}  // namespace

std::string moving_picture_svg(const Take& before, const Take* after, FrameSpanToDraw span) {
  if (after != nullptr) check_frame_counts("moving picture", before, *after);
  std::vector<std::size_t> frames;
  const double rate = before.frame_rate_hz;
  const std::size_t step =
      rate > shown_hz ? static_cast<std::size_t>(std::lround(rate / shown_hz)) : 1;
  if (before.frame_count() > 0) {
    const std::size_t last = std::min(span.second, before.frame_count() - 1);
    for (std::size_t frame = std::min(span.first, last); frame <= last; frame += step)
      frames.push_back(frame);
  }
  if (frames.size() > most_moments) {
    throw Error(ErrorKind::usage,
                fmt::format("moving picture: {} frames of motion; at most {} can be drawn, choose "
                            "a part by --range",
                            frames.size() * step, most_moments * step));
  }
  const Take& last = after != nullptr ? *after : before;
  const Poses poses = poses_of(last, frames);
  const double width = after != nullptr ? (picture_width - between) / 2 : picture_width;
  const Camera camera = camera_of(poses, static_cast<std::size_t>(guess_up_axis(last)), width);
  Svg svg(picture_width, above + camera.height + 3 + below, "motion");
  svg.open_group(inks::font);
  if (frames.empty()) {
    svg.text(picture_width / 2, above + camera.height / 2,
             fmt::format("text-anchor=\"middle\" fill=\"{}\"", inks::quiet), "no frames");
  } else {
    const double seconds = static_cast<double>(frames.size() * step) / rate;
    if (after != nullptr) {
      draw_panel(svg, poses_of(before, frames), camera, {0, width}, seconds, inks::before,
                 "before");
      draw_panel(svg, poses, camera, {width + between, width}, seconds, inks::after, "after");
    } else {
      draw_panel(svg, poses, camera, {0, width}, seconds, inks::after, "");
    }
  }
  svg.close_group();
  return std::move(svg).finish();
}

}  // namespace kinemend
