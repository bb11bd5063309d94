// Makes takes of markers, selects the points that are positions, and finds units by name.
#include "kinemend/take.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kinemend/error.hpp"
#include "kinemend/experimental/convert.hpp"
#include "kinemend/experimental/frame_rate.hpp"
#include "kinemend/experimental/letter_case.hpp"
#include "motion/take_checks.hpp"

namespace kinemend {

std::string_view without_subject(std::string_view name) {
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

Take make_marker_take(std::vector<std::string> names, std::size_t frames, double frame_rate_hz) {
  Take clip;
  clip.names = std::move(names);
  clip.frame_rate_hz = frame_rate_hz;
  const std::size_t samples = frames * clip.names.size();
  clip.positions.resize(samples);
  clip.observed.resize(samples, 0);
  clip.is_position.assign(clip.names.size(), 1);
  return clip;
}

Take positions_only(const Take& clip) {
  std::vector<std::size_t> kept;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (clip.holds_positions(m)) kept.push_back(m);
  }
  Take result = clip;
  const auto keep = [&](auto& values, std::size_t rows) {
    if (values.empty()) return;
    auto out = values.begin();
    for (std::size_t row = 0; row < rows; ++row) {
      for (const std::size_t m : kept) *out++ = values[row * clip.marker_count() + m];
    }
    values.erase(out, values.end());
  };
  keep(result.names, 1);
  keep(result.is_position, 1);
  keep(result.positions, clip.frame_count());
  keep(result.observed, clip.frame_count());
  keep(result.residuals, clip.frame_count());
  return result;
}

double metres_per_unit(std::string_view unit) {
  static constexpr std::array<std::pair<std::string_view, double>, 18> known{{
      {"m", 1},
      {"metre", 1},
      {"metres", 1},
      {"meter", 1},
      {"meters", 1},
      {"dm", 0.1},
      {"cm", 0.01},
      {"centimeters", 0.01},
      {"mm", 0.001},
      {"millimetres", 0.001},
      {"millimeters", 0.001},
      {"um", 1e-6},
      {"in", 0.0254},
      {"inch", 0.0254},
      {"inches", 0.0254},
      {"ft", 0.3048},
      {"foot", 0.3048},
      {"feet", 0.3048},
  }};
  const std::string lower = lower_case(unit);
  const auto found = std::find_if(known.begin(), known.end(),
                                  [&](const auto& entry) { return entry.first == lower; });
  return found == known.end() ? 0 : found->second;
}

std::string unit_name(double metres) {
  for (const char* const name : {"m", "cm", "mm", "in"}) {
    const double known = metres_per_unit(name);
    if (std::fabs(metres - known) <= 1e-9 * known) return name;
  }
  return "";
}

}  // namespace kinemend
