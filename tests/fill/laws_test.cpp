// Properties of every method of filling gaps, for joints and for markers.
#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>
#include <ostream>
#include <set>
#include <string>

#include "fill/made_gaps.hpp"
#include "fill/marker_takes.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/lab/synth.hpp"
#include "motion/clips.hpp"

namespace kinemend::fill {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

struct Case {
  std::string method;
  bool joints = false;
};

void PrintTo(const Case& tried, std::ostream* out) {
  *out << tried.method << (tried.joints ? " of joints" : " of markers");
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const FillMethod& method : fill_methods()) {
    if (method.learned) continue;
    if (method.joints) all.push_back({std::string(method.name), true});
    if (method.markers) all.push_back({std::string(method.name), false});
  }
  return all;
}

struct Taken {
  Take truth;
  std::vector<std::string> names;  // of four tracks; the first two belong to one segment
};

// Markers sway, so that no prediction is exact.
Taken moving(bool joints) {
  if (joints) return {test::moving_chain(6, 500), {"joint1", "joint3", "root", "joint4"}};
  return {marker_take("walk", 5, 0.8), {"LeftLeg_b", "LeftLeg_c", "Head_a", "LeftFoot_a"}};
}

Take damaged(const Taken& take) {
  Take clip = take.truth;
  hide(clip, take.names[0], 200, 223);
  hide(clip, take.names[0], 400, 430);
  hide(clip, take.names[1], 410, 450);
  hide(clip, take.names[2], 210, 240);
  return spoilt(clip);
}

FillReport fill_by(Take& clip, const std::string& method) {
  FillSettings settings;
  settings.method = method;
  settings.fill_all = true;
  if (method == "pattern") settings.donor = "LeftLeg_a";
  return fill_gaps(clip, settings);
}

void expect_observed_joints_equal(const Take& before, const Take& after) {
  for (std::size_t i = 0; i < after.rotations.size(); ++i) {
    if (before.observed[i]) {
      ASSERT_EQ(after.rotations[i], before.rotations[i]);
    }
  }
  for (std::size_t f = 0; f < after.frame_count(); ++f) {
    if (before.is_position_observed(f, 0)) {
      ASSERT_EQ(after.root_position(f), before.root_position(f));
    }
  }
  EXPECT_THAT(find_position_gaps(after), IsEmpty());
}
void expect_observed_equal(const Take& before, const Take& after) {
  if (before.has_joints()) return expect_observed_joints_equal(before, after);
  for (std::size_t i = 0; i < after.positions.size(); ++i) {
    if (before.observed[i]) {
      ASSERT_EQ(after.positions[i], before.positions[i]);
    }
    ASSERT_EQ(after.residuals[i], before.observed[i] ? before.residuals[i] : 0);
  }
}

// Moves the take to another place; markers also get another unit, joints other signs.
const Quat turn = exp(Vec3{0.4, -1.1, 0.7});
constexpr double growth = 10;
void move(Take& clip) {
  for (std::size_t i = 0; i < clip.rotations.size(); ++i)
    clip.rotations[i] = (i % 3 == 0 ? -1.0 : 1.0) * (turn * clip.rotations[i]);
  if (clip.has_joints()) return;
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    if (clip.observed[i])
      clip.positions[i] = growth * rotate(turn, clip.positions[i]) + Vec3{3000, -500, 70};
  }
}

// Largest jump or kink over a span's ends and within the whole take; file units or degrees.
double kink(const Take& clip, std::size_t track, const std::vector<std::size_t>& frames) {
  double largest = 0;
  for (const std::size_t f : frames) {
    const Vec3 change = step_vector(clip, f, track) - step_vector(clip, f - 1, track);
    largest = std::max(largest, norm(change));
  }
  return largest;
}

// Largest step from one frame to the next.
double step(const Take& clip, std::size_t track, const std::vector<std::size_t>& frames) {
  double largest = 0;
  for (const std::size_t f : frames) largest = std::max(largest, norm(step_vector(clip, f, track)));
  return largest;
}

class Laws : public testing::TestWithParam<Case> {
 protected:
  // Checks the law on a take of the case's kind.
  template <class Law>
  static void hold(const Law& law) {
    law(moving(GetParam().joints));
  }
  static const std::string& method() { return GetParam().method; }
};

class LawsOfMarkers : public Laws {};
class LawsOfSpikes : public Laws {};

std::string name_of_case(const testing::TestParamInfo<Case>& tried) {
  std::string name = (tried.param.joints ? "joints_" : "markers_") + tried.param.method;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::vector<Case> cases_of_markers() {
  std::vector<Case> all = cases();
  std::erase_if(all, [](const Case& tried) { return tried.joints; });
  return all;
}

// Methods that detect spikes beside a gap.
std::vector<Case> cases_of_spikes() {
  static const std::set<std::string> able{"auto", "spline", "pchip", "local-regression", "pca"};
  std::vector<Case> all = cases();
  std::erase_if(all, [](const Case& tried) {
    return !able.contains(tried.method) || (tried.method == "pchip" && !tried.joints);
  });
  return all;
}

INSTANTIATE_TEST_SUITE_P(Methods, Laws, testing::ValuesIn(cases()), name_of_case);
INSTANTIATE_TEST_SUITE_P(Methods, LawsOfMarkers, testing::ValuesIn(cases_of_markers()),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(Methods, LawsOfSpikes, testing::ValuesIn(cases_of_spikes()), name_of_case);

TEST_P(Laws, ObservedSamplesStayToTheBit) {
  hold([&](const auto& take) {
    const auto before = damaged(take);
    auto clip = before;
    const FillReport report = fill_by(clip, method());
    EXPECT_EQ(report.refused(), 0U);
    clip.validate();
    EXPECT_THAT(find_gaps(clip), IsEmpty());
    expect_observed_equal(before, clip);
  });
}

// For joints, `slerp` and `pchip` meet the ends in value only: the corner there is at most as large
// as the largest step of the motion (measured: 0.87 of it).
TEST_P(Laws, FilledSpanMeetsItsEndsInValueAndVelocity) {
  hold([&](const auto& take) {
    const bool joints = GetParam().joints;
    const bool has_corners = joints && (method() == "slerp" || method() == "pchip");
    auto clip = damaged(take);
    const FillReport report = fill_by(clip, method());
    ASSERT_GE(report.gaps.size(), 4u);
    for (const GapOutcome& outcome : report.gaps) {
      if (outcome.is_position) continue;
      ASSERT_TRUE(outcome.filled) << outcome.reason;
      const auto& [track, first, last] = outcome.gap;
      // A jump of value or velocity appears as a second difference larger than any of the motion.
      std::vector<std::size_t> all(take.truth.frame_count() - 2);
      std::iota(all.begin(), all.end(), std::size_t{1});
      const double bound = has_corners ? step(take.truth, track, all)
                                       : (joints ? 6 : 4) * kink(take.truth, track, all);
      EXPECT_LT(kink(clip, track, {first - 1, first, last, last + 1}), bound + 0.05)
          << "track " << track << ", gap " << first << " to " << last;
    }
  });
}

TEST_P(Laws, FillsAtTheEndsOfTheTake) {
  hold([&](const auto& take) {
    auto clip = take.truth;
    const std::size_t end = clip.frame_count() - 1;
    hide(clip, take.names[3], 0, 4);
    hide(clip, take.names[3], end - 3, end);
    clip = spoilt(clip);
    const FillReport report = fill_by(clip, method());
    ASSERT_EQ(report.gaps.size(), 2u);
    for (const GapOutcome& outcome : report.gaps) {
      ASSERT_TRUE(outcome.filled) << outcome.reason;
      EXPECT_LT(rms_error(take.truth, clip, outcome.gap), 8);  // degrees, centimetres
    }
  });
}

TEST_P(Laws, ATrackThatIsNeverObservedIsRefused) {
  hold([&](const auto& take) {
    auto clip = take.truth;
    hide(clip, take.names[0], 0, clip.frame_count() - 1);
    const FillReport report = fill_by(clip, method());
    ASSERT_EQ(report.refused(), 1U);
    EXPECT_EQ(report.gaps[0].reason,
              GetParam().joints ? "none of its samples is observed" : "the marker is never seen");
  });
}

TEST_P(Laws, NothingIsDoneWhereNothingIsMissing) {
  hold([&](const auto& take) {
    auto clip = take.truth;
    EXPECT_THAT(fill_by(clip, method()).gaps, IsEmpty());
  });
}

TEST_P(Laws, OnlyTracksThatAreNamedAreFilled) {
  hold([&](const auto& take) {
    auto clip = damaged(take);
    FillSettings settings;
    settings.method = method();
    settings.fill_all = true;
    if (method() == "pattern") settings.donor = "LeftLeg_a";
    settings.names = {"*" + take.names[1].substr(1)};
    const FillReport report = fill_gaps(clip, settings);
    ASSERT_EQ(report.gaps.size(), 1U);
    EXPECT_EQ(name_of(clip, report.gaps[0].gap.track), take.names[1]);
    EXPECT_EQ(find_gaps(clip).size(), 3U);
  });
}

TEST_P(Laws, ResultDoesNotDependOnTheNumberOfThreads) {
  hold([&](const auto& take) {
    auto clip = damaged(take), other = damaged(take);
    fill_by(clip, method());
    const ThreadLimit one(1);
    fill_by(other, method());
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      for (const std::string& name : take.names)
        EXPECT_EQ(distance(clip, other, f, track_of(clip, name)), 0);
    }
  });
}

TEST_P(Laws, ResultMovesTurnsAndGrowsWithTheTake) {
  hold([&](const auto& take) {
    auto clip = damaged(take), other = clip;
    move(other);
    const FillReport report = fill_by(clip, method()), other_report = fill_by(other, method());
    move(clip);
    double largest = 0;
    for (const GapOutcome& outcome : report.gaps) {
      if (!outcome.is_position) largest = std::max(largest, rms_error(clip, other, outcome.gap));
    }
    const bool joints = GetParam().joints;
    // PCHIP keeps the shape of each component separately; end velocities are also estimated
    // robustly.
    const bool robust = method() == "hermite" || method() == "pattern" || method() == "cyclic";
    EXPECT_LT(largest, joints ? 1e-4 : method() == "pchip" ? 20.0 : robust ? 0.2 : 1e-4);
    for (std::size_t g = 0; g < report.gaps.size(); ++g) {
      EXPECT_NEAR(other_report.gaps[g].expected_error,
                  (joints ? 1 : growth) * report.gaps[g].expected_error, 1e-4);
    }
  });
}

// The sample next to a gap has no neighbour on its other side that would reveal it as a spike.
TEST_P(LawsOfSpikes, ASpikeBesideAGapDoesNotBendTheFilling) {
  const auto law = [&](const auto& truth, const std::string& name, const auto& spike) {
    for (const std::size_t length : {3U, 8U, 12U, GetParam().joints ? 25U : 40U}) {
      for (const bool before : {true, false}) {
        auto clip = truth;
        hide(clip, name, 200, 199 + length);
        auto spiked = clip;
        spike(spiked, before ? 199 : 200 + length, track_of(clip, name));
        fill_by(clip, method());
        const GapOutcome outcome = fill_by(spiked, method()).gaps[0];
        EXPECT_LT(rms_error(truth, spiked, outcome.gap),
                  3 * rms_error(truth, clip, outcome.gap) + (GetParam().joints ? 2 : 1))
            << length << " frames, " << (before ? "before" : "behind");
      }
    }
  };
  if (GetParam().joints) {
    const Take truth = synthesize({.motion = "walk", .duration_s = 4});
    law(truth, truth.skeleton.names[3], [](Take& clip, std::size_t f, std::size_t joint) {
      clip.rotation(f, joint) = clip.rotation(f, joint) * exp(Vec3{0.8, 0.3, 0});
    });
  } else {
    law(marker_take("walk", 4, 0.5), "LeftLeg_b",
        [](Take& clip, std::size_t f, std::size_t marker) {
          clip.position(f, marker) += Vec3{15, 5, 0};
        });
  }
}

TEST_P(LawsOfMarkers, OrderOfMarkersDoesNotMatter) {
  Take clip = damaged(moving(false));
  const std::size_t markers = clip.marker_count();
  std::vector<std::size_t> order(markers);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::rotate(order.begin(), order.begin() + 17, order.end());
  std::swap(order[3], order[30]);
  Take other = clip;
  for (std::size_t m = 0; m < markers; ++m) {
    other.names[m] = clip.names[order[m]];
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      other.position(f, m) = clip.position(f, order[m]);
      other.observed[f * markers + m] = clip.observed[f * markers + order[m]];
    }
  }
  fill_by(clip, method());
  fill_by(other, method());
  double largest = 0;
  for (std::size_t m = 0; m < markers; ++m) {
    for (std::size_t f = 0; f < clip.frame_count(); ++f)
      largest = std::max(largest, norm(other.position(f, m) - clip.position(f, order[m])));
  }
  EXPECT_LT(largest, 1e-5);
}

std::string complaint(const Take& take, const FillSettings& settings) {
  Take clip = take;
  try {
    fill_gaps(clip, settings);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "no error";
}

TEST(Fill, SaysWhichMethodTrackOrDonorThereIsNot) {
  const Take markers = marker_take("walk", 0.5);
  const Take joints = test::moving_chain(3, 30);
  FillSettings settings;
  settings.method = "magic";
  EXPECT_THAT(complaint(markers, settings),
              HasSubstr("expected a method for markers (auto, spline"));
  settings.method = "slerp";
  EXPECT_THAT(complaint(markers, settings), HasSubstr("found \"slerp\""));
  settings.method = "rigid-body";
  EXPECT_THAT(complaint(joints, settings), HasSubstr("expected a method for joints (auto, slerp"));
  settings.method = "pattern";
  EXPECT_THAT(complaint(markers, settings), HasSubstr("needs a donor"));
  settings.donor = "Tail";
  EXPECT_THAT(complaint(markers, settings), HasSubstr("no donor \"Tail\""));
  settings = {};
  settings.names = {"tail"};
  EXPECT_THAT(complaint(markers, settings), HasSubstr("no marker matches \"tail\""));
  EXPECT_EQ(complaint(joints, settings),
            "no joint matches \"tail\" (the joints are root, joint1, joint2)");
}

}  // namespace
}  // namespace kinemend::fill
