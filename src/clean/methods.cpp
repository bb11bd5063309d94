#include "kinemend/methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "clean/method_list.hpp"
#include "kinemend/cleaner.hpp"

namespace kinemend {

namespace {

std::vector<std::string> names_of(const auto& entries) {
  std::vector<std::string> names;
  names.reserve(entries.size());
  for (const auto& entry : entries) names.push_back(entry.name);
  return names;
}

void check_option_names(const Method& method, const OptionValues& values) {
  const std::vector<std::string> names = names_of(method.options);
  for (const auto& [name, value] : values) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw Error(ErrorKind::usage,
                fmt::format("method {} has no option \"{}\"{} (it takes {})", method.name, name,
                            suggestion(name, names), fmt::join(names, ", ")));
  }
}

}  // namespace

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
    list.push_back(kalman_learned_method());
    list.push_back(one_euro_method());
    return list;
  }();
  return table;
}

const Method& find_method(std::string_view name) {
  for (const Method& method : methods()) {
    if (method.name == name) return method;
  }
  const std::vector<std::string> names = names_of(methods());
  throw Error(ErrorKind::usage, fmt::format("unknown method \"{}\"{} (there are {})", name,
                                            suggestion(name, names), fmt::join(names, ", ")));
}

std::unique_ptr<Cleaner> make_cleaner(std::string_view method, const OptionValues& values) {
  const Method& entry = find_method(method);
  check_option_names(entry, values);
  return entry.make(values);
}

}  // namespace kinemend
