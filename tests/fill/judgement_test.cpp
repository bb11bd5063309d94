// Tests of the judgement of candidates for a gap: weights and expected errors calculated by hand,
// and the places of trials.
#include "fill/judgement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "fill/methods.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/take.hpp"

namespace kinemend::fill {
namespace {

constexpr auto model = CandidateKind::model;
constexpr auto spline = CandidateKind::spline;
constexpr auto line = CandidateKind::line;

// Candidates with these errors along x in each of three frames.
Eigen::MatrixXd errors(const std::vector<double>& along_x) {
  Proposals proposals;
  for (const double x : along_x) proposals.push_back({{x, 0, 0}, {x, 0, 0}, {x, 0, 0}});
  return products_of(proposals);
}

TEST(Judgement, ProductsAreMeansOverTheFrames) {
  const Eigen::MatrixXd products = products_of({{{1, 2, 2}, {0, -1, 0}}, {{3, 0, 0}, {0, 3, 0}}});
  EXPECT_NEAR(products(0, 0), (9 + 1) / 2.0, 1e-12);
  EXPECT_NEAR(products(1, 1), (9 + 9) / 2.0, 1e-12);
  EXPECT_NEAR(products(0, 1), (3 - 3) / 2.0, 1e-12);
}

TEST(Judgement, WeighsByTheInverseFourthPowerOfErrorsAndNeverTheLine) {
  const auto trial = errors({1, -2, 5});
  const Judgement judgement({model, model, line}, trial, {{trial, trial}}, 0);
  const std::vector<double> weights = judgement.weights(clearly_better);
  EXPECT_NEAR(weights[0] / weights[1], 16, 1e-9);
  EXPECT_EQ(weights[2], 0);
  EXPECT_NEAR(weights[0] + weights[1], 1, 1e-12);
}

TEST(Judgement, AGapInWhichCandidatesDifferAsInTheTrialsPromisesALittleMoreThanTheirError) {
  const auto trial = errors({1, -1, 5});
  const Judgement judgement({model, model, line}, trial, {{trial, trial, trial}, 1}, 0);
  const double expected = judgement.expected_error(std::vector<double>{1, 0, 0});
  EXPECT_GT(expected, 1);
  EXPECT_LT(expected, 1.5);
}

TEST(Judgement, CandidatesThatDifferMoreThanInTheTrialsPromiseMore) {
  const std::vector<double> weights{1, 0, 0};
  const auto trial = errors({1, -1, 5});
  const auto expected = [&](double farther) {
    const auto gap = errors({farther, -farther, farther + 4});  // as far from the line
    return Judgement({model, model, line}, gap, {{trial, trial, trial}, 1}, 0)
        .expected_error(weights);
  };
  EXPECT_NEAR(expected(4) / expected(1), std::pow(4, 0.5), 1e-9);
  EXPECT_NEAR(expected(1) / expected(0.5), std::pow(2, 0.5), 1e-9);
}

TEST(Judgement, AGapThatTurnsFartherThanTheTrialsPromisesMoreAndAStraightOneNoLess) {
  const std::vector<double> weights{1, 0, 0};
  const auto trial = errors({1, -1, 5});
  const auto expected = [&](double from_the_line) {
    const auto gap = errors({1, -1, 1 + from_the_line});
    return Judgement({model, model, line}, gap, {{trial, trial, trial}, 1}, 0)
        .expected_error(weights);
  };
  EXPECT_NEAR(expected(40) / expected(4), std::pow(10, 0.3), 1e-9);
  EXPECT_NEAR(expected(1), expected(4), 1e-9);
}

TEST(Judgement, LongerGapsAndEndsOfTheTakePromiseMore) {
  const std::vector<double> weights{1, 0, 0};
  const auto trial = errors({1, -1, 5});
  const auto expected = [&](double longer, bool at_end) {
    return Judgement({model, model, line}, trial, {{trial}, longer, at_end}, 0)
        .expected_error(weights);
  };
  EXPECT_NEAR(expected(4, false) / expected(1, false), 2, 1e-9);
  EXPECT_GT(expected(1, true), 1.2 * expected(1, false));
}

TEST(Judgement, TheSplineGoesBeforeModelsThatWereALittleBetter) {
  const auto trial = errors({0.7, 0.8, 1, 5});
  const Judgement judgement({model, model, spline, line}, trial, {{trial, trial, trial}, 1}, 0);
  const std::vector<double> weights = judgement.weights(clearly_better);
  EXPECT_GT(weights[2], 0.5);
  const auto clear = errors({0.2, 0.3, 1, 5});
  const Judgement other({model, model, spline, line}, clear, {{clear, clear, clear}, 1}, 0);
  EXPECT_LT(other.weights(clearly_better)[2], 0.1);
}

TEST(Judgement, OneTrialThatWentAstraySaysNothingAgainstTheSpline) {
  const auto usual = errors({1, 1.1, 0.5, 5}), astray = errors({1, 1.1, 20, 5});
  const Judgement judgement({model, model, spline, line}, usual, {{usual, usual, usual, astray}, 1},
                            0);
  EXPECT_GT(judgement.weights(clearly_better)[2], 0.5);
  // The failed trial still raises the expected error.
  EXPECT_GT(judgement.expected_error(std::vector<double>{0, 0, 1, 0}), 4);
}

TEST(TrialPlaces, AreSeenThroughoutAndLieAboutTheGapAndElsewhere) {
  std::vector<std::uint8_t> usable(1000, 1);
  const FrameSpan gap{400, 419};
  std::fill(usable.begin() + 400, usable.begin() + 420, 0);
  std::fill(usable.begin() + 440, usable.begin() + 450, 0);
  const std::vector<FrameSpan> spans = trial_places(usable, 0, gap);
  ASSERT_EQ(spans.size(), 9U);
  std::size_t near = 0;
  for (const FrameSpan span : spans) {
    EXPECT_EQ(span.length(), 20U);
    for (std::size_t f = span.first - 1; f <= span.last + 1; ++f) EXPECT_EQ(usable[f], 1) << f;
    near += span.first > 300 && span.last < 520;
  }
  EXPECT_GE(near, 6U);
  // One frame lies between, so that the gap's end and the trial's end are different samples.
  EXPECT_EQ(spans[0].last, 398U);
}

TEST(TrialPlaces, AreShorterWhereThereIsNoRoomAndNoneWhereThereIsNone) {
  std::vector<std::uint8_t> usable(100, 1);
  std::fill(usable.begin() + 20, usable.begin() + 80, 0);
  const std::vector<FrameSpan> spans = trial_places(usable, 0, {20, 79});
  ASSERT_FALSE(spans.empty());
  EXPECT_EQ(spans[0].length(), 15U);
  EXPECT_TRUE(trial_places(std::vector<std::uint8_t>(100, 0), 0, {20, 79}).empty());
}

// A hidden span gives the same result as a missing span: its samples are ignored.
TEST(HiddenSpan, IsAsAGapOfTheTake) {
  const Take clip = synthesize({.motion = "stroll", .duration_s = 4});
  const std::size_t joint = 5;
  const Track whole = rotation_track(clip, joint);
  const PoseRegression poses(clip);
  const JointContext context{clip.frame_rate_hz, poses, 1};
  for (const std::size_t first : {60U, 200U, 333U}) {
    const FrameSpan span{first, first + 11};
    Take gapped = clip;
    const NamedGap gap{clip.skeleton.names[joint], span.first, span.last};
    mark_gaps(gapped, {&gap, 1});
    Track missing = rotation_track(gapped, joint);
    Track hidden = hide_span(whole, span, {}, 100, clip.frame_rate_hz);
    const std::size_t shift = hidden.first_frame;
    for (const char* name : {"slerp", "spline", "pchip", "squad"}) {
      const Method& method = find_method(name, true);
      ASSERT_TRUE(fill_joint(method, missing, span, context));
      ASSERT_TRUE(fill_joint(method, hidden, within(hidden, span), context));
      for (std::size_t f = span.first; f <= span.last; ++f) {
        EXPECT_LT(angle_between(missing.rotation(f), hidden.rotation(f - shift)), 1e-9)
            << name << ", frame " << f;
      }
    }
  }
}

}  // namespace
}  // namespace kinemend::fill
