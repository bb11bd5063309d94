#pragma once

#include <cstddef>
#include <functional>

namespace kinemend {

/// Calls `work(i)` for each i below `count`, in parallel where `samples` (all that is to be done)
/// pays for it. `work` writes to what belongs to i alone.
void for_each_parallel(std::size_t count, std::size_t samples,
                       const std::function<void(std::size_t)>& work);

}  // namespace kinemend
