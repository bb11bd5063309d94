// Tests of live sessions with lost, late, duplicate, malformed and reordered frames.
#include <nlohmann/json.hpp>

#include "kinemend/error.hpp"
#include "kinemend/methods.hpp"
#include "live_run.hpp"
#include "pass_through.hpp"

namespace kinemend::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

class LiveSessionTest : public testing::Test {
 protected:
  // The output equals the parsed input.
  std::unique_ptr<Cleaner> filter_ = std::make_unique<PassThrough>();
  StreamText stream_ = stream_text(noisy_clip(30));

  static std::string numbered(std::int64_t number, const std::string& line) {
    return std::to_string(number) + " " + line;
  }
  // The frames with these numbers, for a session that reads numbers.
  std::string lines(const std::vector<int>& numbers) const {
    std::string text;
    for (const int n : numbers) text += numbered(n, stream_.frames[static_cast<std::size_t>(n)]);
    return text;
  }
  static LiveOptions with_numbers() {
    LiveOptions options;
    options.numbered = true;
    return options;
  }
  Take truth() const { return read_bvh_text(stream_.text()); }
};

TEST_F(LiveSessionTest, GivesAnUnchangedFrameBack) {
  LiveRun run(*filter_);
  run.feed(stream_.text());
  run.session.finish();
  const auto [turn, way] = difference(read_bvh_text(run.text), truth());
  EXPECT_LT(turn, digits_rad);
  EXPECT_LT(way, digits_units);
  EXPECT_EQ(run.text.substr(0, run.text.find("MOTION")),
            stream_.header.substr(0, stream_.header.find("MOTION")));
}

TEST_F(LiveSessionTest, TellsTheSkeletonAndTheDelay) {
  const auto median = make_cleaner("median");
  LiveRun run(*median);
  EXPECT_FALSE(run.session.has_skeleton());
  run.feed(stream_.header);
  EXPECT_TRUE(run.session.has_skeleton());
  EXPECT_THAT(run.session.take_notes(),
              ElementsAre("7 joints at 120 Hz: 4 frames of delay, 33.3 ms"));
  EXPECT_TRUE(run.session.take_notes().empty());
}

TEST_F(LiveSessionTest, SaysThatACutoffIsNotBelowTheNyquistFrequency) {
  const auto euro = make_cleaner("one-euro", {{"min_cutoff_hz", 60.0}});
  LiveRun run(*euro);
  run.feed(stream_.header);
  EXPECT_THAT(run.session.take_notes(),
              Contains("min_cutoff_hz: 60.0 Hz is not below the Nyquist frequency of 60.0 Hz (half "
                       "the frame rate); a pose that is held is hardly smoothed"));
  const auto below = make_cleaner("one-euro", {{"min_cutoff_hz", 59.0}});
  LiveRun below_run(*below);
  below_run.feed(stream_.header);
  EXPECT_THAT(below_run.session.take_notes(), testing::SizeIs(1));
}

TEST_F(LiveSessionTest, ReadsLinesAsSuitsEndThem) {
  std::string text = stream_.header;
  for (std::string frame : stream_.frames) {
    frame.pop_back();
    text += "0 Anna " + frame + " ||";
  }
  LiveOptions options;
  options.skipped_words = 2;
  LiveRun run(*filter_, options);
  run.feed(text, 11);
  run.session.finish();
  EXPECT_EQ(run.counts().frames_out, 30);
  EXPECT_EQ(run.counts().malformed, 0);
  EXPECT_LT(difference(read_bvh_text(run.text), truth()).first, digits_rad);
}

TEST_F(LiveSessionTest, ReadsLinesThatEndWithCarriageReturns) {
  std::string text = stream_.text();
  for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; at += 2)
    text.replace(at, 1, "\r\n");
  LiveRun run(*filter_);
  run.feed(text, 13);
  run.session.finish();
  EXPECT_EQ(run.counts().frames_out, 30);
  EXPECT_LT(difference(read_bvh_text(run.text), truth()).first, digits_rad);
}

TEST_F(LiveSessionTest, MakesUpLostFramesBetweenThoseOnEitherSide) {
  LiveRun run(*filter_, with_numbers());
  run.feed(stream_.header + lines({0, 1, 2, 6, 7}));
  run.session.finish();
  EXPECT_EQ(run.counts().lost, 3);
  EXPECT_EQ(run.counts().made_up, 3);
  EXPECT_EQ(run.counts().frames_in, 5);
  const Take clip = read_bvh_text(run.text), whole = truth();
  ASSERT_EQ(clip.frame_count(), 8);
  for (const std::size_t f : {0, 1, 2, 6, 7})
    EXPECT_LT(angle_between(clip.rotation(f, 1), whole.rotation(f, 1)), digits_rad) << f;
  EXPECT_LT(
      angle_between(clip.rotation(4, 1), slerp(whole.rotation(2, 1), whole.rotation(6, 1), 0.5)),
      digits_rad);
  EXPECT_LT(
      norm(clip.root_position(3) -
           (whole.root_position(2) + 0.25 * (whole.root_position(6) - whole.root_position(2)))),
      digits_units);
}

TEST_F(LiveSessionTest, LeavesLateAndDoubledFramesOut) {
  LiveRun run(*filter_, with_numbers());
  run.feed(stream_.header + lines({3, 4, 4, 5, 3, 4, 6}));
  run.session.finish();
  EXPECT_EQ(run.counts().doubled, 1);
  EXPECT_EQ(run.counts().late, 2);
  EXPECT_EQ(run.counts().lost, 0);
  EXPECT_EQ(run.counts().frames_out, 4);
}

TEST_F(LiveSessionTest, TakesALeapOfTheNumbersForAFreshStart) {
  LiveOptions options = with_numbers();
  options.longest_gap_s = 5.0 / 120;
  LiveRun run(*filter_, options);
  run.feed(stream_.header + lines({20, 21}) + numbered(9000, stream_.frames[22]) +
           numbered(9001, stream_.frames[23]) + lines({2, 3}));
  run.session.finish();
  EXPECT_EQ(run.counts().restarts, 2);
  EXPECT_EQ(run.counts().lost, 0);
  EXPECT_EQ(run.counts().frames_out, 6);
}

TEST_F(LiveSessionTest, GivesAMalformedLineThePlaceOfItsFrame) {
  StreamText stream = stream_;
  stream.frames[5] = "1 2 3\n";
  stream.frames[6].insert(stream.frames[6].size() - 1, " 4");
  stream.frames[7] = "1.5 2 x" + stream.frames[7];
  LiveRun run(*filter_);
  run.feed(stream.text());
  run.session.finish();
  EXPECT_EQ(run.counts().malformed, 3);
  EXPECT_EQ(run.counts().made_up, 3);
  const Take clip = read_bvh_text(run.text), whole = truth();
  ASSERT_EQ(clip.frame_count(), 30);
  EXPECT_LT(
      angle_between(clip.rotation(6, 1), slerp(whole.rotation(4, 1), whole.rotation(8, 1), 0.5)),
      digits_rad);
  EXPECT_LT(angle_between(clip.rotation(29, 1), whole.rotation(29, 1)), digits_rad);
  EXPECT_THAT(
      run.session.take_notes(),
      Contains("ignored a malformed line: expected 21 channel values, found 3 (more of them "
               "are only counted)"));
}

TEST_F(LiveSessionTest, PutsOvertakenFramesBackInTheirPlace) {
  LiveOptions options = with_numbers();
  LiveRun in_order(*filter_, options);
  in_order.feed(stream_.header + lines({0, 1, 2, 3, 4, 5, 6, 7, 8}));
  in_order.session.finish();
  options.reorder_frames = 4;
  LiveRun run(*filter_, options);
  run.feed(stream_.header + lines({0, 1, 3, 2, 7, 6, 5, 6, 4, 8}));
  EXPECT_EQ(run.lines.size(), 9) << "no frame waits once those before it have come";
  run.session.finish();
  EXPECT_EQ(run.text, in_order.text);
  EXPECT_EQ(run.counts().reordered, 4);
  EXPECT_EQ(run.counts().doubled, 1);
  EXPECT_EQ(run.counts().lost + run.counts().made_up + run.counts().late, 0);
}

TEST_F(LiveSessionTest, CountsAFrameAsLostWhenTheOthersMayWaitNoLonger) {
  LiveOptions options = with_numbers();
  options.reorder_frames = 4;
  LiveRun run(*filter_, options);
  run.feed(stream_.header + lines({0, 1, 3, 4, 5, 6}));
  EXPECT_EQ(run.lines.size(), 2);
  run.feed(lines({7}));
  EXPECT_EQ(run.lines.size(), 8);
  EXPECT_EQ(run.counts().made_up, 1);
  run.feed(lines({2}));
  EXPECT_EQ(run.counts().late, 1);
  // Silence, a returning sender, and the end release the waiting frames.
  run.feed(lines({9}));
  run.session.settle();
  EXPECT_EQ(run.lines.size(), 10);
  run.feed(lines({11}));
  run.session.drop_line();
  EXPECT_EQ(run.lines.size(), 12);
  run.feed(lines({0, 2}));
  run.session.finish();
  EXPECT_EQ(run.lines.size(), 15);
  EXPECT_EQ(run.counts().frames_out, run.counts().frames_in + run.counts().made_up);
}

TEST_F(LiveSessionTest, GivesAMalformedDatagramNoFrame) {
  LiveOptions options;
  options.datagrams = true;
  LiveRun run(*filter_, options);
  run.feed(stream_.header + stream_.frames[0]);
  for (const std::string_view garbage : {"1 2 3", "7", "\xff\xfe\x01"}) {
    run.feed(garbage);
    run.session.end_line();
  }
  run.feed(stream_.frames[1] + "1 2 3\n");
  run.session.finish();
  EXPECT_EQ(run.counts().malformed, 4);
  EXPECT_EQ(run.counts().made_up + run.counts().held + run.counts().lost, 0);
  EXPECT_EQ(run.counts().frames_out, 2);
}

TEST_F(LiveSessionTest, CountsTextThatIsNoFrameWithoutAPlace) {
  LiveRun run(*filter_);
  run.feed("GET / HTTP/1.1\r\nHost: here\r\n\r\n" + stream_.header + stream_.frames[0] + "hello\n" +
           stream_.frames[1] + std::string((1 << 20) + 1, '7') + "\n" + stream_.frames[2]);
  run.session.finish();
  EXPECT_EQ(run.counts().malformed, 4);
  EXPECT_EQ(run.counts().frames_out, 3);
}

TEST_F(LiveSessionTest, GivesAMalformedLastFrameItsPlaceToo) {
  StreamText stream = stream_;
  stream.frames.back() = "1 2 3\n";
  LiveRun run(*filter_);
  run.feed(stream.text());
  run.session.finish();
  EXPECT_EQ(run.counts().frames_out, 30);
  EXPECT_EQ(run.counts().held, 1);
}

TEST_F(LiveSessionTest, GoesOnWhenASenderComesBackWithTheSameSkeleton) {
  LiveRun run(*filter_);
  run.feed(stream_.header + stream_.frames[0] + stream_.frames[1] + "1 2 3");
  run.session.drop_line();
  run.feed(stream_.header + stream_.frames[2]);
  run.session.drop_line();
  run.feed(stream_.frames[3]);
  run.session.finish();
  EXPECT_EQ(run.counts().sessions, 1);
  EXPECT_EQ(run.headers, 1);
  EXPECT_EQ(run.counts().malformed, 0);
  EXPECT_EQ(run.counts().frames_out, 4);
}

TEST_F(LiveSessionTest, TakesNumbersThatBeginAgainBehindASenderThatCameBack) {
  LiveRun run(*filter_, with_numbers());
  run.feed(stream_.header + lines({3, 4, 5}));
  run.session.drop_line();
  run.feed(lines({0, 1, 2}));
  run.session.finish();
  EXPECT_EQ(run.counts().late, 0);
  EXPECT_EQ(run.counts().restarts, 1);
  EXPECT_EQ(run.counts().frames_out, 6);
}

TEST_F(LiveSessionTest, EndsTheOldStreamWhenAnotherSkeletonComes) {
  const auto median = make_cleaner("median");
  Take other = noisy_clip(3);
  other.skeleton.offsets[1] = {0, 11, 0};
  LiveRun run(*median);
  run.feed(stream_.text() + stream_text(other).text());
  run.session.finish();
  EXPECT_EQ(run.counts().sessions, 2);
  EXPECT_EQ(run.headers, 2);
  EXPECT_EQ(run.counts().frames_out, 33);
  // The last frames of the old stream precede the header of the new one.
  EXPECT_GT(run.text.rfind("HIERARCHY"), run.text.find(run.lines[29]));
}

TEST_F(LiveSessionTest, PassesOverAHeaderThatIsNone) {
  LiveRun run(*filter_);
  run.feed(
      "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0\n}\nMOTION\nFrames: 1\nFrame Time: 0.01\n1 2 3\n");
  EXPECT_EQ(run.counts().bad_headers, 1);
  EXPECT_FALSE(run.session.has_skeleton());
  EXPECT_THAT(run.session.take_notes(), Contains(HasSubstr("header:5:")));
  run.feed(stream_.text());
  run.session.finish();
  EXPECT_EQ(run.counts().frames_out, 30);
}

TEST_F(LiveSessionTest, GoesOnWithFramesBehindAHeaderThatLostItsEnd) {
  LiveRun run(*filter_);
  run.feed(stream_.header + stream_.frames[0] + stream_.header.substr(0, 100) + "\n" +
           stream_.frames[1] + stream_.frames[2]);
  run.session.finish();
  EXPECT_EQ(run.counts().bad_headers, 1);
  EXPECT_EQ(run.counts().frames_out, 3);
}

TEST_F(LiveSessionTest, TakesTheSkeletonAndTheRateThatItIsGiven) {
  LiveOptions options;
  options.skeleton = stream_.text();
  options.frame_rate_hz = 60;
  LiveRun run(*filter_, options);
  for (const std::string& frame : stream_.frames) run.feed(frame);
  run.session.finish();
  EXPECT_EQ(run.session.frame_rate_hz(), 60);
  EXPECT_THAT(run.text, HasSubstr("Frame Time: 0.016667\n"));
  EXPECT_EQ(read_bvh_text(run.text).frame_count(), 30);
}

TEST_F(LiveSessionTest, HoldsTheLastFrameWhileNothingComes) {
  LiveRun run(*filter_, with_numbers());
  run.session.hold();
  EXPECT_EQ(run.counts().held, 0);
  run.feed(stream_.header + lines({0, 1}));
  run.session.hold();
  run.session.hold();
  EXPECT_EQ(run.lines.size(), 4);
  EXPECT_EQ(run.lines[3], run.lines[1]);
  // Three frames were lost, and two of them are output already.
  run.feed(lines({5, 6}));
  run.session.finish();
  EXPECT_EQ(run.counts().lost, 3);
  EXPECT_EQ(run.counts().made_up, 1);
  EXPECT_EQ(run.counts().frames_out, 7);
}

TEST_F(LiveSessionTest, BlendsByStrength) {
  const auto gaussian = make_cleaner("gaussian");
  const auto run_with = [&](double strength) {
    LiveOptions options;
    options.strength = strength;
    LiveRun run(*gaussian, options);
    run.feed(stream_.text());
    run.session.finish();
    return read_bvh_text(run.text);
  };
  const Take none = run_with(0), half = run_with(0.5), all = run_with(1);
  EXPECT_LT(difference(none, truth()).first, digits_rad);
  EXPECT_LT(angle_between(half.rotation(9, 1), slerp(none.rotation(9, 1), all.rotation(9, 1), 0.5)),
            digits_rad);
  EXPECT_GT(angle_between(half.rotation(9, 1), all.rotation(9, 1)), 1e-3);
}

TEST_F(LiveSessionTest, WritesLinesOfJson) {
  LiveOptions options = with_numbers();
  options.format = LiveFormat::jsonl;
  LiveRun run(*filter_, options);
  run.feed(stream_.header + lines({4, 5, 7}));
  run.session.finish();
  const auto header = nlohmann::json::parse(run.text.substr(0, run.text.find('\n')));
  EXPECT_EQ(header["kinemend"], "live/1");
  EXPECT_EQ(header["frame_rate_hz"], 120);
  EXPECT_EQ(header["joints"][2], "LeftArm");
  EXPECT_EQ(header["parents"][0], -1);
  EXPECT_EQ(header["translated"], nlohmann::json({6}));
  ASSERT_EQ(run.lines.size(), 4);
  const Take whole = truth();
  for (const std::size_t i : {0, 1, 3}) {
    const auto frame = nlohmann::json::parse(run.lines[i]);
    const std::size_t f = i + 4;
    EXPECT_EQ(frame["frame"], f);
    const auto q = frame["rotations"][2].get<std::vector<double>>();
    EXPECT_LT(angle_between(whole.rotation(f, 2), normalized({q[0], q[1], q[2], q[3]})),
              digits_rad);
    EXPECT_NEAR(frame["root"][1].get<double>(), whole.root_position(f).y, digits_units);
    EXPECT_NEAR(frame["translations"][0][2].get<double>(), whole.position(f, 1).z, digits_units);
  }
}

TEST_F(LiveSessionTest, RefusesWhatMakesNoSense) {
  const auto refused = [](const Cleaner& cleaner, const LiveOptions& options) {
    try {
      LiveSession(cleaner, options, [](const LivePiece&) {});
      return std::string("no error");
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  LiveOptions options;
  options.strength = 2;
  EXPECT_THAT(refused(*filter_, options), HasSubstr("strength"));
  options = {};
  options.skeleton = "no BVH";
  EXPECT_THAT(refused(*filter_, options), HasSubstr("skeleton:1: expected HIERARCHY"));
  EXPECT_THAT(refused(*make_cleaner("wavelet"), {}), HasSubstr("needs the whole take"));
}

}  // namespace
}  // namespace kinemend::test
