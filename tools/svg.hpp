#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kinemend::tools {

struct Point {
  double x = 0, y = 0;
};

/// A drawing, in pixels from the top left corner. Coordinates are written to a tenth, lines as
/// steps from point to point, so that long curves stay small.
class Svg {
 public:
  Svg(double width, double height, std::string_view title)
      : text_(fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
            "height=\"{1}\" role=\"img\" aria-label=\"{2}\">\n<title>{2}</title>\n",
            width, height, title)) {}

  void open_group(std::string_view attributes) { text_ += fmt::format("<g {}>\n", attributes); }
  void close_group() { text_ += "</g>\n"; }
  void raw(std::string_view element) { text_.append(element).append("\n"); }

  void rectangle(double x, double y, double width, double height, std::string_view attributes) {
    text_ +=
        fmt::format("<rect x=\"{:.6g}\" y=\"{:.6g}\" width=\"{:.6g}\" height=\"{:.6g}\" {}/>\n", x,
                    y, width, height, attributes);
  }
  void circle(Point centre, double radius, std::string_view attributes = "") {
    text_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}/>\n", centre.x,
                         centre.y, radius, attributes);
  }
  void text(double x, double y, std::string_view attributes, std::string_view content) {
    text_ +=
        fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, attributes, content);
  }
  void line(Point from, Point to, std::string_view attributes = "") {
    path({{from, to}}, attributes);
  }
  /// One element of several lines.
  void path(const std::vector<std::vector<Point>>& lines, std::string_view attributes = "") {
    text_ += "<path d=\"";
    for (const auto& points : lines) append_line(points);
    text_ += fmt::format("\" {}/>\n", attributes);
  }

  std::string finish() && { return std::move(text_) + "</svg>\n"; }

 private:
  static long tenths(double value) { return std::lround(10 * value); }

  // As short as it gets: no zero before the point, none after it.
  void append_number(long tenths) {
    if (tenths < 0) text_ += '-';
    const long size = std::labs(tenths);
    if (size >= 10 || size == 0) text_.append(fmt::format("{}", size / 10));
    if (size % 10 != 0) text_.append(fmt::format(".{}", size % 10));
  }
  void append_pair(long x, long y) {
    append_number(x);
    if (y >= 0) text_ += ' ';
    append_number(y);
  }
  void append_line(const std::vector<Point>& points) {
    if (points.empty()) return;
    long x = tenths(points[0].x), y = tenths(points[0].y);
    text_ += 'M';
    append_pair(x, y);
    for (std::size_t i = 1; i < points.size(); ++i) {
      const long next_x = tenths(points[i].x), next_y = tenths(points[i].y);
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

  std::string text_;
};

}  // namespace kinemend::tools
