#include "recurrent_training.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "checkpoint.hpp"
#include "kinemend/error.hpp"
#include "network_model.hpp"

namespace kinemend::train {

namespace {

constexpr double least_error_deg = 0.03;  // errors below count for less
constexpr double share_of_missing = 0.3;

// Of the observed and of the missing samples.
struct Sums {
  double error = 0, before = 0, count = 0;
};

// Calls `use(i, is_marked)` for the channels of tracks that were ever seen.
template <class Use>
void for_each_seen(const RecurrentTake& take, const Use& use) {
  const std::size_t tracks = take.channels / 3;
  std::vector<std::uint8_t> seen(tracks, 0);
  for (std::size_t i = 0; i < take.marks.size(); ++i) {
    if (take.marks[i] == 0) seen[i % tracks] = 1;
  }
  for (std::size_t f = 0; f < take.frames; ++f) {
    for (std::size_t n = 0; n < tracks; ++n) {
      if (seen[n] == 0) continue;
      const bool is_marked = take.marks[f * tracks + n] != 0;
      for (std::size_t axis = 0; axis < 3; ++axis) use(f * take.channels + 3 * n + axis, is_marked);
    }
  }
}

// The loss of a correction, and its derivative.
double loss_of(const RecurrentSample& sample, const std::vector<float>& correction,
               std::vector<float>& derivative) {
  Sums sums[2];
  const auto errors = [&](std::size_t i) {
    const double before = static_cast<double>(sample.take.automatic[i] - sample.truth[i]);
    return std::pair(before, before + static_cast<double>(correction[i]));
  };
  for_each_seen(sample.take, [&](std::size_t i, bool is_marked) {
    const auto [before, after] = errors(i);
    Sums& sum = sums[is_marked ? 1 : 0];
    sum.error += after * after;
    sum.before += before * before;
    sum.count += 1;
  });
  const double all = sums[0].count + sums[1].count;
  double loss = 0, weights[2] = {};
  for (int part = 0; part < 2; ++part) {
    if (sums[part].count == 0) continue;
    const double share = part == 0 ? 1 : share_of_missing * std::min(1.0, 50 * sums[1].count / all);
    weights[part] =
        share / (sums[part].before + sums[part].count * least_error_deg * least_error_deg);
    loss += weights[part] * sums[part].error;
  }
  derivative.assign(correction.size(), 0.0F);
  for_each_seen(sample.take, [&](std::size_t i, bool is_marked) {
    derivative[i] = static_cast<float>(2 * weights[is_marked ? 1 : 0] * errors(i).second);
  });
  return loss;
}

ConvolutionalShape shape_of(const TrainingSequences& sequences, const RecurrentTraining& training) {
  const std::size_t channels = sequences.layout.channel_count();
  return {recurrent_feature_count(channels), training.hidden, recurrent_output_count(channels),
          training.dilations};
}

double rate_at(std::size_t batch, const RecurrentTraining& settings) {
  constexpr double warm_up = 200, least = 0.02;
  return cosine_rate(batch, settings.batches, warm_up, settings.rate, least);
}

std::uint64_t number_of(std::size_t batch, std::size_t index) {
  return (static_cast<std::uint64_t>(batch) << 8) + index;
}

}  // namespace

RecurrentTrainer::RecurrentTrainer(const TrainingSequences& sequences,
                                   const RecurrentTraining& settings)
    : sequences_(sequences),
      settings_(settings),
      statistics_(recurrent_statistics(sequences)),
      mirror_(mirror_of(sequences.layout)),
      network_(shape_of(sequences, settings), settings.descent, settings.seed) {}

void RecurrentTrainer::fill_pool(std::size_t round) {
  if (pool_round_ == round + 1) return;
  pool_.assign(settings_.pool, {});
  const Random random = Random(settings_.seed).fork(1 + round);
  // One after another: `auto` has threads of its own, and memory for each sample at work.
  for (std::size_t i = 0; i < settings_.pool; ++i)
    pool_[i] = random_recurrent_sample(sequences_, settings_.frames, random.fork(i));
  pool_round_ = round + 1;
}

double RecurrentTrainer::step() {
  const std::size_t batches_a_round = settings_.pool * settings_.uses / settings_.batch;
  const std::size_t round = batch_ / batches_a_round;
  fill_pool(round);
  // All samples of the pool once in each of their forms, in an order of the round's own.
  std::vector<std::size_t> order(settings_.pool * settings_.uses);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random shuffle = Random(settings_.seed ^ 0x5eed).fork(round);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[shuffle.below(i)]);
  double loss = 0;
  for (std::size_t i = 0; i < settings_.batch; ++i) {
    const std::size_t at = (batch_ % batches_a_round) * settings_.batch + i;
    const std::size_t form = order[at] / settings_.pool;
    RecurrentSample chosen =
        in_form(pool_[order[at] % settings_.pool], {form % 2 == 1, form / 2 % 2 == 1}, mirror_);
    if (settings_.offset_deg > 0 || settings_.most_scale > 1)
      chosen = of_another_body(std::move(chosen), settings_.offset_deg, settings_.most_scale,
                               Random(settings_.seed ^ 0xb0d1e5).fork(number_of(batch_, i)));
    const RecurrentInput input = recurrent_input(chosen.take, statistics_);
    const std::vector<float> outputs = network_.forward(input.features, number_of(batch_, i));
    std::vector<float> correction(chosen.truth.size()), derivative;
    recurrent_correction(input, outputs, correction);
    loss += loss_of(chosen, correction, derivative);
    for (float& value : derivative) value /= static_cast<float>(settings_.batch);
    std::vector<float> gradient(outputs.size());
    recurrent_correction_adjoint(input, derivative, gradient);
    network_.add_gradient(gradient);
  }
  network_.step(rate_at(batch_, settings_));
  ++batch_;
  return loss / static_cast<double>(settings_.batch);
}

double RecurrentTrainer::share_left(const RecurrentSample& sample) const {
  const RecurrentInput input = recurrent_input(sample.take, statistics_);
  const std::vector<float> outputs = network_.run(input.features);
  std::vector<float> correction(sample.truth.size());
  recurrent_correction(input, outputs, correction);
  double before = 0, after = 0;
  for_each_seen(sample.take, [&](std::size_t i, bool) {
    const double error = static_cast<double>(sample.take.automatic[i] - sample.truth[i]);
    before += error * error;
    after += std::pow(error + static_cast<double>(correction[i]), 2);
  });
  return before > 0 ? std::sqrt(after / before) : 1;
}

Model RecurrentTrainer::model() const {
  Model model;
  model.method = "recurrent";
  model.rate_hz = sequences_.rate_hz;
  model.layout = sequences_.layout;
  put_dilations(settings_.dilations, model);
  put_weights(network_.averages(), model);
  put_numbers("mean", statistics_.mean, model);
  put_numbers("deviation", statistics_.deviation, model);
  put_numbers("speed", statistics_.speed, model);
  return model;
}

std::string RecurrentTrainer::checkpoint() const {
  return write_checkpoint(network_.state(), batch_, settings_.seed);
}

void RecurrentTrainer::resume(std::string_view bytes, std::string_view name) {
  const Checkpoint kept = read_checkpoint(bytes, name, settings_.seed);
  network_.set_state(kept.state);
  batch_ = kept.batch;
}

}  // namespace kinemend::train
