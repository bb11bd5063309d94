// Settings for Highway, to be included before it in each kernel file.
#pragma once

// Sizeless vectors (SVE, RVV) cannot be held in arrays; the other disabled targets would only add
// code.
#define HWY_DISABLED_TARGETS \
  (HWY_AVX3_DL | HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
