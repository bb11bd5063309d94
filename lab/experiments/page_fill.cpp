// Figures of docs/methods/fill.md and fill-joints.md: expected and real errors of filled gaps, and
// the methods for joints by gap length.
#include <algorithm>

#include "fill/made_gaps.hpp"
#include "page.hpp"
#include "quality/gapped_markers.hpp"
#include "quality/marker_quality.hpp"

namespace kinemend::papers {
namespace {

// `least` is the smallest error of a short gap that is counted, millimetres or degrees.
void add_promises(Table& table, const std::string& takes, const std::vector<fill::Kept>& kept,
                  double least) {
  const fill::Figures f = fill::figures_of(kept, least);
  table.add({takes, fmt::format("{}", f.gaps), figure(100 * f.share_within_twice()),
             fmt::format("{}", f.above_ten), figure(f.worst),
             fmt::format("{}", f.worse_than_spline), fmt::format("{}", f.short_gaps)});
}

void promises(const Arguments& arguments) {
  Table table(arguments, "page_promises.csv",
              "takes,gaps,within_twice_percent,above_ten,worst,worse_than_spline,short_gaps");
  const std::uint64_t rounds = arguments.quick ? 2 : 8;
  std::vector<fill::Kept> kept;
  const auto keep = [&](const auto& truth, const std::vector<std::size_t>& tracks) {
    for (std::uint64_t seed = 1; seed <= rounds; ++seed) {
      const auto some = fill::make_and_fill(truth, tracks, 8, seed);
      kept.insert(kept.end(), some.begin(), some.end());
    }
  };
  for (const char* file : {"HDM_bd_05-01_01_120.c3d", "FunctionalLHip.c3d", "561xxa01_anonym.C3D",
                           "sample21.c3d", "S02-Trial-Walk-1-vicon.c3d", "SprintMotion.trc",
                           "ballet_reduced.trc", "depth-RTK.reference.trc"}) {
    const auto path = find_take(arguments.data, file);
    const bool is_hdm = std::string(file).starts_with("HDM");  // their first points are not markers
    const Take truth =
        path ? quality::points_of(*path, is_hdm ? 3 : 0, 41) : test::marker_take("walk", 5);
    keep(truth, fill::whole_markers(truth));
    if (arguments.quick) break;
  }
  add_promises(table, "markers", kept, 0.5);
  kept.clear();
  for (const char* name :
       {"01_05", "03_03", "07_04", "09_05", "10_03", "11_01", "35_20", "131_05"}) {
    const Take truth = load_take(arguments, std::string(name) + ".bvh", {.motion = "walk"}).clip;
    keep(truth, fill::moving_joints(truth));
    if (arguments.quick) break;
  }
  add_promises(table, "joints", kept, 0.1);
  table.close();
}

// Adds three gaps to each of five moving joints, at random places.
Take with_gaps(const Take& truth, std::size_t length, std::uint64_t seed) {
  constexpr std::size_t apart = 3;
  Random random(seed);
  Take clip = truth;
  std::vector<std::size_t> joints = fill::moving_joints(truth);
  for (std::size_t i = 0; i < 5; ++i) {
    std::swap(joints[i], joints[i + random.below(joints.size() - i)]);
    for (const std::size_t start : fill::three_starts(random, clip.frame_count(), length, apart))
      fill::hide(clip, truth.skeleton.names[joints[i]], start, start + length - 1);
  }
  return clip;
}

double mean_error_deg(const Take& truth, const Take& damaged, const Take& filled) {
  double sum = 0, count = 0;
  for (std::size_t f = 0; f < truth.frame_count(); ++f) {
    for (std::size_t j = 0; j < truth.joint_count(); ++j) {
      if (damaged.is_observed(f, j)) continue;
      sum += fill::distance(truth, filled, f, j);
      count += 1;
    }
  }
  return sum / count;
}

void joints_by_length(const Arguments& arguments) {
  Table table(arguments, "page_joint_gaps.csv", "method,length_s,mean_deg");
  std::vector<Take> truths;
  for (const auto& [name, motion] :
       {std::pair{"35_01", "walk"}, {"02_05", "punch"}, {"09_03", "run"}})
    truths.push_back(load_take(arguments, std::string(name) + ".bvh", {.motion = motion}).clip);
  for (const double length_s : {0.1, 0.25, 1.0}) {
    for (const char* method :
         {"auto", "slerp", "squad", "spline", "quintic", "pchip", "hermite", "cyclic", "pca"}) {
      double mean = 0, count = 0;
      for (const Take& truth : truths) {
        const auto length = static_cast<std::size_t>(length_s * truth.frame_rate_hz);
        if (truth.frame_count() < 3 * length + 30) continue;  // too short, as a run is
        for (std::uint64_t seed = 1; seed <= (arguments.quick ? 1 : 10); ++seed) {
          const Take damaged = with_gaps(truth, length, seed);
          Take filled = fill::spoilt(damaged);
          fill::fill_with(filled, method, true);
          mean += mean_error_deg(truth, damaged, filled);
          count += 1;
        }
      }
      table.add({method, fmt::format("{:g}", length_s), figure(mean / count)});
    }
  }
  table.close();
}

void page_fill(const Arguments& arguments) {
  promises(arguments);
  joints_by_length(arguments);
}

const Registration page_fill_entry("page_fill", page_fill);

}  // namespace
}  // namespace kinemend::papers
