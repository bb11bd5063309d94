// Asks a method whether it can clean a take.
#include "kinemend/experimental/method_choice.hpp"

#include "kinemend/error.hpp"
#include "methods/prior/prior_cleaning.hpp"

namespace kinemend {

std::string why_not(const Method& method, const Take& take) {
  try {
    const std::unique_ptr<Cleaner> cleaner = method.make({});
    const auto* const particular = dynamic_cast<const ParticularCleaner*>(cleaner.get());
    return particular == nullptr ? "" : particular->why_not(take);
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace kinemend
