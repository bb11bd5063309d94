// The parameters of a C3D file, which are named values in groups: reads, makes and changes them,
// and writes them as a section of the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/c3d/c3d_source.hpp"

namespace kinemend {

enum class C3dType : std::int8_t { text = -1, byte = 1, integer = 2, real = 4 };

/// One parameter, decoded from any processor type.
struct C3dParameter {
  std::int32_t group = 0;  ///< number of its group, from 1
  std::string name;        ///< as the file spells it
  std::string description;
  bool locked = false;
  C3dType type = C3dType::integer;
  std::vector<std::uint8_t> dimensions;  ///< first index fastest; empty for a single value
  std::string text;                      ///< for type `text`: all characters
  std::vector<double> numbers;           ///< for the other types; integers are signed
  std::size_t data_begin = 0;            ///< byte of the first value in the file
};

struct C3dGroup {
  std::int32_t number = 0;  ///< from 1
  std::string name;
  std::string description;
  bool locked = false;
};

/// The parameter section. Names are compared without regard to case; groups of the same name are
/// merged.
struct C3dParameters {
  std::vector<C3dGroup> groups;
  std::vector<C3dParameter> entries;  ///< in the order of the file

  /// Whether the parameter is in a group of that name.
  bool holds(std::string_view group, const C3dParameter& parameter) const;
  /// Returns the first parameter of that name, or nullptr.
  const C3dParameter* find(std::string_view group, std::string_view name) const;
  bool has_group(std::string_view name) const;
  /// Returns the first value; empty if there is no value, or only text.
  std::optional<double> number(std::string_view group, std::string_view name) const;
  /// Returns the first value as an unsigned 16-bit integer, which a file may also store as a real.
  std::optional<std::size_t> count(std::string_view group, std::string_view name) const;
  /// Returns all values of NAME, NAME2, NAME3, ...
  std::vector<double> numbers(std::string_view group, std::string_view name) const;
  /// Returns all texts of NAME, NAME2, NAME3, ..., without padding blanks.
  std::vector<std::string> texts(std::string_view group, std::string_view name) const;
  /// Returns the first text; empty if there is no text.
  std::string text(std::string_view group, std::string_view name) const;
};

/// Returns the texts of one parameter, without padding blanks.
std::vector<std::string> texts_of(const C3dParameter& parameter);

/// Reads the entries in [begin, end) of the file. A damaged entry ends the list, with a diagnostic
/// `damaged_parameters`.
C3dParameters read_c3d_parameters(const C3dSource& source, std::size_t begin, std::size_t end);

C3dParameter c3d_integers(std::string name, std::vector<double> values);
C3dParameter c3d_integer(std::string name, double value);  ///< without dimensions
C3dParameter c3d_real(std::string name, double value);     ///< without dimensions
/// Makes a parameter with `columns` values per row.
C3dParameter c3d_reals(std::string name, std::vector<double> values, std::size_t columns);
C3dParameter c3d_text(std::string name, std::string_view text);
/// Puts a parameter into a group and replaces one of the same name. The group is created if it is
/// missing. Errors: `usage` if no group number is free.
void set_parameter(C3dParameters& parameters, std::string_view group, C3dParameter parameter);
/// Replaces NAME, NAME2, NAME3, ...; no part exceeds the texts or bytes of a parameter. Errors:
/// `usage` for a text of more than 255 bytes.
void set_texts(C3dParameters& parameters, std::string_view group, const std::string& name,
               const std::vector<std::string>& texts);
/// Removes NAME, NAME2, NAME3, ...
void remove_parameter(C3dParameters& parameters, std::string_view group, std::string_view name);
/// Removes a group and its parameters.
void remove_group(C3dParameters& parameters, std::string_view name);

/// Returns a parameter section of Intel numbers, in whole blocks of 512 bytes.
std::string c3d_parameter_section(const C3dParameters& parameters);

}  // namespace kinemend
