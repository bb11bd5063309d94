// The experiments of Courty 2008, Bilateral Human Motion Filtering: mean square error against the
// number of passes for several sigma_g (figure 3), velocity profiles of one joint (figure 2) and
// the path of a hand (figure 4).
#include <algorithm>
#include <cmath>

#include "experiment.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/lab/corrupt.hpp"

namespace kinemend::papers {
namespace {

// The paper's angles are those of the quaternion's logarithm: half the rotation angle. sigma_t is
// in frames.
constexpr double paper_noise = 0.18;
constexpr double paper_sigma_g = 0.1;
constexpr double paper_sigma_t_frames = 1.0;
constexpr int paper_passes = 5;

double sigma_g_deg(double paper_value) { return 2 * paper_value * degrees_per_radian; }

std::vector<Quat> track_of(const Take& clip, std::size_t joint) {
  std::vector<Quat> track;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) track.push_back(clip.rotation(f, joint));
  return track;
}

double path_rad(const Take& clip, std::size_t joint, std::size_t first, std::size_t last) {
  double sum = 0;
  for (std::size_t f = first + 1; f < last; ++f) {
    sum += angle_between(clip.rotation(f - 1, joint), clip.rotation(f, joint));
  }
  return sum;
}

bool is_arm(const std::string& name) {
  return name.find("Arm") != std::string::npos || name.ends_with("Hand");
}

// The part of `frames` frames, taking every `step`-th, in which the arms turn most.
Take busiest_part(const Take& clip, std::size_t step, std::size_t frames) {
  std::size_t best = 0;
  double most = -1;
  for (std::size_t first = 0; first + step * frames <= clip.frame_count(); first += 10) {
    double sum = 0;
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      if (is_arm(clip.skeleton.names[j])) sum += path_rad(clip, j, first, first + step * frames);
    }
    if (sum > most) most = sum, best = first;
  }
  return thinned(clip, best, step, frames);
}

// The paper shows the left hand; here it is the hand that turns more.
std::size_t busiest_hand(const Take& clip) {
  std::size_t best = 0;
  double most = -1;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    if (!clip.skeleton.names[j].ends_with("Hand")) continue;
    const double path = path_rad(clip, j, 0, clip.frame_count());
    if (path > most) most = path, best = j;
  }
  return best;
}

Take bilateral(Take clip, double paper_value, std::int64_t passes) {
  const BilateralOptions options{paper_sigma_t_frames / clip.frame_rate_hz,
                                 sigma_g_deg(paper_value), passes, "mirror"};
  clean_in_place(*make_bilateral(options), clip);
  return clip;
}

double arms_mse(const Take& truth, const Take& other) {
  double sum = 0, count = 0;
  for (std::size_t j = 0; j < truth.joint_count(); ++j) {
    if (!is_arm(truth.skeleton.names[j])) continue;
    sum += mse_rad2(track_of(truth, j), track_of(other, j));
    count += 1;
  }
  return sum / count;
}

// Figure 3. A filter with a sigma_g so large that it sees no edges is the Gaussian.
void mean_square_errors(const Arguments& arguments, const Take& truth, const Take& noisy) {
  const std::vector<double> sigmas{0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 8.0};
  const int passes = arguments.quick ? 6 : 20;
  Table table(arguments, "courty_mse.csv", "sigma_g,passes,mse_rad2");
  fmt::print(
      "Figure 3: MSE (rad^2, rotation angles; the paper's are a quarter), mean over the arms,\n"
      "against passes, sigma_t = 1 frame. sigma_g in the paper's units; 8 is wide enough for a "
      "Gaussian.\n\n"
      "{:>8}",
      "passes");
  for (const double sigma : sigmas) fmt::print("{:>10}", sigma);
  fmt::print("\n");
  std::vector<Take> clips(sigmas.size(), noisy);
  for (int pass = 0; pass <= passes; ++pass) {
    fmt::print("{:8}", pass);
    for (std::size_t s = 0; s < sigmas.size(); ++s) {
      if (pass > 0) clips[s] = bilateral(clips[s], sigmas[s], 1);
      const double mse = arms_mse(truth, clips[s]);
      fmt::print("{:10.5f}", mse);
      table.add(
          {fmt::format("{}", sigmas[s]), fmt::format("{}", pass), fmt::format("{:.8g}", mse)});
    }
    fmt::print("\n");
  }
  table.close();
}

struct Version {
  std::string name;
  Take clip;
  double mean_speed_rad_s = 0, peak_speed_rad_s = 0, joint_mse_rad2 = 0;
  double path_length = 0, extent = 0, mean_distance = 0;  // of the right hand, file units
};

double peak(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

// Figure 2: |Log(q_i^-1 q_{i+1})| times the rate.
void velocity_profiles(const Arguments& arguments, std::vector<Version>& versions,
                       std::size_t joint) {
  fmt::print(
      "\nFigure 2: angular velocity of {}, rad/s (rotation angles).\n\n{:>12}{:>12}{:>12}{:>16}\n",
      versions[0].clip.skeleton.names[joint], "", "mean", "peak", "MSE, rad^2");
  std::string header = "frame";
  std::vector<std::vector<double>> speeds;
  for (Version& version : versions) {
    header += "," + version.name;
    std::vector<double> speed;
    double sum = 0;
    const std::vector<Quat> track = track_of(version.clip, joint);
    for (std::size_t f = 0; f + 1 < track.size(); ++f) {
      speed.push_back(angle_between(track[f], track[f + 1]) * version.clip.frame_rate_hz);
      sum += speed.back();
    }
    version.mean_speed_rad_s = sum / static_cast<double>(speed.size());
    version.peak_speed_rad_s = peak(speed);
    version.joint_mse_rad2 = mse_rad2(track_of(versions[0].clip, joint), track);
    fmt::print("{:>12}{:12.3f}{:12.3f}{:16.6f}\n", version.name, version.mean_speed_rad_s,
               version.peak_speed_rad_s, version.joint_mse_rad2);
    speeds.push_back(std::move(speed));
  }
  Table table(arguments, "courty_velocity.csv", header);
  for (std::size_t f = 0; f < speeds[0].size(); ++f) {
    std::vector<std::string> cells{fmt::format("{}", f)};
    for (const auto& speed : speeds) cells.push_back(fmt::format("{:.6g}", speed[f]));
    table.add(cells);
  }
  table.close();
}

// Figure 4: the right hand in space.
void hand_paths(const Arguments& arguments, std::vector<Version>& versions) {
  const Skeleton& skeleton = versions[0].clip.skeleton;
  const auto hand = static_cast<std::size_t>(std::max(0, skeleton.find("RightHand")));
  fmt::print("\nFigure 4: path of {}, file units.\n\n{:>12}{:>12}{:>12}{:>16}\n",
             skeleton.names[hand], "", "length", "extent", "mean distance");
  Table table(arguments, "courty_path.csv", "version,frame,x,y,z");
  const std::vector<Vec3> truth = joint_positions(versions[0].clip);
  for (Version& version : versions) {
    const std::vector<Vec3> positions = joint_positions(version.clip);
    const std::size_t joints = version.clip.joint_count();
    double length = 0, distance = 0;
    Vec3 low = positions[hand], high = low;
    for (std::size_t f = 0; f < version.clip.frame_count(); ++f) {
      const Vec3 p = positions[f * joints + hand];
      if (f > 0) length += norm(p - positions[(f - 1) * joints + hand]);
      distance += norm(p - truth[f * joints + hand]);
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      table.add({version.name, fmt::format("{}", f), fmt::format("{:.6g}", p.x),
                 fmt::format("{:.6g}", p.y), fmt::format("{:.6g}", p.z)});
    }
    version.path_length = length;
    version.extent = norm(high - low);
    version.mean_distance = distance / static_cast<double>(version.clip.frame_count());
    fmt::print("{:>12}{:12.2f}{:12.2f}{:16.3f}\n", version.name, length, version.extent,
               version.mean_distance);
  }
  table.close();
}

// Prints one line per version.
void summary(const Arguments& arguments, const std::vector<Version>& versions) {
  Table table(arguments, "courty_versions.csv",
              "version,mean_speed_rad_s,peak_speed_rad_s,joint_mse_rad2,arms_mse_rad2,path_length,"
              "extent,mean_distance");
  fmt::print("\nMSE of all arms, rad^2:");
  for (const Version& version : versions) {
    const double arms = arms_mse(versions[0].clip, version.clip);
    fmt::print("  {} {:.5f}", version.name, arms);
    std::vector<std::string> cells{version.name};
    for (const double value :
         {version.mean_speed_rad_s, version.peak_speed_rad_s, version.joint_mse_rad2, arms,
          version.path_length, version.extent, version.mean_distance})
      cells.push_back(fmt::format("{:.5g}", value));
    table.add(cells);
  }
  fmt::print("\n");
  table.close();
}

void courty_filtering(const Arguments& arguments) {
  const SynthOptions synth{"wave", 8, 120, 3, false};
  const NamedTake take = load_take(arguments, "26_01.bvh", synth);
  const Take truth = busiest_part(take.clip, 4, 150);
  Take noisy = truth;
  Random random(2008);
  // The paper's value is read as the root mean square of the whole turn. With 0.18 rad on each
  // axis, or on each component of the quaternion's logarithm, sigma_g = 0.1 would take nearly every
  // neighbour for an edge. The damage's unit is half of an axis's angle.
  apply_damage(noisy, "gaussian-log",
               {{"sigma", paper_noise / std::sqrt(3.0) / 2}, {"about", std::string("sample")}},
               random);
  fmt::print(
      "Courty 2008 on {}: {} frames at {} Hz, {} joints. Noise of {} rad (root mean square of the\n"
      "rotation angle), mirrored ends.\n\n",
      take.name, truth.frame_count(), truth.frame_rate_hz, truth.joint_count(), paper_noise);
  mean_square_errors(arguments, truth, noisy);

  std::vector<Version> versions{{"truth", truth},
                                {"noisy", noisy},
                                {"gaussian", bilateral(noisy, 8, paper_passes)},
                                {"bilateral", bilateral(noisy, paper_sigma_g, paper_passes)}};
  velocity_profiles(arguments, versions, busiest_hand(truth));
  hand_paths(arguments, versions);
  summary(arguments, versions);
}

const Registration courty_filtering_entry("courty_filtering", courty_filtering);

}  // namespace
}  // namespace kinemend::papers
