// Reads the limits that a robot has, for `check --robot`.
#pragma once

#include <string>
#include <string_view>

#include "kinemend/check.hpp"

namespace kinemend::cli {

/// The settings of --robot; `path`: the file of --limits, or empty. Errors: as
/// `parse_robot_limits`, and for a file that cannot be read.
RobotSettings robot_settings(const std::string& path);

/// Limits in a TOML text. `speed_deg_s` and `acceleration_deg_s2` are for all joints; a table
/// `[joints."PATTERN"]` with either is for joints whose names match, and inherits the other. Later
/// tables override earlier ones. Errors, with the line: `ErrorKind::unreadable_input` for text that
/// is not TOML, `ErrorKind::usage` for an unknown key or a value that is no number above 0.
RobotSettings parse_robot_limits(std::string_view text, std::string_view name);

}  // namespace kinemend::cli
