// The parameters of a C3D file: named values in groups.
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

/// One parameter, whatever the processor of the file it comes from.
struct C3dParameter {
  std::int32_t group = 0;  ///< number of its group, from 1
  std::string name;        ///< as the file spells it
  std::string description;
  bool locked = false;
  C3dType type = C3dType::integer;
  std::vector<std::uint8_t> dimensions;  ///< first index fastest; empty for a single value
  std::string text;                      ///< of type `text`: all characters
  std::vector<double> numbers;           ///< of the other types; integers are signed
  std::size_t data_begin = 0;            ///< byte of the first value in the file
};

struct C3dGroup {
  std::int32_t number = 0;  ///< from 1
  std::string name;
  std::string description;
  bool locked = false;
};

/// The parameter section. Names are compared without regard to case; groups of the same name count
/// as one.
struct C3dParameters {
  std::vector<C3dGroup> groups;
  std::vector<C3dParameter> entries;  ///< in the order of the file

  /// The first parameter of that name; nullptr where there is none.
  const C3dParameter* find(std::string_view group, std::string_view name) const;
  bool has_group(std::string_view name) const;
  /// The first value; empty where there is none, or only text.
  std::optional<double> number(std::string_view group, std::string_view name) const;
  /// The first value as an unsigned 16-bit integer, which a file may also hold as a real.
  std::optional<std::size_t> count(std::string_view group, std::string_view name) const;
  /// All values of NAME, NAME2, NAME3, ...
  std::vector<double> numbers(std::string_view group, std::string_view name) const;
  /// All texts of NAME, NAME2, NAME3, ..., without the blanks that fill them up.
  std::vector<std::string> texts(std::string_view group, std::string_view name) const;
  /// The first text; empty where there is none.
  std::string text(std::string_view group, std::string_view name) const;
};

/// The texts of one parameter, without the blanks that fill them up.
std::vector<std::string> texts_of(const C3dParameter& parameter);

/// Reads the entries in [begin, end) of the file. What is damaged ends the list, with a diagnostic
/// `damaged_parameters`.
C3dParameters read_c3d_parameters(const C3dSource& source, std::size_t begin, std::size_t end);

}  // namespace kinemend
