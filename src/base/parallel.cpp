// Decides by the amount of work whether to use threads.
#include "base/parallel.hpp"

#include <tbb/parallel_for.h>

namespace kinemend {

void for_each_parallel(std::size_t count, std::size_t samples,
                       const std::function<void(std::size_t)>& work) {
  constexpr std::size_t worth_threads = 4096;
  if (samples < worth_threads || count < 2) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  tbb::parallel_for(std::size_t{0}, count, work);
}

}  // namespace kinemend
