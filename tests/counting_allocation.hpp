// Replaces the allocation functions of the C library, which all others use, by counting ones.
// Exactly one source of a program includes this file.
#pragma once

#include <cerrno>
#include <cstddef>

#include "counted_memory.hpp"

#if !defined(KINEMEND_SANITIZED) && defined(__GLIBC__)
#include <malloc.h>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);
}

namespace kinemend::test {

inline void* counted(void* block) {
  if (block == nullptr) return block;
  const std::size_t size = ::malloc_usable_size(block);
  const std::size_t now = memory_now += size;
  memory_taken += size;
  std::size_t peak = memory_peak;
  while (now > peak && !memory_peak.compare_exchange_weak(peak, now)) {
  }
  return block;
}

inline void uncount(void* block) {
  if (block != nullptr) memory_now -= ::malloc_usable_size(block);
}

}  // namespace kinemend::test

extern "C" {

void* malloc(std::size_t size) { return kinemend::test::counted(__libc_malloc(size)); }
void* calloc(std::size_t count, std::size_t size) {
  return kinemend::test::counted(__libc_calloc(count, size));
}
void* realloc(void* block, std::size_t size) {
  kinemend::test::uncount(block);
  void* const moved = __libc_realloc(block, size);
  if (moved == nullptr && size > 0) {
    kinemend::test::counted(block);
    return nullptr;
  }
  return kinemend::test::counted(moved);
}
void* memalign(std::size_t alignment, std::size_t size) {
  return kinemend::test::counted(__libc_memalign(alignment, size));
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  *block = memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}
void free(void* block) {
  kinemend::test::uncount(block);
  __libc_free(block);
}

}  // extern "C"

#endif
