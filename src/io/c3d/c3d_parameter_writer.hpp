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
/// `columns` values a row.
C3dParameter c3d_reals(std::string name, std::vector<double> values, std::size_t columns);
C3dParameter c3d_text(std::string name, std::string_view text);
/// As NAME, NAME2, ..., none of them with more texts or bytes than a parameter can have.
std::vector<C3dParameter> c3d_texts(const std::string& name, const std::vector<std::string>& texts);

/// Puts a parameter into a group, which is made where it is missing, instead of the one of that
/// name. Errors: `usage` when there is no number left for a group.
void set_parameter(C3dParameters& parameters, std::string_view group, C3dParameter parameter);
/// Replaces NAME, NAME2, NAME3, ...
void set_texts(C3dParameters& parameters, std::string_view group, const std::string& name,
               const std::vector<std::string>& texts);
/// Removes NAME, NAME2, NAME3, ...
void remove_parameter(C3dParameters& parameters, std::string_view group, std::string_view name);
/// Removes a group and all that is in it.
void remove_group(C3dParameters& parameters, std::string_view name);

/// A parameter section of Intel numbers, whole blocks of 512 bytes.
std::string c3d_parameter_section(const C3dParameters& parameters);

}  // namespace kinemend
