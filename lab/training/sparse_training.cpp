// Trains the method `sparse`: the options of the training, its windows, and a dictionary for each
// part.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/files.hpp"
#include "base/parallel.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/random.hpp"
#include "lab/training/training_sequences.hpp"
#include "lab/training/training_stages.hpp"
#include "lab/training/trainings.hpp"
#include "models/model_reading.hpp"
#include "papers/xiao2015_sparse/dictionary.hpp"
#include "papers/xiao2015_sparse/sparse_prior.hpp"

namespace kinemend {

namespace {

struct SparseTraining {
  double rate_hz = 60;
  std::int64_t window_frames = 15;
  std::int64_t atoms = 500;
  std::int64_t sparsity = 10;
  std::int64_t iterations = 10;
  std::int64_t windows = 20'000;
  std::string poselets;
  bool whole = false;
  bool local = false;
};

// Values of a window; limits memory. Chosen by hand.
constexpr std::size_t largest_poselet_window = 16'384;
// Each atom needs several windows that share it. Chosen by hand, not swept.
constexpr std::size_t least_windows_per_atom = 4;

const OptionTable<SparseTraining>& sparse_training_table() {
  static const auto options =
      OptionTable<SparseTraining>()
          .number(&SparseTraining::rate_hz, "rate_hz", "Hz", 5, 500,
                  "rate of the model; takes at other rates are brought to it")
          .integer(&SparseTraining::window_frames, "window_frames", "", 2, 500,
                   "M: frames of a window, at the model's rate")
          .integer(&SparseTraining::atoms, "atoms", "", 1, 10'000,
                   "K: atoms of each dictionary, at most one for four windows")
          .integer(&SparseTraining::sparsity, "sparsity", "", 1, 200,
                   "T: atoms of a window in training")
          .integer(&SparseTraining::iterations, "iterations", "", 1, 1000,
                   "of coding and updating the atoms")
          .integer(&SparseTraining::windows, "windows", "", 1, 1e6,
                   "windows that the atoms are learned from, drawn from all")
          .text(
              &SparseTraining::poselets, "poselets",
              "file of poselets, a line each: \"left arm: LeftShoulder, LeftArm*\"; empty: torso, "
              "arms and legs by the body's names")
          .flag(&SparseTraining::whole, "whole",
                "one dictionary of the whole body instead of one a poselet")
          .flag(&SparseTraining::local, "local",
                "the paper's local coordinates, by hips and neck of each frame; off: the smooth "
                "frame of the body");
  return options;
}

// The same takes; the middle frame of each that is read is also kept in `frames`.
TrainingTakes keeping_frames(const TrainingTakes& takes, std::vector<Take>& frames) {
  return {takes.count, [&takes, &frames](std::size_t index) {
            auto take = takes.take(index);
            if (take && take->has_joints() && take->frame_count() > 0) {
              const std::size_t middle = take->frame_count() / 2;
              frames.push_back(slice(*take, middle, middle + 1));
            }
            return take;
          }};
}

SparsePoints points_for(const BodyLayout& layout, const std::vector<Take>& frames) {
  if (layout.kind == BodyKind::markers) return marker_points(layout);
  SparsePointsBuilder builder(layout);
  for (const Take& clip : frames) builder.add(clip);
  return builder.finish();
}

// At most `count` ascending window numbers below `all`, drawn one from each stretch of them.
std::vector<std::size_t> drawn(std::size_t all, std::size_t count, std::uint64_t seed) {
  count = std::min(all, count);
  Random random(seed);
  std::vector<std::size_t> numbers(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = i * all / count, last = (i + 1) * all / count;
    numbers[i] = first + random.below(last - first);
  }
  return numbers;
}

// Windows of every poselet: W x M x 3 n each.
class WindowSample {
 public:
  WindowSample(const SparsePrior& prior, std::vector<std::size_t> numbers)
      : prior_(prior), numbers_(std::move(numbers)), values_(prior.poselets.size()) {}

  void add(const PoseMatrix& channels, const BodyLayout& layout) {
    const std::size_t window = prior_.window_frames;
    if (channels.frames < window) return;
    const std::size_t end = seen_ + channels.frames - window + 1;
    PoseMatrix positions;
    for (; next_ < numbers_.size() && numbers_[next_] < end; ++next_) {
      if (positions.frames == 0) {
        positions = points_of(prior_.points, layout, channels);
        to_local(local_frames(positions, prior_.local), positions);
      }
      for (std::size_t i = 0; i < values_.size(); ++i)
        append(positions, numbers_[next_] - seen_, prior_.poselets[i], values_[i]);
    }
    seen_ = end;
  }

  // Subtracts the mean of poselet `i` from its windows and returns it.
  std::vector<float> take_mean(std::size_t i) {
    const std::size_t channels = prior_.poselets[i].channels();
    std::vector<double> sums(channels, 0);
    for (std::size_t v = 0; v < values_[i].size(); ++v)
      sums[v % channels] += static_cast<double>(values_[i][v]);
    std::vector<float> mean(channels);
    const std::size_t frames = values_[i].size() / channels;
    const auto count = static_cast<double>(frames);
    for (std::size_t c = 0; c < channels; ++c)
      mean[c] = static_cast<float>(sums[c] / std::max(count, 1.0));
    for (std::size_t v = 0; v < values_[i].size(); ++v) values_[i][v] -= mean[v % channels];
    return mean;
  }

  const std::vector<float>& values(std::size_t i) const { return values_[i]; }

 private:
  void append(const PoseMatrix& positions, std::size_t first, const SparsePoselet& poselet,
              std::vector<float>& values) const {
    for (std::size_t f = first; f < first + prior_.window_frames; ++f) {
      for (const std::int32_t point : poselet.points) {
        for (std::size_t axis = 0; axis < 3; ++axis)
          values.push_back(
              static_cast<float>(positions(f, 3 * static_cast<std::size_t>(point) + axis)));
      }
    }
  }

  const SparsePrior& prior_;
  std::vector<std::size_t> numbers_;
  std::vector<std::vector<float>> values_;
  std::size_t seen_ = 0, next_ = 0;  // windows passed, and numbers used
};

std::size_t window_count(const TrainingSequences& sequences, std::size_t window) {
  std::size_t count = 0;
  for (const TrainingSequences::Entry& entry : sequences.entries)
    count += entry.frames < window ? 0 : entry.frames - window + 1;
  return count;
}

std::string stored(const sparse::KsvdState& state) {
  StageWriter writer;
  writer.value(state.dictionary.rows);
  writer.value(state.dictionary.atoms);
  writer.values(state.dictionary.values);
  writer.value(state.codes.most);
  writer.values(state.codes.counts);
  writer.values(state.codes.atoms);
  writer.values(state.codes.values);
  writer.values(state.left);
  writer.values(state.objective);
  return writer.take();
}

// The stored state; none if `bytes` is empty.
std::optional<sparse::KsvdState> restored(std::string_view bytes, std::size_t signal_values,
                                          std::size_t rows) {
  if (bytes.empty()) return {};
  sparse::KsvdState state;
  StageReader reader(bytes);
  state.dictionary.rows = reader.value<std::size_t>();
  state.dictionary.atoms = reader.value<std::size_t>();
  state.dictionary.values = reader.values<float>();
  state.codes.most = reader.value<std::size_t>();
  state.codes.counts = reader.values<std::uint32_t>();
  state.codes.atoms = reader.values<std::uint32_t>();
  state.codes.values = reader.values<float>();
  state.left = reader.values<float>();
  state.objective = reader.values<double>();
  reader.end();
  const std::size_t slots = state.codes.counts.size() * state.codes.most;
  reader.expect(state.dictionary.rows == rows &&
                state.dictionary.values.size() == state.dictionary.atoms * rows &&
                state.codes.counts.size() * rows == signal_values &&
                state.codes.atoms.size() == slots && state.codes.values.size() == slots &&
                state.left.size() == signal_values);
  for (const std::uint32_t count : state.codes.counts) reader.expect(count <= state.codes.most);
  for (const std::uint32_t atom : state.codes.atoms)
    reader.expect(atom < state.dictionary.atoms || state.dictionary.atoms == 0);
  return state;
}

void learn_dictionaries(const SparseTraining& options, std::size_t windows,
                        const TrainSettings& settings, WindowSample& sample, SparsePrior& prior) {
  const std::size_t most_atoms = std::max<std::size_t>(1, windows / least_windows_per_atom);
  TrainingStages& stages = *settings.stages;
  for_each_parallel(prior.poselets.size(), sample.values(0).size(), [&](std::size_t i) {
    SparsePoselet& poselet = prior.poselets[i];
    poselet.mean = sample.take_mean(i);
    sparse::KsvdSettings learning;
    learning.atoms = std::min(static_cast<std::size_t>(options.atoms), most_atoms);
    learning.sparsity = static_cast<std::size_t>(options.sparsity);
    learning.iterations = static_cast<std::size_t>(options.iterations);
    learning.seed = settings.seed + i;
    const std::size_t rows = prior.window_frames * poselet.channels();
    const std::string stage = "dictionary of " + poselet.name;
    const std::optional<sparse::KsvdState> start =
        restored(stages.kept(stage), sample.values(i).size(), rows);
    const auto keep = [&](const sparse::KsvdState& state) {
      // If another poselet has failed, the last step of this one is incomplete.
      if (work_is_cancelled()) return false;
      if (state.objective.size() == learning.iterations || stages.is_due(stage))
        stages.keep(stage, stored(state));
      return !stages.is_stopping();
    };
    poselet.dictionary =
        sparse::ksvd(sample.values(i), rows, learning, keep, start ? &*start : nullptr).dictionary;
  });
  stages.stop_if_asked();
}

// `text`: the content of the file of poselets.
std::vector<SparsePoselet> poselets_for(const SparseTraining& options, const std::string& text,
                                        const BodyLayout& layout, const SparsePoints& points) {
  if (options.poselets.empty()) return find_poselets(layout, points, options.whole);
  return parse_poselets(text, options.poselets, layout, points);
}

Model train_sparse(const TrainingTakes& takes, const OptionValues& values,
                   const TrainSettings& settings) {
  const SparseTraining options = sparse_training_table().parse(values);
  if (options.whole && !options.poselets.empty())
    throw Error(ErrorKind::usage, "poselets, whole: one or the other");
  const std::string poselet_text =
      options.poselets.empty() ? std::string() : file_bytes(options.poselets);
  settings.stages->see(poselet_text);
  std::vector<Take> frames;
  const TrainingSequences sequences =
      encode_takes(keeping_frames(takes, frames), settings, options.rate_hz);
  Model model;
  model.layout = sequences.layout;
  model.takes = sequences.takes;
  SparsePrior prior;
  prior.rate_hz = options.rate_hz;
  prior.window_frames = static_cast<std::size_t>(options.window_frames);
  prior.points = points_for(model.layout, frames);
  if (options.local) prior.local = find_local_points(model.layout);
  prior.poselets = poselets_for(options, poselet_text, model.layout, prior.points);
  const std::size_t window = prior.window_frames, all = window_count(sequences, window);
  if (all == 0) {
    throw Error(ErrorKind::usage, "no take has a stretch without gaps of " +
                                      std::to_string(window) + " frames, which is a window");
  }
  for (const SparsePoselet& poselet : prior.poselets) {
    if (window * poselet.channels() > largest_poselet_window)
      throw Error(ErrorKind::usage, "window_frames: a window of the " + poselet.name +
                                        " has more than " + std::to_string(largest_poselet_window) +
                                        " values; take a shorter window");
  }
  const std::vector<std::size_t> numbers =
      drawn(all, static_cast<std::size_t>(options.windows), settings.seed);
  WindowSample sample(prior, numbers);
  model.seconds = for_each_sequence(
      sequences, window, settings,
      [&](const TrainingSequence& sequence) { sample.add(sequence.poses, model.layout); });
  learn_dictionaries(options, numbers.size(), settings, sample, prior);
  for (const SparsePoselet& poselet : prior.poselets) {
    if (poselet.dictionary.atoms == 0)
      throw Error(ErrorKind::usage, "nothing moves in these takes");
  }
  store_sparse_prior(prior, model);
  return model;
}

}  // namespace

Training sparse_training() {
  return {"sparse", sparse_models.version,
          "dictionaries of poselets by K-SVD (Xiao et al. 2015, section 3.2)",
          sparse_training_table().specs(), train_sparse};
}

}  // namespace kinemend
