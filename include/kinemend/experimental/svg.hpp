// Builds drawings as SVG text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kinemend {

/// A drawing in SVG, in pixels from the top left corner. Coordinates are written to a tenth, lines
/// as steps from point to point, so that long curves stay small. `attributes` and `element` are SVG
/// as it is; what may hold other characters goes through `xml_escaped` first.
class Svg {
 public:
  struct Point {
    double x = 0, y = 0;
  };

  Svg(double width, double height, std::string_view title);

  void open_group(std::string_view attributes);
  void close_group();
  void raw(std::string_view element);
  void rectangle(double x, double y, double width, double height, std::string_view attributes);
  void circle(Point centre, double radius, std::string_view attributes = "");
  void text(double x, double y, std::string_view attributes, std::string_view content);
  void line(Point from, Point to, std::string_view attributes = "");
  /// One element of several lines.
  void path(const std::vector<std::vector<Point>>& lines, std::string_view attributes = "");

  /// The whole drawing; nothing may be added after it.
  std::string finish() &&;

 private:
  void append_number(long tenths);
  void append_pair(long x, long y);
  void append_line(const std::vector<Point>& points);

  std::string text_;
};

/// Text as it may stand in an element or an attribute of XML: control characters, which it cannot
/// hold, and bytes that are no UTF-8 are replaced.
std::string xml_escaped(std::string_view text);

}  // namespace kinemend
