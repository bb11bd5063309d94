// Random numbers that are the same on every machine.
#pragma once

#include <array>
#include <cstdint>

namespace kinemend {

/// The one random generator (xoshiro256++, seeded through splitmix64). It is passed in, never
/// global: the same seed gives the same numbers on every machine, compiler and number of threads.
class Random {
 public:
  explicit Random(std::uint64_t seed) noexcept;

  /// Uniform over all 64-bit values.
  std::uint64_t next() noexcept;
  /// Uniform in [0, 1), 53 random bits.
  double uniform() noexcept;
  /// Uniform in [low, high).
  double uniform(double low, double high) noexcept;
  /// Uniform in {0, ..., count - 1}; `count` is at least 1.
  std::uint64_t below(std::uint64_t count) noexcept;
  /// Standard normal, by the inverse distribution function (one draw per value).
  double normal() noexcept;
  /// True with the given probability.
  bool chance(double probability) noexcept;
  /// Returns an independent generator for part `index` of the work, so that parts may run in any
  /// order.
  Random fork(std::uint64_t index) const noexcept;

 private:
  std::array<std::uint64_t, 4> state_;
};

/// The standard normal quantile: Phi^-1(p) for p in (0, 1), to 1e-15 relative.
double normal_quantile(double p) noexcept;

}  // namespace kinemend
