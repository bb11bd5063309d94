// `kinemend-train learned`: the network of the method `learned`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "base/file_bytes.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/convert.hpp"
#include "kinemend/io.hpp"
#include "learned/corrector/motion_channels.hpp"
#include "methods/core/pieces.hpp"
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
  std::string pairs, validation_pairs, outset;
};

MotionPair pair_of(const std::string& name, const Take& noisy, const Take& reference,
                   double least_deg) {
  const TakeView take = view_of(noisy);
  MotionTracks tracks = motion_tracks_of(take, changeable_tracks(take));
  std::vector<float> truth = values_in(tracks, view_of(reference));
  return mapped_pair({name, {std::move(tracks.take), std::move(truth)}}, least_deg);
}

// Lines `noisy reference`, with a tab between. Channels that move by less than two degrees, or half
// a hundredth of a body height, say little of motion.
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

// Joints of the takes, as markers. A few of the first frames may be a calibration pose.
std::vector<MarkerMotion> marker_motions_of(const std::vector<std::string>& paths) {
  std::vector<MarkerMotion> motions;
  for (const std::string& path : paths) {
    const Take clip = read_joints(path).take;
    const Take markers =
        joint_markers(slice(clip, leading_calibration_frames(clip), clip.frame_count()));
    const TakeView view = view_of(markers);
    std::vector<std::size_t> all(markers.marker_count());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const MotionTake take = motion_tracks_of(view, std::move(all)).take;
    MarkerMotion motion{take.frame_rate_hz, PoseMatrix(take.frames, take.channels)};
    std::copy(take.values.begin(), take.values.end(), motion.positions.values.begin());
    motions.push_back(std::move(motion));
  }
  return motions;
}

void train(const Arguments& arguments) {
  const Run& run = arguments.run;
  TrainSettings settings;
  settings.seed = arguments.training.seed;
  const TrainingSequences sequences = encode_takes(takes_of(run.paths()), settings, rate_hz);
  std::vector<MotionPair> pairs = pairs_of(arguments.pairs);
  const std::vector<MotionPair> kept = pairs_of(arguments.validation_pairs);
  fmt::print("{} takes, {} sequences, {} channels, {} pairs\n", sequences.takes,
             sequences.entries.size(), sequences.layout.channel_count(), pairs.size());
  std::vector<MarkerMotion> markers;
  if (arguments.training.sampling.marker_share > 0) markers = marker_motions_of(run.paths());
  MotionTrainer trainer(sequences, std::move(pairs), std::move(markers), arguments.training);
  if (!arguments.outset.empty()) trainer.begin_with(read_model(arguments.outset));
  if (run.resume) trainer.resume(file_bytes(run.checkpoint), run.checkpoint);
  std::optional<TrainingSequences> others;
  std::vector<MarkerMotion> other_markers;
  if (!run.validation.empty()) {
    others = encode_takes(takes_of(lines_of(run.validation)), settings, rate_hz);
    other_markers = marker_motions_of(lines_of(run.validation));
  }
  const auto validation = [&] {
    std::string text;
    MotionSampling damaged = arguments.training.sampling;
    damaged.clean_share = damaged.live_share = 0;
    damaged.has_slow_noise = true;  // whatever is learned from
    MotionSampling live = damaged;
    live.live_share = 1;
    MotionSampling paired = damaged;
    paired.pair_share = 1;
    MotionSampling of_markers = damaged;
    of_markers.marker_share = 1;
    const auto left = [&](const MotionSources& sources, const MotionSampling& sampling) {
      return trainer.share_left(sources, sampling, validation_samples, validation_seed);
    };
    if (others && others->layout.channel_count() == sequences.layout.channel_count()) {
      const MotionSources joints{*others, trainer.mirror()};
      text += fmt::format("  of the damage: takes {:.4f}, live {:.4f}, markers {:.4f}",
                          left(joints, damaged), left(joints, live),
                          left({*others, trainer.mirror(), {}, other_markers}, of_markers));
    }
    if (!kept.empty())
      text += fmt::format("  pairs {:.4f}", left({sequences, trainer.mirror(), kept}, paired));
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
  app.add_option("--from", arguments.outset, "model to begin with, of the same shape");
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
  app.add_option("--rate", training.rate, "of learning, at its highest")->capture_default_str();
  int exit_code = 0;
  if (!parse(app, count, values, arguments.run, exit_code)) return exit_code;
  train(arguments);
  return 0;
}

}  // namespace kinemend::train
