// Makes parameters of C3D, changes them, and writes them as a section of the file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/c3d/c3d_parameters.hpp"

namespace kinemend {

C3dParameter c3d_integers(std::string name, std::vector<double> values);
C3dParameter c3d_integer(std::string name, double value);  ///< without dimensions
C3dParameter c3d_real(std::string name, double value);     ///< without dimensions
/// Makes a parameter with `columns` values per row.
C3dParameter c3d_reals(std::string name, std::vector<double> values, std::size_t columns);
C3dParameter c3d_text(std::string name, std::string_view text);
/// Splits texts into NAME, NAME2, ... so that none exceeds the texts or bytes of a parameter.
std::vector<C3dParameter> c3d_texts(const std::string& name, const std::vector<std::string>& texts);

/// Puts a parameter into a group and replaces one of the same name. The group is created if it is
/// missing. Errors: `usage` if no group number is free.
void set_parameter(C3dParameters& parameters, std::string_view group, C3dParameter parameter);
/// Replaces NAME, NAME2, NAME3, ...
void set_texts(C3dParameters& parameters, std::string_view group, const std::string& name,
               const std::vector<std::string>& texts);
/// Removes NAME, NAME2, NAME3, ...
void remove_parameter(C3dParameters& parameters, std::string_view group, std::string_view name);
/// Removes a group and its parameters.
void remove_group(C3dParameters& parameters, std::string_view name);

/// Returns a parameter section of Intel numbers, in whole blocks of 512 bytes.
std::string c3d_parameter_section(const C3dParameters& parameters);

}  // namespace kinemend
