#include "kinemend/clean.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <utility>

#include "clean/changes.hpp"
#include "clean/feet_step.hpp"
#include "clean/gap_step.hpp"
#include "clean/selection.hpp"
#include "clean/tracks.hpp"

namespace kinemend {

namespace {

Selection make_selection(const Clip& clip, const CleanSettings& settings) {
  Selection selection = Selection::all(clip);
  selection.joints = select_names(clip.skeleton.names, settings, "joint");
  selection.root_position = settings.root_position && clip.joint_count() > 0 &&
                            selection.joints[0] != 0 && clip.skeleton.has_position_channels(0);
  return selection;
}

template <class T>
void put_back(std::vector<T>& whole, const std::vector<T>& part, std::size_t first_frame,
              std::size_t width) {
  if (part.empty()) return;  // as may be `whole`, of which nothing is offset then
  std::copy(part.begin(), part.end(),
            whole.begin() + static_cast<std::ptrdiff_t>(first_frame * width));
}

// The tracks of a joint of the take (from `first` on) and of the cleaned motion.
JointTracks tracks_of(const Clip& clip, const Clip& motion, const CleanTrace& trace,
                      std::size_t first, std::size_t joint) {
  JointTracks tracks;
  const std::size_t frames = motion.frame_count(), joints = clip.joint_count();
  tracks.before.resize(frames);
  for (std::size_t f = 0; f < frames; ++f) tracks.before[f] = clip.rotation(first + f, joint);
  tracks.after = joint_track(motion, joint);
  if (!clip.observed.empty()) {
    tracks.observed.resize(frames);
    for (std::size_t f = 0; f < frames; ++f) {
      tracks.observed[f] = clip.is_observed(first + f, joint);
    }
  }
  if (!trace.actions.empty()) {
    tracks.stated.resize(frames);
    for (std::size_t f = 0; f < frames; ++f) tracks.stated[f] = trace.actions[f * joints + joint];
  }
  return tracks;
}

// The input and the motion after the cleaner, on their way to the result.
struct Work {
  const Clip& clip;
  const CleanSettings& settings;
  const Selection& selection;
  const CleanTrace& trace;
  std::size_t first;  // frame of the motion: the number of calibration frames
  std::vector<double> weights, nothing;

  double least_shift() const { return 1e-11 * typical_bone_length(clip.skeleton); }
};

void finish_rotations(const Work& work, Clip& motion, CleanReport& report) {
  const std::size_t joints = motion.joint_count();
  std::vector<JointReport> parts(joints);
  for_each_parallel(joints, motion.local_rotations.size(), [&](std::size_t j) {
    JointTracks tracks = tracks_of(work.clip, motion, work.trace, work.first, j);
    // The rotation of a joint without rotation channels has no place in a file.
    const RotationOrder order = motion.skeleton.rotation_order(j);
    const bool may_turn = work.selection.joints[j] && order.count > 0;
    const TrackChanges changes =
        blend_rotations(tracks, order, work.settings, may_turn ? work.weights : work.nothing);
    set_joint_track(motion, j, tracks.after);
    parts[j] = report_joint(motion.skeleton.names[j], j, tracks, changes, work.first,
                            motion.frame_rate_hz, work.settings.peak_loss_limit);
  });
  for (std::size_t j = 0; j < joints; ++j) {
    if (!work.trace.noise_deg.empty()) parts[j].summary.noise_deg = work.trace.noise_deg[j];
    report.joints.push_back(std::move(parts[j].summary));
    report.spans.insert(report.spans.end(), parts[j].spans.begin(), parts[j].spans.end());
    if (!parts[j].warning.empty()) report.warnings.push_back(std::move(parts[j].warning));
  }
}

// Of position track `track` of the take, as `Clip::is_position_observed` counts them.
std::vector<std::uint8_t> observed_positions(const Work& work, std::size_t track,
                                             std::size_t frames) {
  std::vector<std::uint8_t> observed;
  if (work.clip.observed_positions.empty()) return observed;
  for (std::size_t f = 0; f < frames; ++f)
    observed.push_back(work.clip.is_position_observed(work.first + f, track));
  return observed;
}

void finish_root(const Work& work, Clip& motion, CleanReport& report) {
  const auto before = std::span(work.clip.root_positions).subspan(work.first);
  const TrackChanges changes = blend_positions(
      before, motion.root_positions,
      {observed_positions(work, 0, motion.frame_count()), work.trace.root_actions},
      motion.skeleton.channels[0], work.selection.root_position ? work.weights : work.nothing,
      work.least_shift());
  double squares = 0;
  for (const double change : changes.amounts) {
    squares += change * change;
    report.root_max_change = std::max(report.root_max_change, change);
  }
  if (!before.empty())
    report.root_rms_change = std::sqrt(squares / static_cast<double>(before.size()));
  report.spans = spans_of(-1, changes, work.first);
}

void finish_translations(const Work& work, Clip& motion) {
  const std::size_t width = motion.translated_joints.size(), frames = motion.frame_count();
  for (std::size_t i = 0; i < width && frames > 0; ++i) {
    std::vector<Vec3> before(frames);
    for (std::size_t f = 0; f < frames; ++f) {
      before[f] = work.clip.joint_translations[(work.first + f) * width + i];
    }
    const PositionTrack track{motion.joint_translations.data() + i, width};
    std::vector<Vec3> after = position_track(track, frames);
    PositionMarks marks{observed_positions(work, i + 1, frames), {}};
    for (std::size_t f = 0; f < frames && !work.trace.translation_actions.empty(); ++f)
      marks.stated.push_back(work.trace.translation_actions[f * width + i]);
    const bool selected = translation_selected(motion, work.selection, i);
    const auto joint = static_cast<std::size_t>(motion.translated_joints[i]);
    blend_positions(before, after, marks, motion.skeleton.channels[joint],
                    selected ? work.weights : work.nothing, work.least_shift());
    set_position_track(track, after);
  }
}

// Also where the cleaner did not look at a gap.
void state_filled(const std::vector<std::uint8_t>& observed, const Clip& motion,
                  CleanTrace& trace) {
  if (observed == motion.observed) return;
  if (trace.actions.empty()) trace.actions.assign(motion.local_rotations.size(), Action::kept);
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (observed[i] == 0 && motion.observed[i] != 0) trace.actions[i] = Action::filled;
  }
}

// Whether blending leaves something of the input.
bool takes_part_only(const CleanSettings& settings) {
  return settings.strength < 1 || settings.max_change_deg < 180 || settings.range;
}

}  // namespace

CleanResult clean_clip(const Clip& clip, const Cleaner& cleaner, const CleanSettings& settings,
                       std::string method_name) {
  const auto start = std::chrono::steady_clock::now();
  check_settings(settings, clip.frame_count());
  const Selection selection = make_selection(clip, settings);

  CleanResult result;
  CleanReport& report = result.report;
  report.method = std::move(method_name);
  report.frames = clip.frame_count();
  report.frame_rate_hz = clip.frame_rate_hz;
  report.calibration_frames = leading_calibration_frames(clip);
  const std::size_t first = report.calibration_frames;

  Clip motion = slice(clip, first, clip.frame_count());
  const std::size_t frames = motion.frame_count();
  std::vector<double> weights =
      frame_weights(settings, clip.frame_count(), first, clip.frame_rate_hz);
  const Clip measured = settings.fill ? motion : Clip{};
  bridge_positions(motion);
  CleanTrace trace = cleaner.clean(motion, selection);
  report.warnings = trace.warnings;
  if (settings.fill) {
    report.fill = fill_step(measured, cleaner, selection, weights, *settings.fill, trace, motion);
    for (GapOutcome& outcome : report.fill.gaps) {
      outcome.gap.first_frame += first;
      outcome.gap.last_frame += first;
    }
    report.warnings.insert(report.warnings.end(), report.fill.warnings.begin(),
                           report.fill.warnings.end());
    state_filled(measured.observed, motion, trace);
  }
  if (settings.feet) {
    report.feet = feet_step(motion, selection, *settings.feet, first, trace);
    report.warnings.insert(report.warnings.end(), report.feet->warnings.begin(),
                           report.feet->warnings.end());
  }
  const Work work{clip,
                  settings,
                  selection,
                  trace,
                  first,
                  std::move(weights),
                  std::vector<double>(frames, 0.0)};
  finish_root(work, motion, report);
  finish_translations(work, motion);
  finish_rotations(work, motion, report);

  if (first == 0) {
    motion.source = clip.source;
    result.clip = std::move(motion);
  } else {
    result.clip = clip;
    put_back(result.clip.observed, motion.observed, first, clip.joint_count());
    put_back(result.clip.observed_positions, motion.observed_positions, first,
             1 + clip.translated_joints.size());
    put_back(result.clip.local_rotations, motion.local_rotations, first, clip.joint_count());
    put_back(result.clip.root_positions, motion.root_positions, first, 1);
    put_back(result.clip.joint_translations, motion.joint_translations, first,
             clip.translated_joints.size());
  }
  if (report.feet && takes_part_only(settings) && !report.feet->contacts.empty())
    report.feet->after = feet_figures(result.clip, report.feet->contacts);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace kinemend
