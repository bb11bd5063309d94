#include "clean/prior_cleaning.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/file_bytes.hpp"
#include "base/quantiles.hpp"
#include "clean/auto_markers.hpp"
#include "clean/clip_tracks.hpp"
#include "clean/prior_fall_backs.hpp"
#include "clean/prior_hold.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/representation.hpp"
#include "kinemend/signal.hpp"
#include "tracks/vector_tracks.hpp"

namespace kinemend {

namespace {

// Which parts of the layout may change, and one of the place behind them.
std::vector<std::uint8_t> chosen_parts(const BodyMatch& match,
                                       const std::vector<std::uint8_t>& selected) {
  std::vector<std::uint8_t> chosen(match.parts.size(), 0);
  for (std::size_t part = 0; part < chosen.size(); ++part) {
    const std::int32_t index = match.parts[part];
    if (index >= 0) chosen[part] = selected[static_cast<std::size_t>(index)];
  }
  return chosen;
}

// Sets the marks of a part's channels in one frame.
void mark_part(std::vector<std::uint8_t>& marks, std::size_t channels, std::size_t frame,
               std::size_t part) {
  for (std::size_t axis = 0; axis < 3; ++axis) marks[frame * channels + 3 * part + axis] = 1;
}

// What `auto` says of each joint or marker.
struct AutoOpinion {
  std::vector<double> noise;  // degrees
  std::vector<double> needs;  // as `PriorWork::needs`
};

// The take's channels in the frame of what `auto` made of it, with what `auto` says of each part's
// samples; `actions` is by joint or marker.
PriorWork work_of(BodyChannels channels, PoseMatrix fallback, const BodyMatch& match,
                  const AutoOpinion& opinion, const std::vector<Action>& actions) {
  PriorWork work;
  work.match = &match;
  work.channels = std::move(channels);
  work.fallback = std::move(fallback);
  const std::size_t frames = work.fallback.frames, width = work.fallback.channels;
  work.noise.assign(width, 0);
  work.needs.assign(width / 3, 1);
  work.suspect.assign(frames * width, 0);
  for (std::size_t part = 0; part < match.parts.size(); ++part) {
    if (match.parts[part] < 0) continue;
    const auto index = static_cast<std::size_t>(match.parts[part]);
    for (std::size_t axis = 0; axis < 3; ++axis) work.noise[3 * part + axis] = opinion.noise[index];
    work.needs[part] = opinion.needs[index];
    for (std::size_t f = 0; f < frames; ++f) {
      if (actions[f * opinion.noise.size() + index] == Action::despiked)
        mark_part(work.suspect, width, f, part);
    }
  }
  return work;
}

void leave_alone(const PriorWork& work, bool fill, std::vector<std::uint8_t>& chosen) {
  for (std::size_t part = 0; part < chosen.size(); ++part) {
    if (chosen[part] != 0 && is_left_alone(work, part, fill)) chosen[part] = 0;
  }
}

bool is_rejected(const PriorWork& work, std::size_t frame, std::size_t part) {
  if (work.rejected.empty()) return false;
  const std::size_t first = frame * work.channels.poses.channels + 3 * part;
  return (work.rejected[first] | work.rejected[first + 1] | work.rejected[first + 2]) != 0;
}

std::string lacking(const BodyMatch& match) {
  return fmt::format("the take lacks {} of the {} parts that the model knows: {}",
                     match.missing.size(), match.parts.size(), fmt::join(match.missing, ", "));
}

// ---- joints

struct JointRun {
  const BodyLayout& layout;
  const BodyMatch& match;
  const Selection& selection;
  CleanTrace trace;  // of `auto` on the whole take
  Clip fallback;     // what `auto` makes of it

  std::size_t place_part() const { return layout.part_count(); }
  bool is_chosen_place() const { return layout.with_place && selection.root_position; }
};

JointRun run_auto(const Clip& clip, const BodyLayout& layout, const BodyMatch& match,
                  const Selection& selection) {
  JointRun run{layout, match, selection, {}, clip};
  run.trace = make_auto()->clean(run.fallback, Selection::all(clip));
  if (run.trace.actions.empty())
    run.trace.actions.assign(clip.local_rotations.size(), Action::kept);
  if (run.trace.noise_deg.empty()) run.trace.noise_deg.assign(clip.joint_count(), 0);
  return run;
}

// As `auto` decides how far to smooth each joint.
std::vector<double> joint_needs(const Clip& clip, const CleanTrace& trace) {
  const std::vector<std::size_t> joints = selected_joints(clip, Selection::all(clip));
  std::vector<double> noise, needs(clip.joint_count(), 0);
  for (const std::size_t joint : joints) noise.push_back(trace.noise_deg[joint]);
  const std::vector<double> shares = cleaning_shares(noise, clip.frame_rate_hz);
  for (std::size_t n = 0; n < joints.size(); ++n) needs[joints[n]] = shares[n];
  return needs;
}

double root_need(const Clip& clip, double noise) {
  const double degrees = degrees_per_radian / typical_bone_length(clip.skeleton) * noise;
  return cleaning_shares({degrees}, clip.frame_rate_hz).front();
}

PriorWork work_of(const Clip& clip, const JointRun& run) {
  BodyChannels guide = encode_body(run.fallback, run.layout, run.match);
  BodyChannels channels = encode_body(clip, run.layout, run.match, guide);
  PriorWork work = work_of(std::move(channels), std::move(guide.poses), run.match,
                           {run.trace.noise_deg, joint_needs(clip, run.trace)}, run.trace.actions);
  if (!run.layout.with_place) return work;
  const double noise = run.trace.root_noise.value_or(0);
  for (std::size_t axis = 0; axis < 3; ++axis)
    work.noise[3 * run.place_part() + axis] = noise * work.channels.degrees_per_unit;
  work.needs[run.place_part()] = root_need(clip, noise);
  for (std::size_t f = 0; f < run.trace.root_actions.size(); ++f) {
    if (run.trace.root_actions[f] == Action::despiked)
      mark_part(work.suspect, work.fallback.channels, f, run.place_part());
  }
  return work;
}

Vec3 turn_of(const PoseMatrix& poses, std::size_t frame, std::size_t part) {
  return {poses(frame, 3 * part), poses(frame, 3 * part + 1), poses(frame, 3 * part + 2)};
}

// From a frame to the next; where noise is strong, in medians of that.
constexpr double flip_deg = 60, flip_medians = 6;
constexpr std::size_t flip_half_frames = 3;
constexpr double most_turns = 0.98;  // a few are noise

// A joint that turns away from the model's mean as far as its channels can say, or flips, is
// nothing that the model knows: to the filter it is missing, and `auto` keeps it.
void leave_far_turns_to_auto(PriorWork& work, const JointRun& run,
                             std::vector<std::uint8_t>& chosen) {
  // Spikes that `auto` left go there and back; a flip stays.
  PoseMatrix steady = work.fallback;
  median_filter(steady, flip_half_frames);
  work.left_out.assign(work.needs.size(), 0);
  for (std::size_t part = 0; part < run.layout.part_count(); ++part) {
    const auto is_seen = [&](std::size_t frame) {
      return work.channels.observed[frame * steady.channels + 3 * part] != 0;
    };
    std::vector<double> turns, steps;
    double fastest = 0;
    for (std::size_t f = 0; f < steady.frames; ++f) {
      if (!is_seen(f)) continue;
      turns.push_back(norm(turn_of(steady, f, part)));
      if (f == 0 || !is_seen(f - 1)) continue;
      const auto step = [&](const PoseMatrix& poses) {
        return norm(turn_of(poses, f, part) - turn_of(poses, f - 1, part));
      };
      fastest = std::max(fastest, step(steady));
      steps.push_back(step(work.channels.poses));
    }
    const double flip = std::max(flip_deg, flip_medians * median_of(steps));
    const double farthest = quantile_of(turns, most_turns);
    if (farthest <= degrees_per_radian * tangent_limit_rad && fastest <= flip) continue;
    chosen[part] = 0;
    work.left_out[part] = 1;
    for (std::size_t f = 0; f < work.fallback.frames; ++f) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        work.channels.observed[f * work.fallback.channels + 3 * part + axis] = 0;
    }
  }
}

// Of what `auto` made of the take, what the result may need.
struct KeptFallback {
  std::vector<std::vector<Quat>> rotations;  // of each joint; none where the filter's are taken
  std::vector<Vec3> root_positions, joint_translations;
};

// The filter's rotations are taken of parts that are chosen and not clean; those need `auto` in
// gaps only, where these are not to be filled.
KeptFallback keep_fallback(Clip fallback, const JointRun& run, const PriorWork& work,
                           const std::vector<std::uint8_t>& chosen, bool fill) {
  std::vector<std::uint8_t> needed(fallback.joint_count(), 1);
  for (std::size_t part = 0; part < run.layout.part_count(); ++part) {
    if (chosen[part] == 0 || work.needs[part] == 0 || (!fill && !fallback.observed.empty()))
      continue;
    needed[static_cast<std::size_t>(run.match.parts[part])] = 0;
  }
  KeptFallback kept;
  kept.rotations.resize(needed.size());
  for (std::size_t joint = 0; joint < needed.size(); ++joint) {
    if (needed[joint] != 0) kept.rotations[joint] = joint_track(fallback, joint);
  }
  kept.root_positions = std::move(fallback.root_positions);
  kept.joint_translations = std::move(fallback.joint_translations);
  return kept;
}

// What `auto` made of the joints and positions that the model does not know, or that are clean;
// `chosen` includes the place.
void take_fallback(Clip& clip, const JointRun& run, const KeptFallback& fallback,
                   const std::vector<std::uint8_t>& chosen) {
  std::vector<std::uint8_t> known(clip.joint_count(), 0);
  for (std::size_t part = 0; part < run.layout.part_count(); ++part) {
    if (chosen[part] != 0) known[static_cast<std::size_t>(run.match.parts[part])] = 1;
  }
  for (const std::size_t joint : selected_joints(clip, run.selection)) {
    if (known[joint] != 0) continue;
    for (std::size_t f = 0; f < clip.frame_count(); ++f)
      clip.rotation(f, joint) = fallback.rotations[joint][f];
  }
  if (chosen[run.place_part()] == 0 && run.selection.root_position)
    clip.root_positions = fallback.root_positions;
  const std::size_t width = clip.translated_joints.size();
  for (std::size_t i = 0; i < width; ++i) {
    if (!translation_selected(clip, run.selection, i)) continue;
    for (std::size_t f = 0; f < clip.frame_count(); ++f)
      clip.joint_translations[f * width + i] = fallback.joint_translations[f * width + i];
  }
}

// Where gaps are not to be filled by the model they hold the bridge that `auto` laid.
void keep_bridges(Clip& clip, const JointRun& run, const KeptFallback& fallback,
                  const std::vector<std::uint8_t>& chosen) {
  for (std::size_t part = 0; part < run.layout.part_count(); ++part) {
    if (chosen[part] == 0) continue;
    const auto joint = static_cast<std::size_t>(run.match.parts[part]);
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      if (!clip.is_observed(f, joint)) clip.rotation(f, joint) = fallback.rotations[joint][f];
    }
  }
}

CleanTrace trace_of(const Clip& clip, const JointRun& run, const PriorWork& work,
                    const std::vector<std::uint8_t>& chosen) {
  CleanTrace trace = run.trace;
  const std::size_t joints = clip.joint_count(), frames = clip.frame_count();
  std::vector<std::uint8_t> selected(joints, 0);
  for (const std::size_t joint : selected_joints(clip, run.selection)) selected[joint] = 1;
  for (std::size_t i = 0; i < trace.actions.size(); ++i) {
    if (selected[i % joints] == 0) trace.actions[i] = Action::kept;
  }
  for (std::size_t part = 0; part < run.layout.part_count(); ++part) {
    if (chosen[part] == 0) continue;
    const auto joint = static_cast<std::size_t>(run.match.parts[part]);
    for (std::size_t f = 0; f < frames; ++f) {
      Action& action = trace.actions[f * joints + joint];
      if (!clip.is_observed(f, joint)) {
        action = Action::filled;
      } else if (!is_fallen_back(work, part)) {
        action = is_rejected(work, f, part) ? Action::despiked : Action::kept;
      }
    }
  }
  if (!run.selection.root_position) trace.root_actions.clear();
  if (chosen[run.place_part()] != 0 && !work.rejected.empty() &&
      !is_fallen_back(work, run.place_part())) {
    trace.root_actions.assign(frames, Action::kept);
    for (std::size_t f = 0; f < frames; ++f) {
      if (is_rejected(work, f, run.place_part())) trace.root_actions[f] = Action::despiked;
    }
  }
  trace.fall_backs = fall_backs_of(work, selected, run.is_chosen_place());
  if (!run.match.missing.empty()) trace.warnings.push_back(lacking(run.match));
  trace.warnings.insert(trace.warnings.end(), work.warnings.begin(), work.warnings.end());
  return trace;
}

// ---- markers

struct MarkerRun {
  const BodyLayout& layout;
  const BodyMatch& match;
  MarkerTrace trace;
  MarkerClip fallback;
};

MarkerRun run_auto(const MarkerClip& clip, const BodyLayout& layout, const BodyMatch& match,
                   double body_height) {
  MarkerRun run{layout, match, {}, clip};
  MarkerSelection everything = MarkerSelection::all(clip);
  everything.body_height = body_height;
  run.trace = make_auto()->clean_markers(run.fallback, everything);
  if (run.trace.actions.empty()) run.trace.actions.assign(clip.positions.size(), Action::kept);
  if (run.trace.noise.empty()) run.trace.noise.assign(clip.marker_count(), 0);
  return run;
}

std::vector<double> marker_needs(const MarkerClip& clip, const MarkerTrace& trace,
                                 double body_height) {
  std::vector<double> noise, needs(clip.marker_count(), 0);
  std::vector<std::size_t> markers;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (trace.noise[m] <= 0) continue;
    markers.push_back(m);
    noise.push_back(degrees_per_height / body_height * trace.noise[m]);
  }
  const std::vector<double> shares = cleaning_shares(noise, clip.frame_rate_hz);
  for (std::size_t n = 0; n < markers.size(); ++n) needs[markers[n]] = shares[n];
  return needs;
}

PriorWork work_of(const MarkerClip& clip, const MarkerRun& run, double body_height) {
  BodyChannels guide = encode_body(run.fallback, run.layout, run.match);
  BodyChannels channels = encode_body(clip, run.layout, run.match, guide);
  std::vector<double> noise = run.trace.noise;
  for (double& level : noise) level *= channels.degrees_per_unit;
  return work_of(std::move(channels), std::move(guide.poses), run.match,
                 {std::move(noise), marker_needs(clip, run.trace, body_height)}, run.trace.actions);
}

MarkerTrace trace_of(const MarkerClip& clip, const MarkerSelection& selection, const MarkerRun& run,
                     const PriorWork& work, const std::vector<std::uint8_t>& chosen) {
  MarkerTrace trace = run.trace;
  const std::size_t markers = clip.marker_count();
  for (std::size_t i = 0; i < trace.actions.size(); ++i) {
    if (selection.markers[i % markers] == 0) trace.actions[i] = Action::kept;
  }
  for (std::size_t part = 0; part < run.layout.part_count(); ++part) {
    if (chosen[part] == 0 || is_fallen_back(work, part)) continue;
    const auto marker = static_cast<std::size_t>(run.match.parts[part]);
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      trace.actions[f * markers + marker] =
          is_rejected(work, f, part) && clip.is_observed(f, marker) ? Action::despiked
                                                                    : Action::kept;
    }
  }
  trace.fall_backs = fall_backs_of(work, selection.markers, false);
  if (!run.match.missing.empty()) trace.warnings.push_back(lacking(run.match));
  trace.warnings.insert(trace.warnings.end(), work.warnings.begin(), work.warnings.end());
  return trace;
}

// Makes what the model filled a measurement, and puts back what it may not change.
void settle_gaps(const MarkerClip& before, MarkerClip& clip, const BodyMatch& match,
                 const std::vector<std::uint8_t>& chosen, bool fill, MarkerTrace& trace) {
  const std::size_t markers = clip.marker_count();
  for (std::size_t part = 0; part < match.parts.size(); ++part) {
    if (chosen[part] == 0) continue;
    const auto marker = static_cast<std::size_t>(match.parts[part]);
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      const std::size_t sample = f * markers + marker;
      if (before.is_observed(f, marker)) continue;
      if (fill) {
        clip.observed[sample] = 1;
        if (!clip.residuals.empty()) clip.residuals[sample] = 0;
        trace.actions[sample] = Action::filled;
      } else {
        clip.positions[sample] = before.positions[sample];
      }
    }
  }
}

}  // namespace

Clip cleaned_with_prior(const Clip& clip, const Selection& selection, const BodyLayout& layout,
                        const NameMap& names, bool fill, const PriorFilter& filter,
                        CleanTrace& trace) {
  const BodyMatch match = match_body(layout, clip, names);
  if (clip.frame_count() == 0) return clip;
  std::vector<std::uint8_t> chosen = chosen_parts(match, selection.joints);
  JointRun run = run_auto(clip, layout, match, selection);
  PriorWork work = work_of(clip, run);
  leave_far_turns_to_auto(work, run, chosen);
  const KeptFallback fallback = keep_fallback(std::move(run.fallback), run, work, chosen, fill);
  run.fallback = {};
  filter(work);
  hold_to_needs(work);
  add_fall_back(work, "they turn farther or leap more than the model can say",
                {work.left_out.begin(), work.left_out.end()});
  chosen.push_back(run.is_chosen_place() ? 1 : 0);
  leave_alone(work, fill, chosen);

  Clip result = clip;
  take_fallback(result, run, fallback, chosen);
  decode_body(work.channels, layout, match, result, chosen);
  if (!fill) keep_bridges(result, run, fallback, chosen);
  trace = trace_of(clip, run, work, chosen);
  return result;
}

CleanTrace clean_with_prior(Clip& clip, const Selection& selection, const BodyLayout& layout,
                            const NameMap& names, bool fill, const PriorFilter& filter) {
  CleanTrace trace;
  clip = cleaned_with_prior(clip, selection, layout, names, fill, filter, trace);
  return trace;
}

MarkerTrace clean_with_prior(MarkerClip& clip, const MarkerSelection& selection,
                             const BodyLayout& layout, const NameMap& names, bool fill,
                             const PriorFilter& filter) {
  const BodyMatch match = match_body(layout, clip, names);
  if (clip.frame_count() == 0) return {};
  std::vector<std::uint8_t> chosen = chosen_parts(match, selection.markers);
  const MarkerRun run = run_auto(clip, layout, match, selection.body_height);
  PriorWork work = work_of(clip, run, selection.body_height);
  filter(work);
  hold_to_needs(work);
  leave_alone(work, fill, chosen);

  MarkerClip result = clip;
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    if (selection.markers[i % clip.marker_count()] != 0 && clip.observed[i] != 0)
      result.positions[i] = run.fallback.positions[i];
  }
  decode_body(work.channels, layout, match, result, chosen);
  MarkerTrace trace = trace_of(clip, selection, run, work, chosen);
  settle_gaps(clip, result, match, chosen, fill, trace);
  clip = std::move(result);
  return trace;
}

namespace {

class PriorCleaner final : public Cleaner {
 public:
  PriorCleaner(std::shared_ptr<const Model> model, NameMap names, bool fill, PriorFilter filter)
      : model_(std::move(model)),
        names_(std::move(names)),
        fill_(fill),
        filter_(std::move(filter)) {}

  CleanTrace clean(Clip& clip, const Selection& selection) const override {
    return clean_with_prior(clip, selection, model_->layout, names_, fill_, filter_);
  }

  CleanTrace clean_joints(Clip& clip, const Selection& selection, const JointSink& sink,
                          const std::function<void(double)>& /*progress*/) const override {
    CleanTrace trace;
    hand_over(clip,
              cleaned_with_prior(clip, selection, model_->layout, names_, fill_, filter_, trace),
              sink, trace);
    return trace;
  }

  MarkerTrace clean_markers(MarkerClip& clip, const MarkerSelection& selection) const override {
    return clean_with_prior(clip, selection, model_->layout, names_, fill_, filter_);
  }

 private:
  std::shared_ptr<const Model> model_;
  NameMap names_;
  bool fill_;
  PriorFilter filter_;
};

}  // namespace

std::unique_ptr<Cleaner> make_prior_cleaner(std::shared_ptr<const Model> model,
                                            const std::string& map, bool fill, PriorFilter filter) {
  return std::make_unique<PriorCleaner>(std::move(model), name_map_at(map), fill,
                                        std::move(filter));
}

NameMap name_map_at(const std::string& path) {
  if (path.empty()) return {};
  return parse_name_map(file_bytes(path), path);
}

}  // namespace kinemend
