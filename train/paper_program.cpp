// kinemend-train paper: the networks of Mall et al. 2017, EBF, BF, NN and EBD.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "base/file_bytes.hpp"
#include "filter_training.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/corrupt.hpp"
#include "kinemend/io.hpp"
#include "program.hpp"

namespace kinemend::train {

namespace {

struct Arguments {
  std::vector<std::string> takes, noise, gaps;
  std::string list, validation, output, checkpoint, start;
  bool resume = false;
  double report_s = 60;
  ModelCard card;
  FilterTraining training;
};

// NAME:OPTION=VALUE,OPTION=VALUE
FilterDamage damage_of(const std::string& text) {
  FilterDamage damage{text.substr(0, text.find(':')), {}};
  if (damage.name == "none") return {};
  const auto known = damages();
  const auto found = std::find_if(known.begin(), known.end(),
                                  [&](const Damage& entry) { return entry.name == damage.name; });
  if (found == known.end()) throw Error(ErrorKind::usage, "unknown damage " + damage.name);
  std::size_t at = damage.name.size();
  while (at < text.size()) {
    const std::size_t end = std::min(text.find(',', at + 1), text.size());
    const std::string part = text.substr(at + 1, end - at - 1);
    const std::string name = part.substr(0, part.find('='));
    const auto spec = std::find_if(found->options.begin(), found->options.end(),
                                   [&](const OptionSpec& option) { return option.name == name; });
    if (spec == found->options.end() || part.size() <= name.size())
      throw Error(ErrorKind::usage, fmt::format("{}: OPTION=VALUE is wanted in {}", text, part));
    damage.values[name] = parse_option(*spec, part.substr(name.size() + 1));
    at = end;
  }
  return damage;
}

std::vector<Clip> read_takes(const std::vector<std::string>& paths) {
  std::vector<Clip> takes;
  for (const std::string& path : paths) {
    const Clip clip = read_clip(path).clip;
    takes.push_back(slice(clip, leading_calibration_frames(clip), clip.frame_count()));
  }
  return takes;
}

void save(const Arguments& arguments, const FilterTrainer& trainer) {
  if (!arguments.checkpoint.empty()) write_file(arguments.checkpoint, trainer.checkpoint());
  Model model = trainer.model();
  model.card = arguments.card;
  write_file(arguments.output, write_model(model));
}

void train(Arguments arguments) {
  std::vector<std::string> paths = arguments.takes;
  if (!arguments.list.empty()) {
    const std::vector<std::string> more = lines_of(arguments.list);
    paths.insert(paths.end(), more.begin(), more.end());
  }
  for (const std::string& text : arguments.noise)
    arguments.training.noise.push_back(damage_of(text));
  for (const std::string& text : arguments.gaps) arguments.training.gaps.push_back(damage_of(text));
  FilterTrainer trainer(read_takes(paths), arguments.training);
  if (!arguments.start.empty()) trainer.begin_with(read_model(arguments.start));
  if (arguments.resume) trainer.resume(file_bytes(arguments.checkpoint), arguments.checkpoint);
  std::vector<Clip> kept;
  if (!arguments.validation.empty()) kept = read_takes(lines_of(arguments.validation));
  fmt::print("{} takes, {} channels, {} steps\n", paths.size(),
             trainer.model().layout.channel_count(), trainer.batches());
  const Clock clock;
  const std::size_t first = trainer.batch();
  double loss = 0, weight = 0, reported_s = 0;
  while (trainer.batch() < trainer.batches()) {
    constexpr double memory = 0.98;
    loss = memory * loss + (1 - memory) * trainer.step();
    weight = memory * weight + (1 - memory);
    const bool ends = trainer.batch() == trainer.batches();
    if (!ends && clock.seconds() - reported_s < arguments.report_s) continue;
    reported_s = clock.seconds();
    const double each = reported_s / static_cast<double>(trainer.batch() - first);
    fmt::print("{} of {}  error {:.4f} of that before  {:.0f} s, {:.0f} s left", trainer.batch(),
               trainer.batches(), loss / weight, reported_s,
               each * static_cast<double>(trainer.batches() - trainer.batch()));
    if (!kept.empty()) fmt::print("  kept takes {:.4f}", trainer.share_left(kept));
    fmt::print("\n");
    std::fflush(stdout);
    save(arguments, trainer);
  }
  if (trainer.batch() == first) save(arguments, trainer);
}

}  // namespace

int paper_program(int count, char** values) {
  Arguments arguments;
  FilterTraining& training = arguments.training;
  CLI::App app{
      "Trains the networks of Mall et al. 2017: filters that are predicted for each joint "
      "and frame, and poses for gaps.",
      "kinemend-train paper"};
  app.add_option("takes", arguments.takes, "clean takes of one frame rate");
  app.add_option("--list", arguments.list, "file with further takes, one a line");
  app.add_option("--validate", arguments.validation,
                 "file with takes, one a line, to measure the model on as training goes on");
  app.add_option("-o,--output", arguments.output, "the model")->required();
  app.add_option("--network", training.kind, "ebf, bf, nn or ebd")->capture_default_str();
  app.add_option("--head", training.head, "gaussian, biased, shape or residual")
      ->capture_default_str();
  app.add_option("--noise", arguments.noise,
                 "damage of the takes, NAME:OPTION=VALUE,...; of several one is drawn for a take; "
                 "none: as it is")
      ->expected(1)
      ->take_all();
  app.add_option("--gaps", arguments.gaps, "gaps likewise; the network then fills them")
      ->expected(1)
      ->take_all();
  app.add_option("--checkpoint", arguments.checkpoint, "file to go on from");
  app.add_flag("--resume", arguments.resume, "goes on from the checkpoint, to the same result");
  app.add_option("--start", arguments.start, "model of the same network to begin with");
  app.add_option("--seed", training.seed)->capture_default_str();
  app.add_option("--epochs", training.epochs)->capture_default_str();
  app.add_option("--batch", training.batch, "chunks a step")->capture_default_str();
  app.add_option("--frames", training.frames, "of a chunk")->capture_default_str();
  app.add_option("--uses", training.uses, "epochs of one damage")->capture_default_str();
  app.add_flag("--augment,!--no-augment", training.is_augmented,
               "chunks in a mirror and backwards too");
  app.add_flag("--roughness,!--no-roughness", training.sees_roughness,
               "shows how rough each channel is; the paper's networks do not see it");
  app.add_option("--rate", training.rate, "of learning, at its highest")->capture_default_str();
  app.add_option("--dropout", training.descent.dropout, "of what the LSTM layers see")
      ->capture_default_str();
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
  train(std::move(arguments));
  return 0;
}

}  // namespace kinemend::train
