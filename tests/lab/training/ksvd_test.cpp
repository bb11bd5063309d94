// Tests of K-SVD, on signals of a known dictionary.
#include "lab/training/ksvd.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "papers/xiao2015_sparse/support.hpp"

namespace kinemend::sparse {
namespace {

// Sums of `sparsity` atoms with weights of one to two, and a little noise.
std::vector<float> sums_of(const Dictionary& dictionary, std::size_t count, std::size_t sparsity,
                           double noise, std::uint64_t seed) {
  Random random(seed);
  std::vector<float> signals(count * dictionary.rows);
  for (std::size_t s = 0; s < count; ++s) {
    for (std::size_t i = 0; i < sparsity; ++i) {
      const std::size_t atom = random.below(dictionary.atoms);
      const double weight = random.uniform(1, 2) * (random.chance(0.5) ? 1 : -1);
      for (std::size_t r = 0; r < dictionary.rows; ++r)
        signals[s * dictionary.rows + r] += static_cast<float>(weight) * dictionary.atom(atom)[r];
    }
    for (std::size_t r = 0; r < dictionary.rows; ++r)
      signals[s * dictionary.rows + r] += static_cast<float>(noise * random.normal());
  }
  return signals;
}

TEST(Ksvd, FindsTheDictionaryThatSignalsWereMadeOf) {
  const Dictionary planted = random_dictionary(20, 30, 1);
  const std::vector<float> signals = sums_of(planted, 2000, 3, 0.01, 2);
  const KsvdResult learned =
      ksvd(signals, 20, {.atoms = 30, .sparsity = 3, .iterations = 40, .seed = 3});
  ASSERT_EQ(learned.dictionary.atoms, 30u);
  const Eigen::MatrixXd products =
      (matrix_of(planted).transpose() * matrix_of(learned.dictionary)).cwiseAbs();
  const auto found = (products.rowwise().maxCoeff().array() > 0.99).count();
  EXPECT_GE(found, 25);  // of 30: the method stops in local minima; random atoms would give none
}

TEST(Ksvd, NeverRaisesTheObjectiveWhichIsThatOfItsDictionary) {
  const std::vector<float> signals = random_values(12 * 400, 4);
  const KsvdResult learned =
      ksvd(signals, 12, {.atoms = 40, .sparsity = 4, .iterations = 12, .seed = 5});
  ASSERT_EQ(learned.objective.size(), 12u);
  double energy = 0;
  for (const float value : signals) energy += static_cast<double>(value) * value;
  EXPECT_LT(learned.objective.front(), energy);
  for (std::size_t i = 1; i < learned.objective.size(); ++i)
    EXPECT_LE(learned.objective[i], learned.objective[i - 1] * (1 + 1e-6));
  EXPECT_LT(learned.objective.back(), 0.9 * learned.objective.front());
  for (std::size_t k = 0; k < 40; ++k)
    EXPECT_NEAR(matrix_of(learned.dictionary).col(static_cast<Eigen::Index>(k)).norm(), 1, 1e-5);
}

TEST(Ksvd, ReplacesTwinsAndAtomsThatNothingUses) {
  // Two distant clusters of signals; one is the same signal 200 times.
  std::vector<float> signals;
  const std::vector<float> one = random_values(10, 6), others = random_values(10 * 200, 7);
  for (std::size_t s = 0; s < 200; ++s) signals.insert(signals.end(), one.begin(), one.end());
  signals.insert(signals.end(), others.begin(), others.end());
  const KsvdResult learned =
      ksvd(signals, 10, {.atoms = 20, .sparsity = 2, .iterations = 15, .seed = 8});
  const BatchOmp products(learned.dictionary);
  std::size_t twins = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    for (std::size_t j = 0; j < i; ++j)
      twins += std::abs(products.gram()[i * 20 + j]) > 0.99 ? 1 : 0;
  }
  EXPECT_EQ(twins, 0u);
}

TEST(Ksvd, GivesTheSameBytesForTheSameSeedAndOthersForAnother) {
  const std::vector<float> signals = random_values(12 * 900, 9);
  const KsvdSettings settings{.atoms = 30, .sparsity = 3, .iterations = 3, .seed = 10};
  KsvdSettings other = settings;
  other.seed = 11;
  const Dictionary first = ksvd(signals, 12, settings).dictionary;
  EXPECT_EQ(first.values, ksvd(signals, 12, settings).dictionary.values);
  EXPECT_NE(first.values, ksvd(signals, 12, other).dictionary.values);
}

TEST(Ksvd, LearnsFromFewSignalsAndFromNone) {
  const std::vector<float> signals = random_values(8 * 3, 12);
  EXPECT_EQ(ksvd(signals, 8, {.atoms = 10, .sparsity = 2}).dictionary.atoms, 3u);
  EXPECT_EQ(ksvd({}, 8, {.atoms = 10}).dictionary.atoms, 0u);
  EXPECT_EQ(ksvd(std::vector<float>(32, 0.0F), 8, {.atoms = 10}).dictionary.atoms, 0u);
}

}  // namespace
}  // namespace kinemend::sparse
