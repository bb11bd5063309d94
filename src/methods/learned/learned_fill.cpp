// Fills gaps of joints by the network of the method `learned`, for `src/fill`.
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cleaner/pieces.hpp"
#include "kinemend/experimental/model.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/methods.hpp"
#include "methods/learned/entries.hpp"
#include "methods/learned/learned_body.hpp"
#include "methods/learned/measured_smoothing.hpp"
#include "methods/learned/motion_channels.hpp"
#include "methods/learned/motion_filter.hpp"
#include "methods/prior/prior_cleaning.hpp"
#include "models/model_reading.hpp"

namespace kinemend {

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
