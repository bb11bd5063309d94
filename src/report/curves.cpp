// Takes the curves of a track from takes before and after, computes their power spectrum, and draws
// both as SVG.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <string_view>

#include "base/portable.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/pages.hpp"
#include "kinemend/extend/rotation.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/report.hpp"
#include "motion/rotation.hpp"
#include "report/drawing.hpp"

namespace kinemend {

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

void check_track(std::size_t track, std::size_t before, std::size_t after) {
  if (track >= before || track >= after)
    throw Error(ErrorKind::usage, fmt::format("curves: there is no track {}", track));
}

TrackCurves empty_curves(const Take& take, const std::string& name, std::vector<std::string> axes) {
  TrackCurves curves;
  curves.name = name;
  curves.first_frame = first_frame_number(take);
  curves.frame_rate_hz = take.frame_rate_hz;
  curves.before.assign(axes.size(), std::vector<double>(take.frame_count(), missing));
  curves.after = curves.before;
  curves.difference.assign(take.frame_count(), missing);
  curves.axes = std::move(axes);
  return curves;
}

void put(const std::optional<Vec3>& position, std::size_t frame,
         std::vector<std::vector<double>>& curves) {
  for (std::size_t axis = 0; position && axis < 3; ++axis)
    curves[axis][frame] = component(*position, axis);
}

// `position_in(take, frame)`: the position; none where it was not observed.
template <typename PositionIn>
TrackCurves position_curves(const Take& before, const Take& after, const std::string& name,
                            const PositionIn& position_in) {
  TrackCurves curves = empty_curves(before, name, {"X", "Y", "Z"});
  curves.quantity = "position";
  curves.unit = take_facts(before).unit;
  for (std::size_t f = 0; f < before.frame_count(); ++f) {
    const std::optional<Vec3> old_position = position_in(before, f);
    const std::optional<Vec3> new_position = position_in(after, f);
    put(old_position, f, curves.before);
    put(new_position, f, curves.after);
    if (old_position && new_position) curves.difference[f] = norm(*new_position - *old_position);
  }
  return curves;
}

}  // namespace

TrackCurves rotation_curves(const Take& before, const Take& after, std::size_t joint) {
  check_frame_counts("curves", before, after);
  check_track(joint, before.joint_count(), after.joint_count());
  RotationOrder order = before.skeleton.rotation_order(joint);
  if (order.count == 0) order = parse_rotation_order("ZXY");
  const std::string letters = to_string(order);
  std::vector<std::string> axes;
  for (const char letter : letters) axes.emplace_back(1, letter);
  TrackCurves curves = empty_curves(before, before.skeleton.names[joint], std::move(axes));
  curves.quantity = "rotation";
  curves.unit = "deg";
  std::array<double, 3> angles{};
  for (std::size_t f = 0; f < before.frame_count(); ++f) {
    const bool has_before = before.is_observed(f, joint), has_after = after.is_observed(f, joint);
    if (has_before) angles = to_euler_near(before.rotation(f, joint), order, angles);
    const auto other = has_after ? to_euler_near(after.rotation(f, joint), order, angles) : angles;
    for (std::size_t a = 0; a < order.count; ++a) {
      if (has_before) curves.before[a][f] = angles[a] * degrees_per_radian;
      if (has_after) curves.after[a][f] = other[a] * degrees_per_radian;
    }
    if (!has_before) angles = other;
    if (has_before && has_after) {
      curves.difference[f] =
          angle_between(before.rotation(f, joint), after.rotation(f, joint)) * degrees_per_radian;
    }
  }
  return curves;
}

TrackCurves root_curves(const Take& before, const Take& after) {
  check_frame_counts("curves", before, after);
  check_track(0, before.joint_count(), after.joint_count());
  return position_curves(before, after, before.skeleton.names[0], [](const Take& take, auto f) {
    return take.is_position_observed(f, 0) ? std::optional(take.root_position(f)) : std::nullopt;
  });
}

TrackCurves marker_curves(const Take& before, const Take& after, std::size_t marker) {
  check_frame_counts("curves", before, after);
  check_track(marker, before.marker_count(), after.marker_count());
  return position_curves(before, after, before.names[marker], [&](const Take& take, auto f) {
    return take.is_observed(f, marker) ? std::optional(take.position(f, marker)) : std::nullopt;
  });
}

namespace {

using Point = Svg::Point;

// Chosen by hand.
constexpr double curves_width = 960, panel_height = 120;  // pixels
constexpr double left = 64, right = 12, top = 28, bottom = 22, space = 10;
// The drawn frames and their horizontal positions.
struct Span {
  std::size_t first = 0, count = 0;

  double x(double frame) const {
    const double steps = std::max(static_cast<double>(count) - 1, 1.0);
    return left + (curves_width - left - right) * (frame - static_cast<double>(first)) / steps;
  }
};

struct Panel {
  double top = 0, height = 0, low = 0, high = 1;

  double y(double value) const { return top + height * (high - value) / (high - low); }
};

void widen(const std::vector<double>& curve, const Span& span, double& low, double& high) {
  for (std::size_t i = 0; i < span.count; ++i) {
    const double value = curve[span.first + i];
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
}

// Returns a panel that holds the curves with a margin; `least` is the smallest range of values that
// it shows.
Panel panel_of(const std::vector<const std::vector<double>*>& curves, const Span& span, double y,
               double height, double least) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto* curve : curves) widen(*curve, span, low, high);
  if (low > high) low = high = 0;
  const double room = std::max(0.08 * (high - low), (least - (high - low)) / 2);
  return {y, height, low - room, high + room};
}

// Lines break at missing samples. Where several frames share a pixel, its least and largest values
// represent them.
std::vector<std::vector<Point>> lines_of(const std::vector<double>& curve, const Span& span,
                                         const Panel& panel) {
  const auto pixels = static_cast<std::size_t>(curves_width);
  const std::size_t stride =
      std::max(span.count / std::max(pixels, std::size_t{1}), std::size_t{1});
  std::vector<std::vector<Point>> lines(1);
  const auto add = [&](std::size_t frame) {
    lines.back().push_back({span.x(static_cast<double>(frame)), panel.y(curve[frame])});
  };
  for (std::size_t f = span.first; f < span.first + span.count; f += stride) {
    const std::size_t end = std::min(f + stride, span.first + span.count);
    std::size_t low = end, high = end;
    bool breaks = false;
    for (std::size_t g = f; g < end; ++g) {
      if (!std::isfinite(curve[g])) {
        breaks = true;
        continue;
      }
      if (low == end || curve[g] < curve[low]) low = g;
      if (high == end || curve[g] > curve[high]) high = g;
    }
    if (low != end) {
      add(std::min(low, high));
      if (low != high) add(std::max(low, high));
    }
    if (breaks && !lines.back().empty()) lines.emplace_back();
  }
  // A single sample between two gaps is drawn as a dot.
  for (std::vector<Point>& line : lines) {
    if (line.size() == 1) line.push_back({line[0].x + 0.1, line[0].y});
  }
  return lines;
}

// Returns a round step, about `count` of which fit in `range`.
double round_step(double range, double count) {
  const double step = range / count, power = portable::pow(10.0, std::floor(portable::log10(step)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= step) return digit * power;
  }
  return 10 * power;
}

// Draws level lines at round values.
void draw_levels(Svg& svg, const Panel& panel) {
  const double step = round_step(panel.high - panel.low, 4);
  svg.open_group(fmt::format("font-size=\"11\" fill=\"{}\" text-anchor=\"end\"", inks::quiet));
  for (double k = std::ceil(panel.low / step); k * step <= panel.high; ++k) {
    const double y = panel.y(k * step);
    svg.line({left, y}, {curves_width - right, y}, fmt::format("stroke=\"{}\"", inks::grid));
    svg.text(left - 5, y + 4, "", fmt::format("{:.4g}", k == 0 ? 0.0 : k * step));
  }
  svg.close_group();
}

// Draws frame numbers below the panels.
void draw_frames(Svg& svg, const TrackCurves& curves, const Span& span, double y) {
  if (span.count == 0) return;
  const auto number = [&](std::size_t frame) { return frame_number(frame, curves.first_frame); };
  const double step = std::max(round_step(static_cast<double>(span.count), 8), 1.0);
  svg.open_group(fmt::format("font-size=\"11\" fill=\"{}\" text-anchor=\"middle\"", inks::quiet));
  const auto last = static_cast<double>(number(span.first + span.count - 1));
  for (double n = step * std::ceil(static_cast<double>(number(span.first)) / step); n <= last;
       n += step) {
    svg.text(span.x(n - static_cast<double>(curves.first_frame)), y, "", fmt::format("{:.0f}", n));
  }
  svg.close_group();
}

void draw_curve(Svg& svg, const std::vector<double>& curve, const Span& span, const Panel& panel,
                std::string_view ink, double width) {
  svg.path(lines_of(curve, span, panel),
           fmt::format("fill=\"none\" stroke-linejoin=\"round\" stroke=\"{}\" stroke-width=\"{}\"",
                       ink, width));
}

void draw_key(Svg& svg, double x, std::string_view ink, std::string_view name) {
  svg.line({x, 14}, {x + 22, 14}, fmt::format("stroke=\"{}\" stroke-width=\"2\"", ink));
  svg.text(x + 27, 18, fmt::format("fill=\"{}\"", inks::text), name);
}

}  // namespace

std::string curves_svg(const TrackCurves& curves, const CurveStyle& style) {
  const std::size_t frames = curves.difference.size();
  const std::size_t first = std::min(style.first_frame, frames);
  const std::size_t last = frames == 0 ? 0 : std::min(style.last_frame, frames - 1);
  const Span span{first, last < first || frames == 0 ? 0 : last - first + 1};
  const std::size_t panels = curves.axes.size() + (style.one_take ? 0 : 1);
  const double last_y = top + static_cast<double>(panels) * (panel_height + space) - space;
  const std::string name = xml_escaped(printable_name(curves.name));
  const std::string unit = curves.unit.empty() ? "" : ", " + xml_escaped(printable(curves.unit));
  Svg svg(curves_width, last_y + bottom, style.one_take ? name : name + " before and after");
  svg.open_group(inks::font);
  svg.text(left, 18, fmt::format("font-weight=\"600\" fill=\"{}\"", inks::text), name + unit);
  if (!style.one_take) {
    draw_key(svg, curves_width - 310, inks::before, "before");
    draw_key(svg, curves_width - 215, inks::after, "after");
    draw_key(svg, curves_width - 130, inks::difference, "difference");
  }
  for (std::size_t p = 0; p < panels; ++p) {
    const double y = top + static_cast<double>(p) * (panel_height + space);
    svg.rectangle(left, y, curves_width - left - right, panel_height, "fill=\"#f8f9fa\"");
  }
  // Nearly constant curves are not magnified to fill their panel. File units, or degrees. Chosen by
  // hand.
  constexpr double least_range = 1e-6;
  for (std::size_t p = 0; p < panels; ++p) {
    const bool is_axis = p < curves.axes.size();
    const double y = top + static_cast<double>(p) * (panel_height + space);
    const Panel panel =
        is_axis
            ? panel_of({&curves.before[p], &curves.after[p]}, span, y, panel_height, least_range)
            : panel_of({&curves.difference}, span, y, panel_height, least_range);
    draw_levels(svg, panel);
    if (is_axis) {
      if (!style.one_take) draw_curve(svg, curves.before[p], span, panel, inks::before, 1);
      draw_curve(svg, curves.after[p], span, panel, inks::after, 1.5);
      svg.text(left + 6, y + 15, fmt::format("fill=\"{}\"", inks::text), curves.axes[p]);
    } else {
      draw_curve(svg, curves.difference, span, panel, inks::difference, 1);
    }
  }
  draw_frames(svg, curves, span, last_y + 15);
  svg.close_group();
  return std::move(svg).finish();
}

namespace {

constexpr std::size_t longest_window = 1024, shortest_window = 8;

// The transform of Cooley and Tukey; the length is a power of two.
void transform(std::vector<std::complex<double>>& values) {
  const std::size_t size = values.size();
  if (size < 2) return;
  std::vector<std::complex<double>> even, odd;
  for (std::size_t i = 0; i < size; i += 2) {
    even.push_back(values[i]);
    odd.push_back(values[i + 1]);
  }
  transform(even);
  transform(odd);
  for (std::size_t k = 0; k < size / 2; ++k) {
    const auto [sine, cosine] =
        portable::sine_and_cosine(-2 * pi * static_cast<double>(k) / static_cast<double>(size));
    const auto turned = std::complex(cosine, sine) * odd[k];
    values[k] = even[k] + turned;
    values[k + size / 2] = even[k] - turned;
  }
}

// Adds the power of a window; returns false if a sample is missing.
bool add_window(const std::vector<double>& axis, std::size_t start, double rate_hz,
                std::size_t size, std::vector<double>& density) {
  const auto first = axis.begin() + static_cast<std::ptrdiff_t>(start);
  const auto last = first + static_cast<std::ptrdiff_t>(size);
  if (!std::all_of(first, last, [](double value) { return std::isfinite(value); })) return false;
  double mean = 0, power = 0;
  for (auto value = first; value != last; ++value) mean += *value / static_cast<double>(size);
  std::vector<std::complex<double>> values;
  for (std::size_t i = 0; i < size; ++i) {
    const double window =
        0.5 - 0.5 * portable::cos(2 * pi * static_cast<double>(i) / static_cast<double>(size));
    power += window * window;
    values.emplace_back(window * (axis[start + i] - mean));
  }
  transform(values);
  for (std::size_t k = 0; k < density.size(); ++k) {
    const double sides = k == 0 || k == size / 2 ? 1 : 2;
    density[k] += sides * std::norm(values[k]) / (rate_hz * power);
  }
  return true;
}

std::vector<double> density_of(const std::vector<std::vector<double>>& axes, double rate_hz,
                               std::size_t size) {
  std::vector<double> density(size / 2 + 1);
  std::size_t windows = 0;
  for (const std::vector<double>& axis : axes) {
    for (std::size_t start = 0; start + size <= axis.size(); start += size / 2)
      windows += add_window(axis, start, rate_hz, size, density) ? 1 : 0;
  }
  if (windows == 0) return {};
  const double segments = static_cast<double>(windows) / static_cast<double>(axes.size());
  for (double& value : density) value /= segments;
  return density;
}

struct Axes {
  double left = 64, top = 28, width = 884, height = 220;  // pixels
  double most_hz = 1, low = 0, high = 1;                  // powers of ten

  double x(double hertz) const { return left + width * hertz / most_hz; }
  double y(double density) const {
    return top + height * (high - portable::log10(density)) / (high - low);
  }
};

Axes axes_of(const TrackSpectrum& spectrum, bool one_take) {
  Axes axes;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto* curve : {&spectrum.before, &spectrum.after}) {
    if (one_take && curve == &spectrum.before) continue;
    for (const double value : *curve) {
      if (!(value > 0)) continue;
      low = std::min(low, portable::log10(value));
      high = std::max(high, portable::log10(value));
    }
  }
  if (low > high) low = high = 0;
  // Power below 1e-12 of the largest is not motion.
  axes.high = std::ceil(high + 0.1);
  axes.low = std::floor(std::max(low, high - 12) - 0.1);
  if (!spectrum.hertz.empty()) axes.most_hz = spectrum.hertz.back();
  return axes;
}

void draw(Svg& svg, const Axes& axes, const std::vector<double>& hertz,
          const std::vector<double>& density, std::string_view ink) {
  std::vector<std::vector<Svg::Point>> lines(1);
  for (std::size_t k = 0; k < density.size(); ++k) {
    if (portable::log10(density[k]) > axes.low) {
      lines.back().push_back({axes.x(hertz[k]), axes.y(density[k])});
    } else if (!lines.back().empty()) {
      lines.emplace_back();
    }
  }
  svg.path(lines, fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.4\"", ink));
}

void draw_scales(Svg& svg, const Axes& axes) {
  svg.open_group(fmt::format("font-size=\"11\" fill=\"{}\"", inks::quiet));
  const double every = std::max(1.0, std::ceil((axes.high - axes.low) / 6));
  for (double power = axes.low; power <= axes.high; power += every) {
    const double y = axes.y(portable::pow(10.0, power));
    svg.line({axes.left, y}, {axes.left + axes.width, y}, fmt::format("stroke=\"{}\"", inks::grid));
    svg.text(axes.left - 5, y + 4, "text-anchor=\"end\"", fmt::format("1e{:.0f}", power));
  }
  const double step = std::max(1.0, std::round(axes.most_hz / 8));
  for (double hertz = 0; hertz <= axes.most_hz; hertz += step)
    svg.text(axes.x(hertz), axes.top + axes.height + 15, "text-anchor=\"middle\"",
             fmt::format("{:.0f} Hz", hertz));
  svg.close_group();
}

}  // namespace

TrackSpectrum track_spectrum(const TrackCurves& curves) {
  TrackSpectrum spectrum;
  const std::size_t frames = curves.difference.size();
  std::size_t size = longest_window;
  while (size > frames && size > shortest_window) size /= 2;
  if (size > frames || !(curves.frame_rate_hz > 0)) return spectrum;
  for (std::size_t k = 0; k <= size / 2; ++k)
    spectrum.hertz.push_back(static_cast<double>(k) * curves.frame_rate_hz /
                             static_cast<double>(size));
  spectrum.before = density_of(curves.before, curves.frame_rate_hz, size);
  spectrum.after = density_of(curves.after, curves.frame_rate_hz, size);
  return spectrum;
}

std::string spectrum_svg(const TrackCurves& curves, bool one_take) {
  const TrackSpectrum spectrum = track_spectrum(curves);
  const Axes axes = axes_of(spectrum, one_take);
  const std::string name = xml_escaped(printable_name(curves.name));
  const std::string unit =
      curves.unit.empty() ? "" : xml_escaped(printable(curves.unit)) + "\u00b2/Hz";
  Svg svg(960, 276, name + ": spectrum");
  svg.open_group(inks::font);
  svg.text(axes.left, 18, fmt::format("font-weight=\"600\" fill=\"{}\"", inks::text),
           fmt::format("{} {}, {}", name, curves.quantity, unit));
  svg.rectangle(axes.left, axes.top, axes.width, axes.height, "fill=\"#f8f9fa\"");
  draw_scales(svg, axes);
  if (!one_take) draw(svg, axes, spectrum.hertz, spectrum.before, inks::before);
  draw(svg, axes, spectrum.hertz, spectrum.after, inks::after);
  if (spectrum.before.empty() && spectrum.after.empty()) {
    svg.text(480, 140, fmt::format("text-anchor=\"middle\" fill=\"{}\"", inks::quiet),
             "too few samples without a gap");
  } else if (!one_take) {
    svg.text(840, 18, fmt::format("fill=\"{}\" text-anchor=\"end\"", inks::before), "before");
    svg.text(948, 18, fmt::format("fill=\"{}\" text-anchor=\"end\"", inks::after), "after");
  }
  svg.close_group();
  return std::move(svg).finish();
}

}  // namespace kinemend
