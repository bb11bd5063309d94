// Turns a take of markers into the channels of a layout of markers, and back.
#include <vector>

#include "body/body_anchors.hpp"
#include "body/body_frame.hpp"
#include "body/body_kinds.hpp"
#include "kinemend/experimental/body.hpp"

namespace kinemend {

namespace representation {

void encode_markers(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                    const BodyChannels* guide, BodyChannels& channels) {
  if (guide == nullptr)
    follow_anchors(clip, layout, match, floor_height(clip, layout, match), channels);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const TurnAboutY turn(channels.headings[f]);
    for (std::size_t i = 0; i < layout.track_count(); ++i) {
      const auto marker = static_cast<std::size_t>(match.tracks[i]);
      if (match.tracks[i] < 0 || !clip.is_observed(f, marker)) continue;
      const Vec3 ahead =
          turn.back(upright_position(clip, match.upright, f, marker) - channels.places[f]);
      put_channels(channels, f, 3 * i,
                   channels.degrees_per_unit * (ahead - match.body_height * layout.means[i]));
    }
  }
}

void decode_markers(const BodyChannels& channels, const BodyLayout& layout, const BodyMatch& match,
                    Take& clip, std::span<const std::uint8_t> chosen) {
  check_fit(channels, layout, match, clip.frame_count(), chosen);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const TurnAboutY turn(channels.headings[f]);
    for (std::size_t i = 0; i < layout.track_count(); ++i) {
      if (match.tracks[i] < 0 || (!chosen.empty() && chosen[i] == 0)) continue;
      const Vec3 ahead = (1 / channels.degrees_per_unit) * channels_at(channels, f, 3 * i) +
                         match.body_height * layout.means[i];
      clip.position(f, static_cast<std::size_t>(match.tracks[i])) =
          rotate(conjugate(match.upright), channels.places[f] + turn(ahead));
    }
  }
}

}  // namespace representation

}  // namespace kinemend
