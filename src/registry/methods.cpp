// Lists all methods, in the order in which they are shown, and asks a method whether it can clean a
// take.
#include <fmt/format.h>

#include <vector>

#include "base/options.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/method_options.hpp"
#include "methods/prior/prior_cleaning.hpp"

namespace kinemend {

// Each is defined in the file of its method.
Method auto_method();
Method bilateral_method();
Method nonlocal_method();
Method gaussian_method();
Method butterworth_method();
Method median_method();
Method hampel_method();
Method wavelet_method();
Method weighted_mean_method();
Method kalman_method();
Method example_method();
Method wiener_method();
Method sparse_method();
Method kalman_learned_method();
Method recurrent_method();
Method learned_method();
Method one_euro_method();

std::span<const Method> methods() {
  static const std::vector<Method> table = [] {
    std::vector<Method> list;
    list.push_back(auto_method());
    list.push_back(bilateral_method());
    list.push_back(nonlocal_method());
    list.push_back(gaussian_method());
    list.push_back(butterworth_method());
    list.push_back(median_method());
    list.push_back(hampel_method());
    list.push_back(wavelet_method());
    list.push_back(weighted_mean_method());
    list.push_back(kalman_method());
    list.push_back(example_method());
    list.push_back(wiener_method());
    list.push_back(sparse_method());
    list.push_back(kalman_learned_method());
    list.push_back(recurrent_method());
    list.push_back(learned_method());
    list.push_back(one_euro_method());
    return list;
  }();
  return table;
}

const Method& find_method(std::string_view name) {
  return find_named(methods(), name, "unknown method");
}

std::unique_ptr<Cleaner> make_cleaner(std::string_view method, const OptionValues& values) {
  const Method& entry = find_method(method);
  for (const auto& [option, value] : values)
    find_option(entry.options, option, fmt::format("method {}", entry.name));
  return entry.make(values);
}

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
