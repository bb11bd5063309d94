// Streams of joints and of markers give the same result as each live method on the whole take.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <ostream>

#include "kinemend/error.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/live.hpp"
#include "registry/marker_takes.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

Frame frame_at(const Take& clip, std::size_t f) { return frame_of(view_of(clip), f); }

// Pushes all frames, flushes, and checks that every frame is output at its time.
std::vector<Frame> run(Stream& stream, const Take& clip) {
  std::vector<Frame> result;
  Frame out;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const bool came = stream.push(frame_at(clip, f), out);
    EXPECT_EQ(came, f >= stream.latency_frames()) << f;
    if (came) result.push_back(out);
  }
  while (stream.flush(out)) result.push_back(out);
  EXPECT_EQ(result.size(), clip.frame_count());
  EXPECT_FALSE(stream.flush(out));
  return result;
}

void expect_equal(const std::vector<Frame>& live, const Take& offline, std::size_t first = 0) {
  ASSERT_EQ(live.size(), offline.frame_count());
  double turn = 0, shift = 0;
  for (std::size_t f = first; f < live.size(); ++f) {
    for (std::size_t j = 0; j < offline.joint_count(); ++j) {
      turn = std::max(turn, angle_between(live[f].rotations[j], offline.rotation(f, j)));
    }
    for (std::size_t i = 0; i < live[f].positions.size(); ++i)
      shift = std::max(shift, norm(live[f].positions[i] - offline.position(f, i)));
  }
  EXPECT_LT(turn, 1e-12);
  EXPECT_LT(shift, 1e-10);  // for positions of about 100
}

struct NamedLive {
  std::string name;
  std::string method;
  OptionValues options;

  friend void PrintTo(const NamedLive& live, std::ostream* out) { *out << live.name; }
};

// Every method that runs live by default, and the causal forms of the others.
std::vector<NamedLive> live_methods() {
  std::vector<NamedLive> list;
  for (const std::string& name : method_names()) {
    if (make_cleaner(name)->live_support(120).runs()) list.push_back({camel_case(name), name, {}});
    for (const OptionSpec& spec : find_method(name).options) {
      if (spec.name == "causal")
        list.push_back({camel_case(name) + "Causal", name, {{"causal", true}}});
    }
  }
  list.push_back({"KalmanFilter", "kalman", {{"smoother", false}}});
  list.push_back({"KalmanPositionFilter",
                  "kalman",
                  {{"smoother", false}, {"model", std::string("position")}}});
  list.push_back({"NonlocalWindow",
                  "nonlocal",
                  {{"bandwidth_deg", 3.0}, {"window_s", 0.2}, {"patch_s", 0.05}}});
  list.push_back({"MedianOfThree", "median", {{"window_s", 0.02}}});
  return list;
}

class LiveMethod : public testing::TestWithParam<NamedLive> {
 protected:
  std::unique_ptr<Cleaner> cleaner_ = make_cleaner(GetParam().method, GetParam().options);

  Take take(std::size_t frames) const {
    Take clip = moving_take(frames, 120);
    add_noise(clip, 1.5, 0.5, 1);
    Random random(2);
    for (std::size_t f = 0; f < frames; ++f) {
      if (random.chance(0.05)) clip.rotation(f, 1) = clip.rotation(f, 1) * exp({0.6, 0.2, 0});
      if (random.chance(0.05)) clip.root_position(f) += {0, 15, 0};
      if (random.chance(0.5)) clip.rotation(f, 2) = -clip.rotation(f, 2);
    }
    return clip;
  }
  Take offline(Take clip) const {
    clean_in_place(*cleaner_, clip);
    return clip;
  }
};

TEST_P(LiveMethod, GivesWhatItGivesForTheWholeTake) {
  const Take clip = take(200);
  expect_equal(run(*make_stream(*cleaner_, clip), clip), offline(clip));
}

TEST_P(LiveMethod, GivesTheSameForTakesShorterThanItsWindow) {
  for (const std::size_t frames : {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 14}) {
    const Take clip = take(frames);
    SCOPED_TRACE(frames);
    expect_equal(run(*make_stream(*cleaner_, clip), clip), offline(clip));
  }
}

TEST_P(LiveMethod, StartsAfreshWhenReset) {
  const Take clip = take(60);
  const auto stream = make_stream(*cleaner_, clip);
  const std::vector<Frame> first = run(*stream, clip);
  stream->reset();
  const std::vector<Frame> second = run(*stream, clip);
  for (std::size_t f = 0; f < 60; ++f) {
    ASSERT_EQ(first[f].rotations, second[f].rotations) << f;
    ASSERT_EQ(first[f].positions, second[f].positions) << f;
  }
  stream->reset();
  Frame out;
  stream->push(frame_at(clip, 0), out);
  stream->reset();  // in the middle of a take
  const std::vector<Frame> third = run(*stream, clip);
  EXPECT_EQ(first[59].rotations, third[59].rotations);
}

TEST_P(LiveMethod, IsDelayedByTheSameNumberOfFramesFromTheFirstOn) {
  const Take clip = take(50);
  const auto stream = make_stream(*cleaner_, clip);
  const std::size_t latency = stream->latency_frames();
  EXPECT_EQ(latency, cleaner_->live(view_of(clip))->lookahead());
  run(*stream, clip);  // also checks each frame's time
  EXPECT_EQ(stream->latency_frames(), latency);
}

// Two takes that differ only in joint 2's missing samples from frame `begin` to `end`.
std::pair<Take, Take> unlike_where_unseen(Take a, std::size_t begin, std::size_t end) {
  Take b = a;
  a.observed.assign(a.rotations.size(), 1);
  for (std::size_t f = begin; f < end; ++f) {
    a.observed[f * a.joint_count() + 2] = 0;
    a.rotation(f, 2) = {};
    b.rotation(f, 2) = exp({0.1, 3, 0});
  }
  b.observed = a.observed;
  return {a, b};
}

TEST_P(LiveMethod, TakesNoNoticeOfJointsThatWereNotSeen) {
  const auto [a, b] = unlike_where_unseen(take(120), 60, 64);
  const auto first = run(*make_stream(*cleaner_, a), a),
             second = run(*make_stream(*cleaner_, b), b);
  for (std::size_t f = 0; f < 120; ++f) {
    ASSERT_LT(angle_between(first[f].rotations[2], second[f].rotations[2]), 1e-12) << f;
    ASSERT_LT(angle_between(first[f].rotations[2], motion_at(2, static_cast<double>(f) / 120)), 1.2)
        << f;
  }
}

TEST_P(LiveMethod, BridgesAGapOfAJointThatIsLongerThanItsWindow) {
  const auto [a, b] = unlike_where_unseen(take(180), 60, 120);
  const auto first = run(*make_stream(*cleaner_, a), a),
             second = run(*make_stream(*cleaner_, b), b);
  for (std::size_t f = 0; f < 180; ++f)
    ASSERT_LT(angle_between(first[f].rotations[2], second[f].rotations[2]), 1e-12) << f;
  const Quat before = first[58].rotations[2], after = first[121].rotations[2];
  for (std::size_t f = 60; f < 120; ++f)
    ASSERT_LT(angle_between(first[f].rotations[2], before), angle_between(before, after) + 1) << f;
}

TEST_P(LiveMethod, AGapOfOneJointChangesNoOther) {
  if (GetParam().method == "nonlocal") GTEST_SKIP() << "compares whole poses";
  const Take whole = take(120);
  Take gapped = whole;
  gapped.observed.assign(whole.rotations.size(), 1);
  for (const std::size_t f : {0, 1, 60, 61, 62, 90, 119})
    gapped.observed[f * whole.joint_count() + 2] = 0;
  const auto first = run(*make_stream(*cleaner_, whole), whole),
             second = run(*make_stream(*cleaner_, gapped), gapped);
  for (std::size_t f = 0; f < 120; ++f) {
    for (std::size_t j = 0; j < whole.joint_count(); ++j) {
      if (j == 2) continue;
      ASSERT_EQ(first[f].rotations[j], second[f].rotations[j]) << f << " " << j;
    }
    ASSERT_EQ(first[f].positions, second[f].positions) << f;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, LiveMethod, testing::ValuesIn(live_methods()),
                         [](const auto& method) { return method.param.name; });

TEST(Stream, RefusesAMethodThatNeedsTheWholeTake) {
  const Take clip = moving_take(5, 120);
  const auto wavelet = make_wavelet();
  try {
    make_stream(*wavelet, clip);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_NE(std::string(error.what()).find("needs the whole take"), std::string::npos);
  }
}

TEST(Stream, RefusesAFrameOfAnotherSkeleton) {
  const Take clip = moving_take(5, 120);
  Frame frame = frame_at(clip, 0), out;
  frame.rotations.pop_back();
  for (const char* method : {"median", "one-euro"}) {
    const auto cleaner = make_cleaner(method);
    EXPECT_THROW(make_stream(*cleaner, clip)->push(frame, out), Error);
  }
}

Take live_take() {
  Take clip = damaged(marker_take("walk", 2), 3, 0.005, 100, 1);
  clip.is_position[9] = 0;
  lose(clip, 0, 50, 60);
  lose(clip, 1, 0, 9);
  lose(clip, 2, 100, 160);
  lose(clip, 3, 200, clip.frame_count() - 1);
  lose(clip, 4, 20, 70);
  for (std::size_t f = 0; f < 40; f += 2) lose(clip, 5, f, f);
  return clip;
}

// Pushes all frames, flushes, and checks that every frame is output at its time.
Take run_markers(Stream& stream, const Take& clip) {
  Take result = clip;
  const std::size_t markers = clip.marker_count();
  std::size_t next = 0;
  Frame in, out;
  const auto take = [&] {
    for (std::size_t m = 0; m < markers; ++m) {
      result.position(next, m) = out.positions[m];
      EXPECT_EQ(out.observed[m], clip.is_observed(next, m));
    }
    ++next;
  };
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    in.positions.clear();
    in.observed.clear();
    for (std::size_t m = 0; m < markers; ++m) {
      in.positions.push_back(clip.position(f, m));
      in.observed.push_back(clip.is_observed(f, m));
    }
    const bool came = stream.push(in, out);
    EXPECT_EQ(came, f >= stream.latency_frames()) << f;
    if (came) take();
  }
  while (stream.flush(out)) take();
  EXPECT_EQ(next, clip.frame_count());
  return result;
}

class LiveOnMarkers : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Cleaner> cleaner_ = [] {
    const std::string& name = GetParam();
    if (name == "kalman") return make_cleaner(name, {{"smoother", false}});
    return make_cleaner(name);
  }();
};

TEST_P(LiveOnMarkers, GivesWhatItGivesForTheWholeTake) {
  const Take clip = live_take();
  Take offline = clip;
  clean_in_place(*cleaner_, offline);
  const auto stream = make_stream(*cleaner_, clip, body_height(clip));
  const Take first = run_markers(*stream, clip);
  EXPECT_LT(max_distance(first, offline), 1e-8);
  stream->reset();
  EXPECT_EQ(run_markers(*stream, clip).positions, first.positions);
}

INSTANTIATE_TEST_SUITE_P(Methods, LiveOnMarkers,
                         testing::Values("kalman", "one-euro", "gaussian", "median", "bilateral",
                                         "weighted-mean"),
                         [](const auto& method) { return camel_case(method.param); });

TEST(MarkerStream, RefusesWhatItCannotDo) {
  const Take clip = marker_take("walk", 0.5);
  EXPECT_THROW(make_stream(*make_cleaner("auto"), clip, 1750), Error);
  EXPECT_THROW(make_stream(*make_cleaner("nonlocal", {{"causal", true}}), clip, 1750), Error);
  Frame frame, out;
  frame.positions.resize(3);
  EXPECT_THROW(make_stream(*make_cleaner("one-euro"), clip, 1750)->push(frame, out), Error);
}

}  // namespace
}  // namespace kinemend::test
