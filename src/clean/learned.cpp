#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "base/progress.hpp"
#include "clean/auto_scale.hpp"
#include "clean/motion_channels.hpp"
#include "clean/pieces.hpp"
#include "clean/prior_cleaning.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/model.hpp"
#include "kinemend/experimental/representation.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/options.hpp"
#include "priors/motion/motion_filter.hpp"

namespace kinemend {

namespace {

constexpr std::size_t fewest_frames = 4;

const OptionTable<LearnedOptions>& learned_table() {
  static const auto options =
      OptionTable<LearnedOptions>()
          .text(&LearnedOptions::model, "model",
                "model file made by kinemend-train learned; empty: the model that ships")
          .text(&LearnedOptions::map, "map",
                "file that maps names in the take to names in the model");
  return options;
}

// The joints of a take that the model knows, as its channels.
struct KnownBody {
  BodyMatch match;
  Clip clip;  // without spikes
  BodyChannels channels;
  std::vector<std::int32_t> track_of;  // N and the place: the track among those cleaned, or -1
};

// Whether a part stays where its channels can say what it does.
bool is_tame(const BodyChannels& body, std::size_t part) {
  constexpr double most_step_deg = 60;
  const auto vector_at = [&](std::size_t frame) {
    return Vec3{body.poses(frame, 3 * part), body.poses(frame, 3 * part + 1),
                body.poses(frame, 3 * part + 2)};
  };
  for (std::size_t f = 0; f < body.poses.frames; ++f) {
    if (norm(vector_at(f)) > degrees_per_radian * tangent_limit_rad) return false;
    if (f > 0 && norm(vector_at(f) - vector_at(f - 1)) > most_step_deg) return false;
  }
  return true;
}

// Nothing where the model knows too little of the take.
std::optional<KnownBody> known_body(const BodyLayout& layout, const NameMap& names,
                                    const TakeView& view, const MotionTracks& tracks) {
  if (view.joints == nullptr || layout.kind != BodyKind::joints) return std::nullopt;
  KnownBody body;
  try {
    body.match = match_body(layout, *view.joints, names);
  } catch (const Error&) {
    if (!names.empty()) throw;
    return std::nullopt;
  }
  body.clip = *view.joints;
  for (std::size_t n = 0; n < tracks.numbers.size(); ++n) {
    const CleanedTrack steady = cleaned_track(tracks, view, n, tracks.take.values);
    if (steady.positions.empty()) {
      set_track(body.clip, tracks.numbers[n], steady.rotations);
    } else {
      set_track(body.clip, tracks.numbers[n], steady.positions);
    }
  }
  body.channels = encode_body(body.clip, layout, body.match);
  const std::size_t parts = body.channels.poses.channels / 3;
  body.track_of.assign(parts, -1);
  for (std::size_t part = 0; part < parts; ++part) {
    const bool is_place = part == layout.track_count();
    if (!is_place && body.match.tracks[part] < 0) continue;
    const std::size_t number =
        is_place ? view.root_track() : static_cast<std::size_t>(body.match.tracks[part]);
    const auto found = std::find(tracks.numbers.begin(), tracks.numbers.end(), number);
    if (found == tracks.numbers.end() || (!is_place && !is_tame(body.channels, part))) continue;
    body.track_of[part] = static_cast<std::int32_t>(found - tracks.numbers.begin());
  }
  return body;
}

// Channels of the body take the place of those that know nothing of it.
void show_body(const KnownBody& body, MotionTake& take) {
  for (std::size_t part = 0; part < body.track_of.size(); ++part) {
    if (body.track_of[part] < 0) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t slot = 3 * part + axis;
      const std::size_t c = 3 * static_cast<std::size_t>(body.track_of[part]) + axis;
      take.slots[c] = static_cast<std::int32_t>(slot);
      for (std::size_t f = 0; f < take.frames; ++f)
        take.values[f * take.channels + c] = static_cast<float>(body.channels.poses(f, slot));
    }
  }
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
    if (view.frames < fewest_frames) return trace;
    ShareProgress progress(tell);
    progress.begin_part(0.3, 1);
    MotionTracks tracks = motion_tracks_of(view, changeable_tracks(view));
    if (tracks.numbers.empty()) return trace;
    std::optional<KnownBody> body = known_body(model_->layout, names_, view, tracks);
    if (body) show_body(*body, tracks.take);
    progress.step();
    progress.begin_part(1, 1);
    const MotionTake& take = tracks.take;
    const MotionResult result = filtered(network_, take);
    say_noise(view, tracks, result, trace);
    hand_over(view, tracks, body, result, sink);
    progress.step();
    return trace;
  }

 private:
  // What was taken out of each track, and what is expected to be left.
  static void say_noise(const TakeView& view, const MotionTracks& tracks,
                        const MotionResult& result, CleanTrace& trace) {
    trace.noise.assign(view.tracks.size(), 0);
    const MotionTake& take = tracks.take;
    for (std::size_t n = 0; n < tracks.numbers.size(); ++n) {
      double square = 0;
      for (std::size_t f = 0; f < take.frames; ++f) {
        for (std::size_t c = 3 * n; c < 3 * n + 3; ++c) {
          const std::size_t i = f * take.channels + c;
          const double change = static_cast<double>(result.values[i] - take.values[i]);
          square += change * change;
        }
      }
      const std::size_t number = tracks.numbers[n];
      trace.noise[number] = std::sqrt(square / static_cast<double>(3 * take.frames)) /
                            degrees_per_unit(view, view.tracks[number].space);
    }
  }

  void hand_over(const TakeView& view, const MotionTracks& tracks, std::optional<KnownBody>& body,
                 const MotionResult& result, const TrackSink& sink) const {
    std::vector<std::uint8_t> is_body(tracks.numbers.size());
    if (body) {
      std::vector<std::uint8_t> chosen;
      for (std::size_t part = 0; part < body->track_of.size(); ++part) {
        const std::int32_t n = body->track_of[part];
        chosen.push_back(n >= 0 ? 1 : 0);
        if (n < 0) continue;
        is_body[static_cast<std::size_t>(n)] = 1;
        for (std::size_t f = 0; f < view.frames; ++f) {
          for (std::size_t axis = 0; axis < 3; ++axis)
            body->channels.poses(f, 3 * part + axis) = static_cast<double>(
                result.values[f * tracks.take.channels + 3 * static_cast<std::size_t>(n) + axis]);
        }
      }
      decode_body(body->channels, model_->layout, body->match, body->clip, chosen);
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
      sink(tracks.numbers[n], std::move(cleaned));
    }
  }

  std::shared_ptr<const Model> model_;
  NameMap names_;
  MotionNetwork network_;
};

}  // namespace

std::unique_ptr<Cleaner> make_learned(const LearnedOptions& options,
                                      std::shared_ptr<const Model> model) {
  learned_table().validate(options);
  return std::make_unique<Learned>(options, model_for("learned", options.model, std::move(model)));
}

}  // namespace kinemend
