// Converts samples to network inputs, draws the next batch during each step, and builds the model.
#include "motion_training.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "checkpoint.hpp"
#include "methods/learned/learned_live.hpp"
#include "methods/learned/motion_network.hpp"
#include "network_model.hpp"

namespace kinemend::train {

namespace {

MotionShape with_slots(MotionShape shape, const TrainingSequences& sequences) {
  shape.slots = sequences.layout.channel_count();
  return shape;
}

double rate_at(std::size_t batch, const MotionTraining& settings) {
  constexpr double warm_up = 200, least = 0.01;
  return cosine_rate(batch, settings.batches, warm_up, settings.rate, least);
}

void append(std::vector<float>& all, const std::vector<float>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

// A sample as network input, with features of the take at every step.
struct ReadSample {
  MotionSteps steps;
  std::vector<std::uint8_t> is_alive;
};

ReadSample read_whole(const MotionTake& take, std::size_t steps) {
  const MotionReader reader(take);
  ReadSample read{reader.steps(0, steps), reader.strengths().is_alive};
  const std::vector<float> of_take = std::move(read.steps.take_features);
  read.steps.take_features.clear();
  for (std::size_t c = 0; c < take.channels; ++c) {
    const auto own = of_take.begin() + static_cast<std::ptrdiff_t>(c * motion_take_features);
    for (std::size_t s = 0; s < steps; ++s)
      read.steps.take_features.insert(read.steps.take_features.end(), own,
                                      own + motion_take_features);
  }
  return read;
}

ReadSample read_live(const MotionTake& take, std::size_t steps) {
  LiveMotionSteps live(take.frame_rate_hz, take.is_position, take.expects_slow_noise);
  ReadSample read;
  read.steps.resize(take.channels, steps);
  read.steps.take_features.resize(take.channels * steps * motion_take_features);
  MotionSteps step;
  std::size_t done = 0;
  const auto put = [&](const std::vector<float>& from, std::vector<float>& to) {
    const std::size_t width = from.size() / take.channels;
    for (std::size_t c = 0; c < take.channels; ++c)
      std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(c * width), width,
                  to.begin() + static_cast<std::ptrdiff_t>((c * steps + done) * width));
  };
  const auto take_steps = [&] {
    while (done < steps && live.next_step(step)) {
      put(step.features, read.steps.features);
      put(step.take_features, read.steps.take_features);
      put(step.levels, read.steps.levels);
      put(step.changes, read.steps.changes);
      put(step.scales, read.steps.scales);
      ++done;
    }
  };
  const std::span<const float> values(take.values);
  const std::span<const std::uint8_t> missing(take.missing);
  for (std::size_t f = 0; f < take.frames; ++f) {
    const std::size_t at = f * take.channels;
    live.push(values.subspan(at, take.channels),
              missing.empty() ? missing : missing.subspan(at, take.channels));
    take_steps();
  }
  live.end();
  take_steps();
  read.is_alive = live.is_alive();
  return read;
}

}  // namespace

MotionBatch batch_of(const std::vector<MotionSample>& samples, std::size_t steps) {
  MotionBatch batch;
  batch.samples = samples.size();
  batch.channels = samples.front().take.channels;
  batch.steps = steps;
  for (const MotionSample& sample : samples) {
    const MotionTake& take = sample.take;
    const ReadSample read = sample.is_live ? read_live(take, steps) : read_whole(take, steps);
    append(batch.features, read.steps.features);
    append(batch.take_features, read.steps.take_features);
    append(batch.levels, read.steps.levels);
    append(batch.changes, read.steps.changes);
    append(batch.scales, read.steps.scales);
    batch.looks_ahead.push_back(sample.is_live ? 0.0F : 1.0F);
    const auto speed = static_cast<float>(take.frame_rate_hz / 120);
    for (std::size_t c = 0; c < take.channels; ++c) {
      batch.alive.push_back(read.is_alive[c] != 0 ? 1.0F : 0.0F);
      batch.known.push_back(take.slots[c] >= 0 ? 1.0F : 0.0F);
      for (std::size_t s = 0; s < steps; ++s) {
        const std::size_t frame = take.frame_of_step(s),
                          next = std::min(frame + 1, take.frames - 1);
        const float value = sample.truth[frame * take.channels + c];
        batch.truth.push_back(value);
        batch.truth_changes.push_back(speed * (sample.truth[next * take.channels + c] - value));
      }
    }
  }
  return batch;
}

MotionTrainer::MotionTrainer(const TrainingSequences& sequences, std::vector<MotionPair> pairs,
                             std::vector<MarkerMotion> markers, std::vector<RigMotion> rigs,
                             const MotionTraining& settings)
    : sequences_(sequences),
      pairs_(std::move(pairs)),
      markers_(std::move(markers)),
      rigs_(std::move(rigs)),
      settings_(settings),
      statistics_(motion_statistics(sequences)),
      mirror_(mirror_of(sequences.layout)),
      descent_(with_slots(settings.shape, sequences), statistics_.mean, statistics_.deviation,
               statistics_.speed, settings.descent, settings.seed) {}

MotionTrainer::~MotionTrainer() = default;

MotionBatch MotionTrainer::drawn(std::size_t batch) const {
  std::vector<MotionSample> samples;
  const Random random = Random(settings_.seed).fork(batch);
  for (std::size_t i = 0; i < settings_.batch; ++i)
    samples.push_back(random_motion_sample({sequences_, mirror_, pairs_, markers_, rigs_},
                                           settings_.sampling, random.fork(i)));
  return batch_of(samples, settings_.sampling.steps);
}

double MotionTrainer::step() {
  const MotionBatch batch = next_.valid() && next_number_ == batch_ ? next_.get() : drawn(batch_);
  next_number_ = batch_ + 1;
  if (next_number_ < settings_.batches)
    next_ = std::async(std::launch::async, [this, number = next_number_] { return drawn(number); });
  const double loss = descent_.step(batch, settings_.loss, rate_at(batch_, settings_), batch_);
  ++batch_;
  return loss;
}

double MotionTrainer::share_left(const MotionSources& sources, const MotionSampling& sampling,
                                 std::size_t samples, std::uint64_t seed) const {
  double sum = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    const MotionSample sample = random_motion_sample(sources, sampling, Random(seed).fork(i));
    sum += descent_.share_left(batch_of({sample}, sampling.steps), settings_.loss);
  }
  return sum / static_cast<double>(samples);
}

Model MotionTrainer::model() const {
  Model model;
  model.method = "learned";
  model.rate_hz = sequences_.rate_hz;
  model.layout = sequences_.layout;
  const MotionShape& shape = settings_.shape;
  model.numbers["second_encoder.dilation"] = static_cast<double>(shape.second_dilation);
  put_dilations(shape.dilations, model);
  put_weights(descent_.averages(), model);
  put_numbers("mean", statistics_.mean, model);
  put_numbers("deviation", statistics_.deviation, model);
  put_numbers("speed", statistics_.speed, model);
  return model;
}

std::string MotionTrainer::checkpoint() const {
  return write_checkpoint(descent_.state(), batch_, settings_.seed);
}

void MotionTrainer::resume(std::string_view bytes, std::string_view name) {
  const Checkpoint kept = read_checkpoint(bytes, name, settings_.seed);
  descent_.set_state(kept.state);
  batch_ = kept.batch;
}

}  // namespace kinemend::train
