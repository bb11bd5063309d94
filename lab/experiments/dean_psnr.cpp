// Table I of Dean 2016, Non-local Pose Means for Denoising Motion Capture Data: peak
// signal-to-noise ratio of denoising methods on a run, for six strengths of Gaussian noise and for
// impulses; the curves of its figures 3 to 6, and the slide of the feet.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "experiment.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/methods.hpp"

namespace kinemend::papers {
namespace {

// The paper's sigma, in quaternion log space (radians of half a rotation vector). The columns of
// its table are read as multiples of it: its figure 3 goes "from 1 sigma to 100 sigma".
constexpr double base_sigma = 0.008;

struct Noise {
  std::string name;
  double multiple;  // 0: impulses
};
const std::vector<Noise> noises{{"1 sigma", 1},   {"15 sigma", 15}, {"30 sigma", 30},
                                {"50 sigma", 50}, {"75 sigma", 75}, {"100 sigma", 100},
                                {"impulse", 0}};

Take damaged(const Take& truth, const Noise& noise) {
  Take clip = truth;
  Random random(2016);
  if (noise.multiple > 0) {
    apply_damage(clip, "gaussian-log", {{"sigma", noise.multiple * base_sigma}}, random);
  } else {
    apply_damage(clip, "impulse", {}, random);
  }
  return clip;
}

// A row of the table: a method with several settings, of which the best is shown, as in the paper
// ("care was taken to find the optimal input parameters").
struct MethodRow {
  std::string name;
  std::string method;
  std::vector<OptionValues> settings;
};

std::vector<OptionValues> grid(const std::string& option, double low, double high, int steps,
                               const OptionValues& fixed = {}) {
  std::vector<OptionValues> list;
  for (int i = 0; i < steps; ++i) {
    OptionValues values = fixed;
    values[option] = low * std::pow(high / low, static_cast<double>(i) / (steps - 1));
    list.push_back(values);
  }
  return list;
}

std::vector<OptionValues> weighted_mean_settings() {
  std::vector<OptionValues> list;
  for (const int passes : {1, 2, 4, 8, 16, 32, 64})
    list.push_back({{"passes", std::int64_t{passes}}});
  return list;
}

std::vector<OptionValues> wavelet_settings() {
  std::vector<OptionValues> list;
  for (const char* family : {"db4", "sym8"}) {
    for (const char* threshold : {"universal", "sure"}) {
      for (const char* shrinkage : {"soft", "hard"}) {
        list.push_back({{"family", std::string(family)},
                        {"threshold", std::string(threshold)},
                        {"shrinkage", std::string(shrinkage)}});
      }
    }
  }
  return list;
}

std::vector<MethodRow> rows(bool quick) {
  const int steps = quick ? 5 : 15;
  const OptionValues filter{{"smoother", false}, {"model", std::string("position")}};
  // sigma as the rotation angle of a channel.
  const double paper_bandwidth_deg = 2 * base_sigma * degrees_per_radian;
  return {{"Gaussian LPF", "gaussian", grid("width_s", 0.003, 0.2, steps)},
          {"Kalman", "kalman", grid("agility", 0.05, 50, steps, filter)},
          {"Blender WMM", "weighted-mean", weighted_mean_settings()},
          {"Wavelet", "wavelet", wavelet_settings()},
          {"Butterworth", "butterworth", grid("cutoff_hz", 1, 40, steps)},
          {"bilateral (Courty)", "bilateral", grid("sigma_g_deg", 2, 200, steps)},
          {"NLPM (bandwidth sigma)", "nonlocal", {{{"bandwidth_deg", paper_bandwidth_deg}}}},
          {"NLPM (best bandwidth)", "nonlocal", grid("bandwidth_deg", 0.2, 60, steps)},
          {"NLPM (automatic)", "nonlocal", {{}}},
          {"NLPM (whole take)", "nonlocal", {{{"window_s", 0.0}}}},
          {"auto", "auto", {{}}}};
}

struct Best {
  double psnr_db = -std::numeric_limits<double>::infinity();
  Take clip;
};

Best best_of(const Take& truth, const Take& noisy, const MethodRow& row) {
  Best best;
  for (const OptionValues& values : row.settings) {
    Take clip = noisy;
    clean_in_place(*make_cleaner(row.method, values), clip);
    const double psnr = psnr_db(truth, clip);
    if (psnr > best.psnr_db) best = {psnr, std::move(clip)};
  }
  return best;
}

// Half a rotation vector, the paper's logarithm of a quaternion.
Vec3 log_at(const Take& clip, std::size_t frame, std::size_t joint) {
  return 0.5 * log(align_hemisphere(clip.rotation(frame, joint), Quat{}));
}

struct Shown {
  std::string noise, version;
  Take clip;
};

std::size_t knee_of(const Take& clip) {
  return static_cast<std::size_t>(std::max(0, clip.skeleton.find("RightLeg")));
}

// Figures 3 and 4: all channels of the truth, the noisy take and the result, at three strengths.
// Figures 5 and 6: the knee's first channel of these and of every method in the table, for every
// noise.
void curves(const Arguments& arguments, const std::vector<Shown>& shown) {
  Table all(arguments, "dean_channels.csv", "noise,version,frame,channel,value"),
      one(arguments, "dean_channel.csv", "noise,version,frame,value");
  for (const auto& [noise, version, clip] : shown) {
    const bool whole =
        (noise == "1 sigma" || noise == "30 sigma" || noise == "75 sigma") &&
        (version == "truth" || version == "noisy" || version.starts_with("NLPM (best"));
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      one.add({noise, version, fmt::format("{}", f),
               fmt::format("{:.5g}", log_at(clip, f, knee_of(clip)).x)});
      for (std::size_t j = 0; whole && j < clip.joint_count(); ++j) {
        const Vec3 v = log_at(clip, f, j);
        for (const auto& [axis, value] : {std::pair{0, v.x}, {1, v.y}, {2, v.z}})
          all.add({noise, version, fmt::format("{}", f), fmt::format("{}", 3 * j + axis),
                   fmt::format("{:.4g}", value)});
      }
    }
  }
  all.close();
  one.close();
}

double channel_rms_deg(const Take& truth, const Take& clip, std::size_t joint) {
  double sum = 0;
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    sum += std::pow(log_at(clip, f, joint).x - log_at(truth, f, joint).x, 2);
  return 2 * degrees_per_radian * std::sqrt(sum / static_cast<double>(clip.frame_count()));
}

// Impulses hit few channels; the knee's is often none of them.
std::size_t joint_hit_most(const Take& truth, const Take& noisy) {
  std::size_t most = 0;
  for (std::size_t j = 1; j < truth.joint_count(); ++j) {
    if (channel_rms_deg(truth, noisy, j) > channel_rms_deg(truth, noisy, most)) most = j;
  }
  return most;
}

std::vector<double> channel_deg(const Take& clip, std::size_t joint) {
  std::vector<double> values;
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    values.push_back(2 * degrees_per_radian * log_at(clip, f, joint).x);
  return values;
}

// By how many frames `late` lies behind `curve`: the shift with the least mean square difference,
// between frames by a parabola.
double shift_frames(const std::vector<double>& curve, const std::vector<double>& late) {
  constexpr std::ptrdiff_t most = 12;
  const auto frames = static_cast<std::ptrdiff_t>(curve.size());
  std::vector<double> differences;
  for (std::ptrdiff_t shift = -most; shift <= most; ++shift) {
    double sum = 0;
    for (std::ptrdiff_t f = most; f + most < frames; ++f)
      sum += std::pow(
          late[static_cast<std::size_t>(f + shift)] - curve[static_cast<std::size_t>(f)], 2);
    differences.push_back(sum);
  }
  const auto least = std::ranges::min_element(differences) - differences.begin();
  if (least == 0 || least == 2 * most) return static_cast<double>(least - most);
  const auto at = static_cast<std::size_t>(least);
  const double before = differences[at - 1], own = differences[at], after = differences[at + 1];
  const double bend = before - 2 * own + after;
  return static_cast<double>(least - most) + (bend > 0 ? 0.5 * (before - after) / bend : 0);
}

// Root mean square of the second differences.
double jitter_of(const std::vector<double>& curve) {
  double sum = 0;
  for (std::size_t f = 1; f + 1 < curve.size(); ++f)
    sum += std::pow(curve[f - 1] - 2 * curve[f] + curve[f + 1], 2);
  return std::sqrt(sum / static_cast<double>(curve.size() - 2));
}

// Figures 5 and 6 as numbers, for the knee's first channel; under impulses for that of the joint
// which they hit most. Degrees of rotation.
void knee(const Arguments& arguments, const Take& truth, const std::vector<Shown>& shown) {
  Table table(arguments, "dean_knee.csv",
              "noise,version,rms_deg,least_deg,greatest_deg,jitter_deg,shift_frames");
  std::size_t hit = knee_of(truth);
  for (const auto& [noise, version, clip] : shown) {
    if (noise == "impulse" && version == "noisy") hit = joint_hit_most(truth, clip);
  }
  fmt::print("impulses: {}\n", truth.skeleton.names[hit]);
  for (const auto& [noise, version, clip] : shown) {
    const std::size_t joint = noise == "impulse" ? hit : knee_of(truth);
    const std::vector<double> curve = channel_deg(clip, joint);
    table.add({noise, version, fmt::format("{:.4g}", channel_rms_deg(truth, clip, joint)),
               fmt::format("{:.4g}", *std::ranges::min_element(curve)),
               fmt::format("{:.4g}", *std::ranges::max_element(curve)),
               fmt::format("{:.4g}", jitter_of(curve)),
               fmt::format("{:.2f}", shift_frames(channel_deg(truth, joint), curve))});
  }
  table.close();
}

// Errors at the ends of the take, a tenth of a second each, and between them, by what poses lie
// beyond the ends.
void ends(const Arguments& arguments, const Take& truth, const std::vector<Take>& noisy) {
  Table table(arguments, "dean_ends.csv", "noise,boundary,ends_deg,middle_deg");
  for (std::size_t n = 0; n < noises.size(); ++n) {
    for (const char* boundary : {"neumann", "mirror", "dirichlet"}) {
      Take clip = noisy[n];
      clean_in_place(*make_cleaner("nonlocal", {{"boundary", std::string(boundary)}}), clip);
      const std::vector<double> errors = rms_deg_per_frame(truth, clip);
      double at_ends = 0, between = 0, ends_count = 0;
      for (std::size_t f = 0; f < errors.size(); ++f) {
        const bool is_end = f < 12 || f + 12 >= errors.size();
        (is_end ? at_ends : between) += errors[f] * errors[f];
        ends_count += is_end ? 1 : 0;
      }
      table.add({noises[n].name, boundary, fmt::format("{:.4g}", std::sqrt(at_ends / ends_count)),
                 fmt::format("{:.4g}", std::sqrt(between / (static_cast<double>(errors.size()) -
                                                            ends_count)))});
    }
  }
  table.close();
}

// Mean travel a frame of toes in the frames in which they stand in the truth.
double travel_of_toes(const Take& clip, const std::vector<FootContact>& stands) {
  const std::vector<Leg> legs = find_legs(clip.skeleton);
  const std::vector<Vec3> places = joint_positions(clip);
  double travel = 0, frames = 0;
  for (const FootContact& stand : stands) {
    const std::int32_t toe = legs[stand.leg].toe;
    if (stand.part != FootPart::toe || toe < 0) continue;
    for (std::size_t f = stand.first_frame + 1; f <= stand.last_frame; ++f, ++frames) {
      const std::size_t at = f * clip.joint_count() + static_cast<std::size_t>(toe);
      travel += norm(places[at] - places[at - clip.joint_count()]);
    }
  }
  return frames > 0 ? travel / frames : 0;
}

// "Foot contact remains solid", as a number.
void feet(const Arguments& arguments, const Take& truth, const std::vector<Shown>& shown) {
  Table table(arguments, "dean_feet.csv", "noise,version,travel_cm");
  ContactSettings rules;
  rules.finder = ContactFinder::thresholds;
  const std::vector<FootContact> stands = find_contacts(truth, rules);
  const double cm = 100 * likely_metres_per_unit(truth);
  for (const auto& [noise, version, clip] : shown)
    table.add({noise, version, fmt::format("{:.4g}", cm * travel_of_toes(clip, stands))});
  table.close();
}

void add_row(Table& table, const std::string& name,
             const std::function<double(std::size_t)>& figure) {
  fmt::print("{:24}", name);
  std::vector<std::string> cells{name};
  for (std::size_t n = 0; n < noises.size(); ++n) {
    const double value = figure(n);
    fmt::print("{:10.2f}", value);
    cells.push_back(fmt::format("{:.4f}", value));
  }
  fmt::print("\n");
  table.add(cells);
}

void dean_psnr(const Arguments& arguments) {
  const SynthOptions synth{"run", arguments.quick ? 1.0 : 3.0, 120, 9, false};
  NamedTake take = load_take(arguments, "09_03.bvh", synth);
  if (arguments.quick)
    take.clip = slice(take.clip, 0, std::min<std::size_t>(120, take.clip.frame_count()));
  std::vector<Take> noisy;
  for (const Noise& noise : noises) noisy.push_back(damaged(take.clip, noise));

  fmt::print("Dean 2016, table I: PSNR in dB on {}, {} frames.\n", take.name,
             take.clip.frame_count());
  fmt::print(
      "sigma = {} in quaternion log space. Impulse: 1 % of the samples turned by 60 degrees.\n"
      "Peak: pi / 2, the largest value of a channel of a quaternion's logarithm. The paper does\n"
      "not state its peak; another one adds the same to every figure. Each method has its best\n"
      "settings of a grid, column by column, but for the rows that say otherwise.\n\n{:24}",
      base_sigma, "");
  std::string header = "method";
  for (const Noise& noise : noises) {
    fmt::print("{:>10}", noise.name);
    header += "," + noise.name;
  }
  fmt::print("\n");
  Table table(arguments, "dean_psnr.csv", header);
  add_row(table, "(noisy)", [&](std::size_t n) { return psnr_db(take.clip, noisy[n]); });
  std::vector<Shown> shown;
  for (std::size_t n = 0; n < noises.size(); ++n) {
    shown.push_back({noises[n].name, "truth", take.clip});
    shown.push_back({noises[n].name, "noisy", noisy[n]});
  }
  for (const MethodRow& row : rows(arguments.quick)) {
    add_row(table, row.name, [&](std::size_t n) {
      Best best = best_of(take.clip, noisy[n], row);
      shown.push_back({noises[n].name, row.name, std::move(best.clip)});
      return best.psnr_db;
    });
  }
  table.close();
  curves(arguments, shown);
  knee(arguments, take.clip, shown);
  feet(arguments, take.clip, shown);
  ends(arguments, take.clip, noisy);
}

const Registration dean_psnr_entry("dean_psnr", dean_psnr);

}  // namespace
}  // namespace kinemend::papers
