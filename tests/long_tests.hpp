// Selects the tests that take longer than ten seconds and seldom fail alone; they run where
// KINEMEND_LONG is set, as in `make nightly`.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

namespace kinemend::test {

/// Returns whether long tests run.
inline bool runs_long_tests() { return std::getenv("KINEMEND_LONG") != nullptr; }

}  // namespace kinemend::test

#define KINEMEND_LONG_TEST() \
  if (!kinemend::test::runs_long_tests()) GTEST_SKIP() << "long: KINEMEND_LONG=1 runs it"

/// For tests that take long under sanitizers alone.
#if defined(KINEMEND_SANITIZED)
#define KINEMEND_LONG_WHEN_SANITIZED() KINEMEND_LONG_TEST()
#else
#define KINEMEND_LONG_WHEN_SANITIZED() static_cast<void>(0)
#endif
