// The options, files and training loop shared by the training programs.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "kinemend/extend/model.hpp"
#include "kinemend/lab/train.hpp"
#include "lab/training/training_sequences.hpp"
#include "sequence_network.hpp"

namespace kinemend::train {

/// The non-empty lines of a file. Errors: `ErrorKind::unreadable_input`.
std::vector<std::string> lines_of(const std::string& path);
/// Writes a temporary file and renames it, so that a killed run leaves the old file or the new one.
/// Errors: `ErrorKind::cannot_write`.
void write_file(const std::string& path, const std::string& bytes);

/// Inputs, outputs and reporting interval of a run.
struct Run {
  std::vector<std::string> takes;
  std::string list;        ///< file with further takes, one a line
  std::string validation;  ///< file with takes, one a line; empty: none
  std::string output, checkpoint;
  bool resume = false;
  double report_s = 60;
  ModelCard card;

  std::vector<std::string> paths() const;  ///< paths of all takes
};

void add_run_options(CLI::App& app, Run& run, DescentSettings& descent);
/// Parses the command line. Returns false with the exit code if the program should end now. Errors:
/// `ErrorKind::usage` for `--resume` without a checkpoint.
bool parse(CLI::App& app, int count, char** values, const Run& run, int& exit_code);

TrainingTakes takes_of(const std::vector<std::string>& paths);
/// Saves the checkpoint, if wanted, and the model with the card of the run and, if `sequences` are
/// given, the amount of training data.
void save(const Run& run, const std::string& checkpoint, Model model,
          const TrainingSequences* sequences = nullptr);

/// A training, step by step.
struct Steps {
  std::size_t first = 0, last = 0;  ///< batches done before, and at the end
  double memory = 0;                ///< decay of the running mean of the loss per step
  std::function<double()> step;     ///< returns the loss
  std::function<std::string()> validation;
  std::function<void()> save;  ///< saves checkpoint and model
};

/// Runs the steps; every `report_s` seconds and at the end it prints the loss and the remaining
/// time, and saves. Without a step to do, it saves once more with the current card.
void run_steps(const Steps& steps, double report_s);

/// `kinemend-train paper ...`: trains the networks of Mall et al. 2017. Returns the exit code.
int paper_program(int count, char** values);

}  // namespace kinemend::train
