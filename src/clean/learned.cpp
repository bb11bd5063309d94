#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "base/progress.hpp"
#include "base/quantiles.hpp"
#include "clean/auto_scale.hpp"
#include "clean/learned_body.hpp"
#include "clean/motion_channels.hpp"
#include "clean/pieces.hpp"
#include "clean/prior_cleaning.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/model.hpp"
#include "kinemend/experimental/representation.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/options.hpp"
#include "priors/motion/measured_smoothing.hpp"
#include "priors/motion/motion_filter.hpp"

namespace kinemend {

namespace {

// Of what the network has learned from.
constexpr double shortest_take_s = 0.5, lowest_rate_hz = 20;

const OptionTable<LearnedOptions>& learned_table() {
  static const auto options =
      OptionTable<LearnedOptions>()
          .text(&LearnedOptions::model, "model",
                "model file made by kinemend-train learned; empty: the model that ships")
          .text(&LearnedOptions::map, "map",
                "file that maps names in the take to names in the model");
  return options;
}

// Mean squares per axis of a track, degrees squared.
struct TrackError {
  double removed = 0, left = 0;
  double quick = 0;        ///< of what was removed, what is not the same a little later
  double correlation = 0;  ///< of what was removed, from frame to frame

  double all() const { return removed + left; }
};

TrackError track_error(const MotionTake& take, const MotionResult& result, std::size_t track) {
  constexpr double a_little_s = 0.04;
  const auto later = static_cast<std::size_t>(std::ceil(a_little_s * take.frame_rate_hz));
  TrackError error;
  const auto change = [&](std::size_t i) {
    return static_cast<double>(result.values[i] - take.values[i]);
  };
  double samples = 0;  // of axes that move
  for (std::size_t f = 0; f < take.frames; ++f) {
    for (std::size_t c = 3 * track; c < 3 * track + 3; ++c) {
      const std::size_t i = f * take.channels + c;
      if (result.deviation[i] == 0) continue;
      samples += 1;
      error.removed += change(i) * change(i);
      error.left += static_cast<double>(result.deviation[i]) * result.deviation[i];
      if (f < later) continue;
      const double difference = change(i) - change(i - later * take.channels);
      error.quick += 0.5 * difference * difference;
    }
  }
  samples = std::max(samples, 1.0);
  error.removed /= samples, error.left /= samples, error.quick /= samples;
  if (error.removed > error.quick)
    error.correlation = std::pow(1 - error.quick / error.removed, 1 / static_cast<double>(later));
  return error;
}

// Of the middle track, degrees per axis; 0 where errors are small or show from frame to frame.
double slow_noise(const std::vector<TrackError>& errors) {
  constexpr double least_deg = 1, most_quick_share = 0.25;
  std::vector<double> sizes, quick;
  for (const TrackError& error : errors) {
    if (error.left == 0) continue;
    sizes.push_back(std::sqrt(error.all()));
    quick.push_back(error.quick / error.all());
  }
  if (sizes.empty()) return 0;
  const double size = median_of(sizes);
  return size >= least_deg && median_of(quick) <= most_quick_share ? size : 0;
}

class Learned final : public Cleaner {
 public:
  Learned(const LearnedOptions& options, std::shared_ptr<const Model> model)
      : model_(std::move(model)),
        names_(name_map_at(options.map)),
        network_(motion_network_of(*model_)) {}

  CleanTrace clean(const TakeView& view, const TrackSink& sink,
                   const std::function<void(double)>& tell) const override {
    CleanTrace trace;
    if (const std::string reason = why_not(view); !reason.empty())
      return clean_by_auto(view, reason, sink, tell);
    ShareProgress progress(tell);
    progress.begin_part(0.3, 1);
    MotionTracks tracks = motion_tracks_of(view, changeable_tracks(view));
    if (tracks.numbers.empty()) return trace;
    std::optional<KnownBody> body = known_body(model_->layout, names_, view, tracks);
    if (body) show_body(*body, tracks.take);
    progress.step();
    progress.begin_part(1, 1);
    add_measured_smoothing(tracks.take);
    MotionResult result = filtered(network_, tracks.take);
    if (view.joints != nullptr) smooth_places(view, tracks, result);
    std::vector<TrackError> errors;
    for (std::size_t n = 0; n < tracks.numbers.size(); ++n)
      errors.push_back(track_error(tracks.take, result, n));
    say_what_was_wrong(view, tracks, errors, trace);
    hand_over(view, tracks, body, result, errors, sink);
    progress.step();
    return trace;
  }

 private:
  // How bodies travel through the world is nothing that the network has learned from: places of
  // joints are smoothed by the noise that is measured.
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

  static std::string why_not(const TakeView& view) {
    if (static_cast<double>(view.frames) < shortest_take_s * view.frame_rate_hz)
      return "the take is shorter than half a second";
    if (view.frame_rate_hz < lowest_rate_hz) return "the frame rate is below 20 Hz";
    return {};
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

  // What was taken out of each track, what is expected to be left, and noise that is mostly slow.
  static void say_what_was_wrong(const TakeView& view, const MotionTracks& tracks,
                                 const std::vector<TrackError>& errors, CleanTrace& trace) {
    trace.noise.assign(view.tracks.size(), 0);
    trace.left.assign(view.tracks.size(), 0);
    std::vector<TrackError> turning, moving;
    for (std::size_t n = 0; n < tracks.numbers.size(); ++n) {
      const TrackError& error = errors[n];
      const std::size_t number = tracks.numbers[n];
      const double unit = degrees_per_unit(view, view.tracks[number].space);
      trace.noise[number] = std::sqrt(error.removed) / unit;
      trace.left[number] = std::sqrt(error.left) / unit;
      (view.tracks[number].space == Space::rotation ? turning : moving).push_back(error);
    }
    for (const Space space : {Space::rotation, Space::position}) {
      const double strength_deg = slow_noise(space == Space::rotation ? turning : moving);
      if (strength_deg == 0) continue;
      NoiseCharacter character;
      character.space = space;
      character.strength = strength_deg / degrees_per_unit(view, space);
      character.is_expected = true;
      trace.characters.push_back(character);
    }
  }

  void hand_over(const TakeView& view, const MotionTracks& tracks, std::optional<KnownBody>& body,
                 const MotionResult& result, const std::vector<TrackError>& errors,
                 const TrackSink& sink) const {
    std::vector<std::uint8_t> is_body(tracks.numbers.size());
    if (body) {
      decode_known_body(*body, model_->layout, tracks.take, result.values);
      for (const std::int32_t n : body->track_of)
        if (n >= 0) is_body[static_cast<std::size_t>(n)] = 1;
    }
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
      cleaned.noise = {
          std::sqrt(errors[n].all()) / degrees_per_unit(view, view.tracks[number].space),
          errors[n].correlation};
      sink(number, std::move(cleaned));
    }
  }

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
  return std::make_unique<Learned>(options, model_for("learned", options.model, std::move(model)));
}

}  // namespace kinemend
