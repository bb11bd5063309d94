// Aligns C++ memory to 16 bytes, as on 64-bit systems. Emscripten aligns to 8, and Eigen sums from
// the first aligned number on, so the order of a sum and its last bit would differ.
#include <cstdlib>
#include <new>

namespace {

void* aligned_memory(std::size_t size) {
  void* memory = nullptr;
  if (posix_memalign(&memory, 16, size > 0 ? size : 1) != 0) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) { return aligned_memory(size); }
void* operator new[](std::size_t size) { return aligned_memory(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
