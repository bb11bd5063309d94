// An LSTM layer for training, which takes less time to differentiate than LibTorch's own.
#pragma once

#include <torch/torch.h>

// Included by sequence_network.cpp alone: LibTorch's headers define CHECK and LOG.
namespace kinemend::train {

/// An LSTM layer over whole sequences, from a state of zeros: x is T x B x inputs, the result
/// T x B x H; weights and order of gates (i, f, g, o) are LibTorch's. Its own step of
/// differentiation: a product and one loop over the gates a frame, where LibTorch's takes some
/// twenty small tensors.
torch::Tensor lstm_layer(const torch::Tensor& x, const torch::Tensor& input_weight,
                         const torch::Tensor& state_weight, const torch::Tensor& bias,
                         bool is_backward);

}  // namespace kinemend::train
