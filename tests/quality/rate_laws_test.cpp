// Tests over every valid frame rate: results are finite, and their cost depends on the number of
// frames, not on the rate.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <ostream>

#include "counting_allocation.hpp"
#include "kinemend/check.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/lab/train.hpp"
#include "kinemend/live.hpp"
#include "kinemend/metrics.hpp"
#include "registry/marker_takes.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

constexpr double rates_hz[] = {0.1, 1, 10, 1e3, 5e3, 1e5};
constexpr std::size_t few_frames = 40, more_frames = 200;

Take made_walk(std::size_t frames) {
  SynthOptions options;
  options.duration_s = static_cast<double>(frames) / 120;
  Take clip = slice(synthesize(options), 0, frames);
  Random random(5);
  apply_damage(clip, "gaussian", {{"std_deg", 1.5}}, random);
  apply_damage(clip, "outliers", {{"share", 0.004}}, random);
  return clip;
}

Take walk(std::size_t frames, double rate_hz) {
  static const Take few = made_walk(few_frames), more = made_walk(more_frames);
  Take clip = frames == few_frames ? few : more;
  clip.frame_rate_hz = rate_hz;
  return clip;
}

Take walk_of_markers(std::size_t frames, double rate_hz) {
  static const Take more =
      damaged(marker_take("walk", static_cast<double>(more_frames) / 120), 3, 0.003, 100, 1);
  Take clip = slice(more, 0, frames);
  clip.frame_rate_hz = rate_hz;
  return clip;
}

// Bytes allocated in total and at peak; zero under sanitizers.
struct Cost {
  std::size_t taken = 0, peak = 0;
};

Cost cost_of(const std::function<void()>& action) {
  const std::size_t before = memory_taken;
  const std::size_t peak = peak_memory(action);
  return {memory_taken - before, peak};
}

// Expects that `run(frames, rate)` costs about the same at every rate.
void expect_cost_by_frames(const std::function<void(std::size_t, double)>& run,
                           const std::vector<std::size_t>& sizes = {few_frames, more_frames}) {
  // With several threads, the system decides how many hold memory at a time.
  const ThreadLimit one_thread(1);
  for (const std::size_t frames : sizes) {
    run(frames, 120);  // fills caches
#if !defined(KINEMEND_SANITIZED)
    ASSERT_GT(cost_of([&] { run(frames, 120); }).taken, 0U);
#endif
    Cost usual;
    for (const double rate_hz : {30.0, 120.0, 1000.0}) {
      const Cost cost = cost_of([&] { run(frames, rate_hz); });
      usual = {std::max(usual.taken, cost.taken), std::max(usual.peak, cost.peak)};
    }
    for (const double rate_hz : rates_hz) {
      SCOPED_TRACE(testing::Message() << frames << " frames at " << rate_hz << " Hz");
      const Cost cost = cost_of([&] { run(frames, rate_hz); });
      // The number of iterations and trials varies a little; a dependence on the rate would be a
      // hundredfold.
      constexpr std::size_t slack = 1 << 18, rounds = 6;
      EXPECT_LE(cost.taken, rounds * usual.taken + slack);
      EXPECT_LE(cost.peak, usual.peak + usual.peak / 2 + slack);
    }
  }
}

// Expects that the text holds neither "inf" nor "nan" as a word.
void expect_words(const std::string& text) {
  for (const char* word : {"inf", "nan"}) {
    const std::size_t at = text.find(word);
    const bool is_word = at != text.npos && (at == 0 || !std::isalpha(text[at - 1])) &&
                         !std::isalpha((text + " ")[at + 3]);
    EXPECT_FALSE(is_word) << text;
  }
}

void expect_finite(const CleanReport& report) {
  for (const TrackSummary& track : report.tracks) {
    for (const double figure : {track.noise, track.rms_change, track.max_change,
                                track.peak_speed_before, track.peak_speed_after}) {
      EXPECT_TRUE(std::isfinite(figure)) << track.name;
    }
  }
  for (const std::string& warning : report.warnings) expect_words(warning);
}

std::unique_ptr<Cleaner> made(const std::string& method) {
  if (method != "kalman-learned") return make_cleaner(method);
  SynthOptions options{.motion = "walk", .duration_s = 3, .frame_rate_hz = 30};
  const Take clip = synthesize(options);
  const auto model = std::make_shared<const Model>(
      train_model(method, {1, [&](std::size_t) { return Take(clip); }}));
  return make_kalman_learned({}, model);
}

std::vector<std::string> every_method() {
#if defined(KINEMEND_SANITIZED)
  return method_names();  // methods with a model are slow here, and allocations are not counted
#else
  std::vector<std::string> names;
  for (const Method& method : methods()) names.push_back(method.name);
  return names;
#endif
}

// Only `learned` supports markers among the methods with a model.
std::vector<std::string> methods_for_markers() {
  std::vector<std::string> names = method_names();
#if !defined(KINEMEND_SANITIZED)
  names.push_back("learned");
#endif
  return names;
}

// Methods that run live with their default options; methods with a model have separate stream
// tests.
std::vector<std::string> methods_that_run_live() {
  std::vector<std::string> names = method_names();
  std::erase_if(
      names, [](const std::string& name) { return !make_cleaner(name)->live_support(120).runs(); });
  return names;
}

class EveryRate : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Cleaner> cleaner_ = made(GetParam());
  // Methods with a model are slower.
  std::vector<std::size_t> sizes() const {
    if (find_method(GetParam()).learned) return {few_frames};
    return {few_frames, more_frames};
  }
};
class EveryRateOnMarkers : public EveryRate {};
class EveryRateLive : public EveryRate {};

TEST_P(EveryRate, CleansJointsAtACostThatGoesByFrames) {
  const auto run = [&](std::size_t frames, double rate_hz) {
    const CleanResult result = clean_take(walk(frames, rate_hz), *cleaner_);
    EXPECT_NO_THROW(result.take.validate());
    expect_finite(result.report);
  };
  expect_cost_by_frames(run, sizes());
}

TEST_P(EveryRateOnMarkers, CleansMarkersAtACostThatGoesByFrames) {
  const auto run = [&](std::size_t frames, double rate_hz) {
    const CleanResult result = clean_take(walk_of_markers(frames, rate_hz), *cleaner_);
    EXPECT_NO_THROW(result.take.validate());
    expect_finite(result.report);
  };
  expect_cost_by_frames(run, sizes());
}

TEST_P(EveryRateLive, RunsLiveAtACostThatGoesByFrames) {
  const std::size_t latency = make_stream(*cleaner_, walk(few_frames, 1000))->latency_frames();
  expect_cost_by_frames(
      [&](std::size_t frames, double rate_hz) {
        const Take clip = walk(frames, rate_hz);
        const auto stream = make_stream(*cleaner_, clip);
        EXPECT_LE(stream->latency_frames(), latency);
        Frame out;
        const auto check = [&] {
          for (const Quat q : out.rotations) EXPECT_NEAR(norm(q), 1, 1e-6);
        };
        for (std::size_t f = 0; f < clip.frame_count(); ++f) {
          if (stream->push(frame_of(view_of(clip), f), out)) check();
        }
        while (stream->flush(out)) check();
      },
      {few_frames});
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryRate, testing::ValuesIn(every_method()), test_name_of);
INSTANTIATE_TEST_SUITE_P(Methods, EveryRateOnMarkers, testing::ValuesIn(methods_for_markers()),
                         test_name_of);
INSTANTIATE_TEST_SUITE_P(Methods, EveryRateLive, testing::ValuesIn(methods_that_run_live()),
                         test_name_of);

TEST(TheModelsWindow, IsNoLongerThanTheTakeAtHighRates) {
  const auto cleaner = make_cleaner("wiener");
  const auto run = [&](double rate_hz) { clean_take(walk(few_frames, rate_hz), *cleaner); };
  run(240);
  const Cost usual = cost_of([&] { run(240); }), high = cost_of([&] { run(1000); });
  EXPECT_LE(high.peak, usual.peak + usual.peak / 4);
}

TEST(EveryRateOfMarkers, RunsLiveAtACostThatGoesByFrames) {
  for (const char* method : {"median", "butterworth", "one-euro"}) {
    const auto cleaner = method == std::string("butterworth")
                             ? make_cleaner(method, {{"causal", true}})
                             : make_cleaner(method);
    expect_cost_by_frames(
        [&](std::size_t, double rate_hz) {
          const Take clip = walk_of_markers(few_frames, rate_hz);
          const auto stream = make_stream(*cleaner, clip, 1700);
          Frame out;
          for (std::size_t f = 0; f < clip.frame_count(); ++f) {
            Frame in;
            for (std::size_t m = 0; m < clip.marker_count(); ++m)
              in.positions.push_back(clip.position(f, m));
            stream->push(in, out);
          }
          while (stream->flush(out)) {
            for (const Vec3 p : out.positions) EXPECT_TRUE(std::isfinite(norm(p)));
          }
        },
        {few_frames});
  }
}

TEST(CheckAtEveryRate, CostsByFramesAndFindsNumbers) {
  const auto expect_numbers = [](const CheckReport& report) {
    EXPECT_TRUE(std::isfinite(report.figures.worst_noise));
    EXPECT_TRUE(std::isfinite(report.figures.longest_gap_s));
    for (const Finding& finding : report.findings) {
      EXPECT_TRUE(std::isfinite(finding.figure)) << finding.words;
      expect_words(finding.words);
    }
  };
  expect_cost_by_frames([&](std::size_t frames, double rate_hz) {
    expect_numbers(check_take(walk(frames, rate_hz)));
    expect_numbers(check_take(walk_of_markers(frames, rate_hz)));
  });
}

TEST(FillAtEveryRate, CostsByFrames) {
  for (const FillMethod& method : fill_methods()) {
    if (method.learned) continue;
    SCOPED_TRACE(std::string(method.name));
    FillSettings settings;
    settings.method = method.name;
    settings.fill_all = true;
    expect_cost_by_frames(
        [&](std::size_t frames, double rate_hz) {
          if (method.joints) {
            Take clip = walk(frames, rate_hz);
            clip.observed.assign(clip.rotations.size(), 1);
            for (std::size_t f = 12; f < 20; ++f) {
              clip.observed[f * clip.joint_count() + 3] = 0;
              clip.observed[f * clip.joint_count() + 5] = f % 2 == 0;
            }
            fill_gaps(clip, settings);
            EXPECT_NO_THROW(clip.validate());
            EXPECT_TRUE(find_gaps(clip).empty());
          }
          if (method.markers) {
            Take clip = walk_of_markers(frames, rate_hz);
            FillSettings with_donor = settings;
            if (method.name == "pattern") with_donor.donor = clip.names[4];
            lose(clip, 1, 12, 20);
            lose(clip, 2, 15, 30);
            fill_gaps(clip, with_donor);
            EXPECT_NO_THROW(clip.validate());
            EXPECT_TRUE(find_gaps(clip).empty());
          }
        },
        {few_frames});
  }
}

TEST(FeetAtEveryRate, CostByFrames) {
  expect_cost_by_frames([](std::size_t frames, double rate_hz) {
    Take clip = walk(frames, rate_hz);
    const FeetReport report = clean_feet(clip);
    EXPECT_NO_THROW(clip.validate());
    EXPECT_TRUE(std::isfinite(report.before.slide + report.after.slide));
  });
}

TEST(FiguresAtEveryRate, CostByFramesAndAreNumbers) {
  expect_cost_by_frames([](std::size_t frames, double rate_hz) {
    const Take truth = walk(frames, rate_hz);
    Take other = truth;
    Random random(9);
    apply_damage(other, "gaussian", {{"std_deg", 1.0}}, random);
    const Comparison comparison = compare_clips(truth, other);
    for (const double figure : {comparison.rms_deg, comparison.geodesic_max_deg, comparison.mpjpe,
                                comparison.accel_error, comparison.psnr_db, comparison.mse_rad2}) {
      EXPECT_TRUE(std::isfinite(figure));
      EXPECT_GT(figure, 0);
    }
    EXPECT_EQ(comparison.accel_error, accel_error(truth, other));
    for (const double speed : peak_angular_speed_deg_s(other)) EXPECT_TRUE(std::isfinite(speed));
  });
}

TEST(DamageAtEveryRate, CostsByFrames) {
  for (const Damage& damage : damages()) {
    SCOPED_TRACE(damage.name);
    expect_cost_by_frames(
        [&](std::size_t frames, double rate_hz) {
          Take clip = walk(frames, rate_hz);
          Random random(3);
          apply_damage(clip, damage.name, {}, random);
          EXPECT_NO_THROW(clip.validate());
        },
        {few_frames});
  }
}

}  // namespace
}  // namespace kinemend::test
