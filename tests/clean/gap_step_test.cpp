// Filling changes only the gaps of a cleaned take, whatever the method.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinemend/clean.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/take.hpp"
#include "registry/marker_takes.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

CleanSettings with_fill() {
  CleanSettings settings;
  settings.fill = FillSettings{};
  return settings;
}

class EveryWithFill : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Cleaner> cleaner_ = make_cleaner(GetParam());

  CleanResult run(const Take& clip, const CleanSettings& settings) const {
    return clean_take(clip, *cleaner_, settings);
  }
};

struct MarkerGaps {
  std::size_t marker, first, last;
};
constexpr MarkerGaps marker_gaps[] = {{4, 100, 107}, {9, 60, 89}, {14, 150, 150}, {21, 110, 199}};

// Markers with noise and a few spikes; `spikes_beside` adds one next to each gap.
Take gappy_markers(bool spikes_beside) {
  Take clip = damaged(marker_take("walk", 2), 2, 0.002, 150, 6);
  for (const auto& [marker, first, last] : marker_gaps) {
    lose(clip, marker, first, last);
    if (spikes_beside) clip.position(first - 1, marker) += {0, 200, 0};
  }
  return clip;
}

// A walk with jitter in all joints.
Take walker() {
  Take clip = synthesize({.motion = "walk", .duration_s = 2});
  Random random(3);
  for (Quat& q : clip.rotations) q = q * exp(random_vector(random, 0.5 * radians_per_degree));
  return clip;
}

Take gappy_joints(bool spikes_beside) {
  Take clip = walker();
  const std::vector<NamedGap> gaps{{clip.skeleton.names[5], 100, 109},
                                   {clip.skeleton.names[2], 60, 66},
                                   {clip.skeleton.names[0], 150, 157}};
  mark_gaps(clip, gaps);
  for (const NamedGap& gap : gaps) {
    const auto joint = static_cast<std::size_t>(clip.skeleton.find(gap.name));
    for (std::size_t f = gap.first_frame; f <= gap.last_frame; ++f) clip.rotation(f, joint) = {};
    if (spikes_beside)
      clip.rotation(gap.first_frame - 1, joint) =
          clip.rotation(gap.first_frame - 1, joint) * exp(Vec3{1.2, 0.3, 0});
  }
  return clip;
}

TEST_P(EveryWithFill, FillingGapsOfMarkersLeavesWhatWasMeasuredAsCleaningAloneMakesIt) {
  const Take clip = gappy_markers(true);
  const CleanResult alone = run(clip, {}), filled = run(clip, with_fill());
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    if (clip.observed[i] == 0) continue;
    ASSERT_EQ(filled.take.positions[i], alone.take.positions[i]) << i;
  }
  for (std::size_t m = 0; m < clip.marker_count(); ++m)
    EXPECT_EQ(filled.report.tracks[m].noise, alone.report.tracks[m].noise);
}

TEST_P(EveryWithFill, FillingGapsOfJointsLeavesWhatWasMeasuredAsCleaningAloneMakesIt) {
  const Take clip = gappy_joints(true);
  const CleanResult alone = run(clip, {}), filled = run(clip, with_fill());
  for (std::size_t i = 0; i < clip.rotations.size(); ++i) {
    if (clip.observed[i] == 0) continue;
    ASSERT_EQ(filled.take.rotations[i], alone.take.rotations[i]) << i;
  }
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    if (!clip.is_position_observed(f, 0)) continue;
    ASSERT_EQ(filled.take.root_position(f), alone.take.root_position(f)) << f;
  }
  for (std::size_t j = 0; j < clip.joint_count(); ++j)
    EXPECT_EQ(filled.report.tracks[j].noise, alone.report.tracks[j].noise);
}

TEST_P(EveryWithFill, AFillingOfMarkersRestsOnNoSpikeBesideIt) {
  const Take with = run(gappy_markers(true), with_fill()).take;
  const Take without = run(gappy_markers(false), with_fill()).take;
  for (const auto& [marker, first, last] : marker_gaps) {
    for (std::size_t f = first; f <= last; ++f) {
      ASSERT_TRUE(with.is_observed(f, marker));
      // The spike is 200 mm. Without it, one sample less is known, and its neighbours are noisy.
      EXPECT_LT(norm(with.position(f, marker) - without.position(f, marker)), 25)
          << marker << ", frame " << f;
    }
  }
}

TEST_P(EveryWithFill, AFillingOfJointsRestsOnNoSpikeBesideIt) {
  const Take clip = gappy_joints(true);
  const Take with = run(clip, with_fill()).take;
  const Take without = run(gappy_joints(false), with_fill()).take;
  for (std::size_t i = 0; i < clip.observed.size(); ++i) {
    if (clip.observed[i] != 0) continue;
    ASSERT_NE(with.observed[i], 0);
    EXPECT_LT(angle_between(with.rotations[i], without.rotations[i]), 4 * radians_per_degree) << i;
  }
}

template <class Gapped>
void expect_filled_spans(const std::vector<ReportSpan>& spans, std::size_t tracks,
                         std::size_t frames, const Gapped& is_gap) {
  for (std::size_t t = 0; t < tracks; ++t) {
    for (std::size_t f = 0; f < frames; ++f) {
      const bool stated = std::any_of(spans.begin(), spans.end(), [&](const ReportSpan& span) {
        return span.action == Action::filled && span.joint == static_cast<std::int32_t>(t) &&
               span.first_frame <= f && f <= span.last_frame;
      });
      ASSERT_EQ(stated, is_gap(f, t)) << t << ", frame " << f;
    }
  }
}

TEST_P(EveryWithFill, WhatIsFilledIsReportedAsFilled) {
  const Take markers = gappy_markers(true);
  expect_filled_spans(run(markers, with_fill()).report.spans, markers.marker_count(),
                      markers.frame_count(),
                      [&](std::size_t f, std::size_t m) { return !markers.is_observed(f, m); });
  const Take joints = gappy_joints(true);
  expect_filled_spans(run(joints, with_fill()).report.spans, joints.joint_count(),
                      joints.frame_count(),
                      [&](std::size_t f, std::size_t j) { return !joints.is_observed(f, j); });
}

// Noise and gaps as in a lab: many missing samples and considerable noise.
TEST(GapStep, MeasuresTheNoiseOnWhatWasMeasured) {
  const Take truth = marker_take("walk", 4);
  Take clip = damaged(truth, 4, 0.002, 150, 9);
  for (std::size_t f = 20; f + 60 < clip.frame_count(); f += 60) lose(clip, 4, f, f + 44);
  const CleanResult result = clean_take(clip, *make_cleaner("auto"), with_fill());
  EXPECT_NEAR(result.report.tracks[4].noise, 4, 1);
}

TEST(GapStep, MeasuresTheNoiseOfTheRootsPositionOnWhatWasMeasured) {
  Take clip = moving_take(480, 120);
  add_noise(clip, 1, 1, 5);
  std::vector<NamedGap> gaps;
  for (std::size_t f = 20; f + 60 < 480; f += 60) gaps.push_back({"Hips", f, f + 44});
  mark_gaps(clip, gaps);
  const InPlaceTrace trace = clean_in_place(*make_cleaner("auto"), clip);
  EXPECT_NEAR(trace.noise[clip.joint_count()], 1, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryWithFill, testing::ValuesIn(method_names()),
                         [](const auto& method) { return camel_case(method.param); });

}  // namespace
}  // namespace kinemend::test
