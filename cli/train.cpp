// kinemend train: trains a model on clean takes.

#include "kinemend/lab/train.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include "batch_list.hpp"
#include "clean_flags.hpp"
#include "commands.hpp"
#include "json.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/io.hpp"
#include "method_options.hpp"
#include "model_view.hpp"
#include "platform/system.hpp"
#include "run_files.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

/// The settings of a training.
struct TrainingRun {
  std::string method;
  OptionValues options;
  TrainSettings settings;
  std::vector<std::string> takes;
  ReadOptions reading;
  std::string fill;  ///< a method of `fill_methods()`; empty: no filling
  std::string output, card;
  std::string checkpoint;  ///< its path; empty: none, as the model goes to no file
  bool kept = false;       ///< this training has written the checkpoint
  bool force = false, json = false, quiet = false, skip_unreadable = false;
};

Take read_training_take(const TrainingRun& training, const std::string& path) {
  return read_and_warn(path, training.reading).take;
}

/// Returns nullopt, with a warning, for an unreadable take if those are skipped.
std::optional<Take> training_take(const TrainingRun& training, const std::string& path) {
  std::optional<Take> take;
  try {
    take = read_training_take(training, path);
  } catch (const Error& error) {
    if (!training.skip_unreadable || error.kind() != ErrorKind::unreadable_input) throw;
    say_warning(fmt::format("{} (skipped)", error.what()));
    return std::nullopt;
  }
  if (!training.fill.empty()) {
    FillSettings settings;
    settings.method = training.fill;
    fill_gaps(*take, settings);
  }
  return take;
}

TrainingTakes takes_of(const TrainingRun& training, ProgressLine& progress) {
  return {training.takes.size(), [&training, &progress](std::size_t index) {
            progress.clear();
            return training_take(training, training.takes[index]);
          }};
}

std::string summary_text(const ModelFile& file, double training_s) {
  const Model& model = file.model;
  std::string text = Colours::of_out().paint(Paint::bold, printable(file.name)) +
                     fmt::format(": {} of {} at {:.6g} Hz\n", model.method, body_text(model.layout),
                                 model.rate_hz);
  text += fmt::format("  from {} ({:.1f} min) in {:.1f} s, {} kB\n", counted(model.takes, "take"),
                      model.seconds / 60, training_s, grouped((file.bytes + 999) / 1000));
  Table table({Align::left, Align::right}, 4);
  for (const auto& [name, value] : model.numbers)
    table.add({printable_name(name), fmt::format("{:.6g}", value)});
  return text + table.text();
}

/// The command for the card, without options that do not affect the model.
std::string command_text(const Arguments& arguments) {
  static constexpr std::array<std::string_view, 10> aside = {
      "force", "json", "quiet", "card", "title", "data", "licence", "figures", "jobs", "resume"};
  std::string text = "kinemend train";
  for (const Flag& flag : arguments.command->flags) {
    const std::string& name = flag.spec.name;
    if (std::find(aside.begin(), aside.end(), name) != aside.end()) continue;
    if (const auto list = arguments.lists.find(name); list != arguments.lists.end())
      text += fmt::format(" --{} {}", dashed(name),
                          shell_word(fmt::format("{}", fmt::join(list->second, ","))));
    const auto value = arguments.values.find(name);
    if (value == arguments.values.end()) continue;
    text += " --" + dashed(name);
    if (flag.takes != Takes::nothing) text += " " + shell_word(kinemend::to_string(value->second));
  }
  for (const auto& [name, given] : arguments.group_texts) {
    const bool is_switch = given == "true" || given == "false";
    text += is_switch ? fmt::format(" --{}{}", given == "true" ? "" : "no-", dashed(name))
                      : fmt::format(" --{} {}", dashed(name), shell_word(given));
  }
  constexpr std::size_t most = 8;
  const std::vector<std::string>& words = arguments.positionals;
  for (std::size_t i = 0; i < std::min(words.size(), most); ++i) text += " " + shell_word(words[i]);
  if (words.size() > most) text += fmt::format(" ... ({} more)", words.size() - most);
  return text;
}

std::vector<std::string> training_inputs_of(const Arguments& arguments) {
  std::vector<std::string> inputs(arguments.positionals.begin() + 1, arguments.positionals.end());
  if (const std::string list = arguments.text("list"); !list.empty()) {
    const std::vector<std::string> listed = listed_inputs(read_file(list), input_name(list));
    inputs.insert(inputs.end(), listed.begin(), listed.end());
  }
  if (inputs.empty())
    throw Error(ErrorKind::usage, "train: TAKE or --list is missing (see kinemend train -h)");
  return takes_below(inputs);
}

/// Finds the checkpoint file and, with --resume, reads it.
void find_checkpoint(const Arguments& arguments, TrainingRun& training) {
  const bool goes_on = arguments.flag("resume");
  std::error_code ignored;
  const bool is_device = std::filesystem::exists(training.output, ignored) &&
                         !std::filesystem::is_regular_file(training.output, ignored);
  if (training.output == "-" || is_device) {
    if (goes_on) throw Error(ErrorKind::usage, "train: --resume needs an --output that is a file");
    return;
  }
  training.checkpoint = training.output + ".checkpoint";
  const bool is_there = std::filesystem::exists(training.checkpoint);
  if (goes_on) {
    if (!is_there)
      throw Error(
          ErrorKind::unreadable_input,
          fmt::format("{}: no such checkpoint; leave out --resume to start the training anew",
                      training.checkpoint));
    training.settings.checkpoint.name = training.checkpoint;
    training.settings.checkpoint.start = read_file(training.checkpoint);
  } else if (is_there && !training.force) {
    throw Error(
        ErrorKind::cannot_write,
        fmt::format("{}: left by an unfinished training; --resume continues it, --force starts "
                    "anew",
                    training.checkpoint));
  }
}

TrainingRun training_of(const Arguments& arguments) {
  TrainingRun training;
  training.method = find_training(arguments.positionals.front()).name;
  training.options =
      parse_group_options(arguments.command->groups, training.method, arguments.group_texts);
  training.output = arguments.text("output");
  if (training.output.empty())
    throw Error(ErrorKind::usage, "train: --output is missing (see kinemend train -h)");
  training.card = arguments.text("card");
  training.force = arguments.flag("force");
  training.json = arguments.flag("json");
  training.quiet = arguments.flag("quiet");
  training.skip_unreadable = arguments.flag("skip_unreadable");
  check_free(training.output, training.force);
  if (!training.card.empty()) check_free(training.card, training.force);
  if (const std::string fill = arguments.text("fill"); fill != "off") training.fill = fill;
  training.reading = read_options(arguments);
  training.settings.names = joints_of(arguments);
  training.settings.seed = static_cast<std::uint64_t>(arguments.whole("seed"));
  const std::string command = arguments.text("command");
  training.settings.card = {
      arguments.text("title"), arguments.text("data"), arguments.text("licence"),
      command.empty() ? command_text(arguments) : command, arguments.text("figures")};
  training.takes = training_inputs_of(arguments);
  const std::string list = arguments.text("list");
  find_checkpoint(arguments, training);
  RunFiles files;
  files.reads("TAKE", training.takes)
      .reads("--list", list)
      .reads("--asf", arguments.text("asf"))
      .writes("--output", training.output)
      .writes("the checkpoint of --output", training.checkpoint)
      .writes("--card", training.card)
      .check(training.json);
  return training;
}

Json summary_json(const ModelFile& file, double training_s) {
  Json json = model_json(file);
  json.erase("input");
  Json summary = {{"kinemend", version()}, {"output", file.name}, {"training_s", training_s}};
  summary.update(json);
  return summary;
}

/// The command that continues this training.
std::string resuming_command(const Arguments& arguments) {
  std::vector<std::string> words = arguments.words;
  // Words after -- are not options.
  if (!arguments.flag("resume"))
    words.insert(std::find(words.begin(), words.end(), "--"), "--resume");
  return shell_line(words);
}

/// Tells the user how to continue a stopped training.
void say_stopped(const TrainingRun& training, const Arguments& arguments) {
  if (!training.checkpoint.empty() && std::filesystem::exists(training.checkpoint)) {
    write_err(fmt::format("stopped; the work so far is in {}; to continue:\n  {}\n",
                          printable(training.checkpoint), resuming_command(arguments)));
  } else {
    write_err("stopped before anything could be saved\n");
  }
}

void remove_checkpoint(const TrainingRun& training) {
  std::error_code ignored;
  if (!training.checkpoint.empty()) std::filesystem::remove(training.checkpoint, ignored);
}

Model trained_model(TrainingRun& training, ProgressLine& progress) {
  training.settings.progress = [&](std::string_view stage, double done) {
    if (platform::StopRequest::came()) throw TrainingStopped();
    if (!training.quiet) progress.show(stage, done);
  };
  TrainCheckpoint& checkpoint = training.settings.checkpoint;
  checkpoint.stop = platform::StopRequest::came;
  if (!training.checkpoint.empty()) {
    checkpoint.keep = [&](const std::string& bytes) {
      write_file(training.checkpoint, bytes, true);
      training.kept = true;
    };
  }
  return train_model(training.method, takes_of(training, progress), training.options,
                     training.settings);
}

int run_train(const Arguments& arguments) {
  TrainingRun training = training_of(arguments);
  std::optional<ThreadLimit> limit;
  if (const auto jobs = static_cast<std::size_t>(arguments.whole("jobs")); jobs > 0)
    limit.emplace(jobs);
  const auto begin = std::chrono::steady_clock::now();
  ProgressLine progress;
  const platform::StopRequest stop_request;
  Model model;
  try {
    model = trained_model(training, progress);
  } catch (const TrainingStopped&) {
    progress.clear();
    say_stopped(training, arguments);
    platform::StopRequest::obey();
  } catch (const Error& error) {
    // Takes and options that cannot give a model need no checkpoint; a model that could not be
    // written does.
    if (error.kind() == ErrorKind::usage && training.kept) remove_checkpoint(training);
    throw;
  }
  progress.clear();
  const std::string bytes = write_model(model);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;

  write_output(training.output, bytes, training.force);
  const ModelFile file = model_file_of(bytes, training.output);
  if (!training.card.empty()) write_output(training.card, card_markdown(file), training.force);
  remove_checkpoint(training);
  if (training.json) {
    write_out(json_text(summary_json(file, spent.count())));
  } else if (!training.quiet) {
    const std::string text = summary_text(file, spent.count());
    const bool out_is_taken = training.output == "-" || training.card == "-";
    out_is_taken ? write_err(text) : write_out(text);
  }
  return 0;
}

Flag train_fill_flag() {
  std::vector<std::string> names = {"off"};
  for (const FillMethod& method : fill_methods()) {
    if (!method.learned) names.emplace_back(method.name);
  }
  Flag flag = choice_flag("fill", "Work", "fill gaps in the takes first", std::move(names), "auto",
                          "Gaps that the method refuses stay open and are not learned from.");
  flag.value_name = "METHOD";
  return flag;
}

std::vector<Flag> train_flags() {
  Flag card = file_flag("card", "FILE", "Output", "also write the card of the model, as Markdown");
  std::vector<Flag> joints =
      joints_flags("Work", "joints or markers to learn (default: joints that move)");
  std::vector<Flag> all = {
      output_flag("where to write the model; - is standard output"),
      force_flag(),
      card,
      json_flag("print the summary as JSON instead of text"),
      quiet_flag(),
      std::move(joints[0]),
      std::move(joints[1]),
      train_fill_flag(),
      seed_flag("seed of the random number generator"),
      jobs_flag(),
      text_flag("title", "TEXT", "Card", "title of the model, one line"),
      text_flag("data", "TEXT", "Card", "training data"),
      text_flag("licence", "TEXT", "Card", "licence of data and model"),
      text_flag("command", "TEXT", "Card", "command that made the model (default: this one)"),
      text_flag("figures", "TEXT", "Card", "measured quality"),
      list_flag(),
      switch_flag("skip_unreadable", "Input", "skip takes that cannot be read",
                  "Without it the first such take ends the training, with exit code 3."),
      switch_flag("resume", "Output", "continue a training that was stopped",
                  "Reads the checkpoint beside the output. Use the same takes and options; the "
                  "result has the same bytes as without the stop. Takes are read again.")};
  append(all, reading_flags());
  return all;
}

std::vector<std::string> train_method_names() {
  std::vector<std::string> names;
  for (const Training& method : trainings()) names.push_back(method.name);
  return names;
}

}  // namespace

Command train_command() {
  Command command;
  command.name = "train";
  command.summary = "learn a model from clean takes";
  command.description =
      "Learns from clean takes how people move, for methods that need a model (kinemend clean "
      "--method METHOD --model FILE). Give takes of joints or takes of markers, not both. Bodies "
      "may "
      "differ in size and in the names of their parts. Calibration frames are skipped.\n\n"
      "Each take is read once. Training data is kept in memory up to half a gigabyte, and beyond "
      "that "
      "in the temporary folder (TMPDIR). The same takes and options give the same bytes. During "
      "the "
      "training, FILE.checkpoint beside the output saves the work so far. Ctrl-C keeps it and "
      "prints "
      "the command that continues.";
  command.positionals = {
      {"METHOD", "method to train a model for, see below", 1, 1, train_method_names()},
      {"TAKE", "take, or folder with takes", 0, 1000000, {}}};
  command.flags = train_flags();
  for (const Training& method : trainings())
    command.groups.push_back({method.name, method.summary, "", method.options});
  command.group_heading = "Options of %";
  command.groups_are_flags = true;
  command.examples = {
      {"kinemend train example walks/*.bvh -o walk.kmodel", "learn filter bases from some walks"},
      {"kinemend train wiener takes -o mine.kmodel --card mine.md --licence CC0",
       "learn from all takes in a folder"},
      {"kinemend clean noisy.bvh --method example --model walk.kmodel", "use the model"}};
  command.run = run_train;
  return command;
}

}  // namespace kinemend::cli
