// The table of all methods, in the order in which they are listed.
#include "kinemend/methods.hpp"

#include <fmt/format.h>

#include <vector>

#include "base/named_table.hpp"
#include "classic/entries.hpp"
#include "kinemend/cleaner.hpp"
#include "methods/auto/entries.hpp"
#include "methods/learned/entries.hpp"
#include "methods/wiener/entries.hpp"
#include "papers/courty2008_bilateral/entries.hpp"
#include "papers/dean2016_nonlocal/entries.hpp"
#include "papers/lou2010_example/entries.hpp"
#include "papers/mall2017_recurrent/entries.hpp"
#include "papers/xiao2015_sparse/entries.hpp"

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
