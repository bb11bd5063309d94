// Reads lists of takes, parses the shared options, and saves the model and the checkpoint at
// intervals.
#include "program.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "kinemend/error.hpp"
#include "kinemend/io.hpp"

namespace kinemend::train {

std::vector<std::string> lines_of(const std::string& path) {
  std::vector<std::string> lines;
  std::ifstream file(path);
  if (!file) throw Error(ErrorKind::unreadable_input, path + ": cannot be read");
  for (std::string line; std::getline(file, line);) {
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

void write_file(const std::string& path, const std::string& bytes) {
  const std::string part = path + ".part";
  {
    std::ofstream file(part, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) throw Error(ErrorKind::cannot_write, path + ": cannot be written");
  }
  std::filesystem::rename(part, path);
}

std::vector<std::string> Run::paths() const {
  std::vector<std::string> all = takes;
  if (list.empty()) return all;
  const std::vector<std::string> more = lines_of(list);
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

void add_run_options(CLI::App& app, Run& run, DescentSettings& descent) {
  app.add_option("takes", run.takes, "clean takes");
  app.add_option("--list", run.list, "file with further takes, one a line");
  app.add_option("--validate", run.validation,
                 "file with takes, one a line, to measure the model on as training goes on");
  app.add_option("-o,--output", run.output, "the model")->required();
  app.add_option("--checkpoint", run.checkpoint, "file to go on from");
  app.add_flag("--resume", run.resume, "goes on from the checkpoint, to the same result");
  app.add_option("--dropout", descent.dropout, "of what the layers in time see")
      ->capture_default_str();
  app.add_option("--weight-decay", descent.weight_decay)->capture_default_str();
  app.add_option("--average", descent.average_decay, "of the running mean of the weights")
      ->capture_default_str();
  app.add_option("--report-s", run.report_s, "seconds between reports")->capture_default_str();
  app.add_option("--title", run.card.title, "of the card");
  app.add_option("--data", run.card.data, "of the card");
  app.add_option("--licence", run.card.licence, "of the card");
  app.add_option("--command", run.card.command, "of the card");
  app.add_option("--figures", run.card.figures, "of the card");
}

bool parse(CLI::App& app, int count, char** values, const Run& run, int& exit_code) {
  try {
    app.parse(count, values);
  } catch (const CLI::ParseError& answer) {
    exit_code = app.exit(answer);
    return false;
  }
  if (run.resume && run.checkpoint.empty())
    throw Error(ErrorKind::usage, "--resume wants --checkpoint");
  return true;
}

TrainingTakes takes_of(const std::vector<std::string>& paths) {
  return {paths.size(),
          [paths](std::size_t i) -> std::optional<Take> { return read_joints(paths[i]).take; }};
}

void save(const Run& run, const std::string& checkpoint, Model model,
          const TrainingSequences* sequences) {
  if (!run.checkpoint.empty()) write_file(run.checkpoint, checkpoint);
  model.card = run.card;
  if (sequences) {
    model.takes = sequences->takes;
    for (const TrainingSequences::Entry& entry : sequences->entries)
      model.seconds += entry.weight * static_cast<double>(entry.frames) / sequences->rate_hz;
  }
  write_file(run.output, write_model(model));
}

void run_steps(const Steps& steps, double report_s) {
  using clock = std::chrono::steady_clock;
  const clock::time_point start = clock::now();
  double loss = 0, weight = 0, reported_s = 0;
  for (std::size_t batch = steps.first; batch < steps.last;) {
    loss = steps.memory * loss + (1 - steps.memory) * steps.step();
    weight = steps.memory * weight + (1 - steps.memory);
    ++batch;
    const double now_s = std::chrono::duration<double>(clock::now() - start).count();
    if (batch < steps.last && now_s - reported_s < report_s) continue;
    reported_s = now_s;
    const double each = now_s / static_cast<double>(batch - steps.first);
    fmt::print("{} of {}  loss {:.4f}  {:.0f} s, {:.0f} s left{}\n", batch, steps.last,
               loss / weight, now_s, each * static_cast<double>(steps.last - batch),
               steps.validation());
    std::fflush(stdout);
    steps.save();
  }
  if (steps.first >= steps.last) steps.save();
}

}  // namespace kinemend::train
