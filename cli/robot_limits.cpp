// Reads limits of joints from TOML, with line numbers for errors.
#include "robot_limits.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/io.hpp"
#include "takes.hpp"

namespace kinemend::cli {

namespace {

class LimitsReader {
 public:
  explicit LimitsReader(std::string_view name) : name_(name) {}

  RobotSettings read(const toml::table& root) const {
    RobotSettings settings;
    settings.limits = limits_in(root, settings.limits, {"joints"});
    const toml::node* joints = root.get("joints");
    if (joints == nullptr) return settings;
    if (!joints->is_table()) refuse(*joints, "joints: is not a table of patterns");
    for (const auto& [pattern, node] : in_order_of_lines(*joints->as_table()))
      settings.joints.push_back({pattern, joint_limits(pattern, *node, settings.limits)});
    return settings;
  }

 private:
  // toml++ sorts tables by name, but the file's order decides which pattern applies.
  static std::vector<std::pair<std::string, const toml::node*>> in_order_of_lines(
      const toml::table& table) {
    std::vector<std::pair<std::string, const toml::node*>> nodes;
    for (const auto& [key, node] : table) nodes.emplace_back(std::string(key.str()), &node);
    std::stable_sort(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) {
      return a.second->source().begin.line < b.second->source().begin.line;
    });
    return nodes;
  }

  JointLimits joint_limits(const std::string& pattern, const toml::node& node,
                           JointLimits inherited) const {
    if (!node.is_table()) refuse(node, pattern + ": is not a table of limits");
    return limits_in(*node.as_table(), inherited, {});
  }

  JointLimits limits_in(const toml::table& table, JointLimits limits,
                        const std::vector<std::string>& others) const {
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (name == "speed_deg_s")
        limits.speed_deg_s = positive(name, node);
      else if (name == "acceleration_deg_s2")
        limits.acceleration_deg_s2 = positive(name, node);
      else if (std::find(others.begin(), others.end(), name) == others.end())
        refuse_unknown(name, node, others);
    }
    return limits;
  }

  double positive(const std::string& name, const toml::node& node) const {
    constexpr double most = 1e9;
    const auto value = node.value<double>();
    if (node.is_number() && value && *value > 0 && *value <= most) return *value;
    refuse(node, name + ": is not a number above 0, up to 1e9");
  }

  [[noreturn]] void refuse_unknown(const std::string& key, const toml::node& node,
                                   const std::vector<std::string>& others) const {
    std::vector<std::string> known = {"speed_deg_s", "acceleration_deg_s2"};
    known.insert(known.end(), others.begin(), others.end());
    const std::string guess = nearest_name(key, known);
    refuse(node, fmt::format("unknown limit {}{}", key,
                             guess.empty() ? "" : fmt::format(" (did you mean {}?)", guess)));
  }

  [[noreturn]] void refuse(const toml::node& node, const std::string& message) const {
    throw Error(ErrorKind::usage,
                fmt::format("{}:{}: {}", name_, node.source().begin.line, message));
  }

  std::string_view name_;
};

}  // namespace

RobotSettings robot_settings(const std::string& path) {
  return path.empty() ? RobotSettings{} : parse_robot_limits(read_file(path), input_name(path));
}

RobotSettings parse_robot_limits(std::string_view text, std::string_view name) {
  try {
    return LimitsReader(name).read(toml::parse(text));
  } catch (const toml::parse_error& error) {
    throw Error(ErrorKind::unreadable_input,
                fmt::format("{}:{}: {}", name, error.source().begin.line, error.description()));
  }
}

}  // namespace kinemend::cli
