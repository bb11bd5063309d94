// The table of all methods, in the order in which they are listed.
#include "kinemend/methods.hpp"

#include <fmt/format.h>

#include <vector>

#include "base/named_table.hpp"
#include "kinemend/cleaner.hpp"
#include "learned/corrector/entries.hpp"
#include "learned/example/entries.hpp"
#include "learned/papers/entries.hpp"
#include "learned/sparse/entries.hpp"
#include "learned/wiener/entries.hpp"
#include "methods/auto/entries.hpp"
#include "methods/filters/entries.hpp"

namespace kinemend {

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

}  // namespace kinemend
