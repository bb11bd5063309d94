#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinemend/signal.hpp"
#include "signal/checks.hpp"
#include "signal/kernels.hpp"

namespace kinemend {

namespace {

using signal::require;

constexpr std::size_t group_width =
    32;  // channels filtered together: the trace of a group stays small

std::size_t components_of(const LinearGaussianModel& model) {
  switch (model.kind) {
    case MotionModel::position:
      return 1;
    case MotionModel::velocity:
      return 2;
    case MotionModel::acceleration:
      return 3;
  }
  throw Error(ErrorKind::usage, "unknown motion model");
}

double value_of(const std::vector<double>& values, std::size_t channel) {
  return values.size() == 1 ? values[0] : values[channel];
}

void require_valid(const LinearGaussianModel& model, std::size_t channels) {
  require(model.frame_step_s > 0 && std::isfinite(model.frame_step_s),
          fmt::format("a frame step of {} s makes no sense", model.frame_step_s));
  for (const auto* noise : {&model.process_noise, &model.measurement_noise}) {
    require(noise->size() == 1 || noise->size() == channels,
            fmt::format("{} noise values for {} channels", noise->size(), channels));
  }
  for (const double noise : model.process_noise) {
    require(noise >= 0 && std::isfinite(noise),
            fmt::format("a process noise of {} makes no sense", noise));
  }
  for (const double noise : model.measurement_noise) {
    require(noise > 0 && std::isfinite(noise),
            fmt::format("a measurement noise of {} makes no sense", noise));
  }
}

// All rows of KalmanLanes in one block.
std::size_t memory_size(std::size_t components, std::size_t channels) {
  const std::size_t rows = components + components * (components + 1) / 2 + (components + 1) + 3;
  return rows * channels;
}

signal::KalmanLanes lanes_in(double* memory, std::size_t components, std::size_t channels) {
  signal::KalmanLanes lanes{};
  lanes.components = components;
  lanes.channels = channels;
  const auto take = [&](std::size_t rows) {
    double* result = memory;
    memory += rows * channels;
    return result;
  };
  lanes.state = take(components);
  lanes.covariance = take(components * (components + 1) / 2);
  lanes.gain = take(components + 1);
  lanes.first_frame = take(1);
  lanes.noise = take(1);
  lanes.prior = take(1);
  return lanes;
}

// In units of one frame and one measurement variance the white derivative's density becomes q^2
// dt^(2n - 1) / r^2.
std::vector<double> fresh_memory(const LinearGaussianModel& model, std::size_t first_channel,
                                 std::size_t channels) {
  const std::size_t components = components_of(model);
  std::vector<double> memory(memory_size(components, channels), 0.0);
  const signal::KalmanLanes lanes = lanes_in(memory.data(), components, channels);
  const double step = std::pow(model.frame_step_s, 2.0 * static_cast<double>(components) - 1);
  for (std::size_t c = 0; c < channels; ++c) {
    const double ratio = value_of(model.process_noise, first_channel + c) /
                         value_of(model.measurement_noise, first_channel + c);
    lanes.noise[c] = ratio * ratio * step;
    lanes.prior[c] = 1e8 * std::max(1.0, lanes.noise[c]);
    lanes.first_frame[c] = std::numeric_limits<double>::infinity();
  }
  return memory;
}

template <class Work>
void for_each_group(PoseMatrix& matrix, const LinearGaussianModel& model,
                    std::span<const std::uint8_t> missing, const Work& work) {
  require_valid(model, matrix.channels);
  signal::require_marks(matrix, missing);
  if (matrix.frames == 0) return;
  for (std::size_t first = 0; first < matrix.channels; first += group_width) {
    const std::size_t width = std::min(group_width, matrix.channels - first);
    std::vector<double> memory = fresh_memory(model, first, width);
    signal::KalmanLanes lanes = lanes_in(memory.data(), components_of(model), width);
    const signal::KalmanRows rows = {matrix.values.data() + first,
                                     missing.empty() ? nullptr : missing.data() + first,
                                     matrix.channels, 0, matrix.frames};
    work(lanes, rows, first);
  }
}

}  // namespace

void kalman_filter(PoseMatrix& matrix, const LinearGaussianModel& model,
                   std::span<const std::uint8_t> missing) {
  for_each_group(
      matrix, model, missing,
      [&](signal::KalmanLanes& lanes, const signal::KalmanRows& rows, std::size_t first) {
        signal::kalman_forward_rows(lanes, rows, nullptr);
        for (std::size_t c = 0; c < lanes.channels; ++c) {
          if (!std::isfinite(lanes.first_frame[c])) continue;
          const auto start = static_cast<std::size_t>(lanes.first_frame[c]);
          for (std::size_t t = 0; t < start; ++t) matrix(t, first + c) = matrix(start, first + c);
        }
      });
}

void kalman_smoother(PoseMatrix& matrix, const LinearGaussianModel& model,
                     std::span<const std::uint8_t> missing) {
  signal::KalmanTrace trace;
  for_each_group(matrix, model, missing,
                 [&](signal::KalmanLanes& lanes, const signal::KalmanRows& rows, std::size_t) {
                   trace.predicted.resize(rows.frames * lanes.channels);
                   trace.gains.clear();
                   trace.slots.resize(rows.frames);
                   signal::kalman_forward_rows(lanes, rows, &trace);
                   signal::kalman_backward_rows(lanes, rows, trace);
                 });
}

KalmanState::KalmanState(const LinearGaussianModel& model, std::size_t channels)
    : components_(components_of(model)), channels_(channels) {
  require_valid(model, channels);
  memory_ = fresh_memory(model, 0, channels);
}

void KalmanState::step(std::span<double> frame, std::span<const std::uint8_t> missing) {
  require(frame.size() == channels_,
          fmt::format("a frame of {} channels, where {} are filtered", frame.size(), channels_));
  require(missing.empty() || missing.size() == channels_, "not one mark for each channel");
  if (channels_ == 0) return;
  signal::KalmanLanes lanes = lanes_in(memory_.data(), components_, channels_);
  lanes.settled = settled_;
  signal::kalman_forward_rows(
      lanes, {frame.data(), missing.empty() ? nullptr : missing.data(), channels_, frame_, 1},
      nullptr);
  settled_ = lanes.settled;
  ++frame_;
}

void KalmanState::reset() {
  const signal::KalmanLanes lanes = lanes_in(memory_.data(), components_, channels_);
  std::fill(lanes.first_frame, lanes.first_frame + channels_,
            std::numeric_limits<double>::infinity());
  settled_ = false;
}

}  // namespace kinemend
