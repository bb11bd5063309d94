// Chooses atoms one by one by the Gram matrix, with a Cholesky factor that grows with them.
#include "papers/xiao2015_sparse/batch_omp.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace kinemend::sparse {

namespace {

constexpr std::size_t block_signals = 128;  // task size
// Share of an atom's squared length outside the chosen atoms; less is rounding.
constexpr float least_new_share = 1e-6F;
constexpr float least_correlation = 1e-7F;  // of the signal's length

// The pursuit of one signal; its memory is reused for the next.
class Pursuit {
 public:
  Pursuit(std::span<const float> gram, std::size_t atoms, std::size_t most)
      : gram_(gram), atoms_(atoms), left_(atoms), factor_(most * most), code_(most), work_(most) {
    chosen_.reserve(most);
  }

  // `correlations`: K, one per atom with the signal.
  void run(std::span<const float> correlations, double energy, const OmpSettings& settings) {
    chosen_.clear();
    std::copy(correlations.begin(), correlations.end(), left_.begin());
    const double enough = settings.residual * settings.residual;
    const float floor = least_correlation * static_cast<float>(std::sqrt(energy));
    double residual = energy;
    while (chosen_.size() < code_.size() && residual > enough) {
      const std::size_t atom = largest();
      if (std::abs(left_[atom]) <= floor || !add_row(atom)) break;
      solve(correlations);
      residual = energy - explained(correlations);
      if (chosen_.size() < code_.size()) update(correlations);
    }
  }

  void store(SparseCodes& codes, std::size_t signal) const {
    codes.counts[signal] = static_cast<std::uint32_t>(chosen_.size());
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      codes.atoms[signal * codes.most + i] = static_cast<std::uint32_t>(chosen_[i]);
      codes.values[signal * codes.most + i] = code_[i];
    }
  }

 private:
  float& factor(std::size_t row, std::size_t column) {
    return factor_[row * code_.size() + column];
  }

  std::size_t largest() const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < atoms_; ++k) {
      if (std::abs(left_[k]) > std::abs(left_[best])) best = k;
    }
    return best;
  }

  // Adds a row to the Cholesky factor; false for an atom that depends on the chosen ones.
  bool add_row(std::size_t atom) {
    const std::size_t n = chosen_.size();
    float left = gram_[atom * atoms_ + atom];
    for (std::size_t i = 0; i < n; ++i) {
      if (chosen_[i] == atom) return false;
      float sum = gram_[atom * atoms_ + chosen_[i]];
      for (std::size_t j = 0; j < i; ++j) sum -= factor(i, j) * factor(n, j);
      factor(n, i) = sum / factor(i, i);
      left -= factor(n, i) * factor(n, i);
    }
    if (left <= least_new_share) return false;
    factor(n, n) = std::sqrt(left);
    chosen_.push_back(atom);
    return true;
  }

  void solve(std::span<const float> correlations) {
    const std::size_t n = chosen_.size();
    for (std::size_t i = 0; i < n; ++i) {
      float sum = correlations[chosen_[i]];
      for (std::size_t j = 0; j < i; ++j) sum -= factor(i, j) * work_[j];
      work_[i] = sum / factor(i, i);
    }
    for (std::size_t i = n; i-- > 0;) {
      float sum = work_[i];
      for (std::size_t j = i + 1; j < n; ++j) sum -= factor(j, i) * code_[j];
      code_[i] = sum / factor(i, i);
    }
  }

  double explained(std::span<const float> correlations) const {
    double sum = 0;
    for (std::size_t i = 0; i < chosen_.size(); ++i)
      sum += static_cast<double>(code_[i]) * static_cast<double>(correlations[chosen_[i]]);
    return sum;
  }

  void update(std::span<const float> correlations) {
    std::copy(correlations.begin(), correlations.end(), left_.begin());
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      const float* const row = gram_.data() + chosen_[i] * atoms_;
      const float value = code_[i];
      for (std::size_t k = 0; k < atoms_; ++k) left_[k] -= value * row[k];
    }
    for (const std::size_t atom : chosen_) left_[atom] = 0;
  }

  std::span<const float> gram_;
  std::size_t atoms_;
  std::vector<float> left_;          // K: correlations with the residual
  std::vector<float> factor_;        // lower triangle
  std::vector<float> code_, work_;   // T
  std::vector<std::size_t> chosen_;  // atoms, in their order
};

}  // namespace

BatchOmp::BatchOmp(const Dictionary& dictionary)
    : rows_(dictionary.rows),
      atoms_(dictionary.atoms),
      atoms_by_row_(nn::MatrixViewF{dictionary.values.data(), dictionary.atoms, dictionary.rows,
                                    dictionary.rows}
                        .transposed()),
      gram_(dictionary.atoms * dictionary.atoms) {
  const nn::MatrixViewF atoms{dictionary.values.data(), atoms_, rows_, rows_};
  nn::multiply_symmetric(atoms, atoms.transposed(), {gram_.data(), atoms_, atoms_, atoms_});
}

void BatchOmp::code_block(std::span<const float> signals, std::size_t first, std::size_t last,
                          const OmpSettings& settings, SparseCodes& codes) const {
  const std::size_t count = last - first;
  std::vector<float> correlations(count * atoms_);
  nn::multiply(nn::MatrixViewF{signals.data() + first * rows_, count, rows_, rows_}, atoms_by_row_,
               nn::MutableMatrixViewF{correlations.data(), count, atoms_, atoms_});
  Pursuit pursuit(gram_, atoms_, codes.most);
  for (std::size_t s = first; s < last; ++s) {
    double energy = 0;
    for (std::size_t r = 0; r < rows_; ++r) {
      const double value = signals[s * rows_ + r];
      energy += value * value;
    }
    pursuit.run({correlations.data() + (s - first) * atoms_, atoms_}, energy, settings);
    pursuit.store(codes, s);
  }
}

SparseCodes BatchOmp::code(std::span<const float> signals, const OmpSettings& settings) const {
  const std::size_t count = rows_ == 0 ? 0 : signals.size() / rows_;
  SparseCodes codes(count, std::min({settings.most_atoms, atoms_, rows_}));
  if (codes.most == 0) return codes;
  const std::size_t blocks = (count + block_signals - 1) / block_signals;
  for_each_parallel(blocks, signals.size(), [&](std::size_t b) {
    code_block(signals, b * block_signals, std::min(count, (b + 1) * block_signals), settings,
               codes);
  });
  return codes;
}

}  // namespace kinemend::sparse
