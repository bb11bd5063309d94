// Figures of docs/measured/learned.md: markers of moving bodies, noisy and clean.
#include <algorithm>
#include <map>

#include "base/quantiles.hpp"
#include "compared.hpp"
#include "kept_takes.hpp"
#include "kinemend/methods.hpp"
#include "marker_noise.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

const std::vector<MarkerNoise> marker_noises{{"none", 0, 0},
                                             {"white 1 mm", 1, 0},
                                             {"white 3 mm", 3, 0},
                                             {"white 15 mm", 15, 0},
                                             {"correlation 0.8, 3 mm", 3, 0.8},
                                             {"correlation 0.8, 15 mm", 15, 0.8},
                                             {"correlation 0.95, 15 mm", 15, 0.95}};

Take markers_cleaned_by(const Compared& compared, Take clip) {
  clean_in_place(*make_cleaner(compared.method, compared.options), clip);
  return clip;
}

void markers_under_noise(const Arguments& arguments) {
  Table table(arguments, "any_markers.csv", "noise,method,takes,rms_mm");
  const std::vector<std::string> names = kept_takes(arguments);
  for (const MarkerNoise& noise : marker_noises) {
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

// Measures how much optical takes change as recorded.
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

// Measures the remaining share of shaking hand markers in a clean take.
void shaking_hands(const Arguments& arguments) {
  Table table(arguments, "any_shaking.csv", "frequency_hz,method,share");
  const Take still = in_millimetres(kept_take(arguments, kept_takes(arguments).back()));
  for (const double frequency_hz : {3.0, 5.0, 7.0}) {
    const Take shaking = with_shaking_hands(still, frequency_hz);
    for (const Compared& compared : auto_and_learned) {
      const Take result = markers_cleaned_by(compared, shaking);
      double left = 0, put = 0;
      for (std::size_t i = 0; i < still.positions.size(); ++i) {
        const double shake = shaking.positions[i].z - still.positions[i].z;
        left += shake * (result.positions[i].z - still.positions[i].z);
        put += shake * shake;
      }
      table.add({fmt::format("{:g}", frequency_hz), compared.label, figure(left / put)});
      fmt::print("hands shake at {} Hz: {:14} {:.3f} is left\n", frequency_hz, compared.label,
                 left / put);
    }
  }
  table.close();
}

void page_any_markers(const Arguments& arguments) {
  shaking_hands(arguments);
  markers_under_noise(arguments);
  optical_takes(arguments);
}

const Registration page_any_markers_entry("page_any_markers", page_any_markers);

}  // namespace
}  // namespace kinemend::papers
