// Figure 6 of Lou & Chai 2010, Example-based Human Motion Denoising: both arms missing throughout,
// as joints and as markers.
#include <algorithm>
#include <array>
#include <cmath>

#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/motion.hpp"
#include "lou.hpp"

namespace kinemend::papers {
namespace {

bool has_part(const std::string& name, const auto& parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const char* part) { return name.find(part) != std::string::npos; });
}

bool is_of_an_arm(const std::string& name) {
  constexpr std::array parts = {"Arm", "Hand", "Finger", "Thumb"};
  constexpr std::array markers = {"UPA", "ELB", "FRM", "WRA", "WRB", "FIN"};  // names in C3D takes
  return has_part(name, parts) || has_part(name, markers);
}

Take without_arms(Take clip) {
  if (clip.has_joints()) clip.observed.resize(clip.rotations.size(), 1);
  for (std::size_t i = 0; i < clip.observed.size(); ++i) {
    if (!is_of_an_arm(clip.owner_names()[i % clip.owner_count()])) continue;
    clip.observed[i] = 0;
    if (clip.has_joints())
      clip.rotations[i] = {};
    else
      clip.positions[i] = {};
  }
  return clip;
}

// Mean distance over the points of the arms, centimetres.
double arm_distance(std::span<const Vec3> truth, std::span<const Vec3> other,
                    const std::vector<std::string>& names, double cm_per_unit) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!is_of_an_arm(names[i % names.size()])) continue;
    sum += norm(truth[i] - other[i]);
    count += 1;
  }
  return cm_per_unit * sum / count;
}

double cm_per_unit(const Take& clip) {
  const auto unit = guess_length_unit(clip.skeleton);
  return unit ? 100 * unit->metres : 1.0;
}

double error_of(const Cleaner& cleaner, const Take& truth) {
  const Take filled = cleaned(cleaner, without_arms(truth));
  return arm_distance(joint_positions(truth), joint_positions(filled), truth.skeleton.names,
                      cm_per_unit(truth));
}

double error_of(const Cleaner& cleaner, const Take& truth, double cm) {
  Take filled = without_arms(truth);
  clean_in_place(cleaner, filled);
  return arm_distance(truth.positions, filled.positions, truth.names, cm);
}

struct Fillers {
  std::vector<std::string> names;
  std::vector<std::unique_ptr<Cleaner>> cleaners;
};

Fillers fillers_of(const LouModels& models) {
  Fillers fillers;
  const auto add = [&](std::string name, std::unique_ptr<Cleaner> cleaner) {
    fillers.names.push_back(std::move(name));
    fillers.cleaners.push_back(std::move(cleaner));
  };
  add("example", make_example({}, models.example));
  add("example, solver=paper", papers_example(models.example));
  add("kalman-learned", make_kalman_learned({}, models.kalman));
  if (models.wiener) add("wiener", make_wiener({}, models.wiener));
  return fillers;
}

struct Result {
  std::string take;
  std::vector<double> errors_cm;
};

void joints_and_joint_markers(const std::vector<LouGroup>& groups, std::vector<Result>& results,
                              std::vector<std::string>& columns) {
  for (const LouGroup& group : groups) {
    const Fillers of_joints = fillers_of(lou_models(group.training));
    std::vector<Take> markers;
    for (const Take& clip : group.training) markers.push_back(joint_markers(clip, true));
    const Fillers of_markers = fillers_of(lou_models(markers));
    columns = of_joints.names;
    Result joints{group.name + ", joints", {}}, as_markers{group.name + ", markers", {}};
    for (std::size_t c = 0; c < columns.size(); ++c) {
      double joint_sum = 0, marker_sum = 0;
      for (const Take& truth : group.tests) {
        joint_sum += error_of(*of_joints.cleaners[c], truth);
        marker_sum +=
            error_of(*of_markers.cleaners[c], joint_markers(truth, true), cm_per_unit(truth));
      }
      const auto tests = static_cast<double>(group.tests.size());
      joints.errors_cm.push_back(joint_sum / tests);
      as_markers.errors_cm.push_back(marker_sum / tests);
    }
    results.push_back(joints);
    results.push_back(as_markers);
  }
}

// Captured markers: another sequence of the same subject. The motion is breakdance, so sequences
// differ.
void captured_markers(const Arguments& arguments, std::vector<Result>& results) {
  const auto training = find_take(arguments.data, "85_12.c3d");
  const auto test = find_take(arguments.data, "85_02.c3d");
  if (!training || !test || arguments.quick) return;
  const std::vector<Take> clips = {read_take(*training).take};
  const Take truth = resample(read_take(*test).take, lou_rate_hz);
  const Fillers fillers = fillers_of(lou_models(clips));
  Result result{"CMU 85_02, markers (C3D)", {}};
  for (const auto& cleaner : fillers.cleaners)
    result.errors_cm.push_back(error_of(*cleaner, truth, 0.1));
  results.push_back(result);
}

void figure_6(const Arguments& arguments) {
  std::vector<Result> results;
  std::vector<std::string> columns;
  joints_and_joint_markers(walking_groups(arguments), results, columns);
  captured_markers(arguments, results);
  Table table(arguments, "lou_missing.csv", "take,method,distance_cm");
  fmt::print("Figure 6: both arms missing throughout. Mean distance of what is of an arm, cm.\n\n");
  std::vector<std::string> short_names;
  for (const std::string& column : columns)
    short_names.push_back(column.find("paper") == std::string::npos ? column.substr(0, 8)
                                                                    : "paper");
  const TextTable text(short_names);
  for (const Result& result : results) {
    text.add(result.take, result.errors_cm);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      table.add({papers::quoted(result.take), papers::quoted(columns[c]),
                 fmt::format("{:.4g}", result.errors_cm[c])});
    }
  }
  table.close();
}

const Registration lou_missing_entry("lou_missing", figure_6);

}  // namespace
}  // namespace kinemend::papers
