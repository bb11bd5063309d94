// Figures of `sparse` on takes outside its model's training: the error left for several kinds of
// noise, the error of a filled arm, and the changes to clean takes.
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/motion.hpp"
#include "page.hpp"
#include "quality/lower_rate.hpp"

namespace kinemend::papers {
namespace {

struct SparseKind {
  std::string name;
  std::function<Take(const Take&)> damage;
};

std::vector<SparseKind> sparse_kinds() {
  using quality::of_lower_rate;
  const auto of = [](const std::string& name, const OptionValues& options) {
    return [name, options](const Take& c) { return damaged(c, name, options, 5); };
  };
  return {{"white 1", of("gaussian", {{"std_deg", 1.0}})},
          {"white 4 and spikes", [](const Take& c) { return noisy(c, 4, 0.004, 5); }},
          {"10 % outliers", [](const Take& c) { return noisy(c, 1, 0.1, 5); }},
          {"ar1 0.5", of("ar1", {{"std_deg", 1.5}, {"correlation", 0.5}})},
          {"ar1 0.8", of("ar1", {{"std_deg", 1.5}, {"correlation", 0.8}})},
          {"ar1 0.95", of("ar1", {{"std_deg", 1.5}, {"correlation", 0.95}})},
          {"held 60", [](const Take& c) { return of_lower_rate(noisy(c, 1.5, 0, 5), 2, true); }},
          {"linear 30", [](const Take& c) { return of_lower_rate(noisy(c, 1.5, 0, 5), 4, false); }},
          {"video", of("system", {{"kind", std::string("video")}})},
          {"inertial", of("system", {{"kind", std::string("inertial")}})}};
}

// Three seconds of each of ten hold-outs of cmu/recurrent-100.csv, which are outside the training
// of these models.
std::vector<Take> takes(const Arguments& arguments) {
  std::vector<std::string> names{"02_02", "05_01", "07_02", "08_01", "16_15",
                                 "26_01", "35_02", "09_01", "10_01", "135_04"};
  if (arguments.quick || arguments.data.empty()) names = {"walk"};
  std::vector<Take> clips;
  for (const std::string& name : names) {
    const Take clip = load_take(arguments, name + ".bvh", {.motion = "walk"}).clip;
    clips.push_back(slice(clip, 0, std::min<std::size_t>(clip.frame_count(), 361)));
  }
  return clips;
}

void noises(const Arguments& arguments, const std::vector<Take>& truths) {
  Table table(arguments, "sparse_kinds.csv", "kind,takes,noisy_deg,auto_deg,sparse_deg,of_auto");
  const auto count = static_cast<double>(truths.size());
  for (const SparseKind& kind : sparse_kinds()) {
    double before = 0, automatic = 0, sparse = 0, share = 0;
    for (const Take& take : truths) {
      const Take clip = kind.damage(take);
      const Take truth = slice(take, 0, clip.frame_count());
      const double a = geodesic_rms_deg(truth, cleaned(clip, "auto"));
      const double s = geodesic_rms_deg(truth, cleaned(clip, "sparse"));
      before += geodesic_rms_deg(truth, clip) / count;
      automatic += a / count, sparse += s / count;
      share += std::log(s / a) / count;
    }
    table.add({kind.name, fmt::format("{}", truths.size()), figure(before), figure(automatic),
               figure(sparse), figure(std::exp(share))});
    fmt::print("{:20} {:.3f} auto {:.3f} sparse {:.3f} deg, {:.3f} of auto\n", kind.name, before,
               automatic, sparse, std::exp(share));
    std::fflush(stdout);
  }
  table.close();
}

// Error of the left arm's joints that a gap of shoulder, elbow and hand affects, centimetres.
double arm_distance_cm(const Take& truth, const Take& filled, std::size_t first, std::size_t last,
                       const std::vector<std::size_t>& arm) {
  const auto unit = guess_length_unit(truth.skeleton);
  const std::vector<Vec3> from = joint_positions(truth), to = joint_positions(filled);
  double sum = 0;
  for (std::size_t f = first; f < last; ++f) {
    for (const std::size_t joint : arm)
      sum += norm(from[f * truth.joint_count() + joint] - to[f * truth.joint_count() + joint]);
  }
  return (unit ? 100 * unit->metres : 1) * sum / static_cast<double>((last - first) * arm.size());
}

// White noise of 1 degree, and the left arm hidden for a while in the middle.
void gaps(const Arguments& arguments, const std::vector<Take>& truths) {
  Table table(arguments, "sparse_gaps.csv", "gap,takes,example,wiener,sparse");
  for (const auto& [name, seconds] : {std::pair{"0.1 s", 0.1}, {"0.25 s", 0.25}, {"1 s", 1.0}}) {
    std::vector<double> sums(3, 0);
    for (const Take& truth : truths) {
      Take clip = noisy(truth, 1, 0, 5);
      clip.observed.assign(clip.rotations.size(), 1);
      const auto half = static_cast<std::size_t>(0.5 * seconds * clip.frame_rate_hz);
      const std::size_t middle = clip.frame_count() / 2;
      const std::size_t first = middle - std::min(half, middle);
      const std::size_t last = std::min(middle + half, clip.frame_count());
      std::vector<std::size_t> arm;
      for (const char* joint : {"LeftArm", "LeftForeArm", "LeftHand"}) {
        if (const auto found = clip.skeleton.find(joint); found >= 0)
          arm.push_back(static_cast<std::size_t>(found));
      }
      if (arm.size() < 2) continue;
      for (std::size_t f = first; f < last; ++f) {
        for (const std::size_t joint : arm) {
          clip.observed[f * clip.joint_count() + joint] = 0;
          clip.rotation(f, joint) = {};
        }
      }
      arm.erase(arm.begin());  // the shoulder itself does not move
      for (std::size_t m = 0; m < sums.size(); ++m) {
        const char* method = m == 0 ? "example" : m == 1 ? "wiener" : "sparse";
        sums[m] += arm_distance_cm(truth, cleaned(clip, method), first, last, arm) /
                   static_cast<double>(truths.size());
      }
    }
    table.add({name, fmt::format("{}", truths.size()), figure(sums[0]), figure(sums[1]),
               figure(sums[2])});
    fmt::print("arm unseen for {}: example {:.2f} wiener {:.2f} sparse {:.2f} cm\n", name, sums[0],
               sums[1], sums[2]);
    std::fflush(stdout);
  }
  table.close();
}

// Uses every fourth take of the library.
void sparse_on_clean_takes(const Arguments& arguments) {
  Table table(arguments, "sparse_clean.csv", "method,takes,unchanged,mean_deg,largest_deg");
  std::set<std::string> all;
  for (const char* part : {"cmu/bvh", "cmu/bvh-rotations"}) {
    if (!std::filesystem::is_directory(arguments.data / part)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(arguments.data / part))
      all.insert(entry.path().filename().string());
  }
  std::vector<std::string> names;
  std::size_t number = 0;
  for (const std::string& name : all) {
    if (number++ % (arguments.quick ? 80 : 4) == 0) names.push_back(name);
  }
  if (names.empty()) names = {"walk", "run", "punch", "wave", "landing"};
  for (const char* method : {"auto", "sparse"}) {
    std::size_t unchanged = 0;
    double mean = 0, largest = 0;
    for (const std::string& name : names) {
      const Take clip = load_take(arguments, name, {.motion = name}).clip;
      const double change = rms_deg(clip, cleaned(clip, method));
      unchanged += change == 0 ? 1 : 0;
      mean += change / static_cast<double>(names.size());
      largest = std::max(largest, change);
    }
    table.add({method, fmt::format("{}", names.size()), fmt::format("{}", unchanged), figure(mean),
               figure(largest)});
  }
  table.close();
}

void page_sparse(const Arguments& arguments) {
  const std::vector<Take> truths = takes(arguments);
  noises(arguments, truths);
  gaps(arguments, truths);
  sparse_on_clean_takes(arguments);
}

const Registration page_sparse_entry("page_sparse", page_sparse);

}  // namespace
}  // namespace kinemend::papers
