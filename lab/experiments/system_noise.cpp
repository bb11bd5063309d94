// Figures of docs/measured/noise.md: errors of real systems, measured on one motion captured by two
// of them, and of the damage `system` on the same motions, by the same code.
#include <algorithm>
#include <functional>

#include "experiment.hpp"
#include "kinemend/extend/signal.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "lab/damage/system_noise.hpp"
#include "made_pairs.hpp"
#include "noise_measures.hpp"

namespace kinemend::papers {
namespace {

using Series = std::vector<double>;

/// One motion from a system and from optical markers, with a series for each channel.
struct Pair {
  double rate_hz = 0;
  std::vector<std::string> names;
  std::vector<Series> noisy, reference;  // 3 N: x, y, z of each track
};

std::vector<Series> channels_of(const PoseMatrix& values) {
  std::vector<Series> channels(values.channels, Series(values.frames));
  for (std::size_t f = 0; f < values.frames; ++f) {
    for (std::size_t c = 0; c < values.channels; ++c) channels[c][f] = values(f, c);
  }
  return channels;
}

PoseMatrix matrix_of(const std::vector<Series>& channels) {
  PoseMatrix matrix(channels.front().size(), channels.size());
  for (std::size_t f = 0; f < matrix.frames; ++f) {
    for (std::size_t c = 0; c < matrix.channels; ++c) matrix(f, c) = channels[c][f];
  }
  return matrix;
}

/// Markers [first, last); missing samples are bridged by straight lines.
std::vector<Series> tracks_of(const Take& clip, std::size_t first, std::size_t last, Pair& pair) {
  const double scale = clip.unit == "m" ? 1000 : 1;
  last = std::min(last, clip.marker_count());
  PoseMatrix values(clip.frame_count(), 3 * (last - first));
  std::vector<std::uint8_t> missing(values.values.size(), 0);
  for (std::size_t f = 0; f < values.frames; ++f) {
    for (std::size_t n = first; n < last; ++n) {
      const Vec3 p = scale * clip.position(f, n);
      const std::size_t c = 3 * (n - first);
      values(f, c) = p.x, values(f, c + 1) = p.y, values(f, c + 2) = p.z;
      for (std::size_t i = 0; i < 3; ++i)
        missing[f * values.channels + c + i] = clip.is_observed(f, n) ? 0 : 1;
    }
  }
  fill_linear(values, missing);
  pair.rate_hz = clip.frame_rate_hz;
  pair.names.assign(clip.names.begin() + static_cast<std::ptrdiff_t>(first),
                    clip.names.begin() + static_cast<std::ptrdiff_t>(last));
  return channels_of(values);
}

std::vector<Series> read_tracks(const std::filesystem::path& path, std::size_t first,
                                std::size_t last, Pair& pair) {
  return tracks_of(read_take(path).take, first, last, pair);
}

/// The residual of a channel after subtracting the reference times a gain plus an offset.
Series error_of(const Series& noisy, const Series& reference) {
  const double mean_noisy = test::mean_of(noisy), mean = test::mean_of(reference);
  double cross = 0, square = 0;
  for (std::size_t i = 0; i < noisy.size(); ++i) {
    cross += (reference[i] - mean) * (noisy[i] - mean_noisy);
    square += (reference[i] - mean) * (reference[i] - mean);
  }
  const double gain = square > 0 ? cross / square : 0;
  Series error(noisy.size());
  for (std::size_t i = 0; i < noisy.size(); ++i)
    error[i] = noisy[i] - mean_noisy - gain * (reference[i] - mean);
  return error;
}

Series above_6_hz(const Series& series, double rate_hz) {
  // The complement of a zero-phase Butterworth low-pass is the high-pass of the same order.
  PoseMatrix slow = matrix_of({series});
  filter_zero_phase(slow, butterworth_lowpass(4, 6, rate_hz));
  Series fast(series.size());
  for (std::size_t i = 0; i < fast.size(); ++i) fast[i] = series[i] - slow.values[i];
  return fast;
}

/// Means over channels, takes and seeds; deviations root mean square, kurtosis the median.
struct Figures {
  double lags[4] = {}, bands[3] = {}, variance = 0, fast_variance = 0;
  Series kurtosis;
  double count = 0;
  double across = 0, across_count = 0;

  void add(const Series& error, double rate_hz) {
    constexpr std::size_t lag[] = {1, 2, 4, 8};
    for (std::size_t i = 0; i < 4; ++i) lags[i] += test::autocorrelation(error, lag[i]);
    const auto found = test::welch(error, rate_hz, static_cast<std::size_t>(6 * rate_hz));
    const double all = found.between(0, rate_hz);
    bands[0] += found.between(0, 2) / all;
    bands[1] += found.between(2, 6) / all;
    bands[2] += found.between(6, 15) / all;
    const Series fast = above_6_hz(error, rate_hz);
    variance += test::variance_of(error);
    fast_variance += test::variance_of(fast);
    kurtosis.push_back(test::kurtosis_of(fast));
    ++count;
  }
  double median_kurtosis() {
    std::sort(kurtosis.begin(), kurtosis.end());
    return kurtosis[kurtosis.size() / 2];
  }
};

/// The channels of a pair that a line of the page covers.
struct Line {
  std::string name;
  std::vector<Pair> pairs;
  std::function<bool(std::size_t channel)> takes;
  double least_motion = 5;  // channels whose reference moves by less are left out
  OptionValues settings;
  std::uint64_t seeds = 5;
  bool is_rotation = false;
  bool fast_only = false;  // measures only above 6 Hz, because the rest has no reference
};

void measure(const Line& line, const Pair& pair, const std::vector<Series>& noisy,
             Figures& figures) {
  std::vector<std::size_t> chosen;
  std::vector<Series> errors;
  for (std::size_t c = 0; c < noisy.size(); ++c) {
    const double motion = std::sqrt(test::variance_of(pair.reference[c]));
    if (!line.takes(c) || motion <= line.least_motion) continue;
    chosen.push_back(c);
    errors.push_back(error_of(noisy[c], pair.reference[c]));
    if (line.fast_only) errors.back() = above_6_hz(errors.back(), pair.rate_hz);
    figures.add(errors.back(), pair.rate_hz);
  }
  for (std::size_t a = 0; a < chosen.size(); ++a) {
    for (std::size_t b = a + 1; b < chosen.size(); ++b) {
      if (chosen[a] % 3 != chosen[b] % 3) continue;
      figures.across += test::correlation_of(errors[a], errors[b]);
      ++figures.across_count;
    }
  }
}

/// Damages the reference.
std::vector<Series> generated(const Line& line, const Pair& pair, std::uint64_t seed) {
  VectorMotion motion;
  motion.values = matrix_of(pair.reference);
  motion.observed.assign(motion.values.frames * pair.names.size(), 1);
  motion.frame_rate_hz = pair.rate_hz;
  motion.names = pair.names;
  motion.is_rotation.assign(pair.names.size(), line.is_rotation ? 1 : 0);
  motion.is_root.assign(pair.names.size(), 0);
  motion.per_radian = line.is_rotation ? degrees_per_radian : 425;
  motion.per_cm = line.is_rotation ? 0 : 10;
  Random random(seed);
  apply_damage(motion, "system", line.settings, random);
  return channels_of(motion.values);
}

void write(Table& table, const Line& line, const std::string& source, Figures& figures) {
  const auto text = [](double value) { return fmt::format("{:.4g}", value); };
  const double count = figures.count;
  table.add({quoted(line.name), source, text(figures.lags[0] / count),
             text(figures.lags[1] / count), text(figures.lags[2] / count),
             text(figures.lags[3] / count), text(figures.bands[0] / count),
             text(figures.bands[1] / count), text(figures.bands[2] / count),
             text(std::sqrt(figures.variance / count)),
             text(std::sqrt(figures.fast_variance / count)), text(figures.median_kurtosis()),
             text(figures.across_count > 0 ? figures.across / figures.across_count : 0)});
}

Pair trc_pair(const Arguments& arguments, const std::string& name) {
  Pair pair;
  const auto folder = arguments.data / "real";
  pair.noisy = read_tracks(folder / (name + ".noisy.trc"), 0, 1000, pair);
  pair.reference = read_tracks(folder / (name + ".reference.trc"), 0, 1000, pair);
  return pair;
}

std::vector<Pair> video_pairs(const Arguments& arguments, const std::string& name) {
  std::vector<Pair> pairs;
  for (const char* model : {"FULL", "HEAVY", "LITE"})
    pairs.push_back(trc_pair(arguments, name + "_" + model));
  return pairs;
}

/// A take of triangulated video, with its own part below 6 Hz as the reference.
Pair triangulated_pair(const Arguments& arguments) {
  Pair pair;
  pair.noisy = read_tracks(arguments.data / "real/unpaired/pose2sim-balancing.trc", 0, 1000, pair);
  for (const Series& series : pair.noisy) {
    pair.reference.push_back(series);
    const Series fast = above_6_hz(series, pair.rate_hz);
    for (std::size_t i = 0; i < series.size(); ++i) pair.reference.back()[i] -= fast[i];
  }
  return pair;
}

/// Angles of hips, knees and ankles.
Pair inertial_pair(const Arguments& arguments) {
  Pair pair;
  const auto folder = arguments.data / "paired";
  pair.noisy = read_tracks(folder / "S02-Trial-Walk-1-xsens.c3d", 31, 37, pair);
  pair.reference = read_tracks(folder / "S02-Trial-Walk-1-vicon.c3d", 31, 37, pair);
  return pair;
}

std::vector<Line> lines_of(const Arguments& arguments) {
  const auto image = [](std::size_t c) { return c % 3 != 0; };
  const auto depth = [](std::size_t c) { return c % 3 == 0; };
  const auto all = [](std::size_t) { return true; };
  const OptionValues video{{"kind", std::string("video")}, {"depth_axis", std::string("x")}};
  std::vector<Line> lines;
  const auto fast = video_pairs(arguments, "video-60fps_01");
  const auto slow = video_pairs(arguments, "video-regular");
  lines.push_back({"video 60 Hz, image", fast, image, 5, video});
  lines.push_back({"video 60 Hz, depth", fast, depth, 5, video});
  lines.push_back({"video 30 Hz, image", slow, image, 5, video});
  lines.push_back({"video 30 Hz, depth", slow, depth, 5, video});
  lines.push_back({"depth camera",
                   {trc_pair(arguments, "depth-CTK"), trc_pair(arguments, "depth-RTK")},
                   all,
                   5,
                   {{"kind", std::string("depth")}, {"depth_axis", std::string("x")}},
                   20});
  lines.push_back({"inertial suit, angles",
                   {inertial_pair(arguments)},
                   all,
                   0.5,
                   {{"kind", std::string("inertial")}},
                   5,
                   true});
  lines.push_back({"triangulated video, above 6 Hz",
                   {triangulated_pair(arguments)},
                   all,
                   0,
                   {{"kind", std::string("triangulated")}, {"depth_axis", std::string("z")}},
                   20,
                   false,
                   true});
  return lines;
}

/// Lines for use without data: a walk with the noise of a family of systems.
std::vector<Line> made_lines() {
  std::vector<Line> lines;
  for (const char* family : {"video", "depth"}) {
    const MarkerPair made = made_pair("walk", 30, family, 99);
    Pair pair;
    pair.noisy = tracks_of(made.noisy, 0, 1000, pair);
    pair.reference = tracks_of(made.reference, 0, 1000, pair);
    lines.push_back({family,
                     {std::move(pair)},
                     [](std::size_t) { return true; },
                     5,
                     {{"kind", std::string(family)}}});
  }
  return lines;
}

void families(const Arguments& arguments) {
  std::string header = "option";
  for (const auto& family : corrupt::system_families()) header += "," + std::string(family.name);
  Table table(arguments, "system_families.csv", header);
  using S = corrupt::SystemNoise;
  static constexpr std::pair<const char*, double S::*> numbers[] = {
      {"std_mm", &S::std_mm},
      {"arm_factor", &S::arm_factor},
      {"depth_factor", &S::depth_factor},
      {"fc_hz", &S::fc_hz},
      {"slope", &S::slope},
      {"floor_mm", &S::floor_mm},
      {"floor_depth_factor", &S::floor_depth_factor},
      {"floor_hz", &S::floor_hz},
      {"correlation", &S::correlation},
      {"limb_correlation", &S::limb_correlation},
      {"depth_correlation", &S::depth_correlation},
      {"depth_limb_correlation", &S::depth_limb_correlation},
      {"motion_mm", &S::motion_mm},
      {"motion_depth_factor", &S::motion_depth_factor},
      {"motion_hz", &S::motion_hz},
      {"leak", &S::leak},
      {"leak_depth_factor", &S::leak_depth_factor},
      {"bursts_per_min", &S::bursts_per_min},
      {"burst_min_s", &S::burst_min_s},
      {"burst_max_s", &S::burst_max_s},
      {"burst_min_height", &S::burst_min_height},
      {"burst_max_height", &S::burst_max_height},
      {"limb_errors_per_min", &S::limb_errors_per_min},
      {"limb_error_s", &S::limb_error_s},
      {"limb_error_mm", &S::limb_error_mm},
      {"heading_deg", &S::heading_deg},
      {"root_mm", &S::root_mm},
  };
  for (const auto& [name, member] : numbers) {
    std::vector<std::string> cells{name};
    for (const auto& family : corrupt::system_families())
      cells.push_back(fmt::format("{:g}", family.noise.*member));
    table.add(cells);
  }
  table.close();
}

void system_noise(const Arguments& arguments) {
  families(arguments);
  const bool has_pairs = std::filesystem::is_directory(arguments.data / "real");
  Table table(arguments, "system_noise.csv",
              "noise,source,lag_1,lag_2,lag_4,lag_8,below_2,from_2_to_6,from_6_to_15,rms,fast_rms,"
              "kurtosis,correlation");
  for (const Line& line : has_pairs ? lines_of(arguments) : made_lines()) {
    Figures real, made;
    for (const Pair& pair : line.pairs) {
      measure(line, pair, pair.noisy, real);
      for (std::uint64_t seed = 1; seed <= (arguments.quick ? 1 : line.seeds); ++seed)
        measure(line, pair, generated(line, pair, seed), made);
    }
    write(table, line, "real", real);
    write(table, line, "generated", made);
  }
  table.close();
}

const Registration system_noise_entry("system_noise", system_noise);

}  // namespace
}  // namespace kinemend::papers
