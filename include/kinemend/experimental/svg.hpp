// Builds drawings as SVG text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kinemend {

/// A drawing in SVG, in pixels from the top left corner. Coordinates are written to a tenth, lines
/// as steps from point to point, so that long curves stay small. `attributes` and `element` are
/// inserted as SVG; escape any other text with `xml_escaped` first.
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
  /// Adds one element of several lines.
  void path(const std::vector<std::vector<Point>>& lines, std::string_view attributes = "");

  /// Returns the whole drawing, to which no more can be added.
  std::string finish() &&;

 private:
  void append_number(long tenths);
  void append_pair(long x, long y);
  void append_line(const std::vector<Point>& points);

  std::string text_;
};

/// Returns text that is valid in an element or attribute of XML. Control characters, which XML
/// cannot hold, and bytes that are not UTF-8 are replaced.
std::string xml_escaped(std::string_view text);

}  // namespace kinemend
