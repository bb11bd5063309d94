// Damages takes, cuts chunks, computes errors and gradients, and puts the trained network into a
// model.
#include "filter_training.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "checkpoint.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/signal.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "network_model.hpp"

namespace kinemend::train {

namespace {

constexpr double gaussian_s = 0.058;  // the paper's first baseline
// Smaller errors have less weight: straight lines within a degree need no network.
constexpr double least_error_deg = 0.03, least_gap_error_deg = 1;

FilterHead head_of(const std::string& name) {
  const std::vector<std::string> names{"gaussian", "biased", "shape", "residual", "pose"};
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw Error(ErrorKind::usage, "head " + name + ": gaussian, biased, shape, residual or pose");
  return static_cast<FilterHead>(found - names.begin());
}

BidirectionalShape shape_of(const std::string& kind, FilterHead head, std::size_t channels,
                            FilterInputs inputs) {
  BidirectionalShape shape;
  shape.inputs = filter_feature_count(channels, inputs);
  shape.outputs = filter_output_count(head, channels);
  if (kind == "bf") {
    shape.encoder.clear();
  } else if (kind == "nn") {
    shape.encoder.clear();
    shape.layers = 0;
    shape.decoder = {256, 192, 192, 160, 128};
    shape.reach = predicted_filter_reach;
  } else if (kind == "ebd") {
    shape.units = 32;
    shape.decoder = {96, 96, 96};
  } else if (kind != "ebf") {
    throw Error(ErrorKind::usage, "network " + kind + ": ebf, bf, nn or ebd");
  }
  return shape;
}

FilterStatistics statistics_of(const std::vector<FilterTake>& takes) {
  constexpr double least_deviation = 0.5, least_turning = 5;
  const std::size_t channels = takes.front().channels;
  std::vector<double> sum(channels), square(channels), turning(axes_of_turn);
  double frames = 0;
  for (const FilterTake& take : takes) {
    frames += static_cast<double>(take.frames);
    for (std::size_t i = 0; i < take.values.size(); ++i) {
      const double value = static_cast<double>(take.values[i]);
      sum[i % channels] += value;
      square[i % channels] += value * value;
    }
    for (std::size_t i = 0; i < take.turning.size(); ++i)
      turning[i % axes_of_turn] += std::pow(static_cast<double>(take.turning[i]), 2);
  }
  FilterStatistics result;
  for (std::size_t c = 0; c < channels; ++c) {
    const double mean = sum[c] / frames;
    const double deviation = std::sqrt(std::max(0.0, square[c] / frames - mean * mean));
    result.mean.push_back(static_cast<float>(mean));
    result.deviation.push_back(static_cast<float>(std::max(least_deviation, deviation)));
  }
  for (const double value : turning)
    result.turning.push_back(
        static_cast<float>(std::max(least_turning, std::sqrt(value / frames))));
  return result;
}

double rate_at(std::size_t batch, std::size_t batches, double highest) {
  constexpr double longest_warm_up = 100, least = 0.02;
  const double warm_up = std::min(longest_warm_up, 0.1 * static_cast<double>(batches));
  return cosine_rate(batch, batches, warm_up, highest, least);
}

// Fills the gaps with straight lines.
void bridge(BodyChannels& channels) {
  std::vector<std::uint8_t> missing(channels.observed.size());
  bool any = false;
  for (std::size_t i = 0; i < missing.size(); ++i) {
    missing[i] = channels.observed[i] == 0 ? 1 : 0;
    any = any || missing[i] != 0;
  }
  if (any) fill_linear(channels.poses, missing);
}

// The mirror of a body without the root.
BodyMirror without_root(const BodyMirror& whole) {
  BodyMirror mirror;
  for (std::size_t n = 1; n < whole.turns; ++n) mirror.partners.push_back(whole.partners[n] - 1);
  mirror.turns = mirror.partners.size();
  return mirror;
}

// Mirroring changes the sign of the angular velocity about the two axes in the mirror plane;
// reversing time changes all signs.
void turn_in_form(std::vector<float>& turning, MotionForm form) {
  if (form.is_reversed) {
    for (std::size_t low = 0, high = turning.size() / axes_of_turn; low + 1 < high; ++low, --high) {
      for (std::size_t a = 0; a < axes_of_turn; ++a)
        std::swap(turning[axes_of_turn * low + a], turning[axes_of_turn * (high - 1) + a]);
    }
    for (float& value : turning) value = -value;
  }
  if (!form.is_mirrored) return;
  for (std::size_t i = 0; i < turning.size(); ++i) {
    if (i % axes_of_turn != 0) turning[i] = -turning[i];
  }
}

void marks_in_form(std::vector<std::uint8_t>& marks, MotionForm form, const BodyMirror& mirror) {
  const std::size_t tracks = mirror.partners.size(), frames = marks.size() / tracks;
  std::vector<std::uint8_t> result(marks.size());
  for (std::size_t f = 0; f < frames; ++f) {
    const std::size_t from = form.is_reversed ? frames - 1 - f : f;
    for (std::size_t n = 0; n < tracks; ++n)
      result[f * tracks + n] = marks[from * tracks + (form.is_mirrored ? mirror.partners[n] : n)];
  }
  marks = std::move(result);
}

// The statistics with which a network's inputs are radians, and radians a second.
void use_radians(FilterStatistics& statistics) {
  constexpr auto radian = static_cast<float>(degrees_per_radian);
  std::fill(statistics.mean.begin(), statistics.mean.end(), 0.0F);
  std::fill(statistics.deviation.begin(), statistics.deviation.end(), radian);
  std::fill(statistics.turning.begin(), statistics.turning.end(), radian);
}

// Mean over frames of the root mean square over channels; optionally over missing samples only.
double mean_error(const FilterTake& take, const std::vector<float>& values,
                  const std::vector<float>& truth, bool only_missing) {
  double sum = 0, counted = 0;
  for (std::size_t f = 0; f < take.frames; ++f) {
    double square = 0, count = 0;
    for (std::size_t c = 0; c < take.channels; ++c) {
      if (only_missing && take.missing[f * (take.channels / axes_of_turn) + c / axes_of_turn] == 0)
        continue;
      square += std::pow(
          static_cast<double>(values[f * take.channels + c] - truth[f * take.channels + c]), 2);
      ++count;
    }
    if (count == 0) continue;
    sum += std::sqrt(square / count);
    ++counted;
  }
  return counted > 0 ? sum / counted : 0;
}

}  // namespace

FilterTrainer::FilterTrainer(std::vector<Take> takes, const FilterTraining& settings)
    : takes_(std::move(takes)), settings_(settings), head_(head_of(settings.head)) {
  if (takes_.empty()) throw Error(ErrorKind::usage, "no takes to learn from");
  rate_hz_ = takes_.front().frame_rate_hz;
  BodyLayoutBuilder builder;
  for (const Take& take : takes_) {
    if (std::abs(take.frame_rate_hz / rate_hz_ - 1) > 1e-3)
      throw Error(ErrorKind::usage, "the takes have different frame rates");
    builder.add(take);
    seconds_ += static_cast<double>(take.frame_count()) / rate_hz_;
  }
  layout_ = builder.finish();
  mirror_ = without_root(mirror_of(layout_));
  std::vector<FilterTake> clean;
  for (const Take& take : takes_) {
    clean.push_back(filter_take_of(encode_body(take, layout_, match_body(layout_, take)), layout_));
    const std::size_t chunk = settings_.frames * (settings_.kind == "ebd" ? 4 : 1);
    chunks_of_epoch_ += (take.frame_count() + chunk - 1) / chunk;
  }
  statistics_ = statistics_of(clean);
  if (!settings_.standardises) use_radians(statistics_);
  if (settings_.kind == "ebd") {
    stride_ = 4;
    margin_ = 0;
    if (head_ != FilterHead::residual && head_ != FilterHead::pose)
      throw Error(ErrorKind::usage,
                  "an EBD has the head pose or residual: it sees every fourth frame");
    chunks_of_epoch_ *= 2;
  }
  shape_ = shape_of(settings_.kind, head_, clean.front().channels, inputs());
  shape_.weight_bound = settings_.weight_bound;
  shape_.draws_last = !settings_.has_head_start;
  if (settings_.has_head_start && (head_ == FilterHead::gaussian || head_ == FilterHead::biased))
    shape_.outset = best_constants();
  network_ = std::make_unique<SequenceNetwork>(shape_, settings_.descent, settings_.seed);
}

FilterTrainer::Sample FilterTrainer::sample_of(const Take& clip, Random random) const {
  const BodyMatch match = match_body(layout_, clip);
  Sample sample;
  sample.truth = filter_take_of(encode_body(clip, layout_, match), layout_).values;
  Take damaged = clip;
  for (const std::vector<FilterDamage>* choices :
       {&settings_.noise, &settings_.bias, &settings_.gaps}) {
    if (choices->empty()) continue;
    const FilterDamage& damage = (*choices)[random.below(choices->size())];
    Random own = random.fork(random.next());
    if (!damage.name.empty()) apply_damage(damaged, damage.name, damage.values, own);
  }
  BodyChannels channels = encode_body(damaged, layout_, match);
  bridge(channels);
  sample.take = filter_take_of(channels, layout_);
  std::vector<float> first(sample.truth.size());
  for (std::size_t i = 0; i < first.size(); ++i) first[i] = before_training(sample.take, i);
  sample.scale =
      std::max(fills() ? least_gap_error_deg : least_error_deg,
               mean_error(sample.take, first, sample.truth, fills() && head_ != FilterHead::pose));
  return sample;
}

FilterSignal FilterTrainer::signal_of(const FilterTake& take) const {
  return {take.frames, take.channels, take.values, statistics_.deviation, statistics_.mean};
}

bool FilterTrainer::counts(const FilterTake& take, std::size_t sample) const {
  return !fills() || head_ == FilterHead::pose || take.missing[sample / axes_of_turn] != 0;
}

float FilterTrainer::before_training(const FilterTake& take, std::size_t sample) const {
  return head_ == FilterHead::pose ? statistics_.mean[sample % take.channels] : take.values[sample];
}

void FilterTrainer::damage_takes(std::size_t round) {
  if (round_ == round + 1) return;
  const Random random = Random(settings_.seed).fork(1 + round);
  samples_.clear();
  for (std::size_t i = 0; i < takes_.size(); ++i)
    samples_.push_back(sample_of(takes_[i], random.fork(i)));
  round_ = round + 1;
}

std::vector<double> FilterTrainer::best_constants() {
  const std::vector<float> logs{-2, -1.5, -1, -0.5, 0, 0.3F, 0.6F, 0.9F, 1.2F, 1.5F, 1.8F, 2.1F};
  const std::size_t channels = statistics_.mean.size();
  std::vector<double> least(channels, std::numeric_limits<double>::infinity());
  std::vector<double> best(channels);
  damage_takes(0);
  for (const float log : logs) {
    std::vector<double> errors(channels);
    for (const Sample& sample : samples_) {
      const FilterTake& take = sample.take;
      const std::vector<float> outputs(take.values.size(), log);
      std::vector<float> result(take.values.size());
      apply_predicted_filter(FilterHead::gaussian, signal_of(take), outputs, result);
      const double weight = 1 / (sample.scale * static_cast<double>(take.frames));
      for (std::size_t i = 0; i < result.size(); ++i)
        errors[i % channels] +=
            weight * std::pow(static_cast<double>(result[i] - sample.truth[i]), 2);
    }
    for (std::size_t c = 0; c < channels; ++c) {
      if (errors[c] >= least[c]) continue;
      least[c] = errors[c];
      best[c] = static_cast<double>(log);
    }
  }
  return best;
}

// Cuts each take anew for each epoch and returns the chunks in a new order.
std::vector<FilterTrainer::Chunk> FilterTrainer::chunks_of(std::size_t epoch) const {
  Random random = Random(settings_.seed ^ 0x5eed).fork(epoch);
  std::vector<Chunk> chunks;
  const auto length = static_cast<std::ptrdiff_t>(settings_.frames * stride_);
  while (chunks.size() < chunks_of_epoch_) {
    for (std::size_t i = 0; i < takes_.size(); ++i) {
      const auto frames = static_cast<std::ptrdiff_t>(takes_[i].frame_count());
      // Random place of the cuts; a take no longer than a chunk uses its beginning.
      const std::ptrdiff_t shift =
          frames > length
              ? static_cast<std::ptrdiff_t>(random.below(static_cast<std::uint64_t>(length / 2)))
              : -static_cast<std::ptrdiff_t>(random.below(stride_));
      for (std::ptrdiff_t first = -shift; first < frames; first += length) {
        Chunk chunk{i, first, {}};
        if (settings_.is_augmented) chunk.form = {random.chance(0.5), random.chance(0.5)};
        if (first + length > length / 4) chunks.push_back(chunk);
      }
    }
  }
  for (std::size_t i = chunks.size(); i > 1; --i) std::swap(chunks[i - 1], chunks[random.below(i)]);
  chunks.resize(chunks_of_epoch_);
  return chunks;
}

// Includes the frames on either side that filters reach; padding repeats the ends.
FilterTrainer::Rows FilterTrainer::rows_of(const Chunk& chunk) const {
  const Sample& sample = samples_[chunk.take];
  const std::size_t channels = sample.take.channels, tracks = channels / axes_of_turn;
  const auto frames = static_cast<std::ptrdiff_t>(sample.take.frames);
  Rows rows;
  rows.take.frames = settings_.frames + 2 * margin_;
  rows.take.channels = channels;
  for (std::size_t i = 0; i < rows.take.frames; ++i) {
    const std::ptrdiff_t wanted =
        chunk.first + (static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(margin_)) *
                          static_cast<std::ptrdiff_t>(stride_);
    const auto f = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(wanted, 0, frames - 1));
    const bool counts =
        wanted >= 0 && wanted < frames && i >= margin_ && i < settings_.frames + margin_;
    const auto append = [f](auto& to, const auto& from, std::size_t width) {
      const auto begin = from.begin() + static_cast<std::ptrdiff_t>(f * width);
      to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(width));
    };
    append(rows.take.values, sample.take.values, channels);
    append(rows.truth, sample.truth, channels);
    append(rows.take.turning, sample.take.turning, axes_of_turn);
    append(rows.take.missing, sample.take.missing, tracks);
    rows.weight.push_back(counts ? 1.0F : 0.0F);
  }
  rows.take.values = in_form(rows.take.values, chunk.form, mirror_);
  rows.truth = in_form(rows.truth, chunk.form, mirror_);
  turn_in_form(rows.take.turning, chunk.form);
  marks_in_form(rows.take.missing, chunk.form, mirror_);
  if (chunk.form.is_reversed) std::reverse(rows.weight.begin(), rows.weight.end());
  return rows;
}

double FilterTrainer::step() {
  const std::size_t batches_an_epoch = std::max<std::size_t>(1, chunks_of_epoch_ / settings_.batch);
  const std::size_t epoch = batch_ / batches_an_epoch;
  damage_takes(epoch / settings_.uses);
  const std::vector<Chunk> chunks = chunks_of(epoch);
  std::vector<Rows> rows;
  std::vector<float> features;
  for (std::size_t i = 0; i < settings_.batch; ++i) {
    const Chunk& chunk =
        chunks[((batch_ % batches_an_epoch) * settings_.batch + i) % chunks.size()];
    rows.push_back(rows_of(chunk));
    // Dividing by the squared noise gives takes with weak and strong noise the same weight.
    const double scale = settings_.scales_loss ? samples_[chunk.take].scale : 1;
    for (float& weight : rows.back().weight) weight /= static_cast<float>(scale * scale);
    const std::vector<float> own = filter_features(rows.back().take, statistics_, inputs());
    features.insert(features.end(), own.begin(), own.end());
  }
  const std::vector<float> outputs = network_->forward(features, batch_, settings_.batch);
  const std::size_t width = outputs.size() / settings_.batch;
  std::vector<float> gradient(outputs.size());
  double loss = 0, before = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const FilterTake& take = rows[i].take;
    const FilterSignal signal = signal_of(take);
    const std::span<const float> own(outputs.data() + i * width, width);
    std::vector<float> result(take.values.size());
    apply_predicted_filter(head_, signal, own, result);
    double count = 1;
    for (std::size_t k = 0; k < result.size(); ++k) {
      count += counts(take, k) && rows[i].weight[k / take.channels] > 0 ? 1 : 0;
    }
    for (std::size_t k = 0; k < result.size(); ++k) {
      const float weight = rows[i].weight[k / take.channels];
      const bool is_counted = counts(take, k);
      const float error = is_counted ? result[k] - rows[i].truth[k] : 0;
      const float first = is_counted ? before_training(take, k) - rows[i].truth[k] : 0;
      loss += static_cast<double>(weight * error * error) / count;
      before += static_cast<double>(weight * first * first) / count;
      result[k] = 2 * weight * error / static_cast<float>(count * static_cast<double>(rows.size()));
    }
    predicted_filter_adjoint(head_, signal, own, result, {gradient.data() + i * width, width});
  }
  network_->add_gradient(gradient);
  network_->step(rate_at(batch_, batches(), settings_.rate));
  ++batch_;
  return before > 0 ? std::sqrt(loss / before) : 1;
}

std::vector<float> FilterTrainer::apply(const FilterTake& take) const {
  const std::vector<float> features = filter_features(take, statistics_, inputs());
  const std::size_t width = features.size() / take.frames;
  std::vector<float> outputs(take.frames * shape_.outputs);
  for (std::size_t phase = 0; phase < stride_; ++phase) {
    std::vector<float> rows;
    for (std::size_t f = phase; f < take.frames; f += stride_)
      rows.insert(rows.end(), features.begin() + static_cast<std::ptrdiff_t>(f * width),
                  features.begin() + static_cast<std::ptrdiff_t>((f + 1) * width));
    const std::vector<float> part = network_->run(rows);
    for (std::size_t i = 0; i * width < rows.size(); ++i)
      std::copy_n(part.data() + i * shape_.outputs, shape_.outputs,
                  outputs.data() + (phase + i * stride_) * shape_.outputs);
  }
  std::vector<float> result(take.values.size());
  apply_predicted_filter(head_, signal_of(take), outputs, result);
  return result;
}

double FilterTrainer::share_left(const std::vector<Take>& takes) const {
  double share = 0, count = 0;
  for (std::size_t i = 0; i < takes.size(); ++i) {
    const Sample sample = sample_of(takes[i], Random(7).fork(i));
    const FilterTake& take = sample.take;
    std::vector<float> plain = take.values;
    if (!fills()) {
      const std::vector<float> widths(plain.size(),
                                      static_cast<float>(std::log(gaussian_s * rate_hz_)));
      apply_predicted_filter(FilterHead::gaussian, signal_of(take), widths, plain);
    }
    const double before = mean_error(take, plain, sample.truth, fills());
    if (before <= 0) continue;
    share += mean_error(take, apply(take), sample.truth, fills()) / before;
    ++count;
  }
  return count > 0 ? share / count : 1;
}

Model FilterTrainer::model() const {
  Model model;
  model.method = "recurrent";
  model.rate_hz = rate_hz_;
  model.takes = takes_.size();
  model.seconds = seconds_;
  model.layout = layout_;
  model.numbers["head"] = static_cast<double>(head_);
  model.numbers["stride"] = static_cast<double>(stride_);
  model.numbers["reach"] = static_cast<double>(shape_.reach);
  model.numbers["roughness"] = inputs().has_roughness ? 1 : 0;
  model.numbers["masks"] = inputs().has_masks ? 1 : 0;
  model.numbers["encoders"] = static_cast<double>(shape_.encoder.size());
  model.numbers["layers"] = static_cast<double>(shape_.layers);
  model.numbers["decoders"] = static_cast<double>(shape_.decoder.size() + 1);
  put_weights(network_->averages(), model);
  put_numbers("mean", statistics_.mean, model);
  put_numbers("deviation", statistics_.deviation, model);
  put_numbers("turning", statistics_.turning, model);
  return model;
}

std::string FilterTrainer::checkpoint() const {
  return write_checkpoint(network_->state(), batch_, settings_.seed);
}

void FilterTrainer::resume(std::string_view bytes, std::string_view name) {
  const Checkpoint kept = read_checkpoint(bytes, name, settings_.seed);
  network_->set_state(kept.state);
  batch_ = kept.batch;
}

void FilterTrainer::begin_with(const Model& model) {
  TensorFile state = network_->state();
  for (auto& [name, tensor] : state.tensors) {
    const std::size_t dot = name.find('.');
    const auto found = model.tensors.find(name.substr(dot + 1));
    const bool is_weight = name.rfind("weights.", 0) == 0 || name.rfind("means.", 0) == 0;
    if (!is_weight) continue;
    if (found == model.tensors.end() || found->second.shape != tensor.shape)
      throw Error(ErrorKind::usage, "the model to begin with is of another network or body");
    tensor = found->second;
    tensor.stored = TensorType::f32;
  }
  network_->set_state(state);
}

}  // namespace kinemend::train
