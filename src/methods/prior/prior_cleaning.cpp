// Runs `auto` on the take, encodes it, calls the filter of the method, and assembles the cleaned
// tracks.
#include "methods/prior/prior_cleaning.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/files.hpp"
#include "base/quantiles.hpp"
#include "cleaner/pieces.hpp"
#include "kinemend/extend/body.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/signal.hpp"
#include "methods/auto/track_vectors.hpp"
#include "methods/auto/vector_tracks.hpp"
#include "methods/prior/prior_fall_backs.hpp"
#include "motion/rotation.hpp"

namespace kinemend {

namespace {

// A take with its match to the layout of a model.
struct PriorTake {
  const TakeView& view;
  const Take& clip;  // positions of joints without gaps
  const BodyLayout& layout;
  const BodyMatch& match;

  // The track of a part of the layout, or of the place behind the parts; none if the take lacks the
  // part.
  std::optional<std::size_t> track(std::size_t part) const {
    if (part == match.tracks.size()) return view.root_track();
    if (match.tracks[part] < 0) return std::nullopt;
    return static_cast<std::size_t>(match.tracks[part]);
  }
  // Includes the place of the body if the layout has one.
  std::size_t part_count() const { return match.tracks.size() + (has_place() ? 1 : 0); }
  bool has_place() const { return view.joints != nullptr && layout.with_place; }
};

// Which parts may change.
std::vector<std::uint8_t> chosen_parts(const PriorTake& take) {
  std::vector<std::uint8_t> chosen(take.match.tracks.size() + (take.view.joints ? 1 : 0), 0);
  for (std::size_t part = 0; part < take.part_count(); ++part) {
    const auto track = take.track(part);
    if (track && take.view.tracks[*track].selected) chosen[part] = 1;
  }
  return chosen;
}

// Sets the marks of a part's channels in one frame.
void mark_part(std::vector<std::uint8_t>& marks, std::size_t channels, std::size_t frame,
               std::size_t part) {
  for (std::size_t axis = 0; axis < 3; ++axis) marks[frame * channels + 3 * part + axis] = 1;
}

// The result of `auto` for all tracks of a take, selected or not.
struct AutoRun {
  Take clip;
  InPlaceTrace trace;

  bool is_spike(std::size_t track, std::size_t frame) const {
    return !trace.actions[track].empty() && trace.actions[track][frame] == Action::despiked;
  }
};

// Selects every track and passes on the known body height and noise.
Selection all_tracks(const TakeView& view) {
  Selection all;
  all.body_height = view.body_height;
  all.noise.correlation = view.noise_correlation;
  for (std::size_t n = 0; n < view.owners; ++n) all.noise.strengths.push_back(view.tracks[n].noise);
  return all;
}

AutoRun run_auto(const PriorTake& take) {
  AutoRun run{take.clip, {}};
  run.trace = clean_in_place(*make_auto(), run.clip, all_tracks(take.view));
  return run;
}

// How far `auto` smooths each track, 0 to 1. Tracks that share their noise are judged together.
std::vector<double> needs_of(const TakeView& view, const std::vector<double>& noise) {
  std::vector<std::size_t> together;
  std::vector<double> levels, needs(view.tracks.size(), 0);
  for (std::size_t n = 0; n < view.owners && !noise.empty(); ++n) {
    if (view.joints ? !moves(view.tracks[n]) : noise[n] <= 0) continue;
    together.push_back(n);
    levels.push_back(view.joints ? noise[n] : degrees_per_unit(view) * noise[n]);
  }
  const std::vector<double> shares = smoothing_shares(levels, view.frame_rate_hz);
  for (std::size_t i = 0; i < together.size(); ++i) needs[together[i]] = shares[i];
  if (view.joints && !noise.empty()) {
    const double root = degrees_per_unit(view) * noise[view.root_track()];
    needs[view.root_track()] = smoothing_shares({root}, view.frame_rate_hz).front();
  }
  return needs;
}

// The take's channels in the frame of `auto`'s result, with `auto`'s findings on each part's
// samples.
PriorWork work_of(const PriorTake& take, const AutoRun& run) {
  BodyChannels guide = encode_body(run.clip, take.layout, take.match);
  PriorWork work;
  work.match = &take.match;
  work.channels = encode_body(take.clip, take.layout, take.match, guide);
  work.fallback = std::move(guide.poses);
  const std::size_t frames = work.fallback.frames, width = work.fallback.channels;
  work.noise.assign(width, 0);
  work.needs.assign(width / 3, 1);
  work.suspect.assign(frames * width, 0);
  const std::vector<double> needs = needs_of(take.view, run.trace.noise);
  work.is_white = std::all_of(run.trace.characters.begin(), run.trace.characters.end(),
                              [](const NoiseCharacter& noise) {
                                return noise.correlation == 0 && noise.frames_per_sample == 1;
                              });
  for (std::size_t part = 0; part < take.part_count(); ++part) {
    const auto track = take.track(part);
    if (!track) continue;
    work.needs[part] = needs[*track];
    const bool turns = take.view.tracks[*track].space == Space::rotation;
    const double unit = turns ? 1 : work.channels.degrees_per_unit;
    for (std::size_t axis = 0; axis < 3 && !run.trace.noise.empty(); ++axis)
      work.noise[3 * part + axis] = unit * run.trace.noise[*track];
    for (std::size_t f = 0; f < frames; ++f) {
      if (run.is_spike(*track, f)) mark_part(work.suspect, width, f, part);
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
                     match.missing.size(), match.tracks.size(), fmt::join(match.missing, ", "));
}

// Turn from one frame to the next, at least, and in medians of such turns where noise is strong.
// Chosen by hand, not swept; docs/details/wiener.md states what leaving flips to `auto`
// brings.
constexpr double flip_deg = 60, flip_medians = 6;
// Half window of the running median that removes the spikes that `auto` left. Chosen by hand, not
// swept. The share of samples that do not turn too far is not swept either;
// docs/details/wiener.md states what leaving turns of 150 degrees to `auto` brings.
constexpr std::size_t flip_half_frames = 3;
constexpr double most_turns = 0.98;  // a few are noise

// The model knows nothing of a joint that flips, or turns away from the model's mean as far as its
// channels can express: the filter treats it as missing, and `auto` keeps it.
void leave_far_turns_to_auto(PriorWork& work, const BodyLayout& layout,
                             std::vector<std::uint8_t>& chosen) {
  // Spikes that `auto` left return after a few frames; a flip stays.
  PoseMatrix steady = work.fallback;
  median_filter(steady, flip_half_frames);
  work.left_out.assign(work.needs.size(), 0);
  for (std::size_t part = 0; part < layout.track_count(); ++part) {
    const auto is_seen = [&](std::size_t frame) {
      return work.channels.observed[frame * steady.channels + 3 * part] != 0;
    };
    std::vector<double> turns, steps;
    double fastest = 0;
    for (std::size_t f = 0; f < steady.frames; ++f) {
      if (!is_seen(f)) continue;
      turns.push_back(norm(vector_at(steady, f, part)));
      if (f == 0 || !is_seen(f - 1)) continue;
      const auto step = [&](const PoseMatrix& poses) {
        return norm(vector_at(poses, f, part) - vector_at(poses, f - 1, part));
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

// Keeps `auto`'s result for the tracks that may need it. Parts whose every sample comes from the
// filter do not.
std::vector<CleanedTrack> keep_fallback(const PriorTake& take, AutoRun run, const PriorWork& work,
                                        const std::vector<std::uint8_t>& chosen, bool fill) {
  const TakeView view = view_of(run.clip);
  std::vector<std::uint8_t> needed(view.tracks.size(), 1);
  for (std::size_t part = 0; part < take.match.tracks.size(); ++part) {
    if (chosen[part] == 0 || work.needs[part] == 0) continue;
    const std::size_t track = *take.track(part);
    if (fill || observed_of(take.view.tracks[track]).empty()) needed[track] = 0;
  }
  std::vector<CleanedTrack> kept(view.tracks.size());
  for (std::size_t n = 0; n < kept.size(); ++n) {
    kept[n].actions = std::move(run.trace.actions[n]);
    kept[n].noise = run.trace.coloured[n];
    if (needed[n] == 0) continue;
    kept[n].rotations = rotations_of(view.tracks[n]);
    kept[n].positions = positions_of(view.tracks[n]);
  }
  return kept;
}

// The actions on the samples of a part that comes from the filter.
std::vector<Action> actions_of(const TakeView& view, std::size_t number, const PriorWork& work,
                               std::size_t part, bool fill, std::vector<Action> actions) {
  const Track& track = view.tracks[number];
  if (actions.empty()) actions.assign(view.frames, Action::kept);
  const bool is_own = !is_fallen_back(work, part);
  const bool fills = track.space == Space::rotation || (fill && view.markers);
  for (std::size_t f = 0; f < view.frames; ++f) {
    if (number < view.owners && !track.is_observed(f)) {
      actions[f] = fills ? Action::filled : Action::kept;
    } else if (is_own) {
      actions[f] = is_rejected(work, f, part) ? Action::despiked : Action::kept;
    }
  }
  return actions;
}

// The samples of a part that comes from the filter. Gaps that the model may not fill keep the
// bridge of `auto`.
CleanedTrack filtered_track(const TakeView& view, const TakeView& filtered, std::size_t number,
                            bool fill, const CleanedTrack& fallback) {
  const Track& track = filtered.tracks[number];
  CleanedTrack cleaned{rotations_of(track), positions_of(track), {}};
  if (track.space == Space::position) return cleaned;
  for (std::size_t f = 0; f < view.frames && !fill; ++f) {
    if (!view.tracks[number].is_observed(f)) cleaned.rotations[f] = fallback.rotations[f];
  }
  return cleaned;
}

CleanTrace clean_known(const PriorTake& take, bool fill, PriorHold hold, const PriorFilter& filter,
                       const TrackSink& sink) {
  const TakeView& view = take.view;
  std::vector<std::uint8_t> chosen = chosen_parts(take);
  AutoRun run = run_auto(take);
  PriorWork work = work_of(take, run);
  if (view.joints) leave_far_turns_to_auto(work, take.layout, chosen);
  settle_needs(work, hold);
  leave_alone(work, fill, chosen);
  CleanTrace trace = run.trace;
  std::vector<CleanedTrack> fallback = keep_fallback(take, std::move(run), work, chosen, fill);
  if (std::find(chosen.begin(), chosen.end(), 1) != chosen.end()) filter(work);
  hold_to_needs(work);
  if (view.joints) {
    add_fall_back(work, "they turn farther or leap more than the model can say",
                  {work.left_out.begin(), work.left_out.end()});
  }

  Take filtered = take.clip;
  decode_body(work.channels, take.layout, take.match, filtered, chosen);
  const TakeView result = view_of(filtered);
  std::vector<std::uint8_t> selected(view.owners, 0);
  for (std::size_t n = 0; n < view.tracks.size(); ++n) {
    const Track& track = view.tracks[n];
    const bool may_change = track.selected && (view.markers || moves(track));
    if (n < view.owners) selected[n] = may_change ? 1 : 0;
  }
  std::vector<std::uint8_t> is_filtered(view.tracks.size(), 0);
  for (std::size_t part = 0; part < take.part_count(); ++part) {
    if (chosen[part] == 0) continue;
    const std::size_t n = *take.track(part);
    is_filtered[n] = 1;
    CleanedTrack cleaned = filtered_track(view, result, n, fill, fallback[n]);
    cleaned.noise = fallback[n].noise;
    cleaned.actions = actions_of(view, n, work, part, fill, std::move(fallback[n].actions));
    sink(n, std::move(cleaned));
  }
  for (std::size_t n = 0; n < view.tracks.size(); ++n) {
    const bool may_change = n < view.owners ? selected[n] != 0 : view.tracks[n].selected;
    if (may_change && is_filtered[n] == 0) sink(n, std::move(fallback[n]));
  }
  trace.fall_backs =
      fall_backs_of(work, selected, take.has_place() && view.tracks[view.root_track()].selected);
  if (!take.match.missing.empty()) trace.warnings.push_back(lacking(take.match));
  trace.warnings.insert(trace.warnings.end(), work.warnings.begin(), work.warnings.end());
  return trace;
}

// Copies the take with the gaps in joint positions bridged.
Take with_bridged_positions(const TakeView& view) {
  Take clip = *view.joints;
  for (std::size_t n = view.owners; n < view.tracks.size() && !clip.observed_positions.empty(); ++n)
    set_track(clip, n, position_pieces(view, n).front().samples);
  return clip;
}

}  // namespace

CleanTrace clean_with_prior(const TakeView& take, const TrackSink& sink, const BodyLayout& layout,
                            const NameMap& names, bool fill, PriorHold hold,
                            const PriorFilter& filter) {
  const Take& whole = take.joints ? *take.joints : *take.markers;
  const BodyMatch match = match_body(layout, whole, names);
  if (take.frames == 0) return {};
  if (whole.observed_positions.empty())
    return clean_known({take, whole, layout, match}, fill, hold, filter, sink);
  const Take bridged = with_bridged_positions(take);
  return clean_known({take, bridged, layout, match}, fill, hold, filter, sink);
}

namespace {

class PriorCleaner final : public ParticularCleaner {
 public:
  PriorCleaner(std::shared_ptr<const Model> model, PriorMethod method)
      : model_(std::move(model)), names_(name_map_at(method.map)), method_(std::move(method)) {}

  std::string_view name() const override { return method_.name; }
  OptionValues options() const override { return method_.options; }

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& /*progress*/) const override {
    return clean_with_prior(take, sink, model_->layout, names_, method_.fill, method_.hold,
                            method_.filter);
  }

  std::string why_not(const Take& take) const override {
    match_body(model_->layout, take, names_);
    return method_.why_not_at ? method_.why_not_at(take.frame_rate_hz) : "";
  }

  LiveSupport live_support(double frame_rate_hz) const override {
    if (method_.why_not_live.empty()) return Cleaner::live_support(frame_rate_hz);
    return {.why_not = method_.why_not_live};
  }

 private:
  std::shared_ptr<const Model> model_;
  NameMap names_;
  PriorMethod method_;
};

}  // namespace

std::unique_ptr<Cleaner> make_prior_cleaner(std::shared_ptr<const Model> model,
                                            PriorMethod method) {
  return std::make_unique<PriorCleaner>(std::move(model), std::move(method));
}

NameMap name_map_at(const std::string& path) {
  if (path.empty()) return {};
  return parse_name_map(file_bytes(path), path);
}

}  // namespace kinemend
