#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "sequence_network.hpp"

namespace kinemend::train {

/// A training that is under way: the network's state, the batches done and the seed.
std::string write_checkpoint(const SequenceNetwork& network, std::size_t batch, std::uint64_t seed);
/// Puts the state back and returns the batches done. Errors: `ErrorKind::unreadable_input` for what
/// is no checkpoint or one of another network, `ErrorKind::usage` for another seed.
std::size_t read_checkpoint(std::string_view bytes, std::string_view name, std::uint64_t seed,
                            SequenceNetwork& network);

}  // namespace kinemend::train
