// Iterates the dual augmented Lagrangian method and measures the gap of each signal.
#include "papers/xiao2015_sparse/dual_batch.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

namespace kinemend::sparse {

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Relaxation of the alternating directions, above 1 for fewer rounds; rounds from one measurement
// of the gap to the next, for speed. Not swept.
constexpr double over_relaxation = 1.6;
constexpr std::size_t measured_every = 10;
// Penalties are adapted only so long; the method converges once they are fixed. Chosen by hand, not
// swept.
constexpr std::size_t balanced_until = 300;
// Ratio of the two residuals from which a penalty is changed, and by how much. Chosen by hand, not
// swept.
constexpr double balance_ratio = 3, balance_factor = 2;

double clipped(double value, double size) { return std::clamp(value, -size, size); }

}  // namespace

DualBatch::DualBatch(Loss loss, std::size_t rows, std::span<const double> signals,
                     std::span<const double> weights, std::span<const double> lambdas)
    : loss_(loss),
      rows_(rows),
      count_(lambdas.size()),
      signals_(signals),
      weights_(weights),
      lambdas_(lambdas),
      penalties_(count_),
      rests_(signals.begin(), signals.end()),
      doubles_(signals.size()),
      duals_(signals.size()),
      fit_(signals.size()),
      base_(signals.size()),
      objectives_(count_),
      empty_objectives_(count_),
      primal_(count_),
      dual_(count_) {
  for (std::size_t s = 0; s < count_; ++s) {
    double size = 0, weight = 0;
    for (std::size_t i = s * rows_; i < (s + 1) * rows_; ++i) {
      size += weights_[i] > 0 ? std::abs(signals_[i]) : 0;
      weight += weights_[i];
    }
    // The penalty starts at the ratio of a residual to its multiplier.
    const double slope = loss_ == Loss::squares ? 0.5 * static_cast<double>(rows_) : size;
    penalties_[s] = slope > 0 && weight > 0 ? slope / weight : 1;
    empty_objectives_[s] = loss_of(s, true);
  }
}

void DualBatch::set_atoms(std::vector<double> atoms, const std::vector<double>& codes) {
  const bool is_first = atoms_ == 0;
  const std::size_t before = std::exchange(atoms_, rows_ == 0 ? 0 : atoms.size() / rows_);
  std::vector<double> known = std::exchange(codes_, codes);
  for (std::size_t s = 0; s < count_; ++s)
    std::copy_n(known.begin() + static_cast<std::ptrdiff_t>(s * before), before,
                codes_.begin() + static_cast<std::ptrdiff_t>(s * atoms_));
  const nn::MatrixView by_atom{atoms.data(), atoms_, rows_, rows_};
  by_atom_ = nn::PackedMatrix(by_atom);
  by_row_ = nn::PackedMatrix(by_atom.transposed());
  const auto size = static_cast<Eigen::Index>(atoms_);
  Matrix gram(size, size);
  nn::multiply_symmetric(by_atom, by_atom.transposed(), {gram.data(), atoms_, atoms_, atoms_});
  gram_ = nn::PackedMatrix(nn::MatrixView{gram.data(), atoms_, atoms_, atoms_});
  gram.diagonal().array() += 1;
  const Matrix inverse = gram.llt().solve(Matrix::Identity(size, size));
  inverse_ = nn::PackedMatrix(nn::MatrixView{inverse.data(), atoms_, atoms_, atoms_});

  correlations_.assign(count_ * atoms_, 0);
  projected_.assign(count_ * atoms_, 0);
  combined_.assign(count_ * atoms_, 0);
  bounds_.assign(count_ * atoms_, 0);
  if (is_first) start_from_codes();
  nn::multiply({doubles_.data(), count_, rows_, rows_}, by_row_,
               {bounds_.data(), count_, atoms_, atoms_});
  for (std::size_t i = 0; i < bounds_.size(); ++i)
    bounds_[i] = clipped(bounds_[i], lambdas_[i / atoms_]);
}

void DualBatch::start_from_codes() {
  nn::multiply({codes_.data(), count_, atoms_, atoms_}, by_atom_,
               {fit_.data(), count_, rows_, rows_});
  for (std::size_t i = 0; i < rests_.size(); ++i) {
    rests_[i] = signals_[i] - fit_[i];
    const double slow = rests_[i] / penalties_[i / rows_];
    doubles_[i] = loss_ == Loss::squares ? 2 * weights_[i] * rests_[i] : clipped(slow, weights_[i]);
  }
}

void DualBatch::step() {
  for (std::size_t s = 0; s < count_; ++s) {
    const double over = 1 / penalties_[s];
    for (std::size_t i = s * rows_; i < (s + 1) * rows_; ++i)
      base_[i] = over * (signals_[i] - rests_[i]) + doubles_[i];
    for (std::size_t i = s * atoms_; i < (s + 1) * atoms_; ++i)
      combined_[i] = bounds_[i] - over * codes_[i];
  }
  // y = (I + D D^T)^-1 (base + D c), by the inverse of the smaller I + D^T D.
  nn::multiply({base_.data(), count_, rows_, rows_}, by_row_,
               {projected_.data(), count_, atoms_, atoms_});
  nn::multiply({combined_.data(), count_, atoms_, atoms_}, gram_,
               {projected_.data(), count_, atoms_, atoms_}, nn::Product::add);
  nn::multiply({projected_.data(), count_, atoms_, atoms_}, inverse_,
               {correlations_.data(), count_, atoms_, atoms_});
  for (std::size_t i = 0; i < combined_.size(); ++i) combined_[i] -= correlations_[i];
  duals_ = base_;
  nn::multiply({combined_.data(), count_, atoms_, atoms_}, by_atom_,
               {duals_.data(), count_, rows_, rows_}, nn::Product::add);
  for (std::size_t s = 0; s < count_; ++s) step_signal(s);
}

// Updates the other two blocks and the multipliers, over-relaxed, and notes how far they moved.
void DualBatch::step_signal(std::size_t s) {
  const double beta = penalties_[s], lambda = lambdas_[s], over = 1 / beta;
  double apart = 0, moved = 0, multipliers = 0, sizes = 0;
  const auto note = [&](double y, double split, double before, double multiplier) {
    apart += (y - split) * (y - split);
    sizes += split * split;
    moved += (split - before) * (split - before);
    multipliers += multiplier * multiplier;
  };
  for (std::size_t i = s * atoms_; i < (s + 1) * atoms_; ++i) {
    const double before = bounds_[i];
    const double relaxed = over_relaxation * correlations_[i] + (1 - over_relaxation) * before;
    const double v = relaxed + over * codes_[i];
    bounds_[i] = clipped(v, lambda);
    codes_[i] = beta * (v - bounds_[i]);
    note(correlations_[i], bounds_[i], before, codes_[i]);
  }
  for (std::size_t i = s * rows_; i < (s + 1) * rows_; ++i) {
    const double before = doubles_[i];
    const double relaxed = over_relaxation * duals_[i] + (1 - over_relaxation) * before;
    const double u = relaxed + over * rests_[i];
    const double stiff = 2 * weights_[i] * beta;
    doubles_[i] = loss_ == Loss::squares ? u * stiff / (1 + stiff) : clipped(u, weights_[i]);
    rests_[i] = beta * (u - doubles_[i]);
    note(duals_[i], doubles_[i], before, rests_[i]);
  }
  primal_[s] = sizes > 0 ? std::sqrt(apart / sizes) : 0;
  dual_[s] = multipliers > 0 ? beta * std::sqrt(moved / multipliers) : 0;
}

void DualBatch::balance() {
  for (std::size_t s = 0; s < count_; ++s) {
    if (primal_[s] > balance_ratio * dual_[s]) penalties_[s] *= balance_factor;
    if (dual_[s] > balance_ratio * primal_[s]) penalties_[s] /= balance_factor;
  }
}

double DualBatch::loss_of(std::size_t s, bool of_zero) const {
  double sum = 0;
  for (std::size_t i = s * rows_; i < (s + 1) * rows_; ++i) {
    const double left = signals_[i] - (of_zero ? 0 : fit_[i]);
    sum += weights_[i] * (loss_ == Loss::squares ? left * left : std::abs(left));
  }
  return sum;
}

double DualBatch::gap(std::size_t s, double most) const {
  double product = 0, conjugate = 0;
  for (std::size_t i = s * rows_; i < (s + 1) * rows_; ++i) {
    product += doubles_[i] * signals_[i];
    if (loss_ == Loss::squares && weights_[i] > 0)
      conjugate += doubles_[i] * doubles_[i] / (4 * weights_[i]);
  }
  double scale = most > lambdas_[s] ? lambdas_[s] / most : 1;
  if (loss_ == Loss::squares && conjugate > 0) {
    const double largest = most > 0 ? lambdas_[s] / most : product / (2 * conjugate);
    scale = std::clamp(product / (2 * conjugate), 0.0, std::max(largest, 0.0));
  }
  return objectives_[s] - (scale * product - scale * scale * conjugate);
}

bool DualBatch::is_done(std::size_t s, double gap, double tolerance) const {
  return gap <= tolerance * std::min(objectives_[s], empty_objectives_[s]);
}

bool DualBatch::measure(double tolerance) {
  nn::multiply({codes_.data(), count_, atoms_, atoms_}, by_atom_,
               {fit_.data(), count_, rows_, rows_});
  nn::multiply({doubles_.data(), count_, rows_, rows_}, by_row_,
               {projected_.data(), count_, atoms_, atoms_});
  bool all = true;
  for (std::size_t s = 0; s < count_; ++s) {
    double most = 0, sum = 0;
    for (std::size_t i = s * atoms_; i < (s + 1) * atoms_; ++i) {
      most = std::max(most, std::abs(projected_[i]));
      sum += std::abs(codes_[i]);
    }
    objectives_[s] = loss_of(s, false) + lambdas_[s] * sum;
    all = all && is_done(s, gap(s, most), tolerance);
  }
  return all;
}

void DualBatch::iterate(const DualSettings& settings) {
  for (std::size_t i = 1; i <= settings.iterations; ++i) {
    step();
    if (i % measured_every != 0 && i != settings.iterations) continue;
    if (measure(settings.tolerance)) return;
    if (i <= balanced_until) balance();
  }
}

}  // namespace kinemend::sparse
