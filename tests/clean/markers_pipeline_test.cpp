// Tests of the pipeline on markers: strength, limits, selection, range, gaps and report.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kinemend/clean.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/method_options.hpp"
#include "registry/marker_takes.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// Moves every selected marker, including missing samples.
class Mover final : public Cleaner {
 public:
  explicit Mover(Vec3 shift, Action stated = Action::denoised) : shift_(shift), stated_(stated) {}
  std::string_view name() const override { return "mover"; }
  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>&) const override {
    CleanTrace trace;
    trace.noise.assign(take.tracks.size(), 0.25);
    for (std::size_t n = 0; n < take.tracks.size(); ++n) {
      if (!take.tracks[n].selected) continue;
      CleanedTrack cleaned{{}, positions_of(take.tracks[n]), {}};
      cleaned.actions.assign(take.frames, stated_);
      for (Vec3& position : cleaned.positions) position += shift_;
      sink(n, std::move(cleaned));
    }
    return trace;
  }

 private:
  Vec3 shift_;
  Action stated_;
};

class OnlyJoints final : public Cleaner {
 public:
  std::string_view name() const override { return "only-joints"; }
  CleanTrace clean(const TakeView& take, const TrackSink&,
                   const std::function<void(double)>&) const override {
    if (take.markers) throw Error(ErrorKind::usage, "this method works on joints, not on markers");
    return {};
  }
};

Take small_take() {
  Take clip = make_marker_take({"Ann:LASI", "Ann:RASI", "angle"}, 50, 100);
  clip.unit = "mm";
  clip.is_position = {1, 1, 0};
  clip.residuals.assign(150, 0.5F);
  clip.observed.assign(150, 1);
  for (std::size_t f = 0; f < 50; ++f) {
    const double x = static_cast<double>(f);
    clip.position(f, 0) = {x, 900, 0};
    clip.position(f, 1) = {x, 900, 250};
    clip.position(f, 2) = {30, 0, 0};
  }
  return clip;
}

std::string message_of(const Take& clip, const Cleaner& cleaner, const CleanSettings& settings) {
  try {
    clean_take(clip, cleaner, settings);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "no error";
}

TEST(MarkerPipeline, BlendsByStrengthAndLimit) {
  const Take clip = small_take();
  const Mover mover({8, 0, 0});
  CleanSettings settings;
  settings.strength = 0.5;
  EXPECT_EQ(clean_take(clip, mover, settings).take.position(7, 1), (Vec3{11, 900, 250}));
  settings.max_change = 3;
  EXPECT_EQ(clean_take(clip, mover, settings).take.position(7, 1), (Vec3{10, 900, 250}));
  settings.strength = 0;
  EXPECT_EQ(clean_take(clip, mover, settings).take.positions, clip.positions);
}

TEST(MarkerPipeline, ChangesWhatIsSelectedAndAPositionAlone) {
  const Take clip = small_take();
  CleanSettings settings;
  settings.joints = {"RAS?"};
  const Take right = clean_take(clip, Mover({8, 0, 0}), settings).take;
  settings.joints = {};
  settings.exclude = {"Ann:R*"};
  const Take left = clean_take(clip, Mover({8, 0, 0}), settings).take;
  for (std::size_t f = 0; f < 50; ++f) {
    EXPECT_EQ(right.position(f, 0), clip.position(f, 0));
    EXPECT_NE(right.position(f, 1), clip.position(f, 1));
    EXPECT_NE(left.position(f, 0), clip.position(f, 0));
    EXPECT_EQ(left.position(f, 1), clip.position(f, 1));
    EXPECT_EQ(left.position(f, 2), clip.position(f, 2));
  }
}

TEST(MarkerPipeline, StaysInItsRangeAndBlendsIntoIt) {
  const Take clip = small_take();
  CleanSettings settings;
  settings.range = {{20, 49}};
  const Take result = clean_take(clip, Mover({8, 0, 0}), settings).take;
  EXPECT_EQ(result.position(19, 0), clip.position(19, 0));
  EXPECT_GT(norm(result.position(20, 0) - clip.position(20, 0)), 0);
  EXPECT_LT(norm(result.position(20, 0) - clip.position(20, 0)), 1);
  EXPECT_EQ(result.position(49, 0), (clip.position(49, 0) + Vec3{8, 0, 0}));
}

TEST(MarkerPipeline, LeavesMissingSamplesAndResidualsAsTheyAre) {
  Take clip = small_take();
  lose(clip, 0, 10, 14);
  const CleanResult result = clean_take(clip, Mover({8, 0, 0}));
  EXPECT_EQ(result.take.observed, clip.observed);
  EXPECT_EQ(result.take.residuals, clip.residuals);
  EXPECT_EQ(result.report.tracks[0].gaps_left, 1U);
  EXPECT_EQ(result.report.tracks[0].frames_missing, 5U);
  EXPECT_EQ(result.report.tracks[1].gaps_left, 0U);
}

TEST(MarkerPipeline, CountsNoGapOfAPointThatIsAnAngle) {
  Take clip = small_take();
  ASSERT_FALSE(clip.holds_positions(2));
  lose(clip, 2, 10, 14);
  const CleanReport report = clean_take(clip, Mover({8, 0, 0})).report;
  EXPECT_TRUE(report.tracks[0].is_position);
  EXPECT_FALSE(report.tracks[2].is_position);
  EXPECT_EQ(report.tracks[2].gaps_left, 0U);
  EXPECT_EQ(report.tracks[2].frames_missing, 0U);
}

TEST(MarkerPipeline, ReportsInFileUnits) {
  const CleanResult result = clean_take(small_take(), Mover({3, 4, 0}, Action::despiked));
  const CleanReport& report = result.report;
  EXPECT_EQ(report.method, "mover");
  EXPECT_EQ(report.unit, "mm");
  EXPECT_EQ(report.frames, 50U);
  ASSERT_THAT(report.tracks, SizeIs(3));
  EXPECT_EQ(report.tracks[0].name, "Ann:LASI");
  EXPECT_DOUBLE_EQ(report.tracks[0].rms_change, 5);
  EXPECT_DOUBLE_EQ(report.tracks[0].max_change, 5);
  EXPECT_EQ(report.tracks[0].frames_changed, 50U);
  EXPECT_EQ(report.tracks[0].frames_repaired, 50U);
  EXPECT_EQ(report.tracks[2].frames_changed, 0U);
  EXPECT_NE(report.tracks[0].noise, 0.25) << "it is measured, and not the method's";
  ASSERT_THAT(report.spans, SizeIs(2));
  EXPECT_EQ(report.spans[1].joint, 1);
  EXPECT_EQ(report.spans[1].action, Action::despiked);
  EXPECT_EQ(report.spans[1].last_frame, 49U);
  EXPECT_THAT(report.warnings, IsEmpty());
}

TEST(MarkerPipeline, WarnsOfALostPeak) {
  Take clip = small_take();
  for (std::size_t f = 20; f < 30; ++f)
    clip.position(f, 0) += {0, 40 * static_cast<double>(f - 20), 0};
  for (std::size_t f = 30; f < 50; ++f) clip.position(f, 0) += {0, 360, 0};
  const CleanResult result = clean_take(clip, *make_gaussian({.width_s = 0.1}));
  ASSERT_THAT(result.report.warnings, SizeIs(2));
  EXPECT_THAT(result.report.warnings[1], HasSubstr("Ann:LASI: smoothing changes it by "));
  EXPECT_THAT(result.report.warnings[0], HasSubstr("Ann:LASI: peak speed falls from 4001 to "));
  EXPECT_THAT(result.report.warnings[0], HasSubstr(" mm/s ("));
}

TEST(MarkerPipeline, FillsFromWhatIsDenoised) {
  Take truth = marker_take("walk", 2);
  truth.residuals.assign(truth.positions.size(), 0.5F);
  Take clip = damaged(truth, 1, 0, 0, 5);
  lose(clip, 4, 100, 111);
  for (std::size_t f = 100; f < 112; ++f) clip.residuals[f * clip.marker_count() + 4] = -1;
  CleanSettings settings;
  settings.fill = FillSettings{};
  const CleanResult result = clean_take(clip, *make_auto(), settings);
  ASSERT_THAT(result.report.fill.gaps, SizeIs(1));
  EXPECT_TRUE(result.report.fill.gaps[0].filled) << result.report.fill.gaps[0].reason;
  for (std::size_t f = 100; f < 112; ++f) {
    ASSERT_TRUE(result.take.is_observed(f, 4));
    EXPECT_EQ(result.take.residuals[f * clip.marker_count() + 4], 0);
    EXPECT_LT(norm(result.take.position(f, 4) - truth.position(f, 4)), 10) << f;
  }
  EXPECT_EQ(result.take.residuals[99 * clip.marker_count() + 4], 0.5F);
  const auto is_filled = [](const ReportSpan& span) { return span.action == Action::filled; };
  const auto& spans = result.report.spans;
  const auto span = std::find_if(spans.begin(), spans.end(), is_filled);
  ASSERT_NE(span, spans.end());
  EXPECT_EQ(std::count_if(spans.begin(), spans.end(), is_filled), 1);
  EXPECT_EQ(span->joint, 4);
  EXPECT_EQ(span->first_frame, 100U);
  EXPECT_EQ(span->last_frame, 111U);
  EXPECT_EQ(result.report.tracks[4].gaps_left, 0U);
}

TEST(MarkerPipeline, SmoothsNoiseBeforeItFillsGaps) {
  Take clip = marker_take("walk", 2);
  lose(clip, 4, 100, 111);
  CleanSettings settings;
  settings.fill = FillSettings{};
  std::vector<std::string> stages;
  settings.progress = [&](std::string_view stage, double) {
    if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
  };
  clean_take(clip, *make_auto(), settings);
  EXPECT_THAT(stages, testing::ElementsAre("cleaning", "filling"));
}

TEST(MarkerPipeline, FillsOnlyWhatIsSelectedAndInTheRange) {
  Take clip = marker_take("walk", 2);
  lose(clip, 4, 100, 111);
  lose(clip, 6, 30, 41);
  lose(clip, 8, 100, 111);
  CleanSettings settings;
  settings.fill = FillSettings{};
  settings.exclude = {clip.names[8]};
  settings.range = {{80, 200}};
  const CleanResult result = clean_take(clip, *make_auto(), settings);
  EXPECT_TRUE(result.take.is_observed(105, 4));
  EXPECT_FALSE(result.take.is_observed(35, 6));
  EXPECT_FALSE(result.take.is_observed(105, 8));
}

TEST(MarkerPipeline, ASpikeAtTheEdgeOfAGapDoesNotBendTheFilling) {
  const Take truth = marker_take("walk", 2);
  Take clip = damaged(truth, 1, 0, 0, 6);
  lose(clip, 4, 100, 107);
  clip.position(99, 4) += {0, 200, 0};
  CleanSettings settings;
  settings.fill = FillSettings{};
  const CleanResult result = clean_take(clip, *make_auto(), settings);
  for (std::size_t f = 98; f < 110; ++f)
    EXPECT_LT(norm(result.take.position(f, 4) - truth.position(f, 4)), 15) << f;
}

TEST(MarkerPipeline, SaysWhatIsWrongWithSettings) {
  const Take clip = small_take();
  CleanSettings settings;
  settings.joints = {"Toe"};
  EXPECT_THAT(message_of(clip, Mover({}), settings), HasSubstr("no marker matches \"Toe\""));
  settings = {};
  settings.max_change = -1;
  EXPECT_THAT(message_of(clip, Mover({}), settings), HasSubstr("max_change: -1"));
  settings = {};
  settings.fill = FillSettings{};
  settings.fill->names = {"LASI"};
  EXPECT_THAT(message_of(clip, Mover({}), settings), HasSubstr("fill"));
  EXPECT_THAT(message_of(clip, OnlyJoints(), {}), HasSubstr("works on joints, not on markers"));
}

TEST(Pipeline, FillsTheGapsOfJoints) {
  SynthOptions options;
  options.duration_s = 2;
  const Take truth = synthesize(options);
  Take clip = truth;
  const std::vector<NamedGap> gaps{{truth.skeleton.names[5], 100, 109}};
  mark_gaps(clip, gaps);
  for (std::size_t f = 100; f < 110; ++f) clip.rotation(f, 5) = exp({2, 0, 0});
  CleanSettings settings;
  settings.fill = FillSettings{};
  settings.strength = 0.5;  // smoothing only: a filling is not blended with the gap's value
  const CleanResult result = clean_take(clip, *make_auto(), settings);
  ASSERT_THAT(result.report.fill.gaps, SizeIs(1));
  EXPECT_TRUE(result.report.fill.gaps[0].filled) << result.report.fill.gaps[0].reason;
  for (std::size_t f = 100; f < 110; ++f) {
    EXPECT_TRUE(result.take.is_observed(f, 5));
    EXPECT_LT(angle_between(result.take.rotation(f, 5), truth.rotation(f, 5)), 0.1) << f;
  }
}

}  // namespace
}  // namespace kinemend::test
