// A pool of threads of the standard library, for systems without oneTBB.
#pragma once

#include <cstddef>

#include "base/parallel.hpp"

namespace kinemend::pool {

/// Number of threads with the limits that hold now, the caller's among them.
std::size_t thread_count();
/// The number without limits; 0: as many as the machine has. Returns the number before.
std::size_t set_thread_count(std::size_t count);
void add_limit(std::size_t most);
void remove_limit(std::size_t most);
/// As `for_each_index`. A thread that waits for the rest of its own work does no other.
void for_each_index(std::size_t count, const IndexWork& work);
/// As `work_is_cancelled`.
bool is_cancelled();

}  // namespace kinemend::pool
