#include "method_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "command_line.hpp"

namespace kinemend::cli {

namespace {

const OptionSpec* option_called(const Method& method, std::string_view name) {
  const auto found = std::find_if(method.options.begin(), method.options.end(),
                                  [&](const OptionSpec& spec) { return spec.name == name; });
  return found == method.options.end() ? nullptr : &*found;
}

[[noreturn]] void refuse_foreign(const Method& method, const std::string& option) {
  std::vector<std::string> owners;
  for (const Method& other : methods()) {
    if (option_called(other, option)) owners.push_back(other.name);
  }
  throw Error(ErrorKind::usage,
              fmt::format("--{} is an option of {}, not of {} (choose with --method)",
                          dashed(option), fmt::join(owners, ", "), method.name));
}

}  // namespace

std::vector<OptionGroup> method_groups() {
  std::vector<OptionGroup> groups;
  for (const Method& method : methods())
    groups.push_back({method.name, method.summary, method.paper, method.options});
  return groups;
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method& method : methods()) names.push_back(method.name);
  return names;
}

const Method* method_called(std::string_view name) {
  for (const Method& method : methods()) {
    if (method.name == name) return &method;
  }
  return nullptr;
}

OptionValues parse_method_options(const Method& method,
                                  const std::map<std::string, std::string, std::less<>>& texts) {
  OptionValues values;
  for (const auto& [name, text] : texts) {
    const OptionSpec* spec = option_called(method, name);
    if (!spec) refuse_foreign(method, name);
    values[name] = parse_flag_value(*spec, text);
  }
  return values;
}

}  // namespace kinemend::cli
