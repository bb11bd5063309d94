// Checkpoints of trainings, so that one that was interrupted can go on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "kinemend/experimental/tensor.hpp"

namespace kinemend::train {

/// A training that is under way: the network's state and the batches done.
struct Checkpoint {
  TensorFile state;
  std::size_t batch = 0;
};

std::string write_checkpoint(TensorFile state, std::size_t batch, std::uint64_t seed);
/// Errors: `ErrorKind::unreadable_input` for what is no checkpoint, `ErrorKind::usage` for another
/// seed.
Checkpoint read_checkpoint(std::string_view bytes, std::string_view name, std::uint64_t seed);

}  // namespace kinemend::train
