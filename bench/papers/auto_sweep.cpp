// What each constant of the method `auto` does: one at a time is made half, 0.8, 1.25 and 2 times
// as large, and the change of the error measured on takes of subjects that no other table
// of `auto` uses. tools/sweep runs it.
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "kinemend/experimental/convert.hpp"
#include "page.hpp"
#include "tracks/smooth_chart.hpp"
#include "tracks/spikes.hpp"
#include "tracks/track_cleaning.hpp"

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
  void add(const std::string& name, Group& (*group)(Tuning&), Value Group::*member) {
    list.push_back({name,
                    [=](Tuning& tuning) { return static_cast<double>(group(tuning).*member); },
                    [=](Tuning& tuning, double value) {
                      if constexpr (std::is_floating_point_v<Value>)
                        group(tuning).*member = value;
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

// The rotations as the method `auto` cleans them, with other constants.
Clip cleaned_with(const Tuning& tuning, Clip clip) {
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

struct Damage {
  std::string name;
  double rate_hz;
  std::function<Clip(const Clip&)> apply;
};

std::vector<Damage> damages() {
  return {{"1_deg", 120, [](const Clip& c) { return noisy(c, 1, 0, 7); }},
          {"4_deg_spikes", 120, [](const Clip& c) { return noisy(c, 4, 0.004, 7); }},
          {"half", 120,
           [](const Clip& c) {
             return damaged(c, "gaussian-channels", {{"k", 0.5}}, 7);
           }},
          {"30_hz_2_deg", 30, [](const Clip& c) { return noisy(c, 2, 0, 7); }},
          {"30_hz_dense", 30, [](const Clip& c) { return noisy(c, 1, 0.1, 7); }},
          {"impulses", 120, [](const Clip& c) { return damaged(c, "impulse", {}, 7); }},
          {"clean", 120, [](const Clip& c) { return c; }},
          {"clean_30_hz", 30, [](const Clip& c) { return c; }},
          {"impulses_30_hz", 30,
           [](const Clip& c) {
             return damaged(c, "impulse", {{"share", 0.004}}, 7);
           }},
          {"outliers", 120, [](const Clip& c) { return noisy(c, 0, 0.004, 7); }},
          {"third_deg_few_spikes", 120, [](const Clip& c) { return noisy(c, 0.3, 0.001, 7); }}};
}

struct Sample {
  Clip truth, damaged;
};

// 5 s of each take under each damage.
std::vector<std::vector<Sample>> samples(const Arguments& arguments) {
  std::vector<std::vector<Sample>> result;
  std::map<std::string, Clip> takes;
  for (const char* name : {"13_12", "13_29", "39_05", "82_02", "83_47", "111_24", "118_13"}) {
    const Clip clip = load_take(arguments, std::string(name) + ".bvh", {.motion = "walk"}).clip;
    takes[name] = slice(clip, 0, std::min<std::size_t>(clip.frame_count(), 600));
    if (arguments.quick) break;
  }
  for (const Damage& damage : damages()) {
    result.emplace_back();
    for (const auto& [name, clip] : takes) {
      const Clip truth =
          damage.rate_hz == clip.frame_rate_hz ? clip : resample(clip, damage.rate_hz);
      result.back().push_back({truth, damage.apply(truth)});
    }
  }
  return result;
}

// Of each damage the mean over the takes of the logarithm of the error in degrees, to which a
// hundredth is added: smaller errors do not differ for any use.
std::vector<double> log_errors(const std::vector<std::vector<Sample>>& all, const Tuning& tuning) {
  std::vector<double> result;
  for (const auto& of_damage : all) {
    double sum = 0;
    for (const Sample& sample : of_damage) {
      const Clip result_clip = cleaned_with(tuning, sample.damaged);
      sum += std::log(geodesic_rms_deg(sample.truth, result_clip) + 0.01);
    }
    result.push_back(sum / static_cast<double>(of_damage.size()));
  }
  return result;
}

void sweep(const Arguments& arguments) {
  const auto all = samples(arguments);
  Table table(arguments, "auto_sweep.csv", "constant,value,factor,mean,largest");
  const std::vector<double> usual = log_errors(all, {});
  const std::vector<Damage> kinds = damages();
  fmt::print("Error, degrees:");
  for (std::size_t d = 0; d < kinds.size(); ++d)
    fmt::print(" {} {:.4f}", kinds[d].name, std::exp(usual[d]) - 0.01);
  fmt::print(
      "\nChange of the error in percent: mean over the kinds of damage, and the kind that changes "
      "most.\n");
  const std::vector<Constant> list = constants();
  for (std::size_t i = 0; i < list.size(); i += arguments.quick ? 12 : 1) {
    const Constant& constant = list[i];
    Tuning as_is;
    const double value = constant.value(as_is);
    std::string line = fmt::format("{:40} {:8.4g}", constant.name, value);
    for (const double factor : {0.5, 0.8, 1.25, 2.0}) {
      Tuning tuning;
      constant.set(tuning, factor * value);
      const double set = constant.value(tuning);
      if (set == value) {
        line += fmt::format(" {:>17}", "");
        continue;
      }
      const std::vector<double> errors = log_errors(all, tuning);
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
  table.close();
}

}  // namespace
}  // namespace kinemend::papers

int main(int count, char** values) {
  return kinemend::papers::run(count, values, kinemend::papers::sweep);
}
