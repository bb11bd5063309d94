#pragma once

// The operators that count: to be included in one file of a program.
#include <malloc.h>

#include <cstdlib>
#include <new>

#include "counted_memory.hpp"

#if !defined(KINEMEND_SANITIZED)

namespace {

using kinemend::test::memory_now;
using kinemend::test::memory_peak;

void* count(void* block) {
  if (block == nullptr) throw std::bad_alloc();
  const std::size_t now = memory_now += ::malloc_usable_size(block);
  std::size_t peak = memory_peak;
  while (now > peak && !memory_peak.compare_exchange_weak(peak, now)) {
  }
  return block;
}

void uncount(void* block) {
  if (block != nullptr) memory_now -= ::malloc_usable_size(block);
  std::free(block);
}

}  // namespace

void* operator new(std::size_t size) { return count(std::malloc(size)); }
void* operator new[](std::size_t size) { return count(std::malloc(size)); }
void operator delete(void* block) noexcept { uncount(block); }
void operator delete[](void* block) noexcept { uncount(block); }
void operator delete(void* block, std::size_t) noexcept { uncount(block); }
void operator delete[](void* block, std::size_t) noexcept { uncount(block); }

#endif
