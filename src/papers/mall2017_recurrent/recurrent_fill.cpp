// Fills gaps of joints by a network of Mall et al. 2017 (EBD), for `src/fill`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "body/rotation_channels.hpp"
#include "cleaner/pieces.hpp"
#include "kinemend/error.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/methods.hpp"
#include "methods/prior/prior_cleaning.hpp"
#include "models/model_reading.hpp"
#include "papers/mall2017_recurrent/entries.hpp"
#include "papers/mall2017_recurrent/gap_network.hpp"
#include "papers/mall2017_recurrent/recurrent_networks.hpp"

namespace kinemend {

namespace {

// Chosen by hand, not swept.
constexpr double most_within = 0.98;  // a few of the samples may be spikes

// Bridges all gaps: the body's frame needs a root in every frame, and rotation vectors the shortest
// path.
Take bridged_take(const Take& clip) {
  Take whole = clip;
  const TakeView view = view_of(clip);
  for (std::size_t n = 0; n < view.tracks.size(); ++n) {
    if (observed_of(view.tracks[n]).empty()) continue;
    if (view.tracks[n].space == Space::rotation)
      set_track(whole, n, rotation_piece(view, n).samples);
    else
      set_track(whole, n, position_pieces(view, n).front().samples);
  }
  return whole;
}

// Whether a joint turns farther from the model's mean than its channels can express.
bool turns_too_far(const BodyChannels& channels, std::size_t part) {
  const double limit = degrees_per_radian * tangent_limit_rad;
  std::size_t seen = 0, far = 0;
  for (std::size_t f = 0; f < channels.poses.frames; ++f) {
    const auto row = channels.poses.row(f);
    if (channels.observed[f * channels.poses.channels + 3 * part] == 0) continue;
    ++seen;
    if (norm(Vec3{row[3 * part], row[3 * part + 1], row[3 * part + 2]}) > limit) ++far;
  }
  return static_cast<double>(far) > (1 - most_within) * static_cast<double>(seen);
}

LearnedFilling fill_by_network(const FilterNetwork& network, const BodyLayout& layout,
                               const NameMap& names, const Take& clip) {
  LearnedFilling filling{clip.rotations, {}};
  filling.left_out.assign(clip.joint_count(), "the model does not know them");
  if (!has_rate_of(network, clip.frame_rate_hz)) {
    filling.left_out.assign(clip.joint_count(),
                            fmt::format("the network fills takes of {:g} Hz, and this one has {:g}",
                                        network.rate_hz, clip.frame_rate_hz));
    return filling;
  }
  const BodyMatch match = match_body(layout, clip, names);
  const Take guide = bridged_take(clip);
  BodyChannels channels = encode_body(clip, layout, match, encode_body(guide, layout, match));
  std::vector<std::uint8_t> chosen(layout.track_count() + 1, 0);
  for (std::size_t part = 0; part < layout.track_count(); ++part) {
    if (match.tracks[part] < 0) continue;
    std::string& reason = filling.left_out[static_cast<std::size_t>(match.tracks[part])];
    reason = part == 0 ? "the network sees how the root turns, and does not fill it" : "";
    if (part > 0 && turns_too_far(channels, part))
      reason = "they turn farther than the model can say";
    chosen[part] = reason.empty() ? 1 : 0;
  }
  channels.poses = filled_by_network(network, layout, channels);
  Take filled = guide;
  decode_body(channels, layout, match, filled, chosen);
  filling.rotations = std::move(filled.rotations);
  return filling;
}

}  // namespace

LearnedFill make_recurrent_fill(const RecurrentFillOptions& options,
                                std::shared_ptr<const Model> model) {
  model = model_of(recurrent_models, options.model, std::move(model));
  auto network = std::make_shared<const FilterNetwork>(gap_network_of(*model));
  return [network, model, names = name_map_at(options.map)](const Take& clip) {
    return fill_by_network(*network, model->layout, names, clip);
  };
}

}  // namespace kinemend
