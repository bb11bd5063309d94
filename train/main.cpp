// kinemend-train: fits the networks. All that it needs to know of takes comes from the library.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "base/file_bytes.hpp"
#include "kinemend/error.hpp"
#include "kinemend/io.hpp"
#include "motion_training.hpp"
#include "priors/sequence_damage.hpp"
#include "program.hpp"
#include "recurrent_training.hpp"

namespace kinemend::train {

namespace {

constexpr double rate_hz = 120;

struct Arguments {
  Run run;
  RecurrentTraining training;
};

struct ValidationSet {
  std::string name;
  std::vector<RecurrentSample> samples;
};

// White noise, noise in proportion to the motion and correlated noise on the first seconds of takes
// that are not learned from.
std::vector<ValidationSet> validation_sets(const std::vector<std::string>& paths,
                                           const TrainingSequences& sequences) {
  std::vector<ValidationSet> sets{{"white", {}}, {"half", {}}, {"ar1", {}}};
  const std::vector<std::pair<std::string, OptionValues>> damages{
      {"gaussian", {{"std_deg", 1.0}}},
      {"gaussian-channels", {{"k", 0.5}}},
      {"ar1", {{"std_deg", 1.5}, {"correlation", 0.8}}}};
  constexpr std::size_t most_frames = 721;
  for (const std::string& path : paths) {
    Clip clip = read_clip(path).clip;
    clip = slice(clip, leading_calibration_frames(clip), clip.frame_count());
    clip = slice(clip, 0, std::min(clip.frame_count(), most_frames));
    const BodyMatch match = match_body(sequences.layout, clip);
    const PoseMatrix truth = encode_body(clip, sequences.layout, match).poses;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      PoseMatrix poses = truth;
      std::vector<std::uint8_t> observed;
      Random random(7);
      damage_sequence(sequences.layout, sequences.rate_hz, poses, observed, damages[i].first,
                      damages[i].second, random);
      sets[i].samples.push_back(
          recurrent_sample_of(sequences.layout, sequences.rate_hz, truth, poses, observed));
    }
  }
  return sets;
}

std::string validation_text(const RecurrentTrainer& trainer,
                            const std::vector<ValidationSet>& sets) {
  std::string text;
  for (const ValidationSet& set : sets) {
    double sum = 0;
    for (const RecurrentSample& sample : set.samples) sum += trainer.share_left(sample);
    if (!set.samples.empty())
      text += fmt::format("  {} {:.4f}", set.name, sum / static_cast<double>(set.samples.size()));
  }
  return text.empty() ? text : "  of auto's error:" + text;
}

void train(const Arguments& arguments) {
  const Run& run = arguments.run;
  TrainSettings settings;
  settings.seed = arguments.training.seed;
  const TrainingSequences sequences = encode_takes(takes_of(run.paths()), settings, rate_hz);
  fmt::print("{} takes, {} sequences, {} channels\n", sequences.takes, sequences.entries.size(),
             sequences.layout.channel_count());
  RecurrentTrainer trainer(sequences, arguments.training);
  if (run.resume) trainer.resume(file_bytes(run.checkpoint), run.checkpoint);
  const std::vector<ValidationSet> sets =
      run.validation.empty() ? std::vector<ValidationSet>{}
                             : validation_sets(lines_of(run.validation), sequences);
  run_steps({trainer.batch(), arguments.training.batches, 0.995, [&] { return trainer.step(); },
             [&] { return validation_text(trainer, sets); },
             [&] { save(run, trainer.checkpoint(), trainer.model(), &sequences); }},
            run.report_s);
}

int start(int count, char** values) {
  if (count > 1 && std::strcmp(values[1], "paper") == 0)
    return paper_program(count - 1, values + 1);
  if (count > 1 && std::strcmp(values[1], "learned") == 0)
    return motion_program(count - 1, values + 1);
  Arguments arguments;
  RecurrentTraining& training = arguments.training;
  CLI::App app{
      "Trains the network of the method recurrent. `kinemend-train paper`: the networks of "
      "Mall et al. 2017.",
      "kinemend-train"};
  add_run_options(app, arguments.run, training.descent);
  app.add_option("--seed", training.seed)->capture_default_str();
  app.add_option("--batches", training.batches, "steps of the training")->capture_default_str();
  app.add_option("--batch", training.batch, "samples a step")->capture_default_str();
  app.add_option("--frames", training.frames, "of a sample")->capture_default_str();
  app.add_option("--pool", training.pool, "samples damaged at once")->capture_default_str();
  app.add_option("--uses", training.uses, "of a damaged sample")->capture_default_str();
  app.add_option("--hidden", training.hidden, "units")->capture_default_str();
  app.add_option("--dilations", training.dilations, "of the blocks")->delimiter(',');
  app.add_option("--offset-deg", training.offset_deg,
                 "of the bodies that samples are made to be of")
      ->capture_default_str();
  app.add_option("--most-scale", training.most_scale, "of their motion")->capture_default_str();
  app.add_option("--rate", training.rate, "of learning, at its highest")->capture_default_str();
  int exit_code = 0;
  if (!parse(app, count, values, arguments.run, exit_code)) return exit_code;
  train(arguments);
  return 0;
}

}  // namespace

}  // namespace kinemend::train

int main(int count, char** values) {
  // OpenBLAS with threads makes small products slower; it reads this as it is loaded.
  if (std::getenv("OPENBLAS_NUM_THREADS") == nullptr) {
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
    setenv("OMP_NUM_THREADS", "1", 0);
    execv("/proc/self/exe", values);
  }
  try {
    return kinemend::train::start(count, values);
  } catch (const kinemend::Error& error) {
    fmt::print(stderr, "kinemend-train: {}\n", error.what());
    return static_cast<int>(error.kind());
  }
}
