// Which methods can clean a take.
#pragma once

#include <string>

#include "kinemend/cleaner.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Why a method with default options would refuse this take, or leave every joint or marker of it
/// to `auto`: "the network filters takes of 120 Hz only, and this one has 60"; empty: it cleans
/// some. A method that needs a model and has none says so. Looks at names, skeleton and frame rate,
/// not at the samples of joints. Throws nothing but `std::bad_alloc`.
std::string why_not(const Method& method, const Take& take);

}  // namespace kinemend
