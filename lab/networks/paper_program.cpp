// kinemend-train paper: trains the networks of Mall et al. 2017, EBF, BF, NN and EBD.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "base/files.hpp"
#include "filter_training.hpp"
#include "kinemend/error.hpp"
#include "kinemend/io.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "program.hpp"

namespace kinemend::train {

namespace {

struct Arguments {
  Run run;
  std::vector<std::string> noise, bias, gaps;
  std::string start;
  FilterTraining training;
};

// Parses NAME:OPTION=VALUE,OPTION=VALUE.
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

std::vector<Take> read_takes(const std::vector<std::string>& paths) {
  std::vector<Take> takes;
  for (const std::string& path : paths) {
    const Take clip = read_joints(path).take;
    takes.push_back(slice(clip, leading_calibration_frames(clip), clip.frame_count()));
  }
  return takes;
}

void train(Arguments arguments) {
  const Run& run = arguments.run;
  for (const std::string& text : arguments.noise)
    arguments.training.noise.push_back(damage_of(text));
  for (const std::string& text : arguments.bias) arguments.training.bias.push_back(damage_of(text));
  for (const std::string& text : arguments.gaps) arguments.training.gaps.push_back(damage_of(text));
  const std::vector<std::string> paths = run.paths();
  FilterTrainer trainer(read_takes(paths), arguments.training);
  if (!arguments.start.empty()) trainer.begin_with(read_model(arguments.start));
  if (run.resume) trainer.resume(file_bytes(run.checkpoint), run.checkpoint);
  std::vector<Take> kept;
  if (!run.validation.empty()) kept = read_takes(lines_of(run.validation));
  fmt::print("{} takes, {} channels, {} steps\n", paths.size(),
             trainer.model().layout.channel_count(), trainer.batches());
  run_steps({trainer.batch(), trainer.batches(), 0.98, [&] { return trainer.step(); },
             [&] {
               return kept.empty() ? std::string()
                                   : fmt::format("  kept takes {:.4f}", trainer.share_left(kept));
             },
             [&] { save(run, trainer.checkpoint(), trainer.model()); }},
            run.report_s);
}

}  // namespace

int paper_program(int count, char** values) {
  Arguments arguments;
  FilterTraining& training = arguments.training;
  CLI::App app{
      "Trains the networks of Mall et al. 2017: filters that are predicted for each joint "
      "and frame, and poses for gaps.",
      "kinemend-train paper"};
  add_run_options(app, arguments.run, training.descent);
  app.add_option("--network", training.kind, "ebf, bf, nn or ebd")->capture_default_str();
  app.add_option("--head", training.head, "gaussian, biased, shape, residual or pose")
      ->capture_default_str();
  app.add_option("--noise", arguments.noise,
                 "damage of the takes, NAME:OPTION=VALUE,...; of several one is drawn for a take; "
                 "none: as it is")
      ->expected(1)
      ->take_all();
  app.add_option("--bias", arguments.bias, "damage likewise, on top of the noise")
      ->expected(1)
      ->take_all();
  app.add_option("--gaps", arguments.gaps, "gaps likewise; the network then fills them")
      ->expected(1)
      ->take_all();
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
  app.add_option("--weight-bound", training.weight_bound,
                 "weights of dense layers are drawn within this; 0: by the width of their layers");
  app.add_flag("--head-start,!--no-head-start", training.has_head_start,
               "filters begin at the best constant widths, with a last layer of zeros");
  app.add_flag("--scaled-loss,!--no-scaled-loss", training.scales_loss,
               "divides the loss of a take by its noise");
  app.add_flag("--standardised,!--no-standardised", training.standardises,
               "inputs with mean 0 and deviation 1; else radians");
  app.add_option("--rate", training.rate, "of learning, at its highest")->capture_default_str();
  int exit_code = 0;
  if (!parse(app, count, values, arguments.run, exit_code)) return exit_code;
  train(std::move(arguments));
  return 0;
}

}  // namespace kinemend::train
