// Keeps the last frames and states, and runs a backward pass for every third frame.
#include "papers/mall2017_recurrent/live_filter_network.hpp"

#include <algorithm>
#include <utility>

#include "kinemend/error.hpp"

namespace kinemend {

namespace {

constexpr std::size_t reach = predicted_filter_reach;
// Most frames of a pass, from its first frame on, which is one at the end of the stream. By
// definition.
constexpr std::size_t most_rows = reach + 1;
// The second differences about the first of these frames need one frame more than its window. By
// definition.
constexpr std::size_t window_rows = 2 * reach + 2;

std::size_t widest(const FilterNetwork& network) {
  std::size_t width = 0;
  for (const std::vector<nn::Dense>* layers : {&network.encoder, &network.decoder}) {
    for (const nn::Dense& layer : *layers) width = std::max(width, layer.outputs());
  }
  for (const FilterNetwork::BothWays& layer : network.recurrent)
    width = std::max(width, 2 * layer.forward.units());
  return width;
}

std::size_t most_gates(const FilterNetwork& network) {
  std::size_t gates = 0;
  for (const FilterNetwork::BothWays& layer : network.recurrent)
    gates = std::max(gates, layer.forward.input.outputs());
  return gates;
}

}  // namespace

LiveFilterNetwork::LiveFilterNetwork(const FilterNetwork& network, double frame_rate_hz)
    : network_(network),
      rate_hz_(frame_rate_hz),
      channels_(network.channels()),
      width_(filter_feature_count(network.channels(), network.inputs)),
      values_(window_rows * channels_),
      roots_(window_rows),
      missed_(channels_ / axes_of_turn),
      seen_(channels_ / axes_of_turn),
      features_((network.reach + std::max(most_rows, network.reach + 1)) * width_),
      outputs_(most_rows * network.decoder.back().outputs()),
      here_(most_rows * widest(network)),
      there_(here_.size()),
      gates_(most_rows * most_gates(network)),
      squares_(window_rows * channels_),
      sums_(channels_),
      filter_(channels_) {
  check(network);
  for (const FilterNetwork::BothWays& layer : network.recurrent)
    layers_.push_back(
        {nn::start(layer.forward), nn::start(layer.forward), nn::start(layer.backward)});
}

void LiveFilterNetwork::check(const FilterNetwork& network) {
  if (network.inputs.has_masks || network.stride != 1)
    throw Error(ErrorKind::usage, "this network fills gaps and filters nothing");
  if (network.reach > delay)
    throw Error(ErrorKind::usage, "this network sees farther ahead than 15 frames");
}

void LiveFilterNetwork::reset() {
  base_ = count_ = next_ = known_ = 0;
  std::fill(missed_.begin(), missed_.end(), 0);
  std::fill(seen_.begin(), seen_.end(), 0);
  std::fill(features_.begin(), features_.end(), 0.0F);
  for (Layer& layer : layers_) nn::restart(layer.forward);
}

bool LiveFilterNetwork::push(const Input& in, std::span<float> out) {
  append(in);
  const std::size_t frames = base_ + count_;
  if (is_recurrent() && frames + period > known_ + delay + 1) run_pass(period);
  if (frames <= next_ + delay) return false;
  give(out);
  return true;
}

bool LiveFilterNetwork::flush(std::span<float> out) {
  if (next_ >= base_ + count_) return false;
  give(out);
  return true;
}

void LiveFilterNetwork::append(const Input& in) {
  if (count_ == window_rows) {
    std::copy(values_.begin() + static_cast<std::ptrdiff_t>(channels_), values_.end(),
              values_.begin());
    std::copy(roots_.begin() + 1, roots_.end(), roots_.begin());
    ++base_;
    --count_;
  }
  const std::size_t row = count_++;
  for (std::size_t n = 0; n < missed_.size(); ++n) {
    float* own = value_row(row) + axes_of_turn * n;
    if (in.missing[n] == 0) {
      std::copy_n(in.values.data() + axes_of_turn * n, axes_of_turn, own);
      if (missed_[n] > 0) bridge(n, missed_[n]);
      missed_[n] = 0;
      seen_[n] = 1;
      continue;
    }
    const float* held =
        row > 0 ? own - channels_ : network_.statistics.mean.data() + axes_of_turn * n;
    std::copy_n(held, axes_of_turn, own);
    ++missed_[n];
  }
  roots_[row] = !in.root_is_missing ? in.root : row > 0 ? roots_[row - 1] : Quat{};
}

// The newest frame has ended a gap: frames of the gap that are not yet out are interpolated
// linearly.
void LiveFilterNetwork::bridge(std::size_t track, std::size_t missed) {
  const std::size_t last = count_ - 1;
  const std::size_t open = std::min({missed, delay, last});
  for (std::size_t c = axes_of_turn * track; c < axes_of_turn * (track + 1); ++c) {
    const float to = value_row(last)[c];
    const float from = seen_[track] != 0 ? value_row(last - open)[c] : to;
    for (std::size_t i = 0; i < open; ++i) {
      const float share = static_cast<float>(i + 1) / static_cast<float>(open + 1);
      value_row(last - open + i)[c] = from + share * (to - from);
    }
  }
}

void LiveFilterNetwork::give(std::span<float> out) {
  if (next_ >= known_) run_pass(is_recurrent() ? base_ + count_ - next_ : 1);
  const std::size_t width = network_.decoder.back().outputs();
  const std::span<const float> values(values_.data(), count_ * channels_);
  filter_.apply(
      network_.head,
      {count_, channels_, values, network_.statistics.deviation, network_.statistics.mean},
      next_ - base_, {outputs_.data() + next_ % most_rows * width, width}, out);
  ++next_;
}

// Computes the outputs of the `wanted` frames after the known ones, from all frames so far.
void LiveFilterNetwork::run_pass(std::size_t wanted) {
  rows_ = base_ + count_ - known_;
  wanted_ = std::min(wanted, rows_);
  encode();
  for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
    go_on(layer);
    go_back(layer);
  }
  decode();
  known_ += wanted_;
}

void LiveFilterNetwork::encode() {
  const std::size_t before = network_.reach;
  if (before > 0) {  // keeps the features of the frames before
    std::copy(features_.begin() + static_cast<std::ptrdiff_t>(width_),
              features_.begin() + static_cast<std::ptrdiff_t>((before + 1) * width_),
              features_.begin());
    std::fill(features_.begin() + static_cast<std::ptrdiff_t>((before + rows_) * width_),
              features_.end(), 0.0F);
  }
  fill_features();
  x_ = {features_.data() + before * width_, rows_, width_, width_};
  for (const nn::Dense& layer : network_.encoder) run_dense(layer);
}

void LiveFilterNetwork::run_dense(const nn::Dense& layer) {
  nn::run(layer, x_, {there_.data(), x_.rows, layer.outputs(), layer.outputs()});
  x_ = {there_.data(), x_.rows, layer.outputs(), layer.outputs()};
  std::swap(here_, there_);
}

// Runs the forward layer on from its past state. The last layer computes only the wanted frames.
void LiveFilterNetwork::go_on(std::size_t number) {
  const nn::Lstm& layer = network_.recurrent[number].forward;
  Layer& own = layers_[number];
  const std::size_t units = layer.units(), width = layer.input.outputs();
  const std::size_t onward = number + 1 == layers_.size() ? wanted_ : rows_;
  const nn::MutableMatrixViewF both{there_.data(), rows_, 2 * units, 2 * units};
  const nn::MatrixViewF gates{gates_.data(), onward, width, width};
  nn::run(layer.input, x_.block(0, 0, onward, x_.columns), {gates_.data(), onward, width, width});
  nn::run_on(layer, nn::Direction::forward, gates.block(0, 0, wanted_, width), own.forward,
             both.block(0, 0, wanted_, units));
  if (onward == wanted_) return;
  own.ahead.hidden = own.forward.hidden;
  own.ahead.cell = own.forward.cell;
  nn::run_on(layer, nn::Direction::forward, gates.block(wanted_, 0, onward - wanted_, width),
             own.ahead, both.block(wanted_, 0, onward - wanted_, units));
}

void LiveFilterNetwork::go_back(std::size_t number) {
  const nn::Lstm& layer = network_.recurrent[number].backward;
  Layer& own = layers_[number];
  const std::size_t units = layer.units(), width = layer.input.outputs();
  const nn::MutableMatrixViewF both{there_.data(), rows_, 2 * units, 2 * units};
  nn::run(layer.input, x_, {gates_.data(), rows_, width, width});
  nn::restart(own.backward);
  nn::run_on(layer, nn::Direction::backward, {gates_.data(), rows_, width, width}, own.backward,
             both.block(0, units, rows_, units));
  x_ = {there_.data(), rows_, 2 * units, 2 * units};
  std::swap(here_, there_);
}

void LiveFilterNetwork::decode() {
  x_.rows = wanted_;
  if (network_.reach > 0) {  // a window is a row
    const nn::Dense& first = network_.decoder.front();
    x_ = {features_.data(), 1, first.inputs(), first.inputs()};
  }
  for (const nn::Dense& layer : network_.decoder) run_dense(layer);
  for (std::size_t i = 0; i < wanted_; ++i)
    std::copy_n(x_.values + i * x_.row_stride, x_.columns,
                outputs_.data() + (known_ + i) % most_rows * x_.columns);
}

void LiveFilterNetwork::fill_features() {
  const FilterStatistics& statistics = network_.statistics;
  const std::size_t first = known_ - base_;
  float* feature = features_.data() + network_.reach * width_;
  for (std::size_t i = 0; i < rows_; ++i, feature += width_) {
    const float* row = value_row(first + i);
    for (std::size_t c = 0; c < channels_; ++c)
      feature[c] = (row[c] - statistics.mean[c]) / statistics.deviation[c];
    const Vec3 turn = turning(first + i);
    feature[channels_] = static_cast<float>(turn.x) / statistics.turning[0];
    feature[channels_ + 1] = static_cast<float>(turn.y) / statistics.turning[1];
    feature[channels_ + 2] = static_cast<float>(turn.z) / statistics.turning[2];
  }
  if (network_.inputs.has_roughness) fill_roughness();
}

// Updates the sums over the window of one frame to those of the next.
void LiveFilterNetwork::fill_roughness() {
  const std::size_t first = known_ - base_;
  std::fill(squares_.begin(), squares_.end(), 0.0);
  for (std::size_t r = 1; r + 1 < count_; ++r) {
    const float* row = value_row(r);
    double* square = squares_.data() + r * channels_;
    for (std::size_t c = 0; c < channels_; ++c) {
      const double second = static_cast<double>((row - channels_)[c]) -
                            2 * static_cast<double>(row[c]) +
                            static_cast<double>(row[c + channels_]);
      square[c] = second * second;
    }
  }
  // Rows [begin, end) about a frame that have two neighbours; row 0 at the first frame of the
  // stream has only one.
  std::size_t begin = 1, end = 1;
  std::fill(sums_.begin(), sums_.end(), 0.0);
  const auto add = [&](std::size_t r, double sign) {
    const double* square = squares_.data() + r * channels_;
    for (std::size_t c = 0; c < channels_; ++c) sums_[c] += sign * square[c];
  };
  float* feature = features_.data() + network_.reach * width_ + channels_ + axes_of_turn;
  for (std::size_t i = 0; i < rows_; ++i, feature += width_) {
    const std::size_t row = first + i;
    const std::size_t wanted_begin = std::max<std::size_t>(row - std::min(row, reach), 1);
    const std::size_t wanted_end = std::max(std::min(row + reach + 2, count_) - 1, wanted_begin);
    if (i == 0) begin = end = wanted_begin;
    for (; end < wanted_end; ++end) add(end, 1);
    for (; begin < wanted_begin; ++begin) add(begin, -1);
    const double count = wanted_end > wanted_begin ? static_cast<double>(end - begin) : 1;
    for (std::size_t c = 0; c < channels_; ++c)
      feature[c] = roughness_feature(sums_[c] / count, network_.statistics.deviation[c]);
  }
}

Vec3 LiveFilterNetwork::turning(std::size_t row) const {
  const std::size_t before = row > 0 ? row - 1 : row, after = std::min(row + 1, count_ - 1);
  const double steps = static_cast<double>(std::max<std::size_t>(after - before, 1));
  return rate_hz_ * degrees_per_radian / steps * log(conjugate(roots_[before]) * roots_[after]);
}

}  // namespace kinemend
