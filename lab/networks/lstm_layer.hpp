// An LSTM layer for training that is faster to differentiate than LibTorch's own.
#pragma once

#include <torch/torch.h>

// Only sequence_network.cpp includes it, because LibTorch's headers define CHECK and LOG.
namespace kinemend::train {

/// An LSTM layer over whole sequences, starting at a zero state: x is T x B x inputs, the result T
/// x B x H; weights and order of gates (i, f, g, o) are LibTorch's. Its own backward pass uses one
/// product and one loop over the gates per frame, where LibTorch uses about twenty small tensors.
torch::Tensor lstm_layer(const torch::Tensor& x, const torch::Tensor& input_weight,
                         const torch::Tensor& state_weight, const torch::Tensor& bias,
                         bool is_backward);

}  // namespace kinemend::train
