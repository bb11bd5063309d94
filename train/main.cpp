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
#include "priors/sequence_damage.hpp"
#include "program.hpp"
#include "recurrent_training.hpp"

namespace kinemend::train {

namespace {

struct Arguments {
  std::vector<std::string> takes;
  std::string list, validation, output, checkpoint;
  bool resume = false;
  double rate_hz = 120;
  double report_s = 60;
  ModelCard card;
  RecurrentTraining training;
};

TrainingTakes takes_of(const std::vector<std::string>& paths) {
  return {paths.size(), [paths](std::size_t i) -> std::optional<std::variant<Clip, MarkerClip>> {
            return read_clip(paths[i]).clip;
          }};
}

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

void save(const Arguments& arguments, const RecurrentTrainer& trainer,
          const TrainingSequences& sequences) {
  if (!arguments.checkpoint.empty()) write_file(arguments.checkpoint, trainer.checkpoint());
  Model model = trainer.model();
  model.card = arguments.card;
  model.takes = sequences.takes;
  for (const TrainingSequences::Entry& entry : sequences.entries)
    model.seconds += entry.weight * static_cast<double>(entry.frames) / sequences.rate_hz;
  write_file(arguments.output, write_model(model));
}

void run(const Arguments& arguments) {
  std::vector<std::string> paths = arguments.takes;
  if (!arguments.list.empty()) {
    const std::vector<std::string> more = lines_of(arguments.list);
    paths.insert(paths.end(), more.begin(), more.end());
  }
  TrainSettings settings;
  settings.seed = arguments.training.seed;
  const TrainingSequences sequences = encode_takes(takes_of(paths), settings, arguments.rate_hz);
  fmt::print("{} takes, {} sequences, {} channels\n", sequences.takes, sequences.entries.size(),
             sequences.layout.channel_count());
  RecurrentTrainer trainer(sequences, arguments.training);
  if (arguments.resume) trainer.resume(file_bytes(arguments.checkpoint), arguments.checkpoint);
  const std::vector<ValidationSet> sets =
      arguments.validation.empty() ? std::vector<ValidationSet>{}
                                   : validation_sets(lines_of(arguments.validation), sequences);
  const Clock clock;
  const std::size_t first = trainer.batch();
  double loss = 0, weight = 0, reported_s = 0;
  while (trainer.batch() < arguments.training.batches) {
    constexpr double memory = 0.995;
    loss = memory * loss + (1 - memory) * trainer.step();
    weight = memory * weight + (1 - memory);
    const bool ends = trainer.batch() == arguments.training.batches;
    if (!ends && clock.seconds() - reported_s < arguments.report_s) continue;
    reported_s = clock.seconds();
    const double each = reported_s / static_cast<double>(trainer.batch() - first);
    const auto left = static_cast<double>(arguments.training.batches - trainer.batch());
    fmt::print("{} of {}  loss {:.4f}  {:.0f} s, {:.0f} s left{}\n", trainer.batch(),
               arguments.training.batches, loss / weight, reported_s, each * left,
               validation_text(trainer, sets));
    std::fflush(stdout);
    save(arguments, trainer, sequences);
  }
  // A training that was done already: the model once more, with the card as it is said now.
  if (trainer.batch() == first) save(arguments, trainer, sequences);
}

int start(int count, char** values) {
  if (count > 1 && std::strcmp(values[1], "paper") == 0)
    return paper_program(count - 1, values + 1);
  Arguments arguments;
  RecurrentTraining& training = arguments.training;
  CLI::App app{
      "Trains the network of the method recurrent. `kinemend-train paper`: the networks of "
      "Mall et al. 2017.",
      "kinemend-train"};
  app.add_option("takes", arguments.takes, "clean takes");
  app.add_option("--list", arguments.list, "file with further takes, one a line");
  app.add_option("--validate", arguments.validation,
                 "file with takes, one a line, to measure the model on as training goes on");
  app.add_option("-o,--output", arguments.output, "the model")->required();
  app.add_option("--checkpoint", arguments.checkpoint, "file to go on from");
  app.add_flag("--resume", arguments.resume, "goes on from the checkpoint, to the same result");
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
  app.add_option("--dropout", training.descent.dropout)->capture_default_str();
  app.add_option("--weight-decay", training.descent.weight_decay)->capture_default_str();
  app.add_option("--average", training.descent.average_decay)->capture_default_str();
  app.add_option("--report-s", arguments.report_s, "seconds between reports")
      ->capture_default_str();
  app.add_option("--title", arguments.card.title, "of the card");
  app.add_option("--data", arguments.card.data, "of the card");
  app.add_option("--licence", arguments.card.licence, "of the card");
  app.add_option("--command", arguments.card.command, "of the card");
  app.add_option("--figures", arguments.card.figures, "of the card");
  CLI11_PARSE(app, count, values);
  if (arguments.resume && arguments.checkpoint.empty())
    throw Error(ErrorKind::usage, "--resume wants --checkpoint");
  run(arguments);
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
