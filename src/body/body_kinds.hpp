// Encodes and decodes the channels of bodies for each kind of take; `body_take.cpp` chooses.
#pragma once

#include <cstdint>
#include <span>

#include "kinemend/experimental/body.hpp"

namespace kinemend::representation {

/// Fills the measured samples of `channels` in the frame of `guide`, which `channels` has copied;
/// with nullptr it finds the frame first.
void encode_joints(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                   const BodyChannels* guide, BodyChannels& channels);
void encode_markers(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                    const BodyChannels* guide, BodyChannels& channels);
/// Implements `decode_body` for one kind.
void decode_joints(const BodyChannels& channels, const BodyLayout& layout, const BodyMatch& match,
                   Take& clip, std::span<const std::uint8_t> chosen);
void decode_markers(const BodyChannels& channels, const BodyLayout& layout, const BodyMatch& match,
                    Take& clip, std::span<const std::uint8_t> chosen);

}  // namespace kinemend::representation
