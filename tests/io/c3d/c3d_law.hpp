// Conversions of C3D files keep everything in the file that they do not concern.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "c3d_support.hpp"
#include "kinemend/extend/motion.hpp"

namespace kinemend::test {

/// A conversion and its allowed changes.
struct C3dConversion {
  const char* title;
  std::function<Take(const Take&)> convert;
  double factor = 1;                                                      ///< factor of lengths
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};  ///< new axes
  bool resamples = false;
  bool same_bytes = false;
  Vec3 shift{};  ///< added last
};

/// Moves a take like `convert --floor-at-zero --face-forward`.
inline Take turned_and_shifted(Take clip, Quat turn, Vec3 shift) {
  TakeChange change;
  change.axes = {rotate(turn, {1, 0, 0}), rotate(turn, {0, 1, 0}), rotate(turn, {0, 0, 1})};
  change.shift = shift;
  clip.source.document = document_after(clip.source, change);
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    if (clip.observed[i] != 0 && clip.holds_positions(i % clip.marker_count()))
      clip.positions[i] = change.moved(clip.positions[i]);
  }
  return clip;
}

inline Take without_layout(Take clip) {
  drop_layout(clip.source);
  return clip;
}

/// Conversions of every kind. Analog rates are seldom a multiple of one of the rates.
inline std::vector<C3dConversion> c3d_conversions(const Take& clip) {
  const double rate = clip.frame_rate_hz;
  const auto fps = [](double to) { return [to](const Take& take) { return resample(take, to); }; };
  const auto unit = [](double factor, std::string name) {
    return [=](const Take& take) { return scale_lengths(take, factor, name); };
  };
  const auto up = [](Axis from, Axis to) {
    return [=](const Take& take) { return turn_axes(take, from, to); };
  };
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const Quat turn = exp({0, 0, 0.4});
  const Vec3 shift{30, -70, 11};
  return {{"own unit", unit(1, clip.unit), 1, {x, y, z}, false, true},
          {"own rate", fps(rate), 1, {x, y, z}, false, true},
          {"own axis", up(Axis::z, Axis::z), 1, {x, y, z}, false, true},
          {"thousandth", unit(0.001, "u"), 0.001},
          {"inches", unit(1 / 25.4, "in"), 1 / 25.4},
          {"z to y", up(Axis::z, Axis::y), 1, {x, -z, y}},
          {"x to z", up(Axis::x, Axis::z), 1, {z, y, -x}},
          {"plain", without_layout},
          {"half the rate", fps(rate / 2), 1, {x, y, z}, true},
          {"twice the rate", fps(2 * rate), 1, {x, y, z}, true},
          {"another rate", fps(0.7 * rate), 1, {x, y, z}, true},
          {"turned, scaled and resampled",
           [=](const Take& take) {
             return scale_lengths(turn_axes(resample(take, rate / 2), Axis::z, Axis::y), 0.01, "v");
           },
           0.01,
           {x, -z, y},
           true},
          {"turned by an angle and shifted",
           [=](const Take& take) { return turned_and_shifted(take, turn, shift); },
           1,
           {rotate(turn, x), rotate(turn, y), z},
           false,
           false,
           shift},
          {"shifted, then in other axes and units",
           [=](const Take& take) {
             return scale_lengths(turn_axes(turned_and_shifted(take, {}, shift), Axis::z, Axis::y),
                                  0.01, "v");
           },
           0.01,
           {x, -z, y},
           false,
           false,
           0.01 * Vec3{shift.x, shift.z, -shift.y}}};
}

/// Returns whether a parameter may differ: any new file states it anew, or the conversion concerns
/// it.
inline bool may_differ(const std::string& group, const std::string& name,
                       const C3dConversion& conversion) {
  static const std::set<std::string> written{"POINT:FRAMES",
                                             "POINT:LONG_FRAMES",
                                             "POINT:DATA_START",
                                             "POINT:SCALE",
                                             "POINT:USED",
                                             "POINT:RATE",
                                             "POINT:UNITS",
                                             "TRIAL:ACTUAL_START_FIELD",
                                             "TRIAL:ACTUAL_END_FIELD",
                                             "ANALOG:USED",
                                             "ANALOG:RATE",
                                             "POINT:X_SCREEN",
                                             "POINT:Y_SCREEN",
                                             "FORCE_PLATFORM:CORNERS",
                                             "FORCE_PLATFORM:ORIGIN"};
  static const std::set<std::string> timed{"TRIAL:CAMERA_RATE", "FORCE_PLATFORM:ZERO",
                                           "EVENT:TIMES"};
  std::string whole = group + ":" + name;
  for (char& c : whole) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return written.count(whole) > 0 || (conversion.resamples && timed.count(whole) > 0);
}

inline std::string group_name(const C3dParameters& parameters, const C3dParameter& entry) {
  for (const C3dGroup& group : parameters.groups) {
    if (group.number == entry.group) return group.name;
  }
  return "";
}

inline bool is_in(const std::string& group, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [&](const char* name) {
    return std::equal(group.begin(), group.end(), name, name + std::string(name).size(),
                      [](char a, char b) { return std::toupper(a) == b; });
  });
}

inline void expect_same_parameters(const C3dParameters& before, const C3dParameters& after,
                                   const C3dConversion& conversion, const Diagnostics& losses) {
  for (const C3dParameter& entry : before.entries) {
    const std::string group = group_name(before, entry);
    if (group.empty() || may_differ(group, entry.name, conversion)) continue;
    if (before.find(group, entry.name) != &entry) continue;  // one of two with that name
    if (losses.count("analog_lost") > 0 && is_in(group, {"ANALOG", "FORCE_PLATFORM"})) continue;
    if (losses.count("rotations_lost") > 0 && is_in(group, {"ROTATION", "DATA_BLOCKS"})) continue;
    if (losses.count("data_blocks_lost") > 0 && is_in(group, {"DATA_BLOCKS"})) continue;
    const C3dParameter* const now = after.find(group, entry.name);
    ASSERT_NE(now, nullptr) << group << ":" << entry.name << " is lost";
    EXPECT_EQ(now->text, entry.text) << group << ":" << entry.name;
    EXPECT_EQ(now->numbers, entry.numbers) << group << ":" << entry.name;
    EXPECT_EQ(now->dimensions, entry.dimensions) << group << ":" << entry.name;
    EXPECT_EQ(now->description, entry.description) << group << ":" << entry.name;
    EXPECT_EQ(now->locked, entry.locked) << group << ":" << entry.name;
  }
}

inline Vec3 moved(Vec3 v, const C3dConversion& conversion) {
  const auto& axes = conversion.axes;
  return conversion.factor * (v.x * axes[0] + v.y * axes[1] + v.z * axes[2]) + conversion.shift;
}

/// Corners move with the points; the origin of a plate is along its own axes.
inline void expect_plates_to_follow(const C3dParameters& before, const C3dParameters& after,
                                    const C3dConversion& conversion) {
  const auto corners = before.numbers("FORCE_PLATFORM", "CORNERS");
  const auto now = after.numbers("FORCE_PLATFORM", "CORNERS");
  ASSERT_EQ(now.size(), corners.size());
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const Vec3 wanted = moved({corners[i], corners[i + 1], corners[i + 2]}, conversion);
    ASSERT_LE(norm(wanted - Vec3{now[i], now[i + 1], now[i + 2]}), 1e-6 * (1 + norm(wanted)));
  }
  const auto origin = before.numbers("FORCE_PLATFORM", "ORIGIN");
  const auto origin_now = after.numbers("FORCE_PLATFORM", "ORIGIN");
  ASSERT_EQ(origin_now.size(), origin.size());
  for (std::size_t i = 0; i < origin.size(); ++i)
    ASSERT_NEAR(origin_now[i], conversion.factor * origin[i], 1e-6 * (1 + std::fabs(origin[i])));
}

/// The values at the same rate are equal from the first one on; cut or repeated values are
/// reported.
inline void expect_same_analog(const Take& before, const Take& after, const Diagnostics& losses) {
  const C3dAnalog was = analog_of(before), is = analog_of(after);
  if (losses.count("analog_lost") > 0) {
    EXPECT_TRUE(is.values.empty());
    return;
  }
  ASSERT_EQ(is.names, was.names);
  EXPECT_EQ(is.units, was.units);
  EXPECT_NEAR(is.rate_hz, was.rate_hz, 1e-6 * was.rate_hz);
  const std::size_t width = was.names.size();
  EXPECT_EQ(losses.count("analog_cut") > 0, is.values.size() < was.values.size());
  EXPECT_EQ(losses.count("analog_held") > 0, is.values.size() > was.values.size());
  for (std::size_t i = 0; i < is.values.size(); ++i) {
    const double wanted =
        i < was.values.size() ? was.values[i] : was.values[was.values.size() - width + i % width];
    // The values are exact, except VAX reals smaller than the range of other encodings.
    ASSERT_NEAR(is.values[i], wanted, 1e-36) << "analog value " << i;
  }
}

inline double moment_s(const Take& clip, std::size_t event) {
  return clip.events[event].time_s - static_cast<double>(clip.first_frame - 1) / clip.frame_rate_hz;
}

/// Events keep their label, their context and their position in the motion.
inline void expect_same_events(const Take& before, const Take& after) {
  ASSERT_EQ(after.events.size(), before.events.size());
  for (std::size_t i = 0; i < before.events.size(); ++i) {
    EXPECT_EQ(after.events[i].label, before.events[i].label);
    EXPECT_EQ(after.events[i].context, before.events[i].context);
    EXPECT_NEAR(moment_s(after, i), moment_s(before, i), 2e-5);
  }
}

/// Positions are converted, other values among the points are kept, and no sample becomes missing.
inline void expect_points_to_follow(const Take& before, const Take& after,
                                    const C3dConversion& conversion) {
  ASSERT_EQ(after.names, before.names);
  EXPECT_EQ(after.is_position, before.is_position);
  if (conversion.resamples) return;
  EXPECT_EQ(after.first_frame, before.first_frame);
  ASSERT_EQ(after.observed, before.observed);
  for (std::size_t i = 0; i < before.positions.size(); ++i) {
    if (before.observed[i] == 0) continue;
    const Vec3 was = before.positions[i], is = after.positions[i];
    const bool follows = before.holds_positions(i % before.marker_count());
    const Vec3 wanted = follows ? moved(was, conversion) : was;
    ASSERT_LE(norm(is - wanted), 2e-7 * norm(wanted)) << "sample " << i;
    if (!follows) continue;
    const double residual = conversion.factor * static_cast<double>(before.residuals[i]);
    // Far from the origin, residuals have larger steps.
    const bool is_far = !(conversion.shift == Vec3{});
    const double steps = is_far ? document_of(after).layout.scale : 0;
    ASSERT_NEAR(after.residuals[i], residual, 1e-5 * std::fabs(residual) + steps) << "sample " << i;
  }
}

/// Checks one file: everything that a conversion does not concern is kept or reported.
inline void expect_lawful_conversions(const std::string& bytes) {
  const Take before = read_c3d_bytes(bytes).clip;
  for (const C3dConversion& conversion : c3d_conversions(before)) {
    SCOPED_TRACE(conversion.title);
    const Take converted = conversion.convert(before);
    const Diagnostics losses = lost_in_writing(converted, "c3d");
    const std::string out = write_take(converted, "c3d");
    if (conversion.same_bytes) {
      ASSERT_TRUE(out == write_take(before, "c3d"));
      ASSERT_TRUE(losses.empty());
      continue;
    }
    const Take after = read_c3d_bytes(out).clip;
    const C3dParameters& was = document_of(before).parameters;
    const C3dParameters& is = document_of(after).parameters;
    ASSERT_NO_FATAL_FAILURE(expect_same_parameters(was, is, conversion, losses));
    ASSERT_NO_FATAL_FAILURE(expect_same_analog(before, after, losses));
    ASSERT_NO_FATAL_FAILURE(expect_same_events(before, after));
    ASSERT_NO_FATAL_FAILURE(expect_points_to_follow(before, after, conversion));
    EXPECT_EQ(fact_of(after, "subjects"), fact_of(before, "subjects"));
    if (!conversion.resamples) {
      EXPECT_EQ(fact_of(after, "cameras"), fact_of(before, "cameras"));
    }
    EXPECT_EQ(losses.count("force_plates_lost") > 0,
              fact_of(after, "force plates") != fact_of(before, "force plates"));
    EXPECT_EQ(losses.count("rotations_lost") > 0,
              fact_of(after, "rotations") != fact_of(before, "rotations"));
    if (losses.count("analog_lost") > 0) continue;
    ASSERT_NO_FATAL_FAILURE(expect_plates_to_follow(was, is, conversion));
  }
}

}  // namespace kinemend::test
