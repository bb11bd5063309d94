// Tests of batch orthogonal matching pursuit against a direct implementation.
#include "lab/training/ksvd.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <set>

#include "dense_algebra.hpp"
#include "papers/xiao2015_sparse/support.hpp"

namespace kinemend::sparse {
namespace {

// Direct pursuit: selects the atom nearest to the residual, then solves least squares on all
// selected atoms.
struct Pursued {
  std::vector<std::size_t> atoms;
  Eigen::VectorXd code;
  double left = 0;
};
Pursued pursue(const Dictionary& dictionary, const std::vector<float>& signal, std::size_t most,
               double residual) {
  const Eigen::MatrixXd d = matrix_of(dictionary);
  const Eigen::VectorXd z =
      Eigen::Map<const Eigen::VectorXf>(signal.data(), static_cast<Eigen::Index>(signal.size()))
          .cast<double>();
  Pursued result;
  Eigen::VectorXd left = z;
  while (result.atoms.size() < most && left.norm() > residual) {
    Eigen::Index best = 0;
    (d.transpose() * left).cwiseAbs().maxCoeff(&best);
    result.atoms.push_back(static_cast<std::size_t>(best));
    Eigen::MatrixXd chosen(d.rows(), static_cast<Eigen::Index>(result.atoms.size()));
    for (Eigen::Index i = 0; i < chosen.cols(); ++i)
      chosen.col(i) = d.col(static_cast<Eigen::Index>(result.atoms[static_cast<std::size_t>(i)]));
    result.code = test::least_squares(chosen, z);
    left = z - chosen * result.code;
  }
  result.left = left.norm();
  return result;
}

TEST(BatchOmp, ChoosesTheAtomsAndCodesOfPursuitByLeastSquares) {
  const Dictionary dictionary = random_dictionary(24, 60, 1);
  const std::vector<float> signals = random_values(24 * 300, 2);
  const SparseCodes codes = BatchOmp(dictionary).code(signals, {.most_atoms = 7});
  for (std::size_t s = 0; s < 300; ++s) {
    const std::vector<float> signal(signals.begin() + static_cast<std::ptrdiff_t>(24 * s),
                                    signals.begin() + static_cast<std::ptrdiff_t>(24 * (s + 1)));
    const Pursued expected = pursue(dictionary, signal, 7, 0);
    ASSERT_EQ(codes.counts[s], 7u);
    for (std::size_t i = 0; i < 7; ++i) {
      EXPECT_EQ(codes.atoms[7 * s + i], expected.atoms[i]) << "signal " << s;
      EXPECT_NEAR(codes.values[7 * s + i], expected.code(static_cast<Eigen::Index>(i)), 1e-4);
    }
  }
}

TEST(BatchOmp, StopsAtTheResidualThatIsEnough) {
  const Dictionary dictionary = random_dictionary(24, 60, 3);
  const std::vector<float> signals = random_values(24 * 40, 4);
  const SparseCodes codes = BatchOmp(dictionary).code(signals, {.most_atoms = 20, .residual = 1.5});
  for (std::size_t s = 0; s < 40; ++s) {
    const std::vector<float> signal(signals.begin() + static_cast<std::ptrdiff_t>(24 * s),
                                    signals.begin() + static_cast<std::ptrdiff_t>(24 * (s + 1)));
    EXPECT_EQ(codes.counts[s], pursue(dictionary, signal, 20, 1.5).atoms.size());
  }
}

TEST(BatchOmp, FindsTheCodeOfASumOfAnAtomAndEndsThere) {
  const Dictionary dictionary = random_dictionary(16, 20, 5);
  std::vector<float> signals(32, 0.0F);  // the second is zero
  for (std::size_t r = 0; r < 16; ++r) signals[r] = -3 * dictionary.atom(11)[r];
  const SparseCodes codes = BatchOmp(dictionary).code(signals, {.most_atoms = 5, .residual = 1e-2});
  ASSERT_EQ(codes.counts[0], 1u);
  EXPECT_EQ(codes.atoms[0], 11u);
  EXPECT_NEAR(codes.values[0], -3, 1e-5);
  EXPECT_EQ(codes.counts[1], 0u);
}

TEST(BatchOmp, ChoosesNoAtomTwiceNorATwin) {
  Dictionary dictionary = random_dictionary(12, 10, 6);
  std::copy_n(dictionary.atom(0).begin(), 12, dictionary.atom(1).begin());
  const std::vector<float> signals = random_values(12 * 50, 7);
  const SparseCodes codes = BatchOmp(dictionary).code(signals, {.most_atoms = 10});
  for (std::size_t s = 0; s < 50; ++s) {
    std::set<std::uint32_t> atoms;
    for (std::size_t i = 0; i < codes.counts[s]; ++i)
      EXPECT_TRUE(atoms.insert(codes.atoms[10 * s + i]).second);
    EXPECT_FALSE(atoms.contains(0) && atoms.contains(1));
    for (std::size_t i = 0; i < codes.counts[s]; ++i)
      EXPECT_TRUE(std::isfinite(codes.values[10 * s + i]));
  }
}

}  // namespace
}  // namespace kinemend::sparse
