// Makes groups of flags from the table of methods, and rejects options of another group.
#include "method_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "command_line.hpp"
#include "kinemend/methods.hpp"

namespace kinemend::cli {

namespace {

const OptionSpec* option_called(const OptionGroup& group, std::string_view name) {
  const auto found = std::find_if(group.options.begin(), group.options.end(),
                                  [&](const OptionSpec& spec) { return spec.name == name; });
  return found == group.options.end() ? nullptr : &*found;
}

[[noreturn]] void refuse_foreign(const std::vector<OptionGroup>& groups, std::string_view chosen,
                                 const std::string& option, std::string_view hint) {
  std::vector<std::string> owners;
  for (const OptionGroup& group : groups) {
    if (option_called(group, option)) owners.push_back(group.name);
  }
  throw Error(ErrorKind::usage, fmt::format("--{} is an option of {}, not of {}{}", dashed(option),
                                            fmt::join(owners, ", "), chosen, hint));
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

OptionValues parse_group_options(const std::vector<OptionGroup>& groups, std::string_view chosen,
                                 const std::map<std::string, std::string, std::less<>>& texts,
                                 std::string_view hint) {
  const auto group = std::find_if(groups.begin(), groups.end(),
                                  [&](const OptionGroup& g) { return g.name == chosen; });
  OptionValues values;
  for (const auto& [name, text] : texts) {
    const OptionSpec* spec = group == groups.end() ? nullptr : option_called(*group, name);
    if (!spec) refuse_foreign(groups, chosen, name, hint);
    values[name] = parse_flag_value(*spec, text);
  }
  return values;
}

OptionValues parse_method_options(const Method& method,
                                  const std::map<std::string, std::string, std::less<>>& texts) {
  return parse_group_options(method_groups(), method.name, texts, " (choose with --method)");
}

std::vector<std::string> option_files(const Method& method, const OptionValues& values) {
  std::vector<std::string> files;
  for (const OptionSpec& spec : method.options) {
    const auto value = values.find(spec.name);
    if (value == values.end() || !names_file(spec)) continue;
    const std::string& path = std::get<std::string>(value->second);
    if (!path.empty()) files.push_back(path);
  }
  return files;
}

}  // namespace kinemend::cli
