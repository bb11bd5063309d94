// Lists the methods that can clean a live stream.
#include <algorithm>

#include "kinemend/error.hpp"
#include "kinemend/experimental/live.hpp"

namespace kinemend {

namespace {

// Whether a method reads a model file. (A `model` with choices is a filter's setting.)
bool is_learned(const Method& method) {
  return std::any_of(method.options.begin(), method.options.end(), [](const OptionSpec& spec) {
    return spec.name == "model" && spec.choices.empty();
  });
}

bool runs_live(const Method& method, const OptionValues& options) {
  // The rate is arbitrary, by definition.
  constexpr double any_rate_hz = 120;
  try {
    return method.make(options)->live_support(any_rate_hz).runs();
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

std::vector<LiveMethod> live_methods() {
  std::vector<LiveMethod> list;
  for (const Method& method : methods()) {
    // Making a learned method reads a model, which takes long. One of those that run live, by their
    // option, cleans any body.
    if (is_learned(method)) {
      if (method.name == "learned") list.push_back({method.name, {{"live", true}}});
      continue;
    }
    if (runs_live(method, {})) {
      list.push_back({method.name, {}});
      continue;
    }
    for (const OptionSpec& spec : method.options) {
      const bool* const is_on = std::get_if<bool>(&spec.default_value);
      if (is_on == nullptr || !runs_live(method, {{spec.name, !*is_on}})) continue;
      list.push_back({method.name, {{spec.name, !*is_on}}});
      break;
    }
  }
  return list;
}

}  // namespace kinemend
