// Which methods can clean a take.
#pragma once

#include <string>

#include "kinemend/cleaner.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Returns why a method with default options refuses this take, or leaves all its joints or markers
/// to `auto`: "the network filters takes of 120 Hz only, and this one has 60"; empty: it cleans
/// some of them. A missing model is also such a reason. Looks at names, skeleton and frame rate,
/// not at the samples of joints. Throws nothing but `std::bad_alloc`.
std::string why_not(const Method& method, const Take& take);

}  // namespace kinemend
