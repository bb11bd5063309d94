// Draws a take before and after cleaning, for the README: stick figures along the motion with the
// paths of ankle and hand, and the curve of one joint.
//
//   render_take CLEAN NOISY CLEANED -o picture.svg [--joint NAME] [--from S] [--to S]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/experimental/kinematics.hpp"
#include "kinemend/experimental/svg.hpp"
#include "kinemend/io.hpp"
#include "kinemend/metrics.hpp"

namespace {

using namespace kinemend;
using Point = Svg::Point;

constexpr std::string_view noisy_ink = "#d9480f", noisy_pale = "#f4a582";
constexpr std::string_view clean_ink = "#0b7285", clean_pale = "#66b8c7";
constexpr std::string_view text_ink = "#343a40", quiet_ink = "#868e96", truth_ink = "#ced4da";
constexpr double width = 960, margin = 36;

struct Settings {
  std::array<std::string, 3> takes;
  std::string output, joint = "LeftForeArm";
  double from_s = 0, to_s = 1e9;
};

struct Span {
  std::size_t first, last;  // frames, last included
  double rate_hz;

  double x(double frame) const {
    return margin + (width - 2 * margin) * (frame - static_cast<double>(first)) /
                        static_cast<double>(last - first);
  }
};

// Where the root faces, as a unit vector on the floor, averaged over half a second so that steps do
// not turn the view.
std::vector<Vec3> headings(const Take& clip) {
  const std::size_t frames = clip.frame_count();
  const auto half = static_cast<std::size_t>(std::lround(0.25 * clip.frame_rate_hz));
  std::vector<Vec3> result(frames);
  for (std::size_t f = 0; f < frames; ++f) {
    Vec3 sum;
    for (std::size_t g = f > half ? f - half : 0; g <= std::min(f + half, frames - 1); ++g) {
      sum += rotate(clip.rotation(g, 0), {0, 0, 1});
    }
    const double length = std::hypot(sum.x, sum.z);
    result[f] = length > 0 ? Vec3{sum.x / length, 0, sum.z / length} : Vec3{0, 0, 1};
  }
  return result;
}

// The joint positions of a clip as drawn: always seen from its right, a little from the front, each
// frame about its own place on the time axis.
class View {
 public:
  View(const Take& clip, const std::vector<Vec3>& facing, const Span& span, double ground_y,
       double pixels_per_unit)
      : clip_(clip),
        facing_(facing),
        positions_(joint_positions(clip, true)),
        columns_(clip.joint_count() + clip.skeleton.end_sites.size()),
        span_(span),
        ground_y_(ground_y),
        scale_(pixels_per_unit) {}

  Point at(std::size_t frame, std::size_t column) const {
    constexpr double turn = 24 * radians_per_degree;
    const Vec3 from_root = positions_[frame * columns_ + column] - positions_[frame * columns_];
    const Vec3 ahead = facing_[frame], left{ahead.z, 0, -ahead.x};
    const double across =
        std::cos(turn) * dot(ahead, from_root) + std::sin(turn) * dot(left, from_root);
    const double height = positions_[frame * columns_ + column].y;
    return {span_.x(static_cast<double>(frame)) + scale_ * across, ground_y_ - scale_ * height};
  }
  std::vector<Point> trail(std::size_t column) const {
    std::vector<Point> points;
    for (std::size_t f = span_.first; f <= span_.last; ++f) points.push_back(at(f, column));
    return points;
  }
  std::size_t column(std::string_view joint) const {
    const auto index = clip_.skeleton.find(joint);
    if (index < 0) throw Error(ErrorKind::usage, fmt::format("no joint is called {}", joint));
    return static_cast<std::size_t>(index);
  }
  const Take& clip() const { return clip_; }

 private:
  const Take& clip_;
  const std::vector<Vec3>& facing_;
  std::vector<Vec3> positions_;
  std::size_t columns_;
  Span span_;
  double ground_y_, scale_;
};

bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

// Bones of one frame, those of the far side (the left) apart from the others.
struct Figure {
  std::vector<std::vector<Point>> near, far;
  Point head;
};

Figure figure(const View& view, std::size_t frame) {
  const Skeleton& s = view.clip().skeleton;
  Figure result;
  const auto add = [&](std::string_view name, Point from, Point to) {
    (contains(name, "Left") ? result.far : result.near).push_back({from, to});
  };
  for (std::size_t j = 1; j < s.joint_count(); ++j) {
    if (contains(s.names[j], "Thumb") || contains(s.names[j], "Index2")) continue;
    add(s.names[j], view.at(frame, static_cast<std::size_t>(s.parents[j])), view.at(frame, j));
  }
  for (std::size_t e = 0; e < s.end_sites.size(); ++e) {
    const auto parent = static_cast<std::size_t>(s.end_sites[e].parent);
    const Point from = view.at(frame, parent), to = view.at(frame, s.joint_count() + e);
    if (s.names[parent] == "Head") {
      result.head = {0.45 * from.x + 0.55 * to.x, 0.45 * from.y + 0.55 * to.y};
    } else if (contains(s.names[parent], "Toe")) {
      add(s.names[parent], from, to);
    }
  }
  return result;
}

void draw_row(Svg& svg, const View& view, const Span& span, double ground_y, std::string_view ink,
              std::string_view pale) {
  svg.line({margin, ground_y}, {width - margin, ground_y},
           "stroke=\"#dee2e6\" stroke-width=\"1.2\"");
  svg.open_group(
      "fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\" "
      "clip-path=\"url(#inside)\"");
  for (const char* joint : {"LeftFoot", "RightFoot", "LeftHand", "RightHand"}) {
    svg.path({view.trail(view.column(joint))},
             fmt::format("stroke=\"{}\" stroke-width=\"{}\" opacity=\".75\"", pale,
                         contains(joint, "Right") ? 1.1 : 0.8));
  }
  constexpr int figures = 13;
  for (int i = 0; i < figures; ++i) {
    const double place = (i + 0.5) / figures;
    const auto frame = static_cast<std::size_t>(std::lround(
        static_cast<double>(span.first) + place * static_cast<double>(span.last - span.first)));
    const Figure f = figure(view, frame);
    svg.path(f.far, fmt::format("stroke=\"{}\" stroke-width=\"2.4\" opacity=\".55\"", ink));
    svg.path(f.near, fmt::format("stroke=\"{}\" stroke-width=\"2.8\"", ink));
    svg.circle(f.head, 6.2, fmt::format("fill=\"{}\" stroke=\"none\"", ink));
  }
  svg.close_group();
}

// The angle of a joint about the axis that it mostly turns about in the reference, degrees from its
// mean there.
struct JointAngle {
  std::size_t joint;
  Quat mean;
  Vec3 axis;

  double of(const Take& clip, std::size_t frame) const {
    return dot(axis, log(conjugate(mean) * clip.rotation(frame, joint))) * degrees_per_radian;
  }
};

JointAngle main_angle(const Take& clip, std::string_view name) {
  const auto joint = clip.skeleton.find(name);
  if (joint < 0) throw Error(ErrorKind::usage, fmt::format("no joint is called {}", name));
  JointAngle angle{static_cast<std::size_t>(joint), {}, {}};
  std::vector<Quat> track;
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    track.push_back(clip.rotation(f, angle.joint));
  angle.mean = karcher_mean(track);
  Vec3 squares;
  for (Quat q : track) {
    const Vec3 v = log(conjugate(angle.mean) * q);
    squares += {v.x * v.x, v.y * v.y, v.z * v.z};
  }
  angle.axis = squares.x >= squares.y && squares.x >= squares.z ? Vec3{1, 0, 0}
               : squares.y >= squares.z                         ? Vec3{0, 1, 0}
                                                                : Vec3{0, 0, 1};
  return angle;
}

struct Panel {
  double top, bottom, low, high;  // pixels, degrees

  double y(double value) const {
    const double inside = std::clamp(value, low, high);
    return bottom - (bottom - top) * (inside - low) / (high - low);
  }
};

// Level lines at round numbers of degrees.
void draw_scale(Svg& svg, const Panel& panel) {
  double step = 5;
  while ((panel.high - panel.low) / step > 5) step *= 2;
  svg.open_group(fmt::format("font-size=\"11\" fill=\"{}\" stroke=\"none\"", quiet_ink));
  for (double value = step * std::ceil(panel.low / step + 0.2); value < panel.high - 0.2 * step;
       value += step) {
    const double y = panel.y(value);
    svg.line({margin, y}, {width - margin, y}, "stroke=\"#e9ecef\"");
    svg.text(margin - 4, y + 4, "text-anchor=\"end\"",
             fmt::format("{}{:.0f}°", value > 0 ? "+" : "", value));
  }
  svg.close_group();
}

void draw_curves(Svg& svg, const std::array<Take, 3>& clips, const Settings& settings,
                 const Span& span, double top, double bottom) {
  const JointAngle angle = main_angle(clips[0], settings.joint);
  std::array<std::vector<double>, 3> values;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t f = span.first; f <= span.last; ++f)
      values[c].push_back(angle.of(clips[c], f));
  }
  const auto [least, most] = std::minmax_element(values[0].begin(), values[0].end());
  const double room = 0.16 * (*most - *least);
  const Panel panel{top, bottom, *least - room, *most + room};
  svg.rectangle(margin, top, width - 2 * margin, bottom - top, "fill=\"#f8f9fa\" rx=\"4\"");
  svg.open_group(fmt::format("font-size=\"11\" fill=\"{}\" text-anchor=\"middle\"", quiet_ink));
  for (double s = std::ceil(static_cast<double>(span.first) / span.rate_hz);
       s * span.rate_hz <= static_cast<double>(span.last); ++s) {
    const double x = span.x(s * span.rate_hz);
    svg.line({x, top}, {x, bottom}, "stroke=\"#e9ecef\"");
    svg.text(x, bottom + 15, "", fmt::format("{:.0f} s", s));
  }
  svg.close_group();
  draw_scale(svg, panel);
  const std::array<std::string, 3> looks{
      fmt::format("stroke=\"{}\" stroke-width=\"6\"", truth_ink),
      fmt::format("stroke=\"{}\" stroke-width=\".8\" opacity=\".9\"", noisy_ink),
      fmt::format("stroke=\"{}\" stroke-width=\"1.7\"", clean_ink)};
  svg.open_group("fill=\"none\" stroke-linejoin=\"round\"");
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<Point> line;
    for (std::size_t i = 0; i < values[c].size(); ++i) {
      line.push_back({span.x(static_cast<double>(span.first + i)), panel.y(values[c][i])});
    }
    svg.path({line}, looks[c]);
  }
  svg.close_group();
}

void caption(Svg& svg, double y, std::string_view ink, std::string_view title,
             std::string_view figures) {
  svg.text(margin, y, fmt::format("font-size=\"17\" font-weight=\"600\" fill=\"{}\"", ink), title);
  svg.text(width - margin, y,
           fmt::format("font-size=\"13\" text-anchor=\"end\" fill=\"{}\"", text_ink), figures);
}

void key(Svg& svg, double x, double y, std::string_view look, std::string_view name) {
  svg.line({x, y - 4}, {x + 26, y - 4}, look);
  svg.text(x + 32, y, fmt::format("font-size=\"13\" fill=\"{}\"", text_ink), name);
}

std::string figures_of(const Take& reference, const Take& other) {
  return fmt::format("error {:.2f}° RMS, {:.1f}° at the 99th percentile",
                     geodesic_rms_deg(reference, other), geodesic_percentile_deg(reference, other));
}

std::string render(const std::array<Take, 3>& clips, const Settings& settings) {
  const Take& truth = clips[0];
  const double rate = truth.frame_rate_hz;
  const auto last = static_cast<double>(truth.frame_count() - 1);
  const Span span{static_cast<std::size_t>(std::clamp(settings.from_s * rate, 0.0, last - 1)),
                  static_cast<std::size_t>(std::clamp(settings.to_s * rate, 1.0, last)), rate};
  constexpr double height = 640, first_ground = 196, second_ground = 408;
  const std::vector<Vec3> facing = headings(truth);
  double tallest = 0;
  for (Vec3 p : joint_positions(truth, true)) tallest = std::max(tallest, p.y);
  const double scale = 148 / tallest;
  Svg svg(width, height, "A take before and after cleaning");
  svg.rectangle(0, 0, width, height, "fill=\"#fff\" rx=\"10\"");
  svg.raw(
      fmt::format("<clipPath id=\"inside\"><rect x=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>",
                  margin - 14, width - 2 * margin + 28, height));
  svg.open_group("font-family=\"system-ui,-apple-system,Segoe UI,Helvetica,Arial,sans-serif\"");
  caption(svg, 32, noisy_ink, "before", figures_of(truth, clips[1]));
  draw_row(svg, View(clips[1], facing, span, first_ground, scale), span, first_ground, noisy_ink,
           noisy_pale);
  caption(svg, 244, clean_ink, "after", figures_of(truth, clips[2]));
  draw_row(svg, View(clips[2], facing, span, second_ground, scale), span, second_ground, clean_ink,
           clean_pale);
  svg.text(margin, 454, fmt::format("font-size=\"14\" font-weight=\"600\" fill=\"{}\"", text_ink),
           fmt::format("angle of {}, degrees from its mean", settings.joint));
  key(svg, 560, 454, fmt::format("stroke=\"{}\" stroke-width=\"1\"", noisy_ink), "before");
  key(svg, 660, 454, fmt::format("stroke=\"{}\" stroke-width=\"2\"", clean_ink), "after");
  key(svg, 750, 454, fmt::format("stroke=\"{}\" stroke-width=\"6\"", truth_ink),
      "without the damage");
  draw_curves(svg, clips, settings, span, 466, 612);
  svg.close_group();
  return std::move(svg).finish();
}

Settings parse(int count, char** arguments) {
  Settings settings;
  std::size_t takes = 0;
  for (int i = 1; i < count; ++i) {
    const std::string_view argument = arguments[i];
    const auto value = [&]() -> std::string {
      if (i + 1 >= count) throw Error(ErrorKind::usage, fmt::format("{} needs a value", argument));
      return arguments[++i];
    };
    if (argument == "-o") {
      settings.output = value();
    } else if (argument == "--joint") {
      settings.joint = value();
    } else if (argument == "--from") {
      settings.from_s = std::strtod(value().c_str(), nullptr);
    } else if (argument == "--to") {
      settings.to_s = std::strtod(value().c_str(), nullptr);
    } else if (takes < 3) {
      settings.takes[takes++] = argument;
    } else {
      throw Error(ErrorKind::usage, fmt::format("one argument too many: {}", argument));
    }
  }
  if (takes < 3 || settings.output.empty()) {
    throw Error(
        ErrorKind::usage,
        "usage: render_take CLEAN NOISY CLEANED -o picture.svg [--joint NAME] [--from S] [--to S]");
  }
  return settings;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    const Settings settings = parse(count, arguments);
    std::array<Take, 3> clips;
    for (std::size_t i = 0; i < 3; ++i) clips[i] = read_joints(settings.takes[i]).take;
    const std::string svg = render(clips, settings);
    write_file(settings.output, svg, true);
    fmt::print("{}: {} bytes\n", settings.output, svg.size());
  } catch (const Error& e) {
    fmt::print(stderr, "{}\n", e.what());
    return static_cast<int>(e.kind());
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
