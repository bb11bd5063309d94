// The main path: mends labels, runs a cleaner on a take, fills gaps, holds feet, blends, and
// reports.
#include "kinemend/clean.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <mutex>
#include <string_view>
#include <utility>

#include "clean/changes.hpp"
#include "clean/steps.hpp"
#include "cleaner/pieces.hpp"
#include "kinemend/extend/system.hpp"
#include "methods/auto/auto.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace {

// Whether blending keeps some of the input.
bool takes_part_only(const CleanSettings& settings) {
  return settings.strength < 1 || settings.max_change_deg < 180 || settings.range;
}

// Reports progress of one stage of the work.
class Stage {
 public:
  Stage(const CleanSettings& settings, std::string_view name) : settings_(settings), name_(name) {
    tell(0);
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
  void finish() const { tell(1); }
  /// Reports progress again so that the listener can cancel by throwing.
  void ask() const { tell(0); }
  /// Returns the progress callback for the work itself; empty without a listener.
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

// The data that turns a cleaner's result on a track into the final result.
struct Work {
  const CleanSettings& settings;
  Selection selection;
  std::size_t first;            // number of calibration frames, where the motion begins
  std::vector<double> weights;  // one for each frame of motion
  ReportScale scale;
  double least_shift = 0;  // file units
  MeasuredNoise measured{};
};

// Finishes the cleaner's tracks one by one, writing each over its input as soon as it arrives.
class Finisher {
 public:
  Finisher(const Work& work, const TakeView& take, Take& clip)
      : work_(work),
        take_(take),
        clip_(clip),
        nothing_(work.weights.size(), 0.0),
        reports_(take.tracks.size()),
        finished_(take.tracks.size()) {}

  void finish(std::size_t track, CleanedTrack cleaned) {
    if (take_.tracks[track].space == Space::rotation) {
      finish_rotations(track, std::move(cleaned));
    } else {
      finish_positions(track, std::move(cleaned));
    }
    finished_[track] = 1;
  }

  // Finishes the tracks that the cleaner left alone.
  void finish_others() {
    for_each_parallel(take_.tracks.size(), take_.tracks.size() * take_.frames, [&](std::size_t n) {
      if (finished_[n] == 0) finish(n, as_it_stands(n));
    });
  }

  void report(const CleanTrace& trace, CleanReport& report) {
    if (take_.joints) report_root(report);
    const std::vector<std::string> warnings = warnings_of(reports_, report.kind, work_.scale);
    report.warnings.insert(report.warnings.end(), warnings.begin(), warnings.end());
    for (std::size_t n = 0; n < take_.owners; ++n) {
      TrackReport& own = reports_[n];
      TrackSummary& summary = own.summary;
      if (!work_.measured.noise.empty()) summary.noise = work_.measured.noise[n];
      if (!trace.left.empty()) {
        summary.left = trace.left[n];
        summary.expected_noise = trace.noise[n];
      }
      if (take_.markers && !take_.markers->holds_positions(n)) {
        summary.is_position = false;
        summary.noise = summary.expected_noise = summary.left = 0;
        summary.gaps_left = summary.frames_missing = 0;
      }
      report.spans.insert(report.spans.end(), own.spans.begin(), own.spans.end());
      report.tracks.push_back(summary);
    }
  }

 private:
  template <class Sample>
  TrackEdit<Sample> edit_of(std::size_t track, std::vector<Sample> before,
                            std::vector<Sample> after, std::vector<Action> stated) const {
    return {std::move(before), std::move(after), observed_of(take_.tracks[track]),
            std::move(stated)};
  }

  void finish_rotations(std::size_t joint, CleanedTrack cleaned) {
    const Track& track = take_.tracks[joint];
    TrackEdit<Quat> edit = edit_of(joint, rotations_of(track), std::move(cleaned.rotations),
                                   std::move(cleaned.actions));
    // A file cannot store the rotation of a joint without rotation channels.
    const RotationOrder order = take_.joints->skeleton.rotation_order(joint);
    const bool may_turn = track.selected && order.count > 0;
    const TrackChanges changes =
        blend(edit, order, work_.settings.max_change_deg * radians_per_degree,
              may_turn ? work_.weights : nothing_);
    set_track(clip_, joint, edit.after);
    reports_[joint] = report_track(take_.joints->skeleton.names[joint], joint, edit, changes,
                                   measure_of(joint), cleaned.noise, work_.scale);
  }

  void finish_positions(std::size_t number, CleanedTrack cleaned) {
    const Track& track = take_.tracks[number];
    TrackEdit<Vec3> edit = edit_of(number, positions_of(track), std::move(cleaned.positions),
                                   std::move(cleaned.actions));
    PositionLimits limits;
    limits.gaps = take_.gaps;
    limits.least = work_.least_shift;
    if (take_.joints) {
      const auto joint = static_cast<std::size_t>(std::max(track.owner, 0));
      limits.axes = position_axes(take_.joints->skeleton.channels[joint]);
    } else {
      limits.most = work_.settings.max_change;
    }
    const TrackChanges changes = blend(edit, limits, track.selected ? work_.weights : nothing_);
    if (take_.markers) {
      put_back_marker(number, edit.after, changes);
      reports_[number] = report_track(take_.markers->names[number], number, edit, changes,
                                      measure_of(number), cleaned.noise, work_.scale);
      return;
    }
    set_track(clip_, number, edit.after);
    if (number == take_.root_track()) root_ = changes;
  }

  TrackMeasure measure_of(std::size_t track) const {
    if (work_.measured.noise.empty()) return {};
    return {work_.measured.coloured[track], work_.measured.spikes[track]};
  }

  // A missing sample stays missing unless it was filled.
  void put_back_marker(std::size_t marker, const std::vector<Vec3>& samples,
                       const TrackChanges& changes) {
    for (std::size_t f = 0; f < samples.size(); ++f) {
      const std::size_t sample = f * take_.owners + marker;
      const bool filled = changes.actions[f] == Action::filled && clip_.observed[sample] == 0;
      if (clip_.observed[sample] == 0 && !filled) continue;
      clip_.positions[sample] = samples[f];
      if (!filled) continue;
      clip_.observed[sample] = 1;
      if (!clip_.residuals.empty()) clip_.residuals[sample] = 0;
    }
  }

  CleanedTrack as_it_stands(std::size_t number) const {
    const Track& track = take_.tracks[number];
    if (track.space == Space::position && take_.gaps == GapTreatment::bridge)
      return {{}, std::move(position_pieces(take_, number).front().samples), {}};
    return {rotations_of(track), positions_of(track), {}};
  }

  void report_root(CleanReport& report) const {
    double squares = 0;
    for (const double change : root_.amounts) {
      squares += change * change;
      report.root_max_change = std::max(report.root_max_change, change);
    }
    if (take_.frames > 0)
      report.root_rms_change = std::sqrt(squares / static_cast<double>(take_.frames));
    report.spans = spans_of(-1, root_, work_.first);
  }

  const Work& work_;
  const TakeView& take_;
  Take& clip_;
  std::vector<double> nothing_;
  std::vector<TrackReport> reports_;  // for joints' rotations and markers
  TrackChanges root_;
  std::vector<std::uint8_t> finished_;
};

// States filled samples, also in gaps that the cleaner skipped.
void state_filled(const TakeView& measured, const TakeView& filled, InPlaceTrace& trace) {
  for (std::size_t n = 0; n < measured.owners; ++n) {
    for (std::size_t f = 0; f < measured.frames; ++f) {
      if (measured.tracks[n].is_observed(f) || !filled.tracks[n].is_observed(f)) continue;
      if (trace.actions[n].empty()) trace.actions[n].assign(measured.frames, Action::kept);
      trace.actions[n][f] = Action::filled;
    }
  }
}

void hold_feet(const Work& work, Take& cleaned, InPlaceTrace& trace, CleanReport& report) {
  const Stage stage(work.settings, "feet");
  report.feet = feet_step(cleaned, work.selection, *work.settings.feet, work.first, trace);
  report.warnings.insert(report.warnings.end(), report.feet->warnings.begin(),
                         report.feet->warnings.end());
  stage.finish();
}

// Joins the measured noise and the noise that the method's model expects: slow noise, and noise of
// a space in which none was measured.
std::vector<NoiseCharacter> noise_of(const MeasuredNoise& measured, const CleanTrace& trace) {
  std::vector<NoiseCharacter> noise = measured.characters;
  if (trace.left.empty()) return noise;
  for (NoiseCharacter character : trace.characters) {
    const bool is_measured =
        std::any_of(measured.characters.begin(), measured.characters.end(),
                    [&](const NoiseCharacter& own) { return own.space == character.space; });
    // White noise shows from frame to frame, so the measurement finds it if it exists.
    if (!character.is_expected && (is_measured || character.correlation == 0)) continue;
    character.is_expected = true;
    noise.push_back(character);
  }
  return noise;
}

// Takes over what the cleaner states about the whole take.
void state_trace(const CleanTrace& trace, const Work& work, CleanReport& report) {
  report.warnings.insert(report.warnings.end(), trace.warnings.begin(), trace.warnings.end());
  report.fall_backs = trace.fall_backs;
  report.notes = trace.notes;
  report.noise = noise_of(work.measured, trace);
}

void fill(const Work& work, const Take& motion, const Cleaner& cleaner, Take& cleaned,
          InPlaceTrace& trace, CleanReport& report) {
  const Stage stage(work.settings, "filling");
  // Several threads fill gaps; one at a time checks for a cancellation.
  std::mutex asking;
  const FillCheck check = [&] {
    const std::lock_guard lock(asking);
    stage.ask();
  };
  report.fill = fill_step(motion, cleaner, work.selection, work.weights, *work.settings.fill, trace,
                          cleaned, check);
  for (GapOutcome& outcome : report.fill.gaps) {
    outcome.gap.first_frame += work.first;
    outcome.gap.last_frame += work.first;
  }
  report.warnings.insert(report.warnings.end(), report.fill.warnings.begin(),
                         report.fill.warnings.end());
  state_filled(view_of(motion, work.selection), view_of(cleaned), trace);
  stage.finish();
}

// Filling and holding feet read many tracks at once, so a copy of the whole motion is cleaned.
CleanTrace clean_whole(Take& motion, const Cleaner& cleaner, const Work& work, Finisher& finisher,
                       CleanReport& report) {
  Take cleaned = motion;
  const Stage cleaning(work.settings, "cleaning");
  InPlaceTrace trace = clean_in_place(cleaner, cleaned, work.selection, cleaning.shares());
  state_trace(trace, work, report);
  cleaning.finish();
  if (work.settings.fill) fill(work, motion, cleaner, cleaned, trace, report);
  if (work.settings.feet) hold_feet(work, cleaned, trace, report);
  const TakeView result = view_of(cleaned);
  for_each_parallel(result.tracks.size(), result.tracks.size() * result.frames, [&](std::size_t n) {
    finisher.finish(n, {rotations_of(result.tracks[n]), positions_of(result.tracks[n]),
                        std::move(trace.actions[n]), trace.coloured[n]});
  });
  if (motion.has_joints()) {
    motion.observed = cleaned.observed;
    motion.observed_positions = cleaned.observed_positions;
  }
  return trace;
}

void clean_motion(Take& motion, const Cleaner& cleaner, Work work, CleanReport& report) {
  work.scale.first_frame = work.first;
  work.scale.frame_rate_hz = motion.frame_rate_hz;
  work.scale.peak_loss_limit = work.settings.peak_loss_limit;
  const TakeView take = view_of(motion, work.selection);
  work.measured = measure_noise(take);
  Finisher finisher(work, take, motion);
  if (work.settings.fill || (work.settings.feet && motion.has_joints()))
    return finisher.report(clean_whole(motion, cleaner, work, finisher, report), report);
  // Each track replaces its input as soon as it is cleaned, so only one copy of the take exists.
  const Stage stage(work.settings, "cleaning");
  const TrackSink finish = [&](std::size_t track, CleanedTrack cleaned) {
    finisher.finish(track, std::move(cleaned));
  };
  const CleanTrace trace = cleaner.clean(take, finish, stage.shares());
  state_trace(trace, work, report);
  finisher.finish_others();
  finisher.report(trace, report);
  stage.finish();
}

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

CleanReport report_for(const Take& take, const Cleaner& cleaner, const CleanSettings& settings) {
  CleanReport report;
  report.method = cleaner.name();
  report.options = cleaner.options();
  report.source = source_of(take, settings.source);
  report.frames = take.frame_count();
  report.frame_rate_hz = take.frame_rate_hz;
  if (take.has_joints()) {
    report.unit = "deg";
    report.calibration_frames = leading_calibration_frames(take);
  } else {
    report.kind = TakeKind::markers;
    report.unit = take.unit;
    report.body_height = body_height(take);
  }
  return report;
}

void warn_of_feet(const CleanSettings& settings, CleanReport& report) {
  if (!settings.feet || settings.feet->mode == FeetMode::off) return;
  report.warnings.emplace_back(
      "feet: markers are measured points and stay where they are; feet are held in takes of "
      "joints");
}

// Settings in which the source of the take has decided whether feet are held.
CleanSettings with_feet_by_source(CleanSettings settings, const Take& take, Source source) {
  if (!settings.feet || settings.feet->mode != FeetMode::by_source) return settings;
  if (take.has_joints() && (expects_slow_noise(source) || settings.feet->contacts))
    settings.feet->mode = FeetMode::automatic;
  else
    settings.feet.reset();
  return settings;
}

// Changes below rounding are ignored; the limit follows from the size of the body.
Work work_of(const Take& take, const CleanSettings& settings, const CleanReport& report) {
  // Not swept.
  constexpr double rounding_of_bone = 1e-11, rounding_of_body = 1e-13;
  const bool joints = take.has_joints();
  const std::size_t first = report.calibration_frames;
  Selection selection = selection_of(take, settings);
  selection.source = report.source.source;
  return {settings,
          std::move(selection),
          first,
          frame_weights(settings, report.frames, first, take.frame_rate_hz),
          joints ? joint_scale() : marker_scale(take.unit, report.body_height),
          joints ? rounding_of_bone * typical_bone_length(take.skeleton)
                 : rounding_of_body * report.body_height};
}

std::vector<MarkerSwap> undo_found_swaps(Take& take, const CleanSettings& settings) {
  if (!settings.fix_swaps || take.has_joints()) return {};
  std::vector<MarkerSwap> swaps = find_swaps(take);
  undo_swaps(take, swaps);
  return swaps;
}

}  // namespace

CleanResult clean_take(const Take& take, const Cleaner& cleaner, const CleanSettings& settings) {
  return clean_take(Take(take), cleaner, settings);
}

CleanResult clean_take(Take&& take, const Cleaner& cleaner, const CleanSettings& wanted) {
  check_settings(wanted, take.frame_count());
  const CleanSettings settings =
      with_feet_by_source(wanted, take, source_of(take, wanted.source).source);
  std::vector<MarkerSwap> swaps = undo_found_swaps(take, settings);
  mark_gaps(take, settings.gaps);
  std::vector<Leftover> leftovers = leftovers_beyond_cleaning(take, settings);
  const Stopwatch stopwatch;
  CleanResult result{{}, report_for(take, cleaner, settings)};
  CleanReport& report = result.report;
  report.swaps = std::move(swaps);
  report.leftovers = std::move(leftovers);
  if (!take.has_joints()) warn_of_feet(settings, report);
  const Work work = work_of(take, settings, report);
  result.take = std::move(take);
  // A thread that waits for a part of this take must not begin another take of a batch.
  run_isolated([&] {
    on_motion(result.take, work.first,
              [&](Take& motion) { clean_motion(motion, cleaner, work, report); });
  });
  if (report.feet && takes_part_only(settings) && !report.feet->contacts.empty())
    report.feet->after = feet_figures(result.take, report.feet->contacts);
  report.seconds = stopwatch.seconds();
  explain_unchanged(result.take, settings, report);
  return result;
}

}  // namespace kinemend
