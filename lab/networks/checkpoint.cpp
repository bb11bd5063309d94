// Stores the batch and the seed in the metadata of a tensor file, and checks them when reading.
#include "checkpoint.hpp"

#include <fmt/format.h>

#include <charconv>
#include <system_error>
#include <utility>

#include "kinemend/error.hpp"

namespace kinemend::train {

std::string write_checkpoint(TensorFile state, std::size_t batch, std::uint64_t seed) {
  state.metadata["batch"] = fmt::format("{}", batch);
  state.metadata["seed"] = fmt::format("{}", seed);
  return write_tensors(state);
}

Checkpoint read_checkpoint(std::string_view bytes, std::string_view name, std::uint64_t seed) {
  TensorFile state = parse_tensors(bytes, name);
  const auto number = [&](const char* key) {
    const auto found = state.metadata.find(key);
    const std::string text = found == state.metadata.end() ? "" : found->second;
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      throw Error(ErrorKind::unreadable_input, fmt::format("{}: is no checkpoint", name));
    return value;
  };
  const std::uint64_t batch = number("batch"), other_seed = number("seed");
  if (other_seed != seed)
    throw Error(ErrorKind::usage,
                fmt::format("{}: is of a training with seed {}, not {}", name, other_seed, seed));
  return {std::move(state), batch};
}

}  // namespace kinemend::train
