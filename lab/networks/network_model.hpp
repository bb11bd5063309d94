// Writes trained weights and numbers into models, and computes the learning rate over time.
#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/extend/model.hpp"
#include "sequence_network.hpp"

namespace kinemend::train {

/// Writes weights by layer name: matrices in half precision, biases in single.
void put_weights(const Weights& weights, Model& model);
void put_numbers(const char* name, const std::vector<float>& values, Model& model);
/// Writes `blocks` and the dilation of each block.
void put_dilations(const std::vector<std::size_t>& dilations, Model& model);

/// The learning rate of a batch: rises over the first `warm_up` batches to `highest`, then falls
/// along a cosine to the share `least` of it.
double cosine_rate(std::size_t batch, std::size_t batches, double warm_up, double highest,
                   double least);

}  // namespace kinemend::train
