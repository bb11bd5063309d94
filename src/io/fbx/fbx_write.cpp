// Writes FBX into the source file of the take, or as a new file.
#include "io/fbx/fbx.hpp"

#include <string>
#include <vector>

#include "io/fbx/fbx_document.hpp"
#include "io/fbx/fbx_new_file.hpp"
#include "io/fbx/fbx_rewrite.hpp"

namespace kinemend {

namespace {

std::string write_fbx_take(const Take& take) {
  const auto* const document = dynamic_cast<const FbxDocument*>(take.source.document.get());
  if (document == nullptr) return new_fbx_file(take);
  const Take original = take_of_fbx(*document);
  if (!fits_fbx_document(take, *document, original)) return new_fbx_file(take);
  return rewrite_fbx(take, *document, original);
}

}  // namespace

std::vector<std::string> lost_beside_fbx(const Take& take) {
  const auto* const document = dynamic_cast<const FbxDocument*>(take.source.document.get());
  if (document == nullptr) return {};
  const bool joints =
      take.has_joints() && !holds_fbx_markers(document->scene, document->motion, document->rig);
  const Take original = joints ? skeleton_of_fbx(*document) : take_of_fbx(*document);
  if (fits_fbx_document(take, *document, original)) return {};
  std::vector<std::string> parts;
  if (document->scene.models.size() > document->rig.joints.size())
    parts.emplace_back("meshes and other models");
  if (document->scene.stacks.size() > 1) parts.emplace_back("other takes");
  parts.emplace_back("materials and properties");
  return parts;
}

std::string write_fbx(const Take& clip) { return write_fbx_take(clip); }

std::string write_fbx_markers(const Take& clip) { return write_fbx_take(clip); }

}  // namespace kinemend
