// What channels of bodies are for each kind of take; `body_take.cpp` chooses.
#pragma once

#include <cstdint>
#include <span>

#include "kinemend/experimental/body.hpp"

namespace kinemend::representation {

/// As `encode_body`; `guide` may be nullptr.
BodyChannels encode_joints(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                           const BodyChannels* guide);
BodyChannels encode_markers(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                            const BodyChannels* guide);
/// As `decode_body`.
void decode_joints(const BodyChannels& channels, const BodyLayout& layout, const BodyMatch& match,
                   Take& clip, std::span<const std::uint8_t> chosen);
void decode_markers(const BodyChannels& channels, const BodyLayout& layout, const BodyMatch& match,
                    Take& clip, std::span<const std::uint8_t> chosen);

}  // namespace kinemend::representation
