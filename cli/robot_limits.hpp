// Reads the limits of a robot for `check --robot`.
#pragma once

#include <string>
#include <string_view>

#include "kinemend/check.hpp"

namespace kinemend::cli {

/// The settings of --robot. `path` is the file of --limits, or empty. Errors: those of
/// `parse_robot_limits`, and of reading the file.
RobotSettings robot_settings(const std::string& path);

/// Limits in a TOML text. `speed_deg_s` and `acceleration_deg_s2` apply to all joints; a table
/// `[joints."PATTERN"]` with either applies to joints whose names match, and inherits the other.
/// Later tables override earlier ones. Errors, with the line: `ErrorKind::unreadable_input` for
/// text that is not TOML, `ErrorKind::usage` for an unknown key or a value that is not above 0.
RobotSettings parse_robot_limits(std::string_view text, std::string_view name);

}  // namespace kinemend::cli
