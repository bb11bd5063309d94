#include "fill/local_regression.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "fill/bridge.hpp"

namespace kinemend::fill {

namespace {

// The steadiest companions, and more of them while they lie on a line.
MarkerGroup make_group(const std::vector<Companion>& companions, std::size_t most) {
  const std::size_t count = std::min(most, companions.size());
  if (count == 0) return {{}, {}};
  // A distance cannot be known better than to a share of the spread that all have.
  const double floor = 0.1 * companions[count - 1].spread + 1e-300;
  std::vector<std::size_t> markers;
  std::vector<double> weights;
  for (std::size_t k = 0; k < count; ++k) {
    const double spread = companions[k].spread + floor;
    markers.push_back(companions[k].marker);
    weights.push_back(1 / (spread * spread));
  }
  return {std::move(markers), std::move(weights)};
}

double mean_spread(const std::vector<Companion>& companions, std::size_t most) {
  const std::size_t count = std::min(most, companions.size());
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) sum += companions[k].spread;
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

}  // namespace

LocalRegression::LocalRegression(const Samples& samples, const MarkerGap& gap,
                                 std::span<const std::size_t> helpers,
                                 const LocalSettings& settings)
    : samples_(samples), marker_(gap.marker), settings_(settings), group_({}, {}) {
  const std::vector<Companion> companions = companions_of(samples, gap, helpers);
  group_ = make_group(companions, settings.companions);
  rigidity_ = mean_spread(companions, 3);
  if (group_.markers().empty()) return;
  for (std::size_t f = 0; f < samples.frames; ++f) {
    if (samples.sees(f, marker_) && !gap.covers(f) && group_.seen_in(samples, f)) {
      training_.push_back(f);
    }
  }
  training_ = evenly(training_, settings.training_frames);
  if (!usable()) return;
  group_.fit_shape(samples, evenly(training_, 128));
  rows_.resize(static_cast<Eigen::Index>(training_.size()),
               static_cast<Eigen::Index>(3 * group_.markers().size() + 4));
  for (std::size_t i = 0; i < training_.size(); ++i) {
    double* row = &rows_(static_cast<Eigen::Index>(i), 0);
    const Placement placed = local_row(training_[i], row);
    const Vec3 own = placed.to_local(samples.at(training_[i], marker_));
    double* end = row + 3 * group_.markers().size() + 1;
    end[0] = own.x, end[1] = own.y, end[2] = own.z;
  }
  sums_.noalias() = rows_.transpose() * rows_;
}

Placement LocalRegression::local_row(std::size_t frame, double* row) const {
  const Placement placed = group_.placement(samples_, frame);
  *row++ = 1;
  for (std::size_t k = 0; k < group_.markers().size(); ++k) {
    const Vec3 off = placed.to_local(samples_.at(frame, group_.markers()[k])) - group_.shape()[k];
    *row++ = off.x, *row++ = off.y, *row++ = off.z;
  }
  return placed;
}

LocalRegression::Rows LocalRegression::sums_without(Span span, Eigen::Index& count) const {
  const auto first = std::lower_bound(training_.begin(), training_.end(), span.first);
  const auto last = std::upper_bound(first, training_.end(), span.last);
  const Eigen::Index hidden = last - first;
  count = rows_.rows() - hidden;
  if (hidden == 0) return sums_;
  const auto block = rows_.middleRows(first - training_.begin(), hidden);
  return sums_ - block.transpose() * block;
}

std::vector<std::vector<Vec3>> LocalRegression::predict(Span span,
                                                        std::span<const std::size_t> wanted,
                                                        std::span<const double> stiffness) const {
  const MarkerGap gap{marker_, span};
  const double memory = settings_.memory_s * samples_.frame_rate_hz;
  constexpr std::size_t most_beside = 24;
  std::vector<std::size_t> beside = frames_beside(
      samples_, gap, most_beside, std::max(most_beside, static_cast<std::size_t>(3 * memory)));
  std::erase_if(beside, [&](std::size_t f) { return !group_.seen_in(samples_, f); });

  const auto inputs = static_cast<Eigen::Index>(3 * group_.markers().size());
  Eigen::Index count = 0;
  const Rows sums = sums_without(span, count);
  const auto n = static_cast<double>(std::max<Eigen::Index>(count, 1));
  const Eigen::RowVectorXd mean = sums.row(0) / n;
  const Eigen::MatrixXd centred = sums - n * mean.transpose() * mean;

  std::vector<std::size_t> frames = beside;
  frames.insert(frames.end(), wanted.begin(), wanted.end());
  Rows x(static_cast<Eigen::Index>(frames.size()), inputs + 1);
  std::vector<Placement> placed(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    placed[i] = local_row(frames[i], &x(static_cast<Eigen::Index>(i), 0));
  }
  const Rows deviations = (x.rightCols(inputs).rowwise() - mean.segment(1, inputs)).eval();
  const std::vector<std::size_t> wanted_frames(wanted.begin(), wanted.end());

  std::vector<std::vector<Vec3>> results;
  for (const double stiff : stiffness) {
    Rows y = mean.tail(3).replicate(x.rows(), 1);
    if (std::isfinite(stiff)) {
      Eigen::MatrixXd system = centred.block(1, 1, inputs, inputs);
      system.diagonal().array() += n * stiff * stiff;
      y.noalias() += deviations * system.ldlt().solve(centred.block(1, inputs + 1, inputs, 3));
    }
    const auto local = [&](std::size_t i) {
      const auto row = static_cast<Eigen::Index>(i);
      return Vec3{y(row, 0), y(row, 1), y(row, 2)};
    };
    std::vector<Vec3> positions(wanted.size()), errors(beside.size());
    for (std::size_t i = 0; i < beside.size(); ++i) {
      errors[i] = placed[i].to_local(samples_.at(beside[i], marker_)) - local(i);
    }
    const std::vector<Vec3> carried = beside.empty() ? std::vector<Vec3>(wanted.size())
                                                     : Bridge(beside, wanted, memory).carry(errors);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const std::size_t row = beside.size() + i;
      positions[i] = placed[row].to_world(local(row) + carried[i]);
    }
    results.push_back(std::move(positions));
  }
  return results;
}

}  // namespace kinemend::fill
