// Tests on synthetic takes that the default method returns clean takes, whatever their rig, rate,
// length, style and origin. docs/methods/learned.md has the figures for takes of other studios.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "base/quantiles.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/methods.hpp"
#include "long_tests.hpp"
#include "methods/learned/turned_rig.hpp"

namespace kinemend::quality {
namespace {

using test::on_turned_rig;
using test::rig_turns;
using test::with_turned_axes;

Take renamed(Take take) {
  for (std::size_t j = 0; j < take.joint_count(); ++j)
    take.skeleton.names[j] = "Q" + std::to_string(j);
  return take;
}

// The same motion with the same names, other bone axes and another rest pose.
Take on_another_rig(const Take& take) { return on_turned_rig(take, rig_turns(take, 1.5)); }

Take played_faster(Take take, double factor) {
  take.frame_rate_hz *= factor;
  return take;
}

// Keyframes at a lower rate, interpolated by straight turns or held until the next one.
Take keyframed(const Take& take, double keys_hz, bool is_held) {
  const auto step =
      std::max<std::size_t>(2, static_cast<std::size_t>(std::lround(take.frame_rate_hz / keys_hz)));
  Take keyed = take;
  const std::size_t last = take.frame_count() - 1;
  for (std::size_t f = 0; f <= last; ++f) {
    const std::size_t before = f - f % step, after = std::min(before + step, last);
    const double share = is_held || after == before ? 0
                                                    : static_cast<double>(f - before) /
                                                          static_cast<double>(after - before);
    for (std::size_t j = 0; j < take.joint_count(); ++j)
      keyed.rotation(f, j) = slerp(take.rotation(before, j), take.rotation(after, j), share);
  }
  return keyed;
}

struct Style {
  std::string name;
  std::function<Take(const Take&)> of;
  bool is_live = true;  // streams come from capture systems, which hold samples of a lower rate
};
const std::vector<Style> styles{
    {"as it is made", [](const Take& take) { return take; }},
    {"renamed", renamed},
    {"on another rig", on_another_rig},
    {"renamed, on another rig", [](const Take& take) { return renamed(on_another_rig(take)); }},
    {"played faster", [](const Take& take) { return played_faster(take, 1.5); }},
    {"keyed at 12 Hz", [](const Take& take) { return keyframed(take, 12, false); }},
    {"stepped at 15 Hz", [](const Take& take) { return keyframed(take, 15, true); }, false},
    {"as markers", [](const Take& take) { return joint_markers(take); }},
};

struct Harm {
  double rms = 0;        // over all tracks: degrees, or file units (centimetres) for markers
  double peak_loss = 0;  // for tracks faster than 100 degrees or 50 cm per second
};

Harm harm_of(const Take& take, const Cleaner& cleaner) {
  const CleanReport report = clean_take(take, cleaner).report;
  const double fast = take.has_joints() ? 100 : 50;
  Harm harm;
  for (const TrackSummary& track : report.tracks) {
    harm.rms += track.rms_change * track.rms_change / static_cast<double>(report.tracks.size());
    if (track.peak_speed_before > fast)
      harm.peak_loss =
          std::max(harm.peak_loss, 1 - track.peak_speed_after / track.peak_speed_before);
  }
  harm.rms = std::sqrt(harm.rms);
  return harm;
}

// Where `auto` measures noise, as in runs with few keys, up to 1.75 times its change is allowed: a
// run in steps looks like held noise.
void expect_little_harm(const Take& take, const Harm& harm, double most_rms,
                        const std::string& what) {
  constexpr double most_peak_loss = 0.11, more_than_measured = 1.75;
  if (harm.rms <= most_rms && harm.peak_loss <= most_peak_loss) return;
  const Harm measured = harm_of(take, *make_auto());
  EXPECT_LE(harm.rms, std::max(most_rms, more_than_measured * measured.rms)) << what;
  EXPECT_LE(harm.peak_loss, std::max(most_peak_loss, more_than_measured * measured.peak_loss))
      << what;
}

void expect_law_at(double frame_rate_hz) {
  const std::unique_ptr<Cleaner> learned = make_learned(), live = make_learned({.live = true});
  std::vector<double> changes;
  for (const std::string_view motion : synth_motions()) {
    for (const double duration_s : {0.8, 5.0}) {
      const Take made = synthesize({.motion = std::string(motion),
                                    .duration_s = duration_s,
                                    .frame_rate_hz = frame_rate_hz});
      for (const Style& style : styles) {
        const std::string what =
            std::string(motion) + (duration_s < 1 ? ", short, " : ", long, ") + style.name;
        const Take take = style.of(made);
        const Harm harm = harm_of(take, *learned);
        changes.push_back(harm.rms);
        expect_little_harm(take, harm, 1.0, what);
        // A stream of a run is fast from its first frame on, so no noise is measured.
        if (style.is_live && duration_s > 1)
          expect_little_harm(take, harm_of(take, *live), 1.5, what + ", live");
      }
    }
  }
  EXPECT_EQ(quantile_of(changes, 0.5), 0);
  EXPECT_LE(quantile_of(changes, 0.9), 0.1);
}

// Noise that can only be recognised from the whole body; single joints show little of it.
Take with_slow_noise(Take take) {
  Random random(7);
  std::vector<Vec3> noise(take.joint_count());
  for (std::size_t f = 0; f < take.frame_count(); ++f) {
    for (std::size_t j = 1; j < take.joint_count(); ++j) {
      const double x = random.normal(), y = random.normal(), z = random.normal();
      noise[j] = 0.8 * noise[j] + 0.6 * Vec3{x, y, z};
      take.rotation(f, j) = take.rotation(f, j) * exp(0.03 * noise[j]);
    }
  }
  return take;
}

// Compares the angle between two results with that between result and input (root mean squares).
TEST(HarmLaw, TheSameMotionOnAnotherRigIsCleanedAlike) {
  const Take noisy =
      with_slow_noise(synthesize({.motion = "walk", .duration_s = 6, .frame_rate_hz = 60}));
  const std::vector<Quat> turns = rig_turns(noisy, 1);
  for (const Source source : {Source::unknown, Source::video}) {
    CleanSettings settings;
    settings.source = source;
    const auto cleaned = [&](const Take& take) {
      return clean_take(take, *make_learned(), settings).take;
    };
    const Take before = with_turned_axes(noisy, turns),
               own = with_turned_axes(cleaned(noisy), turns), other = cleaned(before);
    double difference = 0, change = 0;
    for (std::size_t f = 0; f < own.frame_count(); ++f) {
      for (std::size_t j = 1; j < own.joint_count(); ++j) {
        // Fingers unknown to the model are smoothed axis by axis.
        if (own.skeleton.names[j].ends_with("2") || own.skeleton.names[j].ends_with("Thumb1"))
          continue;
        const double apart = angle_between(own.rotation(f, j), other.rotation(f, j)),
                     moved = angle_between(own.rotation(f, j), before.rotation(f, j));
        difference += apart * apart;
        change += moved * moved;
      }
    }
    ASSERT_GT(change, 0);
    EXPECT_LT(std::sqrt(difference / change), 0.02) << to_string(source);
  }
}

TEST(HarmLaw, ACleanTakeOf24HzComesBack) { expect_law_at(24); }
TEST(HarmLaw, ACleanTakeOf30HzComesBack) { expect_law_at(30); }
TEST(HarmLaw, ACleanTakeOf60HzComesBack) { expect_law_at(60); }
TEST(HarmLaw, ACleanTakeOf120HzComesBack) { expect_law_at(120); }
TEST(HarmLaw, ACleanTakeOf240HzComesBack) {
  KINEMEND_LONG_TEST();
  expect_law_at(240);
}

}  // namespace
}  // namespace kinemend::quality
