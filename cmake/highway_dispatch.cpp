// The part of Highway that is no header, for targets that Debian has no library for: which of its
// instruction sets the processor has, and aligned memory.
#include <hwy/aligned_allocator.h>
#include <hwy/targets.h>

#include <cstdlib>
#include <new>

namespace hwy {

namespace {

constexpr std::align_val_t alignment{HWY_ALIGNMENT};

#if HWY_ARCH_X86
// The builtins take literals only. They know which registers the system saves. Where no target is
// found, Highway takes the one that every processor has.
std::int64_t targets_of_processor() {
  __builtin_cpu_init();
  std::int64_t targets = 0;
  if (__builtin_cpu_supports("ssse3")) targets |= HWY_SSSE3;
  if (__builtin_cpu_supports("sse4.1") && __builtin_cpu_supports("sse4.2")) targets |= HWY_SSE4;
  const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                        __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  if (has_avx2) targets |= HWY_AVX2;
  const bool has_avx3 = has_avx2 && __builtin_cpu_supports("avx512f") &&
                        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
                        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd");
  if (has_avx3) targets |= HWY_AVX3;
  return targets;
}
#else
std::int64_t targets_of_processor() { return HWY_STATIC_TARGET; }
#endif

// Set by tests; 0: those of the processor.
std::int64_t wanted_targets = 0;

}  // namespace

std::int64_t SupportedTargets() {
  static const std::int64_t targets = targets_of_processor();
  return (wanted_targets != 0 ? wanted_targets : targets) & HWY_TARGETS;
}

void SetSupportedTargetsForTest(std::int64_t targets) { wanted_targets = targets; }

ChosenTarget& GetChosenTarget() {
  static ChosenTarget chosen;
  return chosen;
}

void* AllocateAlignedBytes(std::size_t size, AllocPtr /*allocate*/, void* /*opaque*/) {
  return ::operator new(size, alignment, std::nothrow);
}

void FreeAlignedBytes(const void* memory, FreePtr /*release*/, void* /*opaque*/) {
  ::operator delete(const_cast<void*>(memory), alignment);
}

}  // namespace hwy
