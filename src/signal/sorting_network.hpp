// Networks of exchanges that sort values or find their median.
#pragma once

#include "signal/kernels.hpp"

namespace kinemend::signal {

/// Batcher's odd-even merge sort for any width.
SortingNetwork sorting_network(std::size_t width);
/// The exchanges of that network on which the middle value depends.
SortingNetwork median_network(std::size_t width);

}  // namespace kinemend::signal
