// Writes takes as glTF, into their source file if there is one, else as a new file.
#include <utility>

#include "io/gltf/gltf.hpp"
#include "io/gltf/gltf_document.hpp"
#include "io/gltf/gltf_new.hpp"
#include "io/gltf/gltf_pack.hpp"

namespace kinemend {

namespace {

const GltfDocument* gltf_document_of(const Take& take) {
  return dynamic_cast<const GltfDocument*>(take.source.document.get());
}

// Converts a new binary file to text, with its chunk inline.
std::string text_of_glb(std::string bytes) {
  GltfDocument document;
  Diagnostics none;
  document.file = open_gltf(std::move(bytes), "new file", false, none);
  document.model = parse_gltf(document.file);
  return packed_gltf(document, {}, false, {}).bytes;
}

std::string new_glb_of(const Take& take) {
  return take.has_joints() ? new_glb_of_joints(take) : new_glb_of_markers(take);
}

std::string write_as_gltf(const Take& take, bool as_binary) {
  return gltf_files_of_take(take, as_binary, {}).bytes;
}

}  // namespace

TakeFiles gltf_files_of_take(const Take& take, bool as_binary,
                             const std::filesystem::path& output) {
  take.validate();
  if (const GltfDocument* const document = gltf_document_of(take)) {
    const GltfMotion motion = document->motion();
    if (belongs_to(take, *document, motion)) {
      const GltfChanges changes = changes_of_gltf(take, *document, motion);
      GltfFiles files = packed_gltf(*document, changes, as_binary, output);
      return {std::move(files.bytes), std::move(files.beside)};
    }
  }
  std::string bytes = new_glb_of(take);
  return {as_binary ? std::move(bytes) : text_of_glb(std::move(bytes)), {}};
}

std::vector<std::string> lost_beside_gltf(const Take& take) {
  const GltfDocument* const document = gltf_document_of(take);
  if (document == nullptr || belongs_to(take, *document, document->motion())) return {};
  std::vector<std::string> parts;
  if (document->model.meshes > 0) parts.emplace_back("meshes");
  if (!document->model.skins.empty()) parts.emplace_back("skins");
  if (document->model.animations.size() > 1) parts.emplace_back("other animations");
  parts.emplace_back("other nodes and properties");
  return parts;
}

std::string write_glb(const Take& clip) { return write_as_gltf(clip, true); }
std::string write_gltf(const Take& clip) { return write_as_gltf(clip, false); }
std::string write_glb_markers(const Take& clip) { return write_as_gltf(clip, true); }
std::string write_gltf_markers(const Take& clip) { return write_as_gltf(clip, false); }

}  // namespace kinemend
