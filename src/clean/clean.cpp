#include "kinemend/clean.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>

#include "clean/changes.hpp"
#include "clean/clip_tracks.hpp"
#include "clean/feet_step.hpp"
#include "clean/gap_step.hpp"
#include "clean/selection.hpp"
#include "motion/calibration.hpp"

namespace kinemend {

namespace {

Selection make_selection(const Clip& clip, const CleanSettings& settings) {
  Selection selection = Selection::all(clip);
  selection.joints = select_names(clip.skeleton.names, settings, "joint");
  selection.root_position = settings.root_position && clip.joint_count() > 0 &&
                            selection.joints[0] != 0 && clip.skeleton.has_position_channels(0);
  return selection;
}

// The input without its rotations, and how to get from it to the result.
struct Work {
  const CleanSettings& settings;
  const Selection& selection;
  Clip before;        // positions only
  std::size_t first;  // frame of the motion: the number of calibration frames
  std::vector<double> weights, nothing;

  double least_shift() const { return 1e-11 * typical_bone_length(before.skeleton); }
};

Clip positions_of(const Clip& clip) {
  Clip positions;
  positions.skeleton = clip.skeleton;
  positions.translated_joints = clip.translated_joints;
  positions.root_positions = clip.root_positions;
  positions.joint_translations = clip.joint_translations;
  positions.observed_positions = clip.observed_positions;
  return positions;
}

// Blends a joint's rotations with their input, and puts them into the motion.
JointReport finish_joint(const Work& work, Clip& motion, std::size_t joint, JointTracks tracks) {
  // The rotation of a joint without rotation channels has no place in a file.
  const RotationOrder order = motion.skeleton.rotation_order(joint);
  const bool may_turn = work.selection.joints[joint] && order.count > 0;
  const TrackChanges changes =
      blend_rotations(tracks, order, work.settings, may_turn ? work.weights : work.nothing);
  set_joint_track(motion, joint, tracks.after);
  return report_joint(motion.skeleton.names[joint], joint, tracks, changes, work.first,
                      motion.frame_rate_hz, work.settings.peak_loss_limit);
}

void add_joints(std::vector<JointReport> parts, const CleanTrace& trace, CleanReport& report) {
  for (std::size_t j = 0; j < parts.size(); ++j) {
    if (!trace.noise_deg.empty()) parts[j].summary.noise_deg = trace.noise_deg[j];
    report.joints.push_back(std::move(parts[j].summary));
    report.spans.insert(report.spans.end(), parts[j].spans.begin(), parts[j].spans.end());
    std::move(parts[j].warnings.begin(), parts[j].warnings.end(),
              std::back_inserter(report.warnings));
  }
}

// What was observed of a joint; empty: all.
std::vector<std::uint8_t> observed_of(const std::vector<std::uint8_t>& observed, std::size_t joints,
                                      std::size_t joint) {
  std::vector<std::uint8_t> result;
  for (std::size_t i = joint; i < observed.size(); i += joints) result.push_back(observed[i]);
  return result;
}

// Of position track `track` of the take, as `Clip::is_position_observed` counts them.
std::vector<std::uint8_t> observed_positions(const Work& work, std::size_t track,
                                             std::size_t frames) {
  std::vector<std::uint8_t> observed;
  if (work.before.observed_positions.empty()) return observed;
  for (std::size_t f = 0; f < frames; ++f)
    observed.push_back(work.before.is_position_observed(work.first + f, track));
  return observed;
}

void finish_root(const Work& work, const CleanTrace& trace, Clip& motion, CleanReport& report) {
  const auto before = std::span(work.before.root_positions).subspan(work.first);
  const TrackChanges changes = blend_positions(
      before, motion.root_positions,
      {observed_positions(work, 0, motion.frame_count()), trace.root_actions},
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

void finish_translations(const Work& work, const CleanTrace& trace, Clip& motion) {
  const std::size_t width = motion.translated_joints.size(), frames = motion.frame_count();
  for (std::size_t i = 0; i < width && frames > 0; ++i) {
    std::vector<Vec3> before(frames);
    for (std::size_t f = 0; f < frames; ++f) {
      before[f] = work.before.joint_translations[(work.first + f) * width + i];
    }
    const PositionTrack track{motion.joint_translations.data() + i, width};
    std::vector<Vec3> after = position_track(track, frames);
    PositionMarks marks{observed_positions(work, i + 1, frames), {}};
    for (std::size_t f = 0; f < frames && !trace.translation_actions.empty(); ++f)
      marks.stated.push_back(trace.translation_actions[f * width + i]);
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

// One stage of the work, told of from its beginning to its end.
class Stage {
 public:
  Stage(const CleanSettings& settings, std::string_view name) : settings_(settings), name_(name) {
    tell(0);
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
  void finish() const { tell(1); }
  /// What the work itself may tell: nothing where nobody listens.
  std::function<void(double)> shares() const {
    if (!settings_.progress) return {};
    return [this](double done) {
      if (done < 1) tell(done);
    };
  }

 private:
  void tell(double done) const {
    if (settings_.progress) settings_.progress(name_, done);
  }

  const CleanSettings& settings_;
  std::string_view name_;
};

// Filling and holding feet look at many joints at once: the whole motion is cleaned beside the
// input.
void clean_whole(Clip& motion, const Cleaner& cleaner, const Work& work, CleanReport& report) {
  const Clip input = motion;
  const CleanSettings& settings = work.settings;
  bridge_positions(motion);
  const Stage cleaning(settings, "cleaning");
  CleanTrace trace = cleaner.clean(motion, work.selection);
  report.warnings = trace.warnings;
  report.fall_backs = trace.fall_backs;
  cleaning.finish();
  if (settings.fill) {
    const Stage stage(settings, "filling");
    report.fill =
        fill_step(input, cleaner, work.selection, work.weights, *settings.fill, trace, motion);
    for (GapOutcome& outcome : report.fill.gaps) {
      outcome.gap.first_frame += work.first;
      outcome.gap.last_frame += work.first;
    }
    report.warnings.insert(report.warnings.end(), report.fill.warnings.begin(),
                           report.fill.warnings.end());
    state_filled(input.observed, motion, trace);
    stage.finish();
  }
  if (settings.feet) {
    const Stage stage(settings, "feet");
    report.feet = feet_step(motion, work.selection, *settings.feet, work.first, trace);
    report.warnings.insert(report.warnings.end(), report.feet->warnings.begin(),
                           report.feet->warnings.end());
    stage.finish();
  }
  const std::size_t joints = motion.joint_count(), frames = motion.frame_count();
  std::vector<JointReport> parts(joints);
  finish_root(work, trace, motion, report);
  finish_translations(work, trace, motion);
  for_each_parallel(joints, motion.local_rotations.size(), [&](std::size_t j) {
    JointTracks tracks{
        joint_track(input, j), joint_track(motion, j), observed_of(input.observed, joints, j), {}};
    for (std::size_t f = 0; f < frames && !trace.actions.empty(); ++f)
      tracks.stated.push_back(trace.actions[f * joints + j]);
    parts[j] = finish_joint(work, motion, j, std::move(tracks));
  });
  add_joints(std::move(parts), trace, report);
}

// Each joint takes the place of its input as soon as it is cleaned, so that there is one copy of
// the take.
void clean_joint_by_joint(Clip& motion, const Cleaner& cleaner, const Work& work,
                          CleanReport& report) {
  const std::size_t joints = motion.joint_count();
  const std::vector<std::uint8_t> observed = motion.observed;
  bridge_positions(motion);
  std::vector<JointReport> parts(joints);
  std::vector<std::uint8_t> finished(joints);
  const auto finish = [&](std::size_t joint, std::vector<Quat> after, std::vector<Action> stated) {
    parts[joint] = finish_joint(work, motion, joint,
                                {joint_track(motion, joint), std::move(after),
                                 observed_of(observed, joints, joint), std::move(stated)});
    finished[joint] = 1;
  };
  const Stage stage(work.settings, "cleaning");
  const CleanTrace trace = cleaner.clean_joints(motion, work.selection, finish, stage.shares());
  report.warnings.insert(report.warnings.end(), trace.warnings.begin(), trace.warnings.end());
  report.fall_backs = trace.fall_backs;
  for_each_parallel(joints, motion.local_rotations.size(), [&](std::size_t j) {
    if (finished[j] == 0) finish(j, joint_track(motion, j), {});
  });
  finish_root(work, trace, motion, report);
  finish_translations(work, trace, motion);
  add_joints(std::move(parts), trace, report);
  stage.finish();
}

}  // namespace

CleanResult clean_clip(const Clip& clip, const Cleaner& cleaner, const CleanSettings& settings,
                       std::string method_name) {
  return clean_clip(Clip(clip), cleaner, settings, std::move(method_name));
}

CleanResult clean_clip(Clip&& clip, const Cleaner& cleaner, const CleanSettings& settings,
                       std::string method_name) {
  const auto start = std::chrono::steady_clock::now();
  const std::size_t frames = clip.frame_count();
  check_settings(settings, frames);
  const Selection selection = make_selection(clip, settings);

  CleanResult result;
  CleanReport& report = result.report;
  report.method = std::move(method_name);
  report.frames = frames;
  report.frame_rate_hz = clip.frame_rate_hz;
  report.calibration_frames = leading_calibration_frames(clip);
  const std::size_t first = report.calibration_frames;
  const Work work{settings,
                  selection,
                  positions_of(clip),
                  first,
                  frame_weights(settings, frames, first, clip.frame_rate_hz),
                  std::vector<double>(frames - first, 0.0)};
  result.clip = std::move(clip);
  on_motion(result.clip, first, [&](Clip& motion) {
    if (settings.fill || settings.feet) {
      clean_whole(motion, cleaner, work, report);
    } else {
      clean_joint_by_joint(motion, cleaner, work, report);
    }
  });
  if (report.feet && takes_part_only(settings) && !report.feet->contacts.empty())
    report.feet->after = feet_figures(result.clip, report.feet->contacts);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace kinemend
