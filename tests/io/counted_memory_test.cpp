// Tests of the counted memory of the tests themselves.
#include "counting_allocation.hpp"

#include "hostile.hpp"

#if !defined(KINEMEND_SANITIZED)

namespace kinemend::test {
namespace {

TEST(CountedMemory, SeesWhatAnActionHeldAtOnce) {
  // Makes the memory visible, because a compiler may omit unused allocations.
  volatile const char* seen = nullptr;
  const auto hold = [&](std::size_t bytes) {
    std::vector<char> block(bytes);
    seen = block.data();
    return seen[0];
  };
  const std::size_t peak = peak_memory([&] {
    hold(1 << 20);
    hold(3 << 20);
  });
  EXPECT_GE(peak, std::size_t{3} << 20);
  EXPECT_LT(peak, std::size_t{4} << 20);
}

}  // namespace
}  // namespace kinemend::test

#endif
