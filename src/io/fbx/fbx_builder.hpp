// Builds a binary FBX file of version 7.5 from records.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/rotation.hpp"

namespace kinemend {

/// A binary FBX file under construction. Records nest: `open` begins one with its properties,
/// which come before its children, and `close` ends it.
class FbxBuilder {
 public:
  FbxBuilder();

  FbxBuilder& open(std::string_view name);
  void close();

  FbxBuilder& integer(std::int32_t value);
  FbxBuilder& id(std::int64_t value);
  FbxBuilder& number(double value);
  FbxBuilder& string(std::string_view value);
  FbxBuilder& raw(std::string_view value);
  FbxBuilder& array(std::span<const std::int64_t> values);
  FbxBuilder& array(std::span<const std::int32_t> values);
  FbxBuilder& array(std::span<const float> values);

  /// Adds a record with one value.
  void add(std::string_view name, std::int32_t value);
  void add(std::string_view name, std::string_view value);

  /// Adds a line of Properties70: name, type, label and flags, then values.
  FbxBuilder& property(std::string_view name, std::string_view type, std::string_view label,
                       std::string_view flags);
  void set_integer(std::string_view name, std::string_view type, std::int32_t value);
  void set_number(std::string_view name, std::string_view type, std::string_view label,
                  std::string_view flags, double value);
  void set_time(std::string_view name, std::int64_t ticks);
  void set_vector(std::string_view name, std::string_view type, std::string_view label,
                  std::string_view flags, Vec3 value);

  /// Returns the file's bytes.
  std::string finish() &&;

 private:
  struct Level {
    std::size_t begin = 0;
    std::size_t properties_begin = 0;
    std::uint64_t properties = 0;
    bool has_children = false;
  };

  void end_properties();
  void put(char type, std::string_view bytes);
  template <class Word>
  void append(Word word);
  void put_array(char type, std::size_t count, const std::string& content);

  std::string bytes_;
  std::vector<Level> open_;
};

}  // namespace kinemend
