// Runs independent pieces of work in parallel where that is worth it.
#pragma once

#include <cstddef>
#include <functional>

namespace kinemend {

/// Calls `work(i)` for each i below `count`, in parallel if `samples` (the total amount of work) is
/// worth it. `work(i)` must write only to data of its own.
void for_each_parallel(std::size_t count, std::size_t samples,
                       const std::function<void(std::size_t)>& work);

}  // namespace kinemend
