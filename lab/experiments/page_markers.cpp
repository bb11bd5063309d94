// Figures of README.md and docs about markers: noise on optical takes, and artificial gaps in takes
// without gaps.
#include <algorithm>

#include "experiment.hpp"
#include "kinemend/fill.hpp"
#include "quality/gapped_markers.hpp"
#include "quality/marker_quality.hpp"

namespace kinemend::papers {
namespace {

using quality::cleaned_markers, quality::damaged_markers, test::rms_distance;

std::string figure(double value) { return fmt::format("{:.5g}", value); }

/// The first points of a real take, or markers of a synthetic walk without data.
Take points(const Arguments& arguments, const char* file, std::size_t skip, std::size_t most) {
  const auto path = find_take(arguments.data, file);
  return path ? quality::points_of(*path, skip, most) : test::marker_take("walk", 5);
}

// Uses a part that is long enough: 10 s of 41 markers, 2 s of 330.
void noise(const Arguments& arguments) {
  Table table(arguments, "page_marker_noise.csv", "take,noise_mm,noisy,auto,other,method");
  for (const char* file : {"85_02.c3d", "85_12.c3d", "05_13.c3d"}) {
    const Take all = points(arguments, file, 0, 1000);
    const std::size_t frames = all.marker_count() > 100 ? 240 : 1200;
    const Take truth = slice(all, 0, std::min(all.frame_count(), frames));
    for (const double noise_mm : {2.0, 5.0, 10.0}) {
      const Take noisy = damaged_markers(truth, noise_mm, 11);
      double best = 1e300;
      std::string best_method;
      for (const std::string& method : quality::other_methods()) {
        const double error = rms_distance(cleaned_markers(noisy, method), truth);
        if (error < best) best = error, best_method = method;
      }
      table.add(
          {std::string(file, 5), fmt::format("{}", noise_mm), figure(rms_distance(noisy, truth)),
           figure(rms_distance(cleaned_markers(noisy, "auto"), truth)), figure(best), best_method});
    }
    if (arguments.quick) break;
  }
  table.close();
}

void gaps(const Arguments& arguments) {
  struct Case {
    const char *file, *name;
    std::size_t skip, most, length;
    std::vector<std::string> methods;
  };
  constexpr std::size_t body_markers = 41;
  const std::vector<Case> cases{
      {"85_02.c3d",
       "85_02",
       0,
       body_markers,
       30,
       {"auto", "local-regression", "rigid-body", "pca", "spline", "quintic", "pchip"}},
      {"85_02.c3d", "85_02", 0, body_markers, 120, {"auto", "pca"}},
      {"85_12.c3d", "85_12", 0, body_markers, 120, {"auto", "pca"}},
      {"05_13.c3d", "05_13", 0, body_markers, 120, {"auto", "pca"}},
      {"HDM_bd_05-01_01_120.c3d", "bd_05-01", 3, body_markers, 120, {"auto", "pca"}},
      {"S02-Trial-Walk-1-vicon.c3d", "points of legs", 0, 9, 100, {"auto", "pca"}}};
  Table table(arguments, "page_gaps.csv", "take,frames,method,mean_mm,worst_mm,refused");
  const std::uint64_t seeds = arguments.quick ? 2 : 10;
  for (const Case& one : cases) {
    const Take truth = points(arguments, one.file, one.skip, one.most);
    for (const std::string& method : one.methods) {
      double mean = 0, worst = 0;
      std::size_t refused = 0;
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const Take damaged = quality::with_gaps(truth, one.length, seed);
        Take clip = damaged;
        FillSettings settings;
        settings.method = method;
        refused += fill_gaps(clip, settings).refused();
        settings.fill_all = true;
        fill_gaps(clip, settings);
        double sum = 0, count = 0;
        for (std::size_t i = 0; i < clip.positions.size(); ++i) {
          if (damaged.observed[i] != 0) continue;
          sum += norm(clip.positions[i] - truth.positions[i]);
          count += 1;
        }
        mean += sum / count / static_cast<double>(seeds);
        worst = std::max(worst, sum / count);
      }
      table.add({one.name, fmt::format("{}", one.length), method, figure(mean), figure(worst),
                 fmt::format("{}", refused)});
    }
    if (arguments.quick) break;
  }
  table.close();
}

void page_markers(const Arguments& arguments) {
  noise(arguments);
  gaps(arguments);
}

const Registration page_markers_entry("page_markers", page_markers);

}  // namespace
}  // namespace kinemend::papers
