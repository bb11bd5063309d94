// Computes the power spectrum of a track, and draws it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "base/portable.hpp"
#include "kinemend/extend/pages.hpp"
#include "kinemend/extend/rotation.hpp"
#include "kinemend/extend/text.hpp"
#include "report/drawing.hpp"

namespace kinemend {

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
  const double bottom = axes.top + axes.height;
  const double every = std::max(1.0, std::ceil((axes.high - axes.low) / 6));
  for (double power = axes.low; power <= axes.high; power += every) {
    const double y = axes.y(portable::pow(10.0, power));
    svg.line({axes.left, y}, {axes.left + axes.width, y}, fmt::format("stroke=\"{}\"", inks::grid));
    svg.text(axes.left - 5, y + 4, "text-anchor=\"end\"", fmt::format("1e{:.0f}", power));
  }
  const double step = std::max(1.0, std::round(axes.most_hz / 8));
  for (double hertz = 0; hertz <= axes.most_hz; hertz += step)
    svg.text(axes.x(hertz), bottom + 15, "text-anchor=\"middle\"", fmt::format("{:.0f} Hz", hertz));
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
