// `kinemend-train contacts`: trains the network that finds standing feet.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>
#include <utility>

#include "base/files.hpp"
#include "base/parallel.hpp"
#include "checkpoint.hpp"
#include "contact_training.hpp"
#include "kinemend/error.hpp"
#include "kinemend/io.hpp"
#include "models/model_reading.hpp"
#include "program.hpp"

namespace kinemend::train {

namespace {

constexpr std::size_t validation_samples = 400;
constexpr std::uint64_t validation_seed = 77;

struct Arguments {
  Run run;
  ContactTraining training;
  std::size_t versions = 9;
  bool has_live = true;
};

std::vector<ContactSource> sources_of(const std::vector<std::string>& paths, std::size_t versions,
                                      std::uint64_t seed) {
  std::vector<std::optional<ContactSource>> found(paths.size());
  for_each_index(paths.size(), [&](std::size_t i) {
    const Take take = read_take(paths[i]).take;
    if (take.has_joints()) found[i] = contact_source(take, versions, Random(seed).fork(i));
  });
  std::vector<ContactSource> sources;
  for (std::optional<ContactSource>& source : found) {
    if (source) sources.push_back(std::move(*source));
  }
  return sources;
}

// The checkpoint holds the states of both networks.
std::string part_name(std::size_t number) { return number == 0 ? "whole/" : "live/"; }

void put_part(const TensorFile& part, std::size_t number, TensorFile& all) {
  for (const auto& [name, tensor] : part.tensors) all.tensors[part_name(number) + name] = tensor;
  for (const auto& [name, text] : part.metadata) all.metadata[part_name(number) + name] = text;
}

TensorFile part_of(const TensorFile& all, std::size_t number) {
  const std::string prefix = part_name(number);
  TensorFile part;
  for (const auto& [name, tensor] : all.tensors) {
    if (name.starts_with(prefix)) part.tensors[name.substr(prefix.size())] = tensor;
  }
  for (const auto& [name, text] : all.metadata) {
    if (name.starts_with(prefix)) part.metadata[name.substr(prefix.size())] = text;
  }
  return part;
}

void train(Arguments arguments) {
  const Run& run = arguments.run;
  ContactTraining& training = arguments.training;
  const std::vector<ContactSource> sources =
      sources_of(run.paths(), arguments.versions, training.seed);
  const std::vector<ContactSource> kept =
      run.validation.empty() ? std::vector<ContactSource>()
                             : sources_of(lines_of(run.validation), 10, validation_seed);
  if (sources.empty()) throw Error(ErrorKind::usage, "no foot stands in any of the takes");
  double seconds = 0;
  for (const ContactSource& source : sources)
    seconds += static_cast<double>(source.versions.front().soles.frames) / source.frame_rate_hz;
  fmt::print("{} takes, {:.1f} min, {} to measure on\n", sources.size(), seconds / 60, kept.size());
  std::fflush(stdout);
  std::vector<ContactTrainer> trainers;
  trainers.emplace_back(sources, training);
  if (arguments.has_live) {
    training.lookahead = feet::Lookahead::none;
    trainers.emplace_back(sources, training);
  }
  if (run.resume) {
    Checkpoint kept_state =
        read_checkpoint(file_bytes(run.checkpoint), run.checkpoint, training.seed);
    for (std::size_t i = 0; i < trainers.size(); ++i)
      trainers[i].resume(part_of(kept_state.state, i), kept_state.batch);
  }
  const auto validation = [&] {
    std::string text;
    for (std::size_t i = 0; i < trainers.size() && !kept.empty(); ++i) {
      const ContactScore score = trainers[i].score(kept, validation_samples, validation_seed);
      text += fmt::format("  {} of other takes: loss {:.4f}, found {:.4f}, right {:.4f}",
                          i == 0 ? "whole" : "live", score.loss, score.found, score.right);
    }
    return text;
  };
  const auto save_all = [&] {
    Model model;
    model.method = contact_models.name;
    model.rate_hz = feet::contact_rate_hz;
    model.takes = sources.size();
    model.seconds = seconds;
    TensorFile state;
    for (std::size_t i = 0; i < trainers.size(); ++i) {
      trainers[i].put(model);
      put_part(trainers[i].state(), i, state);
    }
    save(run, write_checkpoint(std::move(state), trainers.front().batch(), training.seed),
         std::move(model));
  };
  const auto step = [&] {
    double loss = 0;
    for (ContactTrainer& trainer : trainers) loss += trainer.step();
    return loss / static_cast<double>(trainers.size());
  };
  run_steps({trainers.front().batch(), training.batches, 0.99, step, validation, save_all},
            run.report_s);
}

}  // namespace

int contact_program(int count, char** values) {
  Arguments arguments;
  ContactTraining& training = arguments.training;
  CLI::App app{"Trains the network that finds standing feet.", "kinemend-train contacts"};
  add_run_options(app, arguments.run, training.descent);
  app.add_flag("!--no-live", arguments.has_live,
               "without the network of streams, which sees no later frame");
  app.add_option("--versions", arguments.versions, "of each take, the first of them clean")
      ->capture_default_str();
  app.add_option("--seed", training.seed)->capture_default_str();
  app.add_option("--batches", training.batches, "steps of the training")->capture_default_str();
  app.add_option("--batch", training.batch, "samples a step")->capture_default_str();
  app.add_option("--steps", training.steps, "of a sample, sixty a second")->capture_default_str();
  app.add_option("--width", training.width)->capture_default_str();
  app.add_option("--dilations", training.dilations, "of the blocks")->delimiter(',');
  app.add_option("--rate", training.rate, "of learning, at its highest")->capture_default_str();
  int exit_code = 0;
  if (!parse(app, count, values, arguments.run, exit_code)) return exit_code;
  train(std::move(arguments));
  return 0;
}

}  // namespace kinemend::train
