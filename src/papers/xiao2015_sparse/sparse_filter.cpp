// Cuts poses into windows for each part of the body, codes them, and averages the results.
#include "papers/xiao2015_sparse/sparse_filter.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "methods/prior/window_bases.hpp"
#include "papers/xiao2015_sparse/descent_solver.hpp"
#include "papers/xiao2015_sparse/dual_solver.hpp"

namespace kinemend {

namespace {

using Eigen::Index;

// Windows in memory at once, and their values. Chosen by hand; docs/details/sparse.md
// states what more noise does.
constexpr std::size_t least_windows = 16, most_windows = 256, chunk_values = std::size_t{1} << 20;
constexpr double least_noise = 1e-5;  // body heights

// The windows of one poselet, a chunk of them at a time.
class PoseletFilter {
 public:
  PoseletFilter(const SparsePrior& prior, const SparsePoselet& poselet, const SparseTake& take,
                const SparseSettings& settings, std::size_t frames, double unit)
      : poselet_(poselet),
        take_(take),
        settings_(settings),
        frames_(frames),
        unit_(unit),
        dictionary_(dictionary_at_rate(poselet, prior.window_frames, frames)) {}

  // Adds the filtered windows [first, last) of `starts` to the sums of their frames.
  void filter(const std::vector<std::size_t>& starts, std::size_t first, std::size_t last,
              PoseMatrix& sums, PoseMatrix& counts) const {
    Windows windows = read(starts, first, last);
    const std::vector<double> values = solve(windows);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t frame = starts[first + i / rows()] + i % rows() / channels();
      if (frame >= take_.positions.frames) continue;
      const std::size_t channel = channel_of(i % channels());
      sums(frame, channel) += unit_ * values[i] + poselet_.mean[i % channels()];
      counts(frame, channel) += 1;
    }
  }

 private:
  struct Windows {
    std::vector<double> signals, weights;  // S x n; in units of the noise, and its deviations
    std::vector<std::uint8_t> strange;     // S: whether samples are far from the guide
    std::size_t count = 0;
  };

  std::size_t channels() const { return poselet_.channels(); }
  std::size_t rows() const { return frames_ * channels(); }
  std::size_t channel_of(std::size_t own) const {
    return 3 * static_cast<std::size_t>(poselet_.points[own / 3]) + own % 3;
  }

  // Weights are unit / noise here. Frames beyond the end repeat the last one and have no weight.
  Windows read(const std::vector<std::size_t>& starts, std::size_t first, std::size_t last) const {
    Windows windows;
    windows.count = last - first;
    windows.strange.assign(windows.count, 0);
    for (std::size_t w = first; w < last; ++w) {
      for (std::size_t i = 0; i < rows(); ++i) {
        const std::size_t wanted = starts[w] + i / channels();
        const std::size_t frame = std::min(wanted, take_.positions.frames - 1);
        const std::size_t channel = channel_of(i % channels());
        const std::size_t sample = frame * take_.positions.channels + channel;
        const bool seen =
            wanted == frame && (take_.observed.empty() || take_.observed[sample] != 0);
        const double noise = std::max(take_.noise[channel], least_noise);
        const double value = take_.positions.values[sample];
        windows.signals.push_back((value - poselet_.mean[i % channels()]) / unit_);
        windows.weights.push_back(seen ? unit_ / noise : 0);
        if (seen &&
            std::abs(value - take_.guide.values[sample]) > settings_.outlier_deviations * noise)
          windows.strange[w - first] = 1;
      }
    }
    return windows;
  }

  sparse::SparseSolution solution_of(sparse::Loss loss, const Windows& windows,
                                     const std::vector<double>& weights) const {
    const double atoms = static_cast<double>(dictionary_.atoms);
    const double largest = std::sqrt(2 * portable::log(std::max(atoms, 2.0)));
    const double lambda = settings_.lambda * largest * (loss == sparse::Loss::squares ? 2 : 1);
    const std::vector<double> lambdas(windows.count, lambda);
    const sparse::SparseProblem problem{loss, windows.signals, weights, lambdas, {}};
    if (settings_.exact) {
      sparse::DualSettings dual;
      dual.tolerance = settings_.tolerance;
      return sparse::solve_sparse(dictionary_, problem, dual);
    }
    sparse::DescentSettings descent;
    descent.tolerance = settings_.tolerance;
    return sparse::descend_sparse(dictionary_, problem, descent);
  }

  std::vector<double> solve(Windows& windows) const {
    if (settings_.loss == SparseLoss::absolute)
      return solution_of(sparse::Loss::absolute, windows, windows.weights).reconstructed;
    if (settings_.loss == SparseLoss::mixed) drop_outliers(windows);
    std::vector<double> squares = windows.weights;
    for (double& weight : squares) weight *= weight;
    return solution_of(sparse::Loss::squares, windows, squares).reconstructed;
  }

  // Removes the weight of samples far from the fit of eq. 5 to their window. Windows without
  // samples far from the guide are skipped.
  void drop_outliers(Windows& windows) const {
    Windows chosen;
    std::vector<std::size_t> numbers;
    for (std::size_t s = 0; s < windows.count; ++s) {
      if (windows.strange[s] == 0) continue;
      numbers.push_back(s);
      const auto from = static_cast<std::ptrdiff_t>(s * rows());
      const auto to = static_cast<std::ptrdiff_t>((s + 1) * rows());
      chosen.signals.insert(chosen.signals.end(), windows.signals.begin() + from,
                            windows.signals.begin() + to);
      chosen.weights.insert(chosen.weights.end(), windows.weights.begin() + from,
                            windows.weights.begin() + to);
    }
    chosen.count = numbers.size();
    if (numbers.empty()) return;
    const std::vector<double> fit =
        solution_of(sparse::Loss::absolute, chosen, chosen.weights).reconstructed;
    std::vector<double> sizes;
    for (std::size_t s = 0; s < numbers.size(); ++s) {
      sizes.clear();
      for (std::size_t i = s * rows(); i < (s + 1) * rows(); ++i) {
        if (chosen.weights[i] > 0)
          sizes.push_back(std::abs(chosen.signals[i] - fit[i]) * chosen.weights[i]);
      }
      // A large residual of the whole window is motion that the atoms cannot express, not outliers.
      const double limit =
          settings_.outlier_deviations * std::max(1.0, deviations_per_median * median_of(sizes));
      for (std::size_t i = 0; i < rows(); ++i) {
        const std::size_t own = s * rows() + i;
        if (std::abs(chosen.signals[own] - fit[own]) * chosen.weights[own] > limit)
          windows.weights[numbers[s] * rows() + i] = 0;
      }
    }
  }

  const SparsePoselet& poselet_;
  const SparseTake& take_;
  const SparseSettings& settings_;
  std::size_t frames_;
  double unit_;
  sparse::Dictionary dictionary_;
};

std::vector<std::size_t> starts_of(std::size_t frames, std::size_t window, std::size_t hops) {
  const std::size_t hop = std::max<std::size_t>(1, window / std::max<std::size_t>(hops, 1));
  std::vector<std::size_t> starts;
  for (std::size_t start = 0; start + window < frames; start += hop) starts.push_back(start);
  starts.push_back(frames > window ? frames - window : 0);
  return starts;
}

bool is_wanted(const SparsePoselet& poselet, std::span<const std::uint8_t> wanted) {
  return wanted.empty() ||
         std::any_of(poselet.points.begin(), poselet.points.end(),
                     [&](std::int32_t p) { return wanted[static_cast<std::size_t>(p)] != 0; });
}

}  // namespace

sparse::Dictionary dictionary_at_rate(const SparsePoselet& poselet, std::size_t window_frames,
                                      std::size_t frames) {
  const auto from = static_cast<Index>(window_frames), to = static_cast<Index>(frames);
  const Index shared = std::min(from, to);
  const Eigen::MatrixXd sampled = window_cosines(to, shared) *
                                  window_cosines(from, shared).transpose() /
                                  static_cast<double>(window_frames);
  const auto channels = static_cast<Index>(poselet.channels());
  sparse::Dictionary result;
  result.rows = frames * poselet.channels();
  result.atoms = poselet.dictionary.atoms;
  for (std::size_t k = 0; k < result.atoms; ++k) {
    const Eigen::Map<const Eigen::MatrixXf> atom(poselet.dictionary.atom(k).data(), channels, from);
    Eigen::MatrixXd values = atom.cast<double>() * sampled.transpose();
    const double length = values.norm();
    if (length > 0) values /= length;
    for (Index i = 0; i < values.size(); ++i)
      result.values.push_back(static_cast<float>(values.data()[i]));
  }
  return result;
}

PoseMatrix sparse_filter(const SparsePrior& prior, const SparseTake& take,
                         const SparseSettings& settings) {
  PoseMatrix local = take.positions, guide = take.guide;
  if (local.frames == 0) return local;
  const std::vector<LocalFrame> turns = local_frames(guide, prior.local);
  to_local(turns, local);
  to_local(turns, guide);
  const SparseTake own{local, guide, take.observed, take.noise, take.rate_hz, take.wanted};
  std::vector<double> levels(take.noise.begin(), take.noise.end());
  const double unit = std::max(median_of(levels), least_noise);
  const auto frames = static_cast<std::size_t>(std::max(
      2.0, std::round(static_cast<double>(prior.window_frames) * take.rate_hz / prior.rate_hz)));
  const std::vector<std::size_t> starts = starts_of(local.frames, frames, settings.hops);
  PoseMatrix sums(local.frames, local.channels), counts(local.frames, local.channels);
  for (const SparsePoselet& poselet : prior.poselets) {
    if (!is_wanted(poselet, take.wanted)) continue;
    const PoseletFilter filter(prior, poselet, own, settings, frames, unit);
    const std::size_t together =
        std::clamp(chunk_values / (frames * poselet.channels()), least_windows, most_windows);
    for (std::size_t first = 0; first < starts.size(); first += together)
      filter.filter(starts, first, std::min(starts.size(), first + together), sums, counts);
  }
  for (std::size_t i = 0; i < sums.values.size(); ++i) {
    local.values[i] = counts.values[i] > 0 ? sums.values[i] / counts.values[i] : guide.values[i];
  }
  from_local(turns, local);
  return local;
}

}  // namespace kinemend
