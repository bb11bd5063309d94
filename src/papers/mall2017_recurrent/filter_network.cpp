// Reads a network from a model and checks that it suits a take, computes its features, and runs it
// on a take. Makes what EBD adds meet the ends of each gap.
#include "papers/mall2017_recurrent/filter_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/portable.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/signal.hpp"
#include "models/model_reading.hpp"

namespace kinemend {

namespace {

// Limits on sizes in a model file, chosen by hand, and the number of head kinds.
constexpr std::size_t most_layers = 16, most_stride = 64, most_reach = 256, head_count = 5;

// Every `stride`-th row from `phase` on.
std::vector<float> rows_of_phase(std::span<const float> rows, std::size_t width, std::size_t phase,
                                 std::size_t stride) {
  std::vector<float> chosen;
  for (std::size_t at = phase * width; at < rows.size(); at += stride * width)
    chosen.insert(chosen.end(), rows.begin() + static_cast<std::ptrdiff_t>(at),
                  rows.begin() + static_cast<std::ptrdiff_t>(at + width));
  return chosen;
}

nn::MatrixViewF view_of(const std::vector<float>& values, std::size_t columns) {
  return {values.data(), values.size() / columns, columns, columns};
}
nn::MutableMatrixViewF rows_in(std::vector<float>& values, std::size_t columns) {
  return {values.data(), values.size() / columns, columns, columns};
}

std::vector<float> roughness(const FilterTake& take, const FilterStatistics& statistics) {
  const std::size_t frames = take.frames, channels = take.channels;
  std::vector<float> result(frames * channels);
  std::vector<double> sums(frames + 1);
  for (std::size_t c = 0; c < channels; ++c) {
    const auto at = [&](std::size_t f) {
      return static_cast<double>(take.values[f * channels + c]);
    };
    for (std::size_t f = 0; f < frames; ++f) {
      const bool is_inner = f > 0 && f + 1 < frames;
      const double second = is_inner ? at(f - 1) - 2 * at(f) + at(f + 1) : 0;
      sums[f + 1] = sums[f] + second * second;
    }
    for (std::size_t f = 0; f < frames; ++f) {
      // Only the inner frames of the window have second differences.
      const std::size_t first = std::max<std::size_t>(f - std::min(f, predicted_filter_reach), 1);
      const std::size_t last = std::min(f + predicted_filter_reach + 2, frames) - 1;
      const double count = last > first ? static_cast<double>(last - first) : 1;
      const double mean = last > first ? (sums[last] - sums[first]) / count : 0;
      result[f * channels + c] = roughness_feature(mean, statistics.deviation[c]);
    }
  }
  return result;
}

std::vector<float> run_dense(const nn::Dense& layer, const nn::MatrixViewF& x) {
  std::vector<float> y(x.rows * layer.outputs());
  nn::run(layer, x, rows_in(y, layer.outputs()));
  return y;
}

std::vector<float> run_phase(const FilterNetwork& network, std::vector<float> values,
                             std::size_t width) {
  const std::size_t steps = values.size() / width;
  if (network.reach > 0) {  // each window is a row that overlaps its neighbours
    std::vector<float> padded(2 * network.reach * width + values.size(), 0.0F);
    std::copy(values.begin(), values.end(),
              padded.begin() + static_cast<std::ptrdiff_t>(network.reach * width));
    const nn::Dense& first = network.decoder.front();
    values = run_dense(first, {padded.data(), steps, first.inputs(), width});
    width = first.outputs();
  }
  for (const nn::Dense& layer : network.encoder) {
    values = run_dense(layer, view_of(values, width));
    width = layer.outputs();
  }
  for (const FilterNetwork::BothWays& layer : network.recurrent) {
    const std::size_t units = layer.forward.units();
    std::vector<float> both(steps * 2 * units);
    const nn::MutableMatrixViewF rows = rows_in(both, 2 * units);
    nn::run(layer.forward, nn::Direction::forward, view_of(values, width),
            rows.block(0, 0, steps, units));
    nn::run(layer.backward, nn::Direction::backward, view_of(values, width),
            rows.block(0, units, steps, units));
    values = std::move(both);
    width = 2 * units;
  }
  for (std::size_t i = network.reach > 0 ? 1 : 0; i < network.decoder.size(); ++i) {
    values = run_dense(network.decoder[i], view_of(values, width));
    width = network.decoder[i].outputs();
  }
  return values;
}

}  // namespace

FilterTake filter_take_of(const BodyChannels& channels, const BodyLayout& layout) {
  const PoseMatrix& poses = channels.poses;
  FilterTake take;
  take.frames = poses.frames;
  take.channels = axes_of_turn * (layout.track_count() - 1);
  take.values.reserve(take.frames * take.channels);
  take.missing.reserve(take.frames * (take.channels / axes_of_turn));
  std::vector<Quat> roots;
  for (std::size_t f = 0; f < take.frames; ++f) {
    const auto row = poses.row(f);
    for (std::size_t c = 0; c < take.channels; ++c)
      take.values.push_back(static_cast<float>(row[axes_of_turn + c]));
    for (std::size_t c = 0; c < take.channels; c += axes_of_turn)
      take.missing.push_back(channels.observed[f * poses.channels + axes_of_turn + c] == 0 ? 1 : 0);
    roots.push_back(exp({0, channels.headings[f], 0}) * layout.references[0] *
                    exp(radians_per_degree * Vec3{row[0], row[1], row[2]}));
  }
  for (std::size_t f = 0; f < take.frames; ++f) {
    const std::size_t before = f > 0 ? f - 1 : f, after = std::min(f + 1, take.frames - 1);
    const double steps = static_cast<double>(std::max<std::size_t>(after - before, 1));
    const Vec3 turn = channels.frame_rate_hz * degrees_per_radian / steps *
                      log(conjugate(roots[before]) * roots[after]);
    for (const double value : {turn.x, turn.y, turn.z})
      take.turning.push_back(static_cast<float>(value));
  }
  return take;
}

void put_filtered(std::span<const float> values, PoseMatrix& poses) {
  const std::size_t channels = poses.frames > 0 ? values.size() / poses.frames : 0;
  for (std::size_t f = 0; f < poses.frames; ++f) {
    for (std::size_t c = 0; c < channels; ++c)
      poses(f, axes_of_turn + c) = static_cast<double>(values[f * channels + c]);
  }
}

std::size_t filter_feature_count(std::size_t channels, FilterInputs inputs) {
  return channels + axes_of_turn + (inputs.has_roughness ? channels : 0) +
         (inputs.has_masks ? channels / axes_of_turn : 0);
}

// The mean square of second differences is six times the variance of white noise.
float roughness_feature(double mean_square, float deviation) {
  // The floor against the logarithm of zero, and the mean and deviation that make the feature about
  // normal. Chosen by hand; networks have learned with them.
  constexpr float squares_of_white = 6, floor_deg = 0.02F, middle = -3, spread = 1.5F;
  const float own = std::sqrt(static_cast<float>(std::max(0.0, mean_square)) / squares_of_white);
  return (portable::log((own + floor_deg) / deviation) - middle) / spread;
}

std::vector<float> filter_features(const FilterTake& take, const FilterStatistics& statistics,
                                   FilterInputs inputs) {
  const std::size_t width = filter_feature_count(take.channels, inputs);
  const std::vector<float> rough =
      inputs.has_roughness ? roughness(take, statistics) : std::vector<float>{};
  std::vector<float> features(take.frames * width);
  for (std::size_t f = 0; f < take.frames; ++f) {
    float* row = features.data() + f * width;
    for (std::size_t c = 0; c < take.channels; ++c)
      *row++ = (take.values[f * take.channels + c] - statistics.mean[c]) / statistics.deviation[c];
    for (std::size_t a = 0; a < axes_of_turn; ++a)
      *row++ = take.turning[axes_of_turn * f + a] / statistics.turning[a];
    for (std::size_t c = 0; inputs.has_roughness && c < take.channels; ++c)
      *row++ = rough[f * take.channels + c];
    for (std::size_t n = 0; inputs.has_masks && n < take.channels / axes_of_turn; ++n)
      *row++ = static_cast<float>(take.missing[f * (take.channels / axes_of_turn) + n]);
  }
  return features;
}

FilterNetwork filter_network_of(const Model& model) {
  const std::size_t channels = axes_of_turn * (model.layout.track_count() - 1);
  FilterNetwork network;
  network.rate_hz = model.rate_hz;
  network.head = static_cast<FilterHead>(whole_number(model, "head", 0, head_count - 1));
  network.stride = whole_number(model, "stride", 1, most_stride);
  network.reach = whole_number(model, "reach", 0, most_reach);
  network.inputs = {whole_number(model, "roughness", 0, 1) == 1,
                    whole_number(model, "masks", 0, 1) == 1};
  network.statistics = {network_numbers(model, "mean", channels, false),
                        network_numbers(model, "deviation", channels, true),
                        network_numbers(model, "turning", axes_of_turn, true)};
  std::size_t width = filter_feature_count(channels, network.inputs) * (2 * network.reach + 1);
  const auto read = [&](const std::string& name, bool is_last) {
    const nn::Activation activation = is_last ? nn::Activation::none : nn::Activation::tanh;
    nn::Dense layer = nn::read_dense(model.tensors, name, activation);
    check_width(name, layer.inputs(), width);
    width = layer.outputs();
    return layer;
  };
  const std::size_t encoders = whole_number(model, "encoders", 0, most_layers);
  for (std::size_t i = 0; i < encoders; ++i)
    network.encoder.push_back(read(fmt::format("encoder{}", i), false));
  const std::size_t layers = whole_number(model, "layers", 0, most_layers);
  for (std::size_t i = 0; i < layers; ++i) {
    FilterNetwork::BothWays layer{nn::read_lstm(model.tensors, fmt::format("forward{}", i)),
                                  nn::read_lstm(model.tensors, fmt::format("backward{}", i))};
    for (const nn::Lstm* way : {&layer.forward, &layer.backward}) {
      check_width(fmt::format("forward{}, backward{}", i, i), way->inputs(), width);
      check_width(fmt::format("backward{}", i), way->units(), layer.forward.units());
    }
    width = 2 * layer.forward.units();
    network.recurrent.push_back(std::move(layer));
  }
  if (network.reach > 0 && encoders + layers > 0)
    refuse_network("the model's reach belongs to a network of dense layers alone");
  const std::size_t decoders = whole_number(model, "decoders", 1, most_layers);
  for (std::size_t i = 0; i < decoders; ++i)
    network.decoder.push_back(read(fmt::format("decoder{}", i), i + 1 == decoders));
  check_width("decoder", width, filter_output_count(network.head, channels));
  return network;
}

std::vector<float> run(const FilterNetwork& network, std::span<const float> features) {
  const std::size_t width = filter_feature_count(network.channels(), network.inputs);
  if (network.stride == 1) return run_phase(network, {features.begin(), features.end()}, width);
  const std::size_t frames = features.size() / width;
  const std::size_t count = network.decoder.back().outputs();
  std::vector<float> outputs(frames * count);
  for (std::size_t phase = 0; phase < std::min(network.stride, frames); ++phase) {
    const std::vector<float> part =
        run_phase(network, rows_of_phase(features, width, phase, network.stride), width);
    for (std::size_t i = 0; i < part.size() / count; ++i)
      std::copy_n(part.data() + i * count, count,
                  outputs.data() + (phase + i * network.stride) * count);
  }
  return outputs;
}

std::vector<float> filtered(const FilterNetwork& network, const FilterTake& take) {
  const std::vector<float> outputs =
      run(network, filter_features(take, network.statistics, network.inputs));
  std::vector<float> result(take.values.size());
  apply_predicted_filter(network.head,
                         {take.frames, take.channels, take.values, network.statistics.deviation,
                          network.statistics.mean},
                         outputs, result);
  return result;
}

namespace {

// Time constant of the correction that makes a filled gap meet its ends. Chosen by hand, not swept.
constexpr double joining_s = 0.1;

std::vector<std::uint8_t> missing_of(const BodyChannels& channels) {
  std::vector<std::uint8_t> missing(channels.observed.size());
  for (std::size_t i = 0; i < missing.size(); ++i) missing[i] = channels.observed[i] == 0 ? 1 : 0;
  return missing;
}

// Resamples the take linearly to frames that are `step` frames apart.
FilterTake at_rate(const FilterTake& take, double step) {
  FilterTake result;
  result.channels = take.channels;
  const auto last = static_cast<double>(take.frames - 1);
  result.frames = static_cast<std::size_t>(std::floor(last / step + 1e-9)) + 1;
  const std::size_t tracks = take.channels / axes_of_turn;
  for (std::size_t f = 0; f < result.frames; ++f) {
    const double place = static_cast<double>(f) * step;
    const auto before = std::min(static_cast<std::size_t>(place), take.frames - 1);
    const std::size_t after = std::min(before + 1, take.frames - 1);
    const auto share = static_cast<float>(place - static_cast<double>(before));
    const auto mix = [&](const std::vector<float>& from, std::size_t width, std::size_t i) {
      const float start = from[before * width + i];
      return start + share * (from[after * width + i] - start);
    };
    for (std::size_t c = 0; c < take.channels; ++c)
      result.values.push_back(mix(take.values, take.channels, c));
    for (std::size_t a = 0; a < axes_of_turn; ++a)
      result.turning.push_back(mix(take.turning, axes_of_turn, a));
    const std::size_t nearest = share < 0.5F ? before : after;
    for (std::size_t n = 0; n < tracks; ++n)
      result.missing.push_back(take.missing[nearest * tracks + n]);
  }
  return result;
}

// The network's additions to the take, F x C, at the take's rate.
std::vector<double> additions(const FilterNetwork& network, const FilterTake& take,
                              double rate_hz) {
  const double step = rate_hz / network.rate_hz;
  const FilterTake seen = at_rate(take, step);
  const std::vector<float> made = filtered(network, seen);
  std::vector<double> result(take.values.size());
  for (std::size_t f = 0; f < take.frames; ++f) {
    const double place = static_cast<double>(f) / step;
    const auto before = std::min(static_cast<std::size_t>(place + 1e-9), seen.frames - 1);
    const std::size_t after = std::min(before + 1, seen.frames - 1);
    const double share = std::clamp(place - static_cast<double>(before), 0.0, 1.0);
    for (std::size_t c = 0; c < take.channels; ++c) {
      const auto at = [&](std::size_t g) {
        return static_cast<double>(made[g * take.channels + c] -
                                   seen.values[g * take.channels + c]);
      };
      result[f * take.channels + c] = at(before) + share * (at(after) - at(before));
    }
  }
  return result;
}

// Adds the additions to one channel in a gap, frames [first, last).
void fill_span(const std::vector<double>& added, std::size_t channels, std::size_t c,
               std::size_t first, std::size_t last, double joining_frames, PoseMatrix& poses) {
  const bool has_start = first > 0, has_end = last < poses.frames;
  const double at_start = has_start ? added[first * channels + c] : 0;
  const double at_end = has_end ? added[(last - 1) * channels + c] : 0;
  for (std::size_t f = first; f < last; ++f) {
    const double from_start = portable::exp(-static_cast<double>(f - first) / joining_frames);
    const double from_end = portable::exp(-static_cast<double>(last - 1 - f) / joining_frames);
    poses(f, axes_of_turn + c) +=
        added[f * channels + c] - from_start * at_start - from_end * at_end;
  }
}

}  // namespace

PoseMatrix filled_by_network(const FilterNetwork& network, const BodyLayout& layout,
                             const BodyChannels& channels) {
  BodyChannels bridged = channels;
  fill_linear(bridged.poses, missing_of(channels));
  PoseMatrix result = bridged.poses;
  if (result.frames < 2) return result;
  const FilterTake take = filter_take_of(bridged, layout);
  const std::vector<double> added = additions(network, take, channels.frame_rate_hz);
  const std::size_t tracks = take.channels / axes_of_turn;
  for (std::size_t n = 0; n < tracks; ++n) {
    const auto is_missing = [&](std::size_t f) { return take.missing[f * tracks + n] != 0; };
    for (std::size_t f = 0; f < take.frames; ++f) {
      if (!is_missing(f)) continue;
      std::size_t last = f;
      while (last < take.frames && is_missing(last)) ++last;
      if (last - f == take.frames) break;  // a joint that the take lacks
      for (std::size_t axis = 0; axis < axes_of_turn; ++axis)
        fill_span(added, take.channels, axes_of_turn * n + axis, f, last,
                  joining_s * channels.frame_rate_hz, result);
      f = last;
    }
  }
  return result;
}

FilterNetwork gap_network_of(const Model& model) {
  constexpr const char* needed =
      "this model of the method recurrent cleans and fills no gaps: one that does is made by "
      "kinemend-train paper --network ebd --head pose";
  FilterNetwork network = filter_network_of(model);
  if (!network.inputs.has_masks) throw Error(ErrorKind::usage, needed);
  return network;
}

bool has_rate_of(const FilterNetwork& network, double frame_rate_hz) {
  // Chosen by hand, not swept.
  constexpr double same_rate = 0.01;  // share of the rate
  return std::abs(frame_rate_hz / network.rate_hz - 1) <= same_rate;
}

}  // namespace kinemend
