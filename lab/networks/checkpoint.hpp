// Checkpoints of trainings, so that an interrupted one can resume.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "kinemend/extend/tensor.hpp"

namespace kinemend::train {

/// An unfinished training: the network's state and the batches done.
struct Checkpoint {
  TensorFile state;
  std::size_t batch = 0;
};

std::string write_checkpoint(TensorFile state, std::size_t batch, std::uint64_t seed);
/// Errors: `ErrorKind::unreadable_input` for bytes that are not a checkpoint, `ErrorKind::usage`
/// for another seed.
Checkpoint read_checkpoint(std::string_view bytes, std::string_view name, std::uint64_t seed);

}  // namespace kinemend::train
