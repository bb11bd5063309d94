// Tests of the progress reported while a long file is read.
#include <gtest/gtest.h>

#include <vector>

#include "kinemend/io.hpp"
#include "kinemend/lab/synth.hpp"

namespace kinemend::test {
namespace {

TEST(ReadingProgress, OfALongBvhRisesToItsEnd) {
  SynthOptions options;
  options.duration_s = 10;
  const std::string bytes = write_take(synthesize(options));
  std::vector<double> shares;
  ReadOptions reading;
  reading.progress = [&](double done) { shares.push_back(done); };
  read_take(bytes, "walk.bvh", reading);
  ASSERT_GT(shares.size(), 10U);
  EXPECT_LT(shares.front(), 0.1);
  EXPECT_GT(shares.back(), 0.9);
  EXPECT_LE(shares.back(), 1);
  for (std::size_t i = 1; i < shares.size(); ++i) EXPECT_LT(shares[i - 1], shares[i]);
}

}  // namespace
}  // namespace kinemend::test
