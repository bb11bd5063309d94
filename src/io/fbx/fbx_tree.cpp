// Detects the form of an FBX file, and walks over its records.
#include "io/fbx/fbx_tree.hpp"

#include <utility>

#include "io/fbx/fbx_values.hpp"
#include "io/text/text.hpp"

namespace kinemend {

namespace {

constexpr std::string_view binary_magic{"Kaydara FBX Binary  \0", 21};

// Returns the version of a text whose first line does not state it.
std::uint32_t stated_version(const FbxTree& tree) {
  const std::uint32_t header = tree.child(no_fbx_record, "FBXHeaderExtension");
  if (header == no_fbx_record) return 0;
  const std::int64_t version = fbx_child_integer(tree, header, "FBXVersion", 0);
  return version > 0 && version < 100000 ? static_cast<std::uint32_t>(version) : 0;
}

}  // namespace

bool is_binary_fbx(std::string_view bytes) { return bytes.substr(0, 21) == binary_magic; }

std::uint32_t FbxTree::child(std::uint32_t parent, std::string_view child_name) const {
  std::uint32_t record = first_child_of(parent);
  while (record != no_fbx_record && name_of(records[record]) != child_name)
    record = records[record].next_sibling;
  return record;
}

Error FbxTree::error_at(std::size_t place, std::string_view message) const {
  return is_text ? Error::at_line(name, line_at(bytes, place), message)
                 : Error::at_byte(name, place, message);
}

FbxTree read_fbx_tree(std::string bytes, std::string_view name, std::size_t max_depth) {
  FbxTree tree;
  tree.name = std::string(name);
  tree.bytes = std::move(bytes);
  tree.is_text = !is_binary_fbx(tree.bytes);
  if (tree.is_text) {
    read_text_fbx_records(tree, max_depth);
    if (tree.version == 0) tree.version = stated_version(tree);
  } else {
    read_binary_fbx_records(tree, max_depth);
  }
  return tree;
}

void FbxRecordBuilder::open(const FbxRecord& record) {
  const auto index = static_cast<std::uint32_t>(tree_.records.size());
  std::uint32_t& last = open_.empty() ? last_root_ : open_.back().last_child;
  if (last != no_fbx_record) {
    tree_.records[last].next_sibling = index;
  } else if (open_.empty()) {
    tree_.first_root = index;
  } else {
    tree_.records[open_.back().record].first_child = index;
  }
  last = index;
  tree_.records.push_back(record);
  if (!open_.empty()) tree_.records.back().parent = open_.back().record;
  open_.push_back({index});
}

}  // namespace kinemend
