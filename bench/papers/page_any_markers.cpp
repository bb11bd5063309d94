// Figures of docs/methods/learned.md: markers of bodies that travel, under noise and clean.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/quantiles.hpp"
#include "compared.hpp"
#include "kept_takes.hpp"
#include "kinemend/experimental/convert.hpp"
#include "kinemend/methods.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

struct Noise {
  std::string name;
  double std_mm, correlation;
};

const std::vector<Noise> marker_noises{{"none", 0, 0},
                                       {"white 1 mm", 1, 0},
                                       {"white 3 mm", 3, 0},
                                       {"white 15 mm", 15, 0},
                                       {"correlation 0.8, 3 mm", 3, 0.8},
                                       {"correlation 0.8, 15 mm", 15, 0.8},
                                       {"correlation 0.95, 15 mm", 15, 0.95}};

Take in_millimetres(const Take& clip) {
  const auto unit = guess_length_unit(clip.skeleton);
  return joint_markers(scale_lengths(clip, 1000 * (unit ? unit->metres : 1)));
}

Take with_marker_noise(Take clip, const Noise& noise, std::uint64_t seed) {
  Random random(seed);
  const std::size_t markers = clip.marker_count();
  const double fresh = std::sqrt(1 - noise.correlation * noise.correlation);
  for (std::size_t m = 0; m < markers; ++m) {
    Vec3 error{};
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      const Vec3 drawn{random.normal(), random.normal(), random.normal()};
      error = f == 0 ? drawn : noise.correlation * error + fresh * drawn;
      clip.positions[f * markers + m] += noise.std_mm * error;
    }
  }
  return clip;
}

Take markers_cleaned_by(const Compared& compared, Take clip) {
  clean_in_place(*make_cleaner(compared.method, compared.options), clip);
  return clip;
}

// Millimetres, root mean square of distances.
double distance_mm(const Take& a, const Take& b) {
  double square = 0;
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    const Vec3 d = a.positions[i] - b.positions[i];
    square += dot(d, d);
  }
  return std::sqrt(square / static_cast<double>(a.positions.size()));
}

void markers_under_noise(const Arguments& arguments) {
  Table table(arguments, "any_markers.csv", "noise,method,takes,rms_mm");
  const std::vector<std::string> names = kept_takes(arguments);
  for (const Noise& noise : marker_noises) {
    std::map<std::string, double> errors;
    for (const std::string& name : names) {
      const Take truth = in_millimetres(kept_take(arguments, name));
      const Take clip = with_marker_noise(truth, noise, 7);
      const auto count = static_cast<double>(names.size());
      errors["untouched"] += distance_mm(truth, clip) / count;
      for (const Compared& compared : auto_and_learned)
        errors[compared.label] += distance_mm(truth, markers_cleaned_by(compared, clip)) / count;
    }
    for (const auto& [method, error] : errors) {
      table.add({quoted(noise.name), method, fmt::format("{}", names.size()), figure(error)});
      fmt::print("{:24} {:14} {:.3f} mm\n", noise.name, method, error);
    }
  }
  table.close();
}

// Optical takes as they were recorded: what changes of them.
void optical_takes(const Arguments& arguments) {
  Table table(arguments, "any_optical.csv", "method,takes,median_mm,most_mm");
  std::vector<Take> takes;
  for (const char* file :
       {"85_02.c3d", "85_12.c3d", "05_13.c3d", "HDM_bd_05-01_01_120.c3d", "SprintMotion.trc"}) {
    if (arguments.quick) break;
    if (const auto path = find_take(arguments.data, file)) takes.push_back(read_take(*path).take);
  }
  if (takes.empty()) takes.push_back(in_millimetres(synthesize({.motion = "run"})));
  for (const Compared& compared : auto_and_learned) {
    std::vector<double> changes;
    for (const Take& clip : takes) {
      const double metres = metres_per_unit(clip.unit);
      changes.push_back((metres > 0 ? 1000 * metres : 1) *
                        distance_mm(clip, markers_cleaned_by(compared, clip)));
    }
    table.add({compared.label, fmt::format("{}", takes.size()), figure(upper_median_of(changes)),
               figure(*std::max_element(changes.begin(), changes.end()))});
    fmt::print("optical takes: {:14} median {:.4f} mm, most {:.3f} mm\n", compared.label,
               upper_median_of(changes), *std::max_element(changes.begin(), changes.end()));
  }
  table.close();
}

// Markers of the hands of a clean take that shake by 6 cm for two seconds: the share of that which
// is left.
void shaking_hands(const Arguments& arguments) {
  constexpr double size_mm = 60;
  Table table(arguments, "any_shaking.csv", "frequency_hz,method,share");
  const Take still = in_millimetres(kept_take(arguments, kept_takes(arguments).back()));
  for (const double frequency_hz : {3.0, 5.0, 7.0}) {
    Take shaking = still;
    const std::size_t markers = still.marker_count(), first = still.frame_count() / 3,
                      last = first + static_cast<std::size_t>(2 * still.frame_rate_hz);
    const auto shakes_at = [&](std::size_t f) {
      const auto inside = static_cast<double>(std::min(f - first, last - 1 - f));
      return size_mm * std::min(1.0, inside / (0.2 * still.frame_rate_hz)) *
             std::sin(2 * std::numbers::pi * frequency_hz * static_cast<double>(f) /
                      still.frame_rate_hz);
    };
    const auto is_hand = [&](std::size_t m) {
      return still.names[m].find("Hand") != std::string::npos;
    };
    for (std::size_t f = first; f < std::min(last, still.frame_count()); ++f) {
      for (std::size_t m = 0; m < markers; ++m)
        if (is_hand(m)) shaking.positions[f * markers + m].z += shakes_at(f);
    }
    for (const Compared& compared : auto_and_learned) {
      const Take result = markers_cleaned_by(compared, shaking);
      double left = 0, put = 0;
      for (std::size_t f = first; f < std::min(last, still.frame_count()); ++f) {
        for (std::size_t m = 0; m < markers; ++m) {
          if (!is_hand(m)) continue;
          const std::size_t i = f * markers + m;
          left += shakes_at(f) * (result.positions[i].z - still.positions[i].z);
          put += shakes_at(f) * shakes_at(f);
        }
      }
      table.add({fmt::format("{:g}", frequency_hz), compared.label, figure(left / put)});
      fmt::print("hands shake at {} Hz: {:14} {:.3f} is left\n", frequency_hz, compared.label,
                 left / put);
    }
  }
  table.close();
}

void experiment(const Arguments& arguments) {
  shaking_hands(arguments);
  markers_under_noise(arguments);
  optical_takes(arguments);
}

const Registration registration("page_any_markers", experiment);

}  // namespace
}  // namespace kinemend::papers
