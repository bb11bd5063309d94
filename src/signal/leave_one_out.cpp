// Fits each smoother in tiles that stay in the cache and compares their predictions.
#include "signal/leave_one_out.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "signal/whittaker_kernels.hpp"

namespace kinemend::signal {

namespace {

// Order of the differences (docs/details/auto.md, "Spikes").
constexpr std::size_t order = 2;
// Rows of the fit that are computed at a time; they fit the L2 cache. For speed, not swept.
constexpr std::size_t tile_frames = 2048;
// Relative influence below which a difference is neglected: below the precision of a double. By
// definition.
constexpr double negligible = 1e-18;

// Number of differences after which the influence of one is negligible: the rows of a converged
// factor are a recursion with constant coefficients, which decays by its largest root.
std::size_t memory_of(const SharedFactor& factor) {
  const std::size_t differences = factor.frames - order;
  const std::size_t rows = factor.inverse_diagonal.size();
  if (rows >= differences) return differences;
  const double b = factor.lower[(rows - 1) * order], c = factor.lower[(rows - 1) * order + 1];
  const double discriminant = b * b / 4 - c;
  const double root = discriminant < 0 ? std::sqrt(c) : std::fabs(b) / 2 + std::sqrt(discriminant);
  if (!(root < 1)) return differences;
  const double frames = std::ceil(portable::log(negligible) / portable::log(std::max(root, 1e-9)));
  return frames < static_cast<double>(differences) ? static_cast<std::size_t>(frames) + order
                                                   : differences;
}

}  // namespace

LeaveOneOut::LeaveOneOut(std::size_t frames, double frame_rate_hz, const CutoffGrid& cutoffs) {
  // Prevents a division by zero. Chosen by hand, not swept.
  constexpr double least_weight = 1e-3;
  if (frames <= order + 1) return;
  std::vector<double> strengths;
  for (std::size_t i = 0; i < cutoffs.count; ++i) {
    const double strength =
        strength_of_cutoff(std::min(cutoffs.hz(i) / frame_rate_hz, 0.49), order);
    if (strength <= largest_strength) strengths.push_back(strength);
  }
  factors_.resize(strengths.size());
  memories_.resize(strengths.size());
  weights_.resize(strengths.size());
  for_each_parallel(strengths.size(), strengths.size() * frames, [&](std::size_t i) {
    factors_[i] = factor_shared(frames, order, strengths[i]);
    memories_[i] = memory_of(factors_[i]);
    weights_[i] = signal::weights_of_others(factors_[i]);
    for (double& weight : weights_[i]) weight = std::max(weight, least_weight);
  });
}

// The backward recursion of a tile starts only as many differences after it as influence it, so
// that the tile stays in the cache.
void LeaveOneOut::fit(std::size_t smoother, const LaneBlock& y, const FitVisitor& visit) const {
  const SharedRows factor = rows_of(factors_[smoother]);
  const std::size_t frames = y.frames, differences = frames - order;
  const std::size_t memory = memories_[smoother];
  const std::size_t room = std::min(differences, tile_frames + memory + order);
  std::vector<double> forward(room * lane_row),
      back(std::min(room, tile_frames + order) * lane_row),
      x(std::min(frames, tile_frames) * lane_row);
  std::size_t held = 0, known = 0;  // differences in `forward`: from, to
  for (std::size_t first = 0; first < frames; first += tile_frames) {
    const std::size_t last = std::min(first + tile_frames, frames);
    const std::size_t from = first < order ? 0 : first - order;
    const std::size_t kept = std::min(last, differences);
    const std::size_t to = std::min(differences, last + memory);
    std::copy(forward.begin() + static_cast<std::ptrdiff_t>((from - held) * lane_row),
              forward.begin() + static_cast<std::ptrdiff_t>((known - held) * lane_row),
              forward.begin());
    held = from;
    lanes_forward(factor, known, to, y.values.data(), forward.data(), held);
    known = to;
    lanes_backward(factor, from, kept, to, forward.data(), held, back.data());
    lanes_fit(factor, first, last, y.values.data(), back.data(), from, x.data());
    visit(first, last - first, x.data());
  }
}

std::array<std::size_t, lane_tracks> LeaveOneOut::best_smoothers(const LaneBlock& y,
                                                                 const BlockRow& caps) const {
  std::vector<BlockRow> sums(smoothers());
  for_each_parallel(smoothers(), smoothers() * y.values.size(), [&](std::size_t m) {
    fit(m, y, [&](std::size_t first, std::size_t count, const double* x) {
      lanes_errors(count, y.row(first), x, weights_[m].data() + first, caps.data(), sums[m].data());
    });
  });
  std::array<std::size_t, lane_tracks> best{};
  for (std::size_t m = 1; m < smoothers(); ++m) {
    for (std::size_t i = 0; i < lane_tracks; ++i) {
      if (sums[m][i] < sums[best[i]][i]) best[i] = m;
    }
  }
  return best;
}

}  // namespace kinemend::signal
