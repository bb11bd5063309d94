// `kinemend-train learned`: trains the network of the method `learned`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "base/files.hpp"
#include "cleaner/pieces.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/io.hpp"
#include "methods/learned/motion_channels.hpp"
#include "motion_training.hpp"
#include "program.hpp"

namespace kinemend::train {

namespace {

constexpr double rate_hz = 120;
constexpr std::size_t validation_samples = 24;
constexpr std::uint64_t validation_seed = 77;

struct Arguments {
  Run run;
  MotionTraining training;
  std::string pairs, validation_pairs, rigs, validation_rigs, outset;
};

MotionPair pair_of(const std::string& name, const Take& noisy, const Take& reference,
                   double least_deg) {
  const TakeView take = view_of(noisy);
  MotionTracks tracks = motion_tracks_of(take, changeable_tracks(take));
  std::vector<float> truth = values_in(tracks, view_of(reference));
  return mapped_pair({name, {std::move(tracks.take), std::move(truth)}}, least_deg);
}

// Reads lines of `noisy<tab>reference`. Channels that move by less than two degrees, or half a
// hundredth of a body height, say little about motion.
std::vector<MotionPair> pairs_of(const std::string& list) {
  constexpr double least_turn_deg = 2, least_move_deg = 3.4;
  std::vector<MotionPair> pairs;
  if (list.empty()) return pairs;
  for (const std::string& line : lines_of(list)) {
    const std::size_t tab = line.find('\t');
    if (tab == std::string::npos)
      throw Error(ErrorKind::usage, fmt::format("{}: expected two files with a tab between", list));
    const std::string noisy = line.substr(0, tab), reference = line.substr(tab + 1);
    const Take one = read_take(noisy).take, other = read_take(reference).take;
    if (one.has_joints() != other.has_joints())
      throw Error(ErrorKind::usage, fmt::format("{}: joints and markers are no pair", noisy));
    pairs.push_back(pair_of(noisy, one, other, one.has_joints() ? least_turn_deg : least_move_deg));
  }
  return pairs;
}

MarkerMotion marker_motion_of(const Take& markers) {
  const TakeView view = view_of(markers);
  std::vector<std::size_t> all(markers.marker_count());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const MotionTake take = motion_tracks_of(view, std::move(all)).take;
  MarkerMotion motion{take.frame_rate_hz, PoseMatrix(take.frames, take.channels)};
  std::copy(take.values.begin(), take.values.end(), motion.positions.values.begin());
  return motion;
}

// Joints of the takes as markers. The first few frames may be a calibration pose.
std::vector<MarkerMotion> marker_motions_of(const std::vector<std::string>& paths) {
  std::vector<MarkerMotion> motions;
  for (const std::string& path : paths) {
    const Take clip = read_joints(path).take;
    motions.push_back(marker_motion_of(
        joint_markers(slice(clip, leading_calibration_frames(clip), clip.frame_count()))));
  }
  return motions;
}

// Clean takes of other rigs, in the channels that the method uses.
RigMotion rig_motion_of(const Take& clip, const BodyLayout& layout,
                        std::span<const float> deviation) {
  const TakeView view = view_of(clip);
  MotionTracks tracks = motion_tracks_of(view, changeable_tracks(view));
  const BodyReading reading = read_body(layout, deviation, {}, view, tracks);
  if (reading.body) show_body(*reading.body, tracks.take);
  const MotionTake& take = tracks.take;
  RigMotion motion{take.frame_rate_hz, PoseMatrix(take.frames, take.channels), take.slots,
                   take.is_position};
  std::copy(take.values.begin(), take.values.end(), motion.values.values.begin());
  return motion;
}

// Training data besides the takes of the body.
struct OtherMotion {
  std::vector<MotionPair> pairs;
  std::vector<MarkerMotion> markers;
  std::vector<RigMotion> rigs;

  OtherMotion(const TrainingSequences& sequences, const std::vector<std::string>& takes,
              const std::string& pair_list, const std::string& rig_list, bool has_markers)
      : pairs(pairs_of(pair_list)) {
    if (has_markers) markers = marker_motions_of(takes);
    if (rig_list.empty()) return;
    const std::vector<float> deviation = motion_statistics(sequences).deviation;
    for (const std::string& path : lines_of(rig_list)) {
      const Take take = read_take(path).take;
      if (take.frame_count() < 8) continue;
      if (!take.has_joints()) {
        if (has_markers) markers.push_back(marker_motion_of(take));
        continue;
      }
      rigs.push_back(
          rig_motion_of(slice(take, leading_calibration_frames(take), take.frame_count()),
                        sequences.layout, deviation));
    }
  }
};

void train(const Arguments& arguments) {
  const Run& run = arguments.run;
  TrainSettings settings;
  settings.seed = arguments.training.seed;
  const TrainingSequences sequences = encode_takes(takes_of(run.paths()), settings, rate_hz);
  const bool has_markers = arguments.training.sampling.marker_share > 0;
  OtherMotion other(sequences, run.paths(), arguments.pairs, arguments.rigs, has_markers);
  std::optional<TrainingSequences> kept_sequences;
  std::vector<std::string> kept_takes;
  if (!run.validation.empty()) {
    kept_takes = lines_of(run.validation);
    kept_sequences = encode_takes(takes_of(kept_takes), settings, rate_hz);
  }
  const OtherMotion kept(kept_sequences ? *kept_sequences : sequences, kept_takes,
                         arguments.validation_pairs, arguments.validation_rigs, has_markers);
  fmt::print("{} takes, {} sequences, {} channels, {} pairs, {} markers, {} other rigs\n",
             sequences.takes, sequences.entries.size(), sequences.layout.channel_count(),
             other.pairs.size(), other.markers.size(), other.rigs.size());
  MotionTrainer trainer(sequences, std::move(other.pairs), std::move(other.markers),
                        std::move(other.rigs), arguments.training);
  if (!arguments.outset.empty()) trainer.begin_with(read_model(arguments.outset));
  if (run.resume) trainer.resume(file_bytes(run.checkpoint), run.checkpoint);
  const auto validation = [&] {
    MotionSampling damaged = arguments.training.sampling;
    damaged.clean_share = damaged.live_share = damaged.pair_share = damaged.marker_share = 0;
    damaged.rig_share = 0;
    damaged.has_slow_noise = true;  // whatever the training data
    const auto with = [&](double MotionSampling::*share) {
      MotionSampling sampling = damaged;
      sampling.*share = 1;
      return sampling;
    };
    const auto left = [&](const MotionSources& sources, const MotionSampling& sampling) {
      return trainer.share_left(sources, sampling, validation_samples, validation_seed);
    };
    std::string text;
    const bool fits = kept_sequences &&
                      kept_sequences->layout.channel_count() == sequences.layout.channel_count();
    if (fits) {
      const MotionSources joints{*kept_sequences, trainer.mirror()};
      text += fmt::format("  of the damage: takes {:.4f}, live {:.4f}", left(joints, damaged),
                          left(joints, with(&MotionSampling::live_share)));
      if (!kept.markers.empty())
        text += fmt::format(", markers {:.4f}",
                            left({*kept_sequences, trainer.mirror(), {}, kept.markers},
                                 with(&MotionSampling::marker_share)));
      text += fmt::format("  clean {:.4f}", left(joints, with(&MotionSampling::clean_share)));
      if (!kept.rigs.empty())
        text += fmt::format("  other rigs {:.4f}",
                            left({*kept_sequences, trainer.mirror(), {}, {}, kept.rigs},
                                 with(&MotionSampling::rig_share)));
    }
    if (!kept.pairs.empty())
      text += fmt::format("  pairs {:.4f}", left({sequences, trainer.mirror(), kept.pairs},
                                                 with(&MotionSampling::pair_share)));
    return text;
  };
  run_steps({trainer.batch(), arguments.training.batches, 0.995, [&] { return trainer.step(); },
             validation, [&] { save(run, trainer.checkpoint(), trainer.model(), &sequences); }},
            run.report_s);
}

}  // namespace

int motion_program(int count, char** values) {
  Arguments arguments;
  MotionTraining& training = arguments.training;
  CLI::App app{"Trains the network of the method learned.", "kinemend-train learned"};
  add_run_options(app, arguments.run, training.descent);
  app.add_option(
      "--pairs", arguments.pairs,
      "file with takes of two systems, noisy and reference, tab between, one pair a line");
  app.add_option("--validate-pairs", arguments.validation_pairs, "the same, not learned from");
  app.add_option("--rigs", arguments.rigs, "file with clean takes of other rigs, one a line");
  app.add_option("--validate-rigs", arguments.validation_rigs, "the same, not learned from");
  app.add_option("--from", arguments.outset,
                 "model to begin with, of the same shape or with fewer inputs and blocks");
  app.add_option("--seed", training.seed)->capture_default_str();
  app.add_option("--batches", training.batches, "steps of the training")->capture_default_str();
  app.add_option("--batch", training.batch, "samples a step")->capture_default_str();
  app.add_option("--steps", training.sampling.steps, "of a sample, thirty a second")
      ->capture_default_str();
  app.add_option("--pair-share", training.sampling.pair_share, "of samples that are pairs")
      ->capture_default_str();
  app.add_option("--marker-share", training.sampling.marker_share,
                 "of the other samples that are of markers, where the joints are")
      ->capture_default_str();
  app.add_option("--rig-share", training.sampling.rig_share, "of the rest that are of other rigs")
      ->capture_default_str();
  app.add_option("--clean-share", training.sampling.clean_share, "of samples that are clean")
      ->capture_default_str();
  app.add_option("--live-share", training.sampling.live_share, "of samples that are read live")
      ->capture_default_str();
  app.add_flag("!--no-slow-noise", training.sampling.has_slow_noise,
               "no low-passed noise, no filtered takes");
  app.add_flag("!--no-trunk", training.shape.has_trunk, "every channel by itself");
  app.add_option("--encoded", training.shape.encoded)->capture_default_str();
  app.add_option("--slot-units", training.shape.slot_units)->capture_default_str();
  app.add_option("--hidden", training.shape.hidden)->capture_default_str();
  app.add_option("--head", training.shape.head)->capture_default_str();
  app.add_option("--dilations", training.shape.dilations, "of the blocks")->delimiter(',');
  app.add_option("--velocity", training.loss.velocity, "what errors of velocity count")
      ->capture_default_str();
  app.add_option("--acceleration", training.loss.acceleration, "what errors of acceleration count")
      ->capture_default_str();
  app.add_option("--rate", training.rate, "of learning, at its highest")->capture_default_str();
  int exit_code = 0;
  if (!parse(app, count, values, arguments.run, exit_code)) return exit_code;
  train(arguments);
  return 0;
}

}  // namespace kinemend::train
