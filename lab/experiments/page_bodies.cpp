// Figures of docs/measured/bodies.md: how little noise moves the frame of a body, and how similar
// the channels are for one motion in two formats and for walks from other programs.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "body/body_frame.hpp"
#include "body/body_takes.hpp"
#include "kinemend/extend/motion.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

using body_test::channels_of, body_test::layout_of, body_test::rms_difference,
    body_test::track_named;

Take motion_of(const std::filesystem::path& path) {
  const Take clip = read_joints(path).take;
  return slice(clip, leading_calibration_frames(clip), clip.frame_count());
}

struct FrameError {
  double heading_deg = 0, place_mm = 0, floor_mm = 0;
};

// Root mean square over the frames; for the floor, the difference.
FrameError frame_error(const BodyChannels& truth, const BodyChannels& found, double metres) {
  FrameError error;
  for (std::size_t f = 0; f < truth.headings.size(); ++f) {
    const double turn = std::remainder(found.headings[f] - truth.headings[f], 2 * std::numbers::pi);
    const Vec3 way = found.places[f] - truth.places[f];
    error.heading_deg += turn * turn;
    error.place_mm += way.x * way.x + way.z * way.z;
  }
  const auto frames = static_cast<double>(truth.headings.size());
  error.heading_deg = degrees_per_radian * std::sqrt(error.heading_deg / frames);
  error.place_mm = 1000 * metres * std::sqrt(error.place_mm / frames);
  error.floor_mm = 1000 * metres * std::fabs(found.places[0].y - truth.places[0].y);
  return error;
}

// Adds two degrees to every joint and a centimetre to the place, in ten draws.
void noise_on_bodies(const Arguments& arguments) {
  Table table(arguments, "page_body_noise.csv", "take,rate_hz,heading_deg,place_mm,floor_mm");
  for (const auto& [name, motion] :
       {std::pair{"35_01", "walk"}, {"02_05", "punch"}, {"09_03", "run"}, {"05_02", "wave"}}) {
    const Take all = load_take(arguments, std::string(name) + ".bvh", {.motion = motion}).clip;
    const BodyLayout layout = layout_of(all);
    const double metres = guess_length_unit(all.skeleton)->metres;
    for (const double rate_hz : {120.0, 30.0}) {
      const Take truth = resample(all, rate_hz);
      const BodyChannels expected = channels_of(layout, truth);
      FrameError mean;
      constexpr std::uint64_t seeds = 10;
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        Take clip = noisy(truth, 2, 0, seed);
        Random random(100 + seed);
        for (std::size_t f = 0; f < clip.frame_count(); ++f)
          clip.root_position(f) += body_test::normal_vector(random, 0.01 / metres);
        const FrameError error = frame_error(expected, channels_of(layout, clip), metres);
        mean.heading_deg += error.heading_deg / seeds;
        mean.place_mm += error.place_mm / seeds;
        mean.floor_mm += error.floor_mm / seeds;
      }
      table.add({name, fmt::format("{:g}", rate_hz), figure(mean.heading_deg),
                 figure(mean.place_mm), figure(mean.floor_mm)});
    }
  }
  table.close();
}

// How far the smoothed path of a walk of 1.3 m/s on a circle of 1 m radius lies inside it, a second
// from the ends.
double circle_cut_cm() {
  std::vector<Vec3> path;
  for (int f = 0; f < 600; ++f) path.push_back({std::cos(1.3 * f / 60), 0, std::sin(1.3 * f / 60)});
  const auto trend =
      representation::smooth_path(path, std::vector<double>(path.size(), 1), 60, 0.5);
  double most = 0;
  for (std::size_t f = 60; f < 540; ++f) most = std::max(most, 1 - norm(trend[f]));
  return 100 * most;
}

// Takes that exist as BVH and as AMC, two per subject: the track whose channels differ most.
void formats(const Arguments& arguments, Table& table) {
  std::map<std::string, int> taken;
  double worst = 0, takes = 0;
  std::set<std::filesystem::path> paths;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(arguments.data / "cmu" / "amc")) {
    if (entry.path().extension() == ".amc") paths.insert(entry.path());
  }
  for (const std::filesystem::path& path : paths) {
    const std::string name = path.stem().string();
    const auto bvh = find_take(arguments.data / "cmu", name + ".bvh");
    const auto skeleton = path.parent_path() / (name.substr(0, 2) + ".asf");
    if (!bvh || !std::filesystem::exists(skeleton) || taken[name.substr(0, 2)] == 2) continue;
    const Take a = motion_of(*bvh), b = motion_of(path);
    if (a.frame_count() != b.frame_count()) continue;
    ++taken[name.substr(0, 2)], ++takes;
    const BodyLayout layout = layout_of(a);
    const BodyChannels expected = channels_of(layout, a), found = channels_of(layout, b);
    for (std::size_t i = 0; i <= layout.track_count(); ++i)
      worst = std::max(worst, rms_difference(expected.poses, found.poses, i));
  }
  table.add({"two formats", fmt::format("{}", takes), figure(worst)});
}

struct NamedMotion {
  std::string name;
  Take clip;
};

// Walks from other programs; without data, other synthetic walks.
std::vector<NamedMotion> other_walks(const Arguments& arguments) {
  std::vector<NamedMotion> walks;
  if (!std::filesystem::is_directory(arguments.data / "bvh-other")) {
    for (const char* motion : {"turn", "stroll"})
      walks.push_back({motion, body_test::walk(motion)});
    return walks;
  }
  for (const char* path :
       {"bvh-other/bvh-python/test_freebvh.bvh", "bvh-other/Mocap-Data-Utilities/Male1_B3_Walk.bvh",
        "bvh-other/bandai-namco/dataset-1_walk_normal_001.bvh",
        "bvh-other/pybvh/bvh_data_bvh_example.bvh", "paired/S02-Trial-Walk-1-xsens.bvh"})
    walks.push_back(
        {std::filesystem::path(path).stem().string(), motion_of(arguments.data / path)});
  return walks;
}

// The largest mean of a channel of trunk, legs and upper arms, in the channels of one walk.
void makers(const Arguments& arguments) {
  Table table(arguments, "page_body_makers.csv", "take,channel,mean_deg");
  const BodyLayout layout = layout_of(load_take(arguments, "35_01.bvh", {}).clip);
  for (const auto& [name, clip] : other_walks(arguments)) {
    const BodyChannels channels = channels_of(layout, clip);
    double most = 0;
    std::size_t channel = 0;
    for (const char* joint : {"Hips", "LeftUpLeg", "LeftLeg", "RightUpLeg", "RightLeg", "LowerBack",
                              "Spine1", "LeftArm", "RightArm"}) {
      const std::size_t track = track_named(layout, joint);
      for (std::size_t c = 3 * track; c < 3 * track + 3; ++c) {
        double sum = 0;
        for (std::size_t f = 0; f < channels.poses.frames; ++f) sum += channels.poses(f, c);
        const double mean = std::fabs(sum / static_cast<double>(channels.poses.frames));
        if (mean > most) most = mean, channel = c;
      }
    }
    table.add({name, layout.channel_name(channel), figure(most)});
  }
  table.close();
}

// How much the other channels of a take of markers change if both arms are missing.
double armless_deg(const Arguments& arguments) {
  const Take clip = read_take(*find_take(arguments.data, "85_12.c3d")).take;
  const BodyLayout layout = layout_of(clip);
  const auto is_of_an_arm = [](std::string_view name) {
    const auto words = {"UPA", "ELB", "FRM", "WRA", "WRB", "FIN"};
    return std::any_of(words.begin(), words.end(),
                       [&](const char* word) { return name.find(word) != name.npos; });
  };
  Take armless = clip;
  for (std::size_t i = 0; i < armless.observed.size(); ++i) {
    if (is_of_an_arm(clip.names[i % clip.marker_count()])) armless.observed[i] = 0;
  }
  const BodyChannels whole = channels_of(layout, clip), without = channels_of(layout, armless);
  double worst = 0;
  for (std::size_t i = 0; i < layout.track_count(); ++i) {
    if (!is_of_an_arm(layout.names[i]))
      worst = std::max(worst, rms_difference(whole.poses, without.poses, i));
  }
  return worst;
}

void page_bodies(const Arguments& arguments) {
  noise_on_bodies(arguments);
  Table table(arguments, "page_bodies.csv", "what,takes,value");
  table.add({"circle", "1", figure(circle_cut_cm())});
  if (find_take(arguments.data, "85_12.c3d")) {
    formats(arguments, table);
    table.add({"without arms", "1", figure(armless_deg(arguments))});
  }
  table.close();
  makers(arguments);
}

const Registration page_bodies_entry("page_bodies", page_bodies);

}  // namespace
}  // namespace kinemend::papers
