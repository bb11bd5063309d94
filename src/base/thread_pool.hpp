// A pool of threads of the standard library, for systems without oneTBB.
#pragma once

#include <cstddef>

#include "base/parallel.hpp"

namespace kinemend::pool {

/// Number of threads under the current limits, including the caller.
std::size_t thread_count();
/// Sets the number without limits; 0: the number of hardware threads. Returns the previous number.
std::size_t set_thread_count(std::size_t count);
void add_limit(std::size_t most);
void remove_limit(std::size_t most);
/// Like `for_each_index`. A thread that waits for the rest of its own work does no other.
void for_each_index(std::size_t count, const IndexWork& work);
/// Like `work_is_cancelled`.
bool is_cancelled();

}  // namespace kinemend::pool
