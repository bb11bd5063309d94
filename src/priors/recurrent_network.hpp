#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinemend/experimental/model.hpp"
#include "nn/layers.hpp"
#include "priors/recurrent_forms.hpp"
#include "priors/recurrent_input.hpp"

// The network of the method `recurrent`, for inference.
namespace kinemend {

/// Dense to H units, then blocks h += dense(ReLU(convolution(h))), then dense of ReLU(h):
/// convolutions of three taps, dilated, over the steps of `RecurrentInput`.
struct RecurrentNetwork {
  struct Block {
    nn::Convolution convolution;
    nn::Dense dense;
  };

  RecurrentStatistics statistics;
  BodyMirror mirror;
  nn::Dense input;
  std::vector<Block> blocks;
  nn::Dense output;
  double rate_hz = 120;

  std::size_t channels() const noexcept { return statistics.mean.size(); }
};

/// Errors: `ErrorKind::unreadable_input` naming the tensor or number that is missing or does not
/// fit.
RecurrentNetwork recurrent_network_of(const Model& model);

/// T x features to T x outputs.
std::vector<float> run(const RecurrentNetwork& network, std::span<const float> features);

/// What is to be added to what `auto` made of a take (F x D): the mean over the take as it is, in a
/// mirror, backwards, and both.
std::vector<float> ensemble_correction(const RecurrentNetwork& network, const RecurrentTake& take);

}  // namespace kinemend
