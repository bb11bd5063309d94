// Reports gaps, and spans that hide gaps because they were not measured: frozen spans and spans on
// straight lines.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/parallel.hpp"
#include "check/checks.hpp"
#include "motion/take.hpp"

namespace kinemend::check {

void check_gaps(const Rows& rows, CheckReport& report) {
  // The level `serious` of docs/check.md. Chosen by hand, not swept.
  constexpr double long_gap_s = 0.5;  // longer gaps need a model to be filled reliably
  std::size_t missing = 0;
  for (const Gap& gap : find_gaps(rows.clip)) {
    if (rows.row_of[gap.track] < 0) continue;
    TrackHealth& track = report.tracks[static_cast<std::size_t>(rows.row_of[gap.track])];
    const double seconds = static_cast<double>(gap.length()) / report.frame_rate_hz;
    ++track.gaps;
    track.longest_gap = std::max(track.longest_gap, gap.length());
    track.missing_frames += gap.length();
    missing += gap.length();
    ++report.figures.gaps;
    report.figures.longest_gap_s = std::max(report.figures.longest_gap_s, seconds);
    const bool never_seen = gap.length() == report.frames - report.calibration_frames;
    report.findings.push_back({FindingKind::gap,
                               seconds >= long_gap_s ? Severity::serious : Severity::warning,
                               track.name, gap.first_frame, gap.last_frame, seconds, "s",
                               never_seen ? "is never seen" : "is missing"});
  }
  const std::size_t samples = report.tracks.size() * (report.frames - report.calibration_frames);
  if (samples > 0) {
    report.figures.missing_percent =
        100.0 * static_cast<double>(missing) / static_cast<double>(samples);
  }
}

namespace {

// The spans in docs/check.md, `frozen` and `bridged`. Chosen by hand, not swept.
constexpr std::size_t shortest_frozen_steps = 2;    // three samples in a row
constexpr std::size_t shortest_straight_steps = 3;  // five samples in a row
constexpr double share_of_usual = 0.01;  // of the usual step or bend; smaller ones are zero
// A joint whose usual step is smaller rests, and what moves is the rounding of a file: 32-bit
// floats round a rotation by 1e-7 radians.
constexpr double least_usual_rad = 1e-6;

// Sizes of the steps and the bends of one track; negative where a sample is missing. Step t lies
// between samples t and t + 1, bend t at sample t + 1.
struct TrackChanges {
  std::vector<double> steps;
  std::vector<double> bends;
};

double usual_size(const std::vector<double>& sizes) {
  std::vector<double> known;
  for (const double s : sizes) {
    if (s > 0) known.push_back(s);
  }
  return median_of(known);
}

// Text rounds samples, so a repeated or interpolated one may deviate in its last digits.
void set_flags(const std::vector<double>& sizes, double most, std::size_t track, FlagTable& table) {
  for (std::size_t t = 0; t < sizes.size(); ++t) {
    if (sizes[t] >= 0) table(t, track) = sizes[t] <= most ? Flag::yes : Flag::no;
  }
}

// Returns the step of a file's digits: the smallest nonzero size, if sizes of that kind are common;
// else 0.
double quantum(const std::vector<double>& sizes) {
  // The least share of such sizes, and the tolerance within which two sizes are the same step.
  // Chosen by hand, not swept.
  constexpr double common_share = 0.05, same = 1e-3;
  double least = std::numeric_limits<double>::infinity();
  for (const double s : sizes) {
    if (s > 0) least = std::min(least, s);
  }
  std::size_t known = 0, small = 0;
  for (const double s : sizes) {
    known += s > 0;
    small += s > 0 && s < (1 + same) * least;
  }
  return static_cast<double>(small) > common_share * static_cast<double>(known) ? least : 0;
}

// The scale by which a change of a track is judged.
struct ChangeScale {
  double usual = 0;
  double digits = 0;  // rounding error of the file

  ChangeScale() = default;
  explicit ChangeScale(const std::vector<double>& sizes)
      : usual(usual_size(sizes)), digits(4 * quantum(sizes)) {}
  double clear() const { return std::max(0.3 * usual, digits); }
};

// Motion decelerates before it rests and bends before it is straight. A stale span has at least one
// end where it does not: the size beside it is large and not decreasing.
bool has_sharp_end(const std::vector<double>& sizes, const FrameSpan& run,
                   const ChangeScale& scale) {
  // Chosen by hand, not swept.
  constexpr double still_large = 0.6;  // of the size one frame farther
  const auto is_sharp = [&](std::size_t beside, std::size_t beyond) {
    return sizes[beside] > scale.clear() && sizes[beside] > still_large * sizes[beyond];
  };
  return (run.first > 1 && is_sharp(run.first - 1, run.first - 2)) ||
         (run.last + 2 < sizes.size() && is_sharp(run.last + 1, run.last + 2));
}

// A slow line may be straight only by rounding.
bool moves_along(const std::vector<double>& steps, const FrameSpan& run, const ChangeScale& scale) {
  return *std::min_element(steps.begin() + static_cast<std::ptrdiff_t>(run.first),
                           steps.begin() + static_cast<std::ptrdiff_t>(run.last) + 1) >
         scale.digits;
}

// Chosen by hand, not swept.
constexpr double slack_rad = 1e-4;  // beyond the end of a hinge, by the digits of a file

// The range of a hinge, a joint that turns about only one axis, as a knee does; other joints have
// none.
struct HingeRange {
  Quat end;        // rotation of the joint at one end
  Vec3 axis;       // towards the other, in the frame of `end`
  double rad = 0;  // from end to end; 0: the joint does not move
};

std::optional<HingeRange> hinge_range(const Take& clip, std::size_t joint) {
  // Chosen by hand, not swept.
  constexpr double part_about_other_axes = 0.05;  // of the whole range
  const auto farthest_from = [&](Quat from) {
    std::pair<Quat, Vec3> farthest{from, {}};
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      const Vec3 turn = log(conjugate(from) * clip.rotation(f, joint));
      if (norm(turn) > norm(farthest.second)) farthest = {clip.rotation(f, joint), turn};
    }
    return farthest;
  };
  HingeRange range;
  range.end = farthest_from(clip.rotation(0, joint)).first;
  const Vec3 across = farthest_from(range.end).second;
  range.rad = norm(across);
  if (range.rad == 0) return range;
  range.axis = (1 / range.rad) * across;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const Vec3 turn = log(conjugate(range.end) * clip.rotation(f, joint));
    const double about_axis = dot(turn, range.axis);
    if (about_axis < -slack_rad ||
        norm(turn - about_axis * range.axis) > part_about_other_axes * range.rad)
      return std::nullopt;
  }
  return range;
}

bool is_at_an_end(const HingeRange& range, Quat rotation) {
  const double from_end = dot(log(conjugate(range.end) * rotation), range.axis);
  return from_end <= slack_rad || from_end >= range.rad - slack_rad;
}

// A frozen or bridged span.
struct Stale {
  FrameSpan span;
  FindingKind kind;
};

// A stretched knee is as still as a frozen one, so spans at the end of a hinge are removed.
void leave_out_hinge_ends(const Take& clip, std::size_t joint, std::vector<Stale>& spans) {
  const auto is_frozen = [](const Stale& stale) { return stale.kind == FindingKind::frozen; };
  if (std::none_of(spans.begin(), spans.end(), is_frozen)) return;
  const std::optional<HingeRange> range = hinge_range(clip, joint);
  if (!range) return;
  std::erase_if(spans, [&](const Stale& stale) {
    return is_frozen(stale) && is_at_an_end(*range, clip.rotation(stale.span.first, joint));
  });
}

// Returns one list for each track, by frame; the spans of a track do not overlap.
std::vector<std::vector<Stale>> find_stale(const std::vector<TrackChanges>& tracks,
                                           double least_usual, std::size_t frames,
                                           std::size_t shortest_frames) {
  std::vector<std::vector<Stale>> spans(tracks.size());
  if (frames < 4) return spans;
  FlagTable repeats(frames - 1, tracks.size()), straight(frames - 2, tracks.size());
  std::vector<ChangeScale> step_scales(tracks.size()), bend_scales(tracks.size());
  for_each_parallel(tracks.size(), frames * tracks.size(), [&](std::size_t n) {
    step_scales[n] = ChangeScale(tracks[n].steps);
    bend_scales[n] = ChangeScale(tracks[n].bends);
    if (step_scales[n].usual <= least_usual) return;
    set_flags(tracks[n].steps, share_of_usual * step_scales[n].usual, n, repeats);
    set_flags(tracks[n].bends, share_of_usual * bend_scales[n].usual, n, straight);
    // A frozen span is also a straight line.
    for (std::size_t t = 0; t + 2 < frames; ++t) {
      if (repeats(t, n) == Flag::yes || repeats(t + 1, n) == Flag::yes) straight(t, n) = Flag::no;
    }
  });
  const auto frozen_runs =
      improbable_runs(repeats, std::max(shortest_frozen_steps, shortest_frames - 1));
  const auto straight_runs =
      improbable_runs(straight, std::max(shortest_straight_steps, shortest_frames));
  for (std::size_t n = 0; n < tracks.size(); ++n) {
    for (const FrameSpan& run : frozen_runs[n]) {
      // The first of the equal samples was measured.
      if (has_sharp_end(tracks[n].steps, run, step_scales[n]))
        spans[n].push_back({{run.first + 1, run.last + 1}, FindingKind::frozen});
    }
    for (const FrameSpan& run : straight_runs[n]) {
      if (has_sharp_end(tracks[n].bends, run, bend_scales[n]) &&
          moves_along(tracks[n].steps, run, step_scales[n]))
        spans[n].push_back({{run.first + 1, run.last + 1}, FindingKind::bridged});
    }
    std::sort(spans[n].begin(), spans[n].end(),
              [](const Stale& a, const Stale& b) { return a.span.first < b.span.first; });
  }
  return spans;
}

void report_stale(const std::vector<Stale>& spans, TrackHealth& track, CheckReport& report) {
  report.figures.frozen += spans.size();
  for (const auto& [span, kind] : spans) {
    const bool is_frozen = kind == FindingKind::frozen;
    ++(is_frozen ? track.frozen : track.bridged);
    const double seconds = static_cast<double>(span.length()) / report.frame_rate_hz;
    report.stale.push_back({track.name, span.first, span.last});
    report.findings.push_back({kind, seconds >= 0.5 ? Severity::serious : Severity::warning,
                               track.name, span.first, span.last, seconds, "s",
                               is_frozen ? "repeats its last value exactly while others move"
                                         : "moves in a straight line, as a bridged gap does"});
  }
}

double largest_component(Vec3 v) {
  return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

// A gap in a rotation is bridged along the geodesic or in the file's angles; its bends are those of
// the straighter one.
TrackChanges rotation_changes(const Take& clip, std::size_t joint) {
  const std::size_t frames = clip.frame_count();
  const RotationOrder order = clip.skeleton.rotation_order(joint);
  TrackChanges changes;
  changes.steps.reserve(frames);
  changes.bends.reserve(frames);
  Vec3 last_turn, last_step;
  std::array<double, 3> last_angles{};
  bool had_step = false;
  if (frames > 0) last_angles = to_euler(clip.rotation(0, joint), order);
  for (std::size_t t = 0; t + 1 < frames; ++t) {
    const bool seen = clip.is_observed(t, joint) && clip.is_observed(t + 1, joint);
    const Vec3 turn = log(conjugate(clip.rotation(t, joint)) * clip.rotation(t + 1, joint));
    const std::array<double, 3> angles =
        to_euler_near(clip.rotation(t + 1, joint), order, last_angles);
    const Vec3 step{angles[0] - last_angles[0], angles[1] - last_angles[1],
                    angles[2] - last_angles[2]};
    if (t > 0) {
      changes.bends.push_back(
          seen && had_step ? std::min(norm(turn - last_turn), largest_component(step - last_step))
                           : -1);
    }
    changes.steps.push_back(seen ? norm(turn) : -1);
    last_turn = turn, last_step = step, last_angles = angles, had_step = seen;
  }
  return changes;
}

TrackChanges position_changes(const Take& clip, std::size_t marker) {
  TrackChanges changes;
  for (std::size_t t = 0; t + 1 < clip.frame_count(); ++t) {
    const bool seen = clip.is_observed(t, marker) && clip.is_observed(t + 1, marker);
    const Vec3 step = clip.position(t + 1, marker) - clip.position(t, marker);
    if (t > 0) {
      const Vec3 last = clip.position(t, marker) - clip.position(t - 1, marker);
      changes.bends.push_back(seen && clip.is_observed(t - 1, marker) ? norm(step - last) : -1);
    }
    changes.steps.push_back(seen ? norm(step) : -1);
  }
  return changes;
}

}  // namespace

void check_stale(const Rows& rows, const CheckSettings& settings, CheckReport& report) {
  const Take& clip = rows.clip;
  const bool joints = clip.has_joints();
  std::vector<std::size_t> kept;  // rows; joints that never move are left out
  for (std::size_t n = 0; n < rows.tracks.size(); ++n) {
    if (!joints || joint_moves(clip, rows.tracks[n])) kept.push_back(n);
  }
  const std::size_t samples = joints ? clip.rotations.size() : clip.positions.size();
  std::vector<TrackChanges> changes(kept.size());
  for_each_parallel(kept.size(), samples, [&](std::size_t i) {
    const std::size_t track = rows.tracks[kept[i]];
    changes[i] = joints ? rotation_changes(clip, track) : position_changes(clip, track);
  });
  const std::size_t shortest = frames_in(settings.shortest_stale_s, report.frame_rate_hz, 2);
  std::vector<std::vector<Stale>> spans =
      find_stale(changes, joints ? least_usual_rad : 0, clip.frame_count(), shortest);
  if (joints) {
    for_each_parallel(kept.size(), samples, [&](std::size_t i) {
      leave_out_hinge_ends(clip, rows.tracks[kept[i]], spans[i]);
    });
  }
  for (std::size_t i = 0; i < kept.size(); ++i)
    report_stale(spans[i], report.tracks[kept[i]], report);
}

}  // namespace kinemend::check
