// Walks over the named properties of an FBX object.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "io/fbx/fbx_tree.hpp"
#include "io/fbx/fbx_values.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

/// One line of Properties70 (`P`) or Properties60 (`Property`): a name, keywords, then values.
struct FbxNamedProperty {
  const FbxTree& tree;
  const FbxRecord& record;
  std::string_view name;
  std::size_t first_value;  ///< index of the first value

  const FbxProperty* value(std::size_t index) const {
    return tree.property(record, first_value + index);
  }
  std::optional<double> number(std::size_t index = 0) const {
    const FbxProperty* const found = value(index);
    return found == nullptr ? std::nullopt : fbx_number(tree, *found);
  }
  std::optional<std::int64_t> integer() const {
    const FbxProperty* const found = value(0);
    return found == nullptr ? std::nullopt : fbx_integer(tree, *found);
  }
  std::string_view text() const {
    const FbxProperty* const found = value(0);
    return found == nullptr ? std::string_view{} : fbx_text(tree, *found);
  }
  /// Returns three numbers; `otherwise` if they are not finite.
  Vec3 vector(Vec3 otherwise) const;
};

/// Calls `take(property)` for each property of an object (or of a template) in the file's order.
template <class Take>
void for_each_fbx_property(const FbxTree& tree, std::uint32_t object, Take&& take) {
  for (const std::string_view list : {"Properties70", "Properties60"}) {
    const std::uint32_t properties = tree.child(object, list);
    if (properties == no_fbx_record) continue;
    const std::size_t first_value = list == "Properties70" ? 4 : 3;
    for (std::uint32_t child = tree.records[properties].first_child; child != no_fbx_record;
         child = tree.records[child].next_sibling) {
      const FbxRecord& record = tree.records[child];
      const FbxProperty* const name = tree.property(record, 0);
      if (name != nullptr) take(FbxNamedProperty{tree, record, fbx_text(tree, *name), first_value});
    }
  }
}

}  // namespace kinemend
