// Defines the method `learned`: its options, its cleaner of whole takes, and its live form. Fills
// gaps of joints by the same network, for `src/fill`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/quantiles.hpp"
#include "cleaner/live.hpp"
#include "cleaner/pieces.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/body.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/extend/options.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/fill.hpp"
#include "methods/auto/track_vectors.hpp"
#include "methods/learned/learned_live.hpp"
#include "methods/learned/motion_channels.hpp"
#include "methods/learned/motion_filter.hpp"
#include "methods/learned/noise_floor.hpp"
#include "methods/prior/prior_cleaning.hpp"
#include "models/model_reading.hpp"

namespace kinemend {

namespace {

const OptionTable<LearnedOptions>& learned_table() {
  static const auto options =
      OptionTable<LearnedOptions>()
          .text(&LearnedOptions::model, "model",
                "model file made by kinemend-train learned; empty: the model that ships")
          .text(&LearnedOptions::map, "map",
                "file that maps names in the take to names in the model")
          .flag(&LearnedOptions::live, "live", "live form: looks an eighth of a second ahead");
  return options;
}

constexpr const char* live_needs =
    "learned runs live in its live form (--live), an eighth of a second behind; without it, the "
    "whole take is seen first";

class Learned final : public Cleaner {
 public:
  Learned(const LearnedOptions& options, std::shared_ptr<const Model> model)
      : options_(options),
        model_(std::move(model)),
        names_(name_map_at(options.map)),
        network_(motion_network_of(*model_)) {}

  std::string_view name() const override { return "learned"; }
  OptionValues options() const override { return learned_table().values(options_); }

  CleanTrace clean(const TakeView& view, const TrackSink& sink,
                   const std::function<void(double)>& tell) const override {
    if (view.source == Source::keyframed) return make_auto()->clean(view, sink, tell);
    CleanTrace trace;
    if (const std::string reason = why_not_learned(view); !reason.empty())
      return clean_by_auto(view, reason, sink, tell);
    ShareProgress progress(tell);
    progress.begin_part(0.3, 1);
    MotionTracks tracks = motion_tracks_of(view, changeable_tracks(view));
    if (tracks.numbers.empty()) return trace;
    tracks.take.expects_slow_noise = expects_slow_noise(view.source);
    BodyReading reading = read_body(model_->layout, network_.deviation, names_, view, tracks);
    std::optional<KnownBody>& body = reading.body;
    note_strange_motion(reading, trace);
    if (body) show_body(*body, tracks.take);
    progress.step();
    progress.begin_part(1, 1);
    add_measured_smoothing(tracks.take);
    MotionResult result = filtered(network_, tracks.take);
    join_measured(tracks.take, result);
    if (!expects_slow_noise(view.source)) {
      const std::vector<double> put_back =
          keep_to_noise_floor(tracks.take, marks_of(body, tracks.numbers.size()),
                              stepped_tracks(view, tracks.numbers), result);
      note_slow_noise_kept(view, tracks, put_back, trace);
    }
    if (view.joints != nullptr) smooth_places(view, tracks, result);
    std::vector<TrackError> errors;
    for (std::size_t n = 0; n < tracks.numbers.size(); ++n)
      errors.push_back(track_error(tracks.take, result, n));
    say_what_was_wrong(view, tracks, errors, trace);
    hand_over(view, tracks, body, result, errors, sink);
    progress.step();
    return trace;
  }
  LiveSupport live_support(double) const override { return {.why_not = live_needs}; }

 private:
  // The network has not learned how bodies travel through the world, so places of joints are
  // smoothed by the measured noise.
  static void smooth_places(const TakeView& view, const MotionTracks& tracks,
                            MotionResult& result) {
    const MotionTake& take = tracks.take;
    for (std::size_t n = 0; n < tracks.numbers.size(); ++n) {
      if (view.tracks[tracks.numbers[n]].space != Space::position) continue;
      for (std::size_t f = 0; f < take.frames; ++f) {
        for (std::size_t c = 3 * n; c < 3 * n + 3; ++c) {
          result.values[f * take.channels + c] = take.measured[f * take.channels + c];
          result.deviation[f * take.channels + c] = 0;
        }
      }
    }
  }

  static CleanTrace clean_by_auto(const TakeView& view, const std::string& reason,
                                  const TrackSink& sink, const std::function<void(double)>& tell) {
    CleanTrace trace = make_auto()->clean(view, sink, tell);
    FallBack fall_back{"auto", reason, {}, {}};
    for (const std::size_t number : changeable_tracks(view)) {
      fall_back.tracks.push_back(view.tracks[number].owner);
      fall_back.shares.push_back(1);
    }
    if (!fall_back.tracks.empty()) trace.fall_backs.push_back(std::move(fall_back));
    return trace;
  }

  // Notes a body that the model knows by name but that moves unlike the training.
  static void note_strange_motion(const BodyReading& reading, CleanTrace& trace) {
    if (reading.body || reading.spread <= most_spread) return;
    trace.notes.push_back(
        fmt::format("the body moves {:.1f} times as widely as those that the model has learned "
                    "from: each joint is cleaned by itself",
                    reading.spread));
  }

  // Notes slow noise that the model expects and the take does not show: the median over the tracks
  // from which it would have been removed.
  static void note_slow_noise_kept(const TakeView& view, const MotionTracks& tracks,
                                   const std::vector<double>& put_back, CleanTrace& trace) {
    // Smallest reported change. Chosen by hand.
    constexpr double least_deg = 0.5;
    for (const Space space : {Space::rotation, Space::position}) {
      std::vector<double> sizes;
      for (std::size_t n = 0; n < put_back.size(); ++n) {
        // Positions of joints are smoothed by the measured noise alone.
        if (view.tracks[tracks.numbers[n]].space != space) continue;
        if (space == Space::position && view.joints != nullptr) continue;
        if (put_back[n] > least_deg) sizes.push_back(put_back[n]);
      }
      if (sizes.empty()) continue;
      const bool turns = space == Space::rotation;
      const std::size_t count = sizes.size();
      const double size = median_of(sizes) / degrees_per_unit(view, space);
      trace.notes.push_back(fmt::format(
          "left alone: changes of about {} on {} that the model proposes and the take does not "
          "show to be noise{}",
          turns ? fmt::format("{:.2g} deg", size) : fmt::format("{:.2g} file units", size),
          counted(count, turns ? "joint" : "marker"),
          view.source == Source::unknown ? "; if this take comes from video, a depth camera or a "
                                           "suit, --source video (depth, suit) makes them"
                                         : ""));
    }
  }

  // Reports what was removed from each track, the error expected to remain, and noise that is
  // mostly slow.
  static void say_what_was_wrong(const TakeView& view, const MotionTracks& tracks,
                                 const std::vector<TrackError>& errors, CleanTrace& trace) {
    trace.noise.assign(view.tracks.size(), 0);
    trace.left.assign(view.tracks.size(), 0);
    std::vector<TrackError> turning, moving;
    for (std::size_t n = 0; n < tracks.numbers.size(); ++n) {
      const TrackError& error = errors[n];
      const std::size_t number = tracks.numbers[n];
      if (!is_worth_a_change(error)) continue;
      const double unit = degrees_per_unit(view, view.tracks[number].space);
      trace.noise[number] = std::sqrt(error.removed) / unit;
      trace.left[number] = std::sqrt(error.left) / unit;
      (view.tracks[number].space == Space::rotation ? turning : moving).push_back(error);
    }
    for (const Space space : {Space::rotation, Space::position}) {
      const std::vector<TrackError>& own = space == Space::rotation ? turning : moving;
      const double slow_deg = slow_noise(own);
      const ColouredNoise removed = removed_noise(own);
      if (removed.strength == 0) continue;
      NoiseCharacter character;
      character.space = space;
      character.is_expected = slow_deg > 0;
      character.strength =
          (slow_deg > 0 ? slow_deg : removed.strength) / degrees_per_unit(view, space);
      if (slow_deg == 0) character.correlation = removed.correlation;
      trace.characters.push_back(character);
    }
  }

  void hand_over(const TakeView& view, const MotionTracks& tracks, std::optional<KnownBody>& body,
                 const MotionResult& result, const std::vector<TrackError>& errors,
                 const TrackSink& sink) const {
    const std::vector<std::uint8_t> is_body = marks_of(body, tracks.numbers.size());
    if (body) decode_known_body(*body, model_->layout, tracks.take, result.values);
    const TakeView decoded = body ? view_of(body->clip) : TakeView{};
    for (std::size_t n = 0; n < tracks.numbers.size(); ++n) {
      CleanedTrack cleaned = cleaned_track(tracks, view, n, result.values);
      if (is_body[n] != 0) {
        if (cleaned.positions.empty()) {
          cleaned.rotations = rotations_of(decoded.tracks[tracks.numbers[n]]);
        } else {
          cleaned.positions = positions_of(decoded.tracks[tracks.numbers[n]]);
        }
      }
      const std::size_t number = tracks.numbers[n];
      if (is_worth_a_change(errors[n])) {
        cleaned.noise = {
            std::sqrt(errors[n].all()) / degrees_per_unit(view, view.tracks[number].space),
            errors[n].correlation};
      } else {
        keep_measured(view, tracks, n, cleaned);
      }
      sink(number, std::move(cleaned));
    }
  }

  // Restores the measured samples of the n-th track except spikes and gaps.
  static void keep_measured(const TakeView& view, const MotionTracks& tracks, std::size_t n,
                            CleanedTrack& cleaned) {
    const Track& track = view.tracks[tracks.numbers[n]];
    for (std::size_t f = 0; f < view.frames; ++f) {
      if (tracks.is_spike[f * tracks.numbers.size() + n] != 0 || !track.is_observed(f)) continue;
      if (track.space == Space::rotation) {
        cleaned.rotations[f] = track.rotation(f);
      } else {
        cleaned.positions[f] = track.position(f);
      }
    }
  }

  LearnedOptions options_;
  std::shared_ptr<const Model> model_;
  NameMap names_;
  MotionNetwork network_;
};

// The same network with no layer that looks ahead.
class LiveLearned final : public Cleaner {
 public:
  LiveLearned(const LearnedOptions& options, std::shared_ptr<const Model> model)
      : options_(options),
        model_(std::move(model)),
        names_(name_map_at(options.map)),
        network_(live_form(motion_network_of(*model_))) {}

  std::string_view name() const override { return "learned"; }
  OptionValues options() const override { return learned_table().values(options_); }

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& progress) const override {
    return clean_as_live(*this, take, sink, progress);
  }
  LiveSupport live_support(double frame_rate_hz) const override {
    if (frame_rate_hz >= lowest_learned_rate_hz) return {};
    return {.why_not = "learned runs live at 20 Hz and more"};
  }
  std::unique_ptr<LiveFilter> live(const TakeView& like) const override {
    if (!live_support(like.frame_rate_hz).runs()) return Cleaner::live(like);
    if (like.source == Source::keyframed) return gap_holding_filter(like);
    return make_learned_live(network_, model_->layout, names_, like);
  }

 private:
  LearnedOptions options_;
  std::shared_ptr<const Model> model_;
  NameMap names_;
  MotionNetwork network_;
};

}  // namespace

Method learned_method() {
  return {"learned",
          "network that reads the take itself and finds noise of every kind, slow noise too",
          "Kinemend; damage as in Mall et al. 2017, smoothers mixed by a network",
          learned_table().specs(),
          [](const OptionValues& values) { return make_learned(learned_table().parse(values)); },
          true};
}

std::unique_ptr<Cleaner> make_learned(const LearnedOptions& options,
                                      std::shared_ptr<const Model> model) {
  learned_table().validate(options);
  model = model_of(learned_models, options.model, std::move(model));
  if (options.live) return std::make_unique<LiveLearned>(options, std::move(model));
  return std::make_unique<Learned>(options, std::move(model));
}

namespace {

LearnedFilling fill_by_network(const MotionNetwork& network, const BodyLayout& layout,
                               const NameMap& names, const Take& clip) {
  LearnedFilling filling{clip.rotations, {}, true};
  const TakeView view = view_of(clip);
  filling.left_out.assign(clip.joint_count(), why_not_learned(view));
  if (!filling.left_out.front().empty()) return filling;
  MotionTracks tracks = motion_tracks_of(view, changeable_tracks(view));
  std::optional<KnownBody> body = read_body(layout, network.deviation, names, view, tracks).body;
  if (body) show_body(*body, tracks.take);
  add_measured_smoothing(tracks.take);
  const MotionResult result = filtered(network, tracks.take);
  const std::vector<std::uint8_t> is_known = marks_of(body, tracks.numbers.size());
  if (body) decode_known_body(*body, layout, tracks.take, result.values);
  for (std::size_t n = 0; n < tracks.numbers.size(); ++n) {
    const std::size_t joint = tracks.numbers[n];
    if (view.tracks[joint].space != Space::rotation) continue;
    const bool is_of_body = is_known[n] != 0;
    const std::vector<Quat> own =
        is_of_body ? std::vector<Quat>{} : cleaned_track(tracks, view, n, result.values).rotations;
    for (std::size_t f = 0; f < clip.frame_count(); ++f)
      filling.rotations[f * clip.joint_count() + joint] =
          is_of_body ? body->clip.rotation(f, joint) : own[f];
  }
  return filling;
}

}  // namespace

LearnedFill make_learned_fill(const LearnedOptions& options, std::shared_ptr<const Model> model) {
  model = model_of(learned_models, options.model, std::move(model));
  auto network = std::make_shared<const MotionNetwork>(motion_network_of(*model));
  return [network, model, names = name_map_at(options.map)](const Take& clip) {
    return fill_by_network(*network, model->layout, names, clip);
  };
}

}  // namespace kinemend
