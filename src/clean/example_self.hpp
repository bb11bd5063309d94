#pragma once

#include <memory>

#include "kinemend/cleaner.hpp"
#include "kinemend/methods.hpp"

namespace kinemend {

/// Example-based denoising without examples: filter bases of the take itself.
std::unique_ptr<Cleaner> make_self_example(const ExampleOptions& options);

}  // namespace kinemend
