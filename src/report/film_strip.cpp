// Draws poses of a take from left to right.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "kinemend/error.hpp"
#include "kinemend/experimental/convert.hpp"
#include "kinemend/experimental/frame_numbers.hpp"
#include "kinemend/experimental/pictures.hpp"
#include "kinemend/experimental/svg.hpp"
#include "motion/component.hpp"
#include "report/inks.hpp"
#include "report/pose_points.hpp"

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
  const std::size_t one = (up + 1) % 3, other = (up + 2) % 3;
  view.across = broad[one] >= broad[other] ? one : other;
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
  if (after != nullptr && before.frame_count() != after->frame_count()) {
    throw Error(ErrorKind::usage, fmt::format("film strip: {} frames before and {} after",
                                              before.frame_count(), after->frame_count()));
  }
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

}  // namespace kinemend
