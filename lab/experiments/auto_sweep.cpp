// Effect of each constant of the method `auto`: one at a time is multiplied by 0.5, 0.8, 1.25 and
// 2, and the change of the error is measured on takes of subjects that no other table of `auto`
// uses. tools/sweep runs it.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/motion.hpp"
#include "methods/auto/track_cleaning.hpp"
#include "methods/auto/track_vectors.hpp"
#include "motion/rotation.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

struct Tuning {
  GrossSpikeTuning gross;
  ChartTuning chart;
  TrackTuning tracks;
};

struct Constant {
  std::string name;
  std::function<double(Tuning&)> value;
  std::function<void(Tuning&, double)> set;  // rounds whole numbers
};

class Constants {
 public:
  template <class Group, class Value>
  void add(const std::string& name, Group& (*group)(Tuning&), Value Group::*member,
           double largest = std::numeric_limits<double>::infinity()) {
    list.push_back({name,
                    [=](Tuning& tuning) { return static_cast<double>(group(tuning).*member); },
                    [=](Tuning& tuning, double value) {
                      if constexpr (std::is_floating_point_v<Value>)
                        group(tuning).*member = std::min(value, largest);
                      else
                        group(tuning).*member = static_cast<Value>(std::lround(value));
                    }});
  }

  std::vector<Constant> list;
};

std::vector<Constant> constants() {
  Constants all;
  const auto gross = +[](Tuning& t) -> GrossSpikeTuning& { return t.gross; };
  all.add("gross.ratio", gross, &GrossSpikeTuning::ratio);
  all.add("gross.least_deg", gross, &GrossSpikeTuning::least_deg);
  all.add("gross.window_frames", gross, &GrossSpikeTuning::window_frames);
  all.add("gross.passes", gross, &GrossSpikeTuning::passes);
  const auto chart = +[](Tuning& t) -> ChartTuning& { return t.chart; };
  all.add("chart.width_s", chart, &ChartTuning::width_s);
  const auto noise = +[](Tuning& t) -> NoiseTuning& { return t.tracks.noise; };
  all.add("noise.minimum_bias", noise, &NoiseTuning::minimum_bias);
  all.add("noise.least_axis_share", noise, &NoiseTuning::least_axis_share);
  all.add("noise.least_level", noise, &NoiseTuning::least_level);
  all.add("noise.log_ratio", noise, &NoiseTuning::log_ratio);
  all.add("noise.chance_log_ratio", noise, &NoiseTuning::chance_log_ratio);
  all.add("noise.largest_ratio", noise, &NoiseTuning::largest_ratio);
  all.add("noise.fewest_differences", noise, &NoiseTuning::fewest_differences);
  all.add("noise.most_differences", noise, &NoiseTuning::most_differences);
  all.add("noise.rounds", noise, &NoiseTuning::rounds);
  const auto spikes = +[](Tuning& t) -> SpikeTuning& { return t.tracks.spikes; };
  all.add("spikes.candidate_ratio", spikes, &SpikeTuning::candidate_ratio);
  all.add("spikes.robust_cap", spikes, &SpikeTuning::robust_cap);
  all.add("spikes.rounds", spikes, &SpikeTuning::rounds);
  all.add("spikes.noise_floor", spikes, &SpikeTuning::noise_floor);
  all.add("spikes.least_error", spikes, &SpikeTuning::least_error);
  all.add("spikes.median_half_s", spikes, &SpikeTuning::median_half_s);
  all.add("spikes.clearance_quiet", spikes, &SpikeTuning::clearance_quiet);
  all.add("spikes.clearance_noisy", spikes, &SpikeTuning::clearance_noisy);
  all.add("spikes.surrounding_frames", spikes, &SpikeTuning::surrounding_frames);
  all.add("spikes.nearby_ratio", spikes, &SpikeTuning::nearby_ratio);
  all.add("spikes.side_error_share", spikes, &SpikeTuning::side_error_share);
  all.add("spikes.fastest_deg_s", spikes, &SpikeTuning::fastest_deg_s);
  all.add("spikes.return_share", spikes, &SpikeTuning::return_share);
  all.add("spikes.longest_run", spikes, &SpikeTuning::longest_run);
  all.add("spikes.cluster_gap", spikes, &SpikeTuning::cluster_gap);
  all.add("spikes.usual_cluster", spikes, &SpikeTuning::usual_cluster);
  all.add("spikes.chance", spikes, &SpikeTuning::chance);
  all.add("spikes.recurrent_deg_s", spikes, &SpikeTuning::recurrent_deg_s);
  all.add("spikes.damage_count", spikes, &SpikeTuning::damage_count);
  all.add("spikes.damage_share", spikes, &SpikeTuning::damage_share);
  all.add("spikes.low_quantile", spikes, &SpikeTuning::low_quantile);
  all.add("spikes.smallest_share", spikes, &SpikeTuning::smallest_share);
  const auto predictors =
      +[](Tuning& t) -> signal::CutoffGrid& { return t.tracks.spikes.predictors; };
  all.add("spikes.predictors.lowest_hz", predictors, &signal::CutoffGrid::lowest_hz);
  all.add("spikes.predictors.highest_hz", predictors, &signal::CutoffGrid::highest_hz);
  all.add("spikes.predictors.count", predictors, &signal::CutoffGrid::count);
  const auto zone = +[](Tuning& t) -> DeadZoneTuning& { return t.tracks.dead_zone; };
  all.add("dead_zone.start_noisy", zone, &DeadZoneTuning::start_noisy);
  all.add("dead_zone.full_noisy", zone, &DeadZoneTuning::full_noisy);
  all.add("dead_zone.start_quiet", zone, &DeadZoneTuning::start_quiet);
  all.add("dead_zone.full_quiet", zone, &DeadZoneTuning::full_quiet);
  all.add("dead_zone.noisy_from", zone, &DeadZoneTuning::noisy_from);
  all.add("dead_zone.rate_exponent", zone, &DeadZoneTuning::rate_exponent);
  const auto smoothing = +[](Tuning& t) -> SmoothingTuning& { return t.tracks.smoothing; };
  all.add("smoothing.axes_window_s", smoothing, &SmoothingTuning::axes_window_s);
  all.add("smoothing.noise_floor", smoothing, &SmoothingTuning::noise_floor);
  const auto models = +[](Tuning& t) -> signal::CutoffGrid& { return t.tracks.smoothing.models; };
  all.add("smoothing.models.lowest_hz", models, &signal::CutoffGrid::lowest_hz);
  all.add("smoothing.models.highest_hz", models, &signal::CutoffGrid::highest_hz);
  all.add("smoothing.models.count", models, &signal::CutoffGrid::count);
  const auto adaptive =
      +[](Tuning& t) -> signal::AdaptiveSettings& { return t.tracks.smoothing.adaptive; };
  all.add("smoothing.adaptive.window_s", adaptive, &signal::AdaptiveSettings::window_s);
  all.add("smoothing.adaptive.iterations", adaptive, &signal::AdaptiveSettings::iterations);
  return all.list;
}

std::vector<Constant> constants_of_colour() {
  Constants all;
  const auto colour = +[](Tuning& t) -> ColourTuning& { return t.tracks.colour; };
  all.add("colour.least_noise", colour, &ColourTuning::least_noise);
  all.add("colour.few_windows", colour, &ColourTuning::few_windows);
  all.add("colour.few_marked", colour, &ColourTuning::few_marked);
  all.add("colour.fewest_samples", colour, &ColourTuning::fewest_samples);
  all.add("colour.fewest_tracks", colour, &ColourTuning::fewest_tracks);
  all.add("colour.fewest_seconds", colour, &ColourTuning::fewest_seconds);
  all.add("colour.least_agreement", colour, &ColourTuning::least_agreement);
  all.add("colour.least_rotation_deg", colour, &ColourTuning::least_rotation_deg);
  all.add("colour.least_of_rotations", colour, &ColourTuning::least_of_rotations);
  all.add("colour.least_deg", colour, &ColourTuning::least_deg);
  all.add("colour.least_ms", colour, &ColourTuning::least_ms);
  all.add("colour.least_product", colour, &ColourTuning::least_product);
  all.add("colour.least_in_distances", colour, &ColourTuning::least_in_distances);
  all.add("colour.start", colour, &ColourTuning::start);
  all.add("colour.full", colour, &ColourTuning::full);
  all.add("colour.slow_correlation", colour, &ColourTuning::slow_correlation);
  all.add("colour.longest_s", colour, &ColourTuning::longest_s);
  all.add("colour.most_of_quiet", colour, &ColourTuning::most_of_quiet);
  all.add("colour.trembling_s", colour, &ColourTuning::trembling_s);
  all.add("colour.share_of_constant", colour, &ColourTuning::share_of_constant);
  return all.list;
}

std::vector<Constant> constants_of_held() {
  Constants all;
  const auto held = +[](Tuning& t) -> HeldTuning& { return t.tracks.held; };
  all.add("held.fewest_samples", held, &HeldTuning::fewest_samples);
  all.add("held.largest_ratio", held, &HeldTuning::largest_ratio);
  all.add("held.least_difference", held, &HeldTuning::least_difference);
  all.add("held.agreeing_tracks", held, &HeldTuning::agreeing_tracks);
  all.add("held.large_quantile", held, &HeldTuning::large_quantile, 1);
  all.add("held.least_clock_step", held, &HeldTuning::least_clock_step);
  return all.list;
}

// Cleans the rotations with the method `auto` and other constants.
Take cleaned_with(const Tuning& tuning, Take clip) {
  const std::size_t frames = clip.frame_count();
  std::vector<std::size_t> joints, track_of(clip.joint_count(), clip.joint_count());
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    if (clip.skeleton.rotation_order(j).count == 0) continue;
    track_of[j] = joints.size();
    joints.push_back(j);
  }
  VectorTracks tracks(frames, joints.size());
  SampleMarks candidates(frames, joints.size());
  const SampleMarks missing(frames, joints.size());
  std::vector<RotationChart> charts;
  const auto joints_near = joints_nearby(clip.skeleton.parents);
  std::vector<std::vector<std::size_t>> nearby(joints.size());
  for (std::size_t n = 0; n < joints.size(); ++n) {
    std::vector<Quat> track(frames);
    for (std::size_t t = 0; t < frames; ++t) track[t] = clip.rotation(t, joints[n]);
    const std::vector<std::uint8_t> gross = replace_gross_spikes(track, tuning.gross);
    charts.push_back(smooth_chart(track, clip.frame_rate_hz, tuning.chart));
    for (std::size_t t = 0; t < frames; ++t) {
      tracks.set(t, n, degrees_per_radian * charts[n].vector_of(t, clip.rotation(t, joints[n])));
      candidates(t, n) = gross[t];
    }
    for (const std::size_t other : joints_near[joints[n]]) {
      if (track_of[other] < joints.size()) nearby[n].push_back(track_of[other]);
    }
  }
  const CleanedTracks cleaned = clean_tracks(tracks, candidates, missing, nearby,
                                             clip.frame_rate_hz, {.tuning = tuning.tracks});
  for (std::size_t n = 0; n < joints.size(); ++n) {
    for (std::size_t t = 0; t < frames; ++t) {
      if (cleaned.shares[n] == 0 && cleaned.marked(t, n) == 0) continue;
      clip.rotation(t, joints[n]) = charts[n].rotation_of(t, radians_per_degree * tracks.at(t, n));
    }
  }
  return clip;
}

// The positions of a clip's joints as markers, at the scale at which `auto` cleans markers.
VectorMotion markers_of(const Take& clip) {
  constexpr double degrees_per_height = 1150;
  const double scale = degrees_per_height / body_height(clip.skeleton);
  const std::vector<Vec3> positions = joint_positions(clip);
  const std::size_t count = clip.joint_count();
  VectorMotion motion;
  motion.values = PoseMatrix(clip.frame_count(), 3 * count);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3 p = scale * positions[i];
    motion.values(i / count, 3 * (i % count)) = p.x;
    motion.values(i / count, 3 * (i % count) + 1) = p.y;
    motion.values(i / count, 3 * (i % count) + 2) = p.z;
  }
  motion.observed.assign(positions.size(), 1);
  motion.frame_rate_hz = clip.frame_rate_hz;
  motion.names = clip.skeleton.names;
  motion.is_rotation.assign(count, 0);
  motion.is_root.assign(count, 0);
  motion.per_radian = degrees_per_height / 4;
  motion.per_cm = degrees_per_height / 170;
  return motion;
}

VectorMotion cleaned_with(const Tuning& tuning, VectorMotion motion) {
  PoseMatrix& y = motion.values;
  VectorTracks tracks(y.frames, y.channels / 3,
                      [&](std::size_t t, std::size_t n) { return vector_at(y, t, n); });
  const SampleMarks none(y.frames, tracks.tracks());
  clean_tracks(tracks, none, none, std::vector<std::vector<std::size_t>>(tracks.tracks()),
               motion.frame_rate_hz, {.kind = TrackKind::positions, .tuning = tuning.tracks});
  for (std::size_t n = 0; n < tracks.tracks(); ++n) {
    for (std::size_t t = 0; t < y.frames; ++t) {
      const Vec3 p = tracks.at(t, n);
      y(t, 3 * n) = p.x;
      y(t, 3 * n + 1) = p.y;
      y(t, 3 * n + 2) = p.z;
    }
  }
  return motion;
}

double rms(const VectorMotion& a, const VectorMotion& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.values.size(); ++i)
    sum += std::pow(a.values.values[i] - b.values.values[i], 2);
  return std::sqrt(3 * sum / static_cast<double>(a.values.values.size()));
}

struct Damage {
  std::string name;
  double rate_hz;
  std::function<Take(const Take&)> apply;
};

// Coloured noise, and clean takes that are easily mistaken for noisy ones.
std::vector<Damage> coloured_damages() {
  const auto ar1 = [](double correlation) {
    return [=](const Take& c) {
      return damaged(c, "ar1", {{"std_deg", 1.5}, {"correlation", correlation}}, 7);
    };
  };
  return {{"ar1_0.5", 120, ar1(0.5)},
          {"ar1_0.8", 120, ar1(0.8)},
          {"ar1_0.95", 120, ar1(0.95)},
          {"video", 60,
           [](const Take& c) {
             return damaged(c, "system", {{"kind", std::string("video")}}, 7);
           }},
          {"half", 120,
           [](const Take& c) {
             return damaged(c, "gaussian-channels", {{"k", 0.5}}, 7);
           }},
          {"clean", 120, [](const Take& c) { return c; }},
          {"clean_30_hz", 30, [](const Take& c) { return c; }}};
}

// Samples of a lower rate with 1 degree of noise, held or interpolated, and clean ones.
std::vector<Damage> held_damages() {
  const auto lower = [](double noise_deg, const char* join, double rate_hz) {
    return [=](const Take& c) {
      return damaged(noisy(c, noise_deg, 0, 7), join, {{"rate_hz", rate_hz}}, 7);
    };
  };
  return {{"held_60_hz", 120, lower(1, "held", 60)},
          {"held_50_hz", 120, lower(1, "held", 50)},
          {"upsampled_60_hz", 120, lower(1, "upsampled", 60)},
          {"upsampled_30_hz", 120, lower(1, "upsampled", 30)},
          {"clean_held_30_hz", 120, lower(0, "held", 30)},
          {"1_deg", 120, [](const Take& c) { return noisy(c, 1, 0, 7); }},
          {"clean", 120, [](const Take& c) { return c; }}};
}

// A kind of damage on markers.
struct MarkerDamage {
  std::string name;
  double rate_hz;
  std::string family;  // family of systems; empty: clean
};

std::vector<MarkerDamage> marker_damages() {
  return {{"markers_video", 60, "video"},
          {"markers_depth", 30, "depth"},
          {"markers_clean_60_hz", 60, ""},
          {"markers_clean_30_hz", 30, ""}};
}

std::vector<Damage> damages() {
  return {{"1_deg", 120, [](const Take& c) { return noisy(c, 1, 0, 7); }},
          {"4_deg_spikes", 120, [](const Take& c) { return noisy(c, 4, 0.004, 7); }},
          {"half", 120,
           [](const Take& c) {
             return damaged(c, "gaussian-channels", {{"k", 0.5}}, 7);
           }},
          {"30_hz_2_deg", 30, [](const Take& c) { return noisy(c, 2, 0, 7); }},
          {"30_hz_dense", 30, [](const Take& c) { return noisy(c, 1, 0.1, 7); }},
          {"impulses", 120, [](const Take& c) { return damaged(c, "impulse", {}, 7); }},
          {"clean", 120, [](const Take& c) { return c; }},
          {"clean_30_hz", 30, [](const Take& c) { return c; }},
          {"impulses_30_hz", 30,
           [](const Take& c) {
             return damaged(c, "impulse", {{"share", 0.004}}, 7);
           }},
          {"outliers", 120, [](const Take& c) { return noisy(c, 0, 0.004, 7); }},
          {"third_deg_few_spikes", 120, [](const Take& c) { return noisy(c, 0.3, 0.001, 7); }}};
}

// Five seconds of each take.
std::vector<Take> takes_of(const Arguments& arguments) {
  std::vector<Take> takes;
  for (const char* name : {"111_24", "118_13", "13_12", "13_29", "39_05", "82_02", "83_47"}) {
    const Take clip = load_take(arguments, std::string(name) + ".bvh", {.motion = "walk"}).clip;
    takes.push_back(slice(clip, 0, std::min<std::size_t>(clip.frame_count(), 600)));
    if (arguments.quick) break;
  }
  return takes;
}

Take at_rate(const Take& clip, double rate_hz) {
  if (rate_hz == clip.frame_rate_hz) return clip;
  return resample(clip, rate_hz);
}

// A kind of damage, with the error that cleaning leaves on each take.
struct SweptKind {
  std::string name;
  std::vector<std::function<double(const Tuning&)>> errors;
};

std::vector<SweptKind> kinds_of(const std::vector<Take>& takes,
                                const std::vector<Damage>& damages) {
  std::vector<SweptKind> kinds;
  for (const Damage& damage : damages) {
    kinds.push_back({damage.name, {}});
    for (const Take& clip : takes) {
      const Take truth = at_rate(clip, damage.rate_hz);
      kinds.back().errors.push_back([truth, bad = damage.apply(truth)](const Tuning& tuning) {
        return geodesic_rms_deg(truth, cleaned_with(tuning, bad));
      });
    }
  }
  return kinds;
}

void add_markers(const std::vector<Take>& takes, std::vector<SweptKind>& kinds) {
  for (const MarkerDamage& damage : marker_damages()) {
    kinds.push_back({damage.name, {}});
    for (const Take& clip : takes) {
      const VectorMotion truth = markers_of(at_rate(clip, damage.rate_hz));
      VectorMotion bad = truth;
      Random random(7);
      if (!damage.family.empty()) apply_damage(bad, "system", {{"kind", damage.family}}, random);
      kinds.back().errors.push_back(
          [truth, bad](const Tuning& tuning) { return rms(truth, cleaned_with(tuning, bad)); });
    }
  }
}

// For each kind, the mean over takes of log(error in degrees + 0.01); smaller errors do not matter
// in practice.
std::vector<double> log_errors(const std::vector<SweptKind>& kinds, const Tuning& tuning) {
  std::vector<double> result;
  for (const SweptKind& kind : kinds) {
    double sum = 0;
    for (const auto& error : kind.errors) sum += std::log(error(tuning) + 0.01);
    result.push_back(sum / static_cast<double>(kind.errors.size()));
  }
  return result;
}

// Multiplies each constant by each factor, for these kinds of damage.
void vary(const Arguments& arguments, const std::vector<Constant>& list,
          const std::vector<SweptKind>& kinds, const std::vector<double>& factors, Table& table) {
  const std::vector<double> usual = log_errors(kinds, {});
  fmt::print("Error, degrees:");
  for (std::size_t d = 0; d < kinds.size(); ++d)
    fmt::print(" {} {:.4f}", kinds[d].name, std::exp(usual[d]) - 0.01);
  fmt::print(
      "\nChange of the error in percent: mean over the kinds of damage, and the kind that changes "
      "most.\n");
  for (std::size_t i = 0; i < list.size(); i += arguments.quick ? 12 : 1) {
    const Constant& constant = list[i];
    Tuning as_is;
    const double value = constant.value(as_is);
    std::string line = fmt::format("{:40} {:8.4g}", constant.name, value);
    for (const double factor : factors) {
      Tuning tuning;
      constant.set(tuning, factor * value);
      const double set = constant.value(tuning);
      if (set == value) {
        line += fmt::format(" {:>17}", "");
        continue;
      }
      const std::vector<double> errors = log_errors(kinds, tuning);
      double mean = 0, most = 0;
      for (std::size_t d = 0; d < errors.size(); ++d) {
        const double change = errors[d] - usual[d];
        mean += change / static_cast<double>(errors.size());
        if (std::fabs(change) > std::fabs(most)) most = change;
      }
      table.add({constant.name, fmt::format("{:g}", set), fmt::format("{:g}", factor),
                 fmt::format("{:.2f}", 100 * std::expm1(mean)),
                 fmt::format("{:.1f}", 100 * std::expm1(most))});
      line += fmt::format(" {:+8.2f}{:+9.1f}", 100 * std::expm1(mean), 100 * std::expm1(most));
    }
    fmt::print("{}\n", line);
    std::fflush(stdout);
  }
  fmt::print("\n");
}

void sweep(const Arguments& arguments) {
  const std::vector<Take> takes = takes_of(arguments);
  const std::string columns = "constant,value,factor,mean,largest";
  // Colour estimation is slow, so fewer values are tried.
  Table special(arguments, "auto_sweep_colour.csv", columns);
  vary(arguments, constants_of_held(), kinds_of(takes, held_damages()), {0.5, 2}, special);
  std::vector<SweptKind> coloured = kinds_of(takes, coloured_damages());
  add_markers(takes, coloured);
  vary(arguments, constants_of_colour(), coloured, {0.5, 2}, special);
  special.close();
  Table table(arguments, "auto_sweep.csv", columns);
  vary(arguments, constants(), kinds_of(takes, damages()), {0.5, 0.8, 1.25, 2}, table);
  table.close();
}

const Registration auto_sweep_entry("auto_sweep", sweep);

}  // namespace
}  // namespace kinemend::papers
