// Functions of `count` floats in place, compiled for each instruction set and chosen at run time.
#pragma once

#include <cstddef>

namespace kinemend::nn {

void exp_of(float* values, std::size_t count);
void tanh_of(float* values, std::size_t count);
/// For training, which keeps the gates of each step.
void sigmoid_of(float* values, std::size_t count);
void relu_of(float* values, std::size_t count);

/// A step of an LSTM's memory from its gates i, f, g and o before activation, `units` each, one
/// after the other: c = s(f) c + s(i) tanh(g), h = s(o) tanh(c).
void lstm_gates(float* gates, std::size_t units, float* cell, float* state);

}  // namespace kinemend::nn
