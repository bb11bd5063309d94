// Finds errors of a file rather than of the motion: a wrong unit or rate, frames that repeat or
// contain only zeros, and Euler angles that jump.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "check/checks.hpp"
#include "motion/names.hpp"

namespace kinemend::check {

namespace {

// Chosen by hand, not swept.
constexpr std::size_t fewest_joints = 10;  // of a body with a meaningful size
constexpr std::size_t fewest_markers = 8;  // of such a body

std::string size_text(double metres) {
  return metres >= 0.1 ? fmt::format("{:.3g} m", metres) : fmt::format("{:.3g} mm", 1000 * metres);
}

// Returns the median over frames of the largest extent along an axis, in file units.
double usual_extent(const Take& clip, const std::vector<std::size_t>& markers) {
  std::vector<double> extents;
  for (const std::size_t f : frames_looked_at(clip.frame_count())) {
    std::size_t seen = 0;
    Vec3 low, high;
    for (const std::size_t m : markers) {
      if (!clip.is_observed(f, m)) continue;
      const Vec3 p = clip.position(f, m);
      if (seen++ == 0) low = high = p;
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    if (seen >= fewest_markers)
      extents.push_back(std::max({high.x - low.x, high.y - low.y, high.z - low.z}));
  }
  return median_of(extents);
}

// Returns the unit in which the markers have the extent of a person.
const LengthUnit* unit_of_extent(double extent) {
  static constexpr std::array<LengthUnit, 4> units{
      {{"mm", 0.001}, {"cm", 0.01}, {"m", 1.0}, {"inch", 0.0254}}};
  for (const LengthUnit& unit : units) {
    const double metres = extent * unit.metres;
    if (metres >= 0.7 && metres <= 2.6) return &unit;
  }
  return nullptr;
}

Finding finding_of(Severity severity, double size_m, const CheckReport& report, std::string words) {
  const std::size_t last = std::max<std::size_t>(report.frames, 1) - 1;
  return {FindingKind::unit, severity, "", 0, last, size_m, "m", std::move(words)};
}

void check_unit_of_joints(const Take& clip, const CheckSettings& settings, CheckReport& report) {
  const auto guess = guess_length_unit(clip.skeleton);
  const double height = body_height(clip.skeleton);
  const double declared = settings.metres_per_unit.value_or(clip.metres_per_unit);
  report.metres_per_unit = declared > 0 ? declared : guess ? guess->metres : 0;
  if (clip.joint_count() < fewest_joints || !(height > 0)) return;
  if (declared > 0) {
    const double metres = height * declared;
    if (metres >= 0.6 && metres <= 3) return;
    std::string words = fmt::format("the body would be {} tall", size_text(metres));
    if (guess)
      words += fmt::format("; in {} it is {}", guess->name, size_text(height * guess->metres));
    report.findings.push_back(finding_of(Severity::serious, metres, report, std::move(words)));
  } else if (!guess) {
    report.findings.push_back(finding_of(
        Severity::note, 0, report,
        fmt::format(
            "the height of the body is {:.3g}, which no usual unit makes the height of a person",
            height)));
  }
}

void check_unit_of_markers(const Take& clip, const CheckSettings& settings, CheckReport& report) {
  const std::vector<std::size_t> markers = largest_subject(clip).markers;
  const double extent = usual_extent(clip, markers);
  const LengthUnit* guess = unit_of_extent(extent);
  const double declared = settings.metres_per_unit.value_or(metres_per_unit(clip.unit));
  report.metres_per_unit = declared > 0 ? declared : guess != nullptr ? guess->metres : 0;
  if (declared > 0) {
    const double metres = extent * declared;
    // An incomplete body, or several people, do not indicate a wrong unit.
    if (extent == 0 || (metres > 0.12 && metres < 12)) return;
    std::string words = fmt::format("the markers would span {}", size_text(metres));
    if (guess != nullptr)
      words += fmt::format("; in {} it is {}", guess->name, size_text(extent * guess->metres));
    report.findings.push_back(finding_of(Severity::serious, metres, report, std::move(words)));
  } else if (!markers.empty()) {
    report.findings.push_back(finding_of(
        Severity::note, 0, report,
        guess != nullptr ? fmt::format("the file states no unit; {} is assumed", guess->name)
                         : std::string("the file states no known unit")));
  }
}

// Whether a frame equals the previous one to the precision of text.
bool repeats(const Take& clip, std::size_t frame) {
  // Text writers round to this; not swept.
  constexpr double same_angle = 1e-7;  // radians
  const Vec3 step = clip.root_position(frame) - clip.root_position(frame - 1);
  if (norm(step) > 1e-9 * (1 + norm(clip.root_position(frame)))) return false;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    if (angle_between(clip.rotation(frame - 1, j), clip.rotation(frame, j)) > same_angle)
      return false;
  }
  for (std::size_t k = 1; k < clip.point_count(); ++k) {
    if (!(clip.position(frame, k) == clip.position(frame - 1, k))) return false;
  }
  return true;
}

bool repeats(const Take& clip, const std::vector<std::size_t>& markers, std::size_t frame) {
  std::size_t seen = 0;
  for (const std::size_t m : markers) {
    if (clip.is_observed(frame, m) != clip.is_observed(frame - 1, m)) return false;
    if (!clip.is_observed(frame, m)) continue;
    if (!(clip.position(frame, m) == clip.position(frame - 1, m))) return false;
    ++seen;
  }
  return seen > 0;
}

// If most of every second step repeats, the take was converted from half the rate (or a third).
void report_low_rate(const std::vector<std::uint8_t>& repeated, CheckReport& report) {
  for (const std::size_t stride : {2, 3, 4, 5}) {
    for (std::size_t phase = 0; phase < stride; ++phase) {
      std::size_t as_expected = 0;
      for (std::size_t t = 1; t < repeated.size(); ++t)
        as_expected += (repeated[t] != 0) == (t % stride != phase);
      if (static_cast<double>(as_expected) < 0.95 * static_cast<double>(repeated.size() - 1))
        continue;
      report.findings.push_back(
          {FindingKind::rate, Severity::serious, "", 0, repeated.size() - 1,
           report.frame_rate_hz / static_cast<double>(stride), "Hz",
           fmt::format("only one frame in {} is new: the motion was captured at {:.6g} Hz", stride,
                       report.frame_rate_hz / static_cast<double>(stride))});
      return;
    }
  }
}

void report_repeats(const std::vector<std::uint8_t>& repeated, CheckReport& report) {
  // Shorter takes say nothing about their rate. Chosen by hand, not swept.
  constexpr std::size_t fewest_frames = 10;
  const auto count = static_cast<std::size_t>(std::count(repeated.begin(), repeated.end(), 1));
  if (repeated.size() < fewest_frames || count == 0) return;
  if (count + 1 == repeated.size()) {
    report.findings.push_back({FindingKind::repeated_frames, Severity::note, "", 0,
                               repeated.size() - 1, static_cast<double>(count), "frames",
                               "nothing moves: every frame is the same"});
    return;
  }
  if (3 * count >= repeated.size()) {
    const std::size_t before = report.findings.size();
    report_low_rate(repeated, report);
    if (report.findings.size() > before) return;
  }
  for (const FrameSpan& run :
       runs_where(repeated.size(), [&](std::size_t t) { return repeated[t] != 0; })) {
    const auto length = static_cast<double>(run.length());
    report.findings.push_back(
        {FindingKind::repeated_frames,
         length >= 0.5 * report.frame_rate_hz ? Severity::serious : Severity::warning, "",
         run.first, run.last, length, "frames",
         run.length() == 1 ? "the frame is equal to the one before"
                           : "the frames are equal to the one before"});
  }
}

bool is_zero(const Take& clip, std::size_t frame) {
  if (norm(clip.root_position(frame)) > 0) return false;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    if (angle_between(clip.rotation(frame, j), {}) > 1e-9) return false;
  }
  return true;
}

}  // namespace

void check_unit(const Take& clip, const CheckSettings& settings, CheckReport& report) {
  if (clip.has_joints())
    check_unit_of_joints(clip, settings, report);
  else
    check_unit_of_markers(clip, settings, report);
}

void check_frames(const Rows& rows, CheckReport& report) {
  const Take& clip = rows.clip;
  const std::size_t frames = clip.frame_count();
  if (frames < 2) return;
  std::vector<std::uint8_t> repeated(frames);
  for (std::size_t t = 1; t < frames; ++t) {
    repeated[t] = clip.has_joints()
                      ? repeats(clip, t) && !(is_zero(clip, t) && is_zero(clip, t - 1))
                      : repeats(clip, rows.tracks, t);
  }
  report_repeats(repeated, report);
}

void check_zero_frames(const Take& clip, CheckReport& report) {
  const std::size_t frames = clip.frame_count();
  const std::vector<FrameSpan> zeros =
      runs_where(frames, [&](std::size_t t) { return is_zero(clip, t); });
  for (const FrameSpan& run : zeros) {
    // A take of zeros only does not move, and one such frame at the start is a pose.
    const bool is_pose = run.last == 0 && report.calibration_frames > 0;
    if (is_pose || run.length() == frames) continue;
    report.findings.push_back({FindingKind::zero_frames, Severity::serious, "", run.first, run.last,
                               static_cast<double>(run.length()), "frames",
                               "every channel is zero"});
  }
}

namespace {

// The rotation channels of one joint among the columns of the file.
struct AngleColumns {
  std::size_t joint = 0;
  std::array<std::size_t, 3> columns{};
  RotationOrder order;
};

std::vector<AngleColumns> angle_columns(const Skeleton& skeleton) {
  std::vector<AngleColumns> list;
  std::size_t column = 0;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    AngleColumns angles{j, {}, skeleton.rotation_order(j)};
    std::size_t found = 0;
    for (const Channel channel : skeleton.channels[j]) {
      if (is_rotation(channel) && found < angles.columns.size()) angles.columns[found++] = column;
      ++column;
    }
    if (found > 0) list.push_back(angles);
  }
  return list;
}

std::size_t channel_count(const Skeleton& skeleton) {
  std::size_t count = 0;
  for (const auto& channels : skeleton.channels) count += channels.size();
  return count;
}

enum class Leap : std::uint8_t { none, whole_turn, other_branch, gimbal_lock };

struct LeapSize {
  Leap leap = Leap::none;
  double degrees = 0;
};

// Returns the degrees from the middle angle to the nearest gimbal lock.
double to_gimbal_lock(double middle, RotationOrder order) {
  const bool repeats_axis = order.axes[0] == order.axes[2];
  return std::fabs(wrap_angle(middle - (repeats_axis ? 0 : 90), 90));
}

LeapSize leap_of(const double* before, const double* now, const AngleColumns& joint,
                 double turn_deg) {
  // The degrees of a leap, the largest share of it that the joint turns, and the degrees from
  // gimbal lock. Chosen by hand, not swept.
  constexpr double large = 90, share_of_leap = 0.25, near_lock = 8;
  LeapSize result;
  double whole = 0, wrapped = 0;
  for (std::size_t i = 0; i < joint.order.count; ++i) {
    const double step = now[joint.columns[i]] - before[joint.columns[i]];
    if (!std::isfinite(step)) return result;
    whole = std::max(whole, std::fabs(step));
    wrapped = std::max(wrapped, std::fabs(wrap_angle(step, 180)));
  }
  if (wrapped > large && turn_deg < share_of_leap * wrapped) {
    result = {Leap::other_branch, wrapped};
    const std::size_t middle = joint.columns[1];
    if (joint.order.count == 3 && std::min(to_gimbal_lock(before[middle], joint.order),
                                           to_gimbal_lock(now[middle], joint.order)) < near_lock)
      result.leap = Leap::gimbal_lock;
  } else if (whole > 180 && turn_deg < share_of_leap * whole) {
    result = {Leap::whole_turn, whole};
  }
  return result;
}

}  // namespace

void check_euler_flips(const Take& clip, CheckReport& report) {
  const std::size_t frames = clip.frame_count(), width = channel_count(clip.skeleton);
  if (clip.source.document == nullptr || frames == 0) return;
  const std::vector<double> values = clip.source.document->channel_values();
  if (values.empty() || values.size() != frames * width) return;
  static constexpr std::array<const char*, 4> words{
      "", "has an angle that jumps by a full turn although the joint does not move",
      "has angles that change to others of the same rotation",
      "has angles that jump at a gimbal lock"};
  for (const AngleColumns& joint : angle_columns(clip.skeleton)) {
    for (std::size_t t = report.calibration_frames + 1; t < frames; ++t) {
      const double turn = degrees_per_radian * angle_between(clip.rotation(t - 1, joint.joint),
                                                             clip.rotation(t, joint.joint));
      const LeapSize leap =
          leap_of(values.data() + (t - 1) * width, values.data() + t * width, joint, turn);
      if (leap.leap == Leap::none) continue;
      ++report.tracks[joint.joint].flips;
      ++report.figures.flips;
      report.findings.push_back({FindingKind::euler_flip, Severity::note,
                                 clip.skeleton.names[joint.joint], t, t, leap.degrees, "deg",
                                 words[static_cast<std::size_t>(leap.leap)]});
    }
  }
}

}  // namespace kinemend::check
