// Keeps an FBX file as it was read so that changed curves can be written back into it, and makes
// the take of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/fbx/fbx_rig.hpp"
#include "io/fbx/fbx_scene.hpp"
#include "io/fbx/fbx_tree.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

struct FbxFrames {
  std::vector<std::int64_t> times;  ///< ticks, at least one, ascending
  double rate_hz = 30;
  double step_ticks = 0;
  std::size_t resampled = 0;  ///< curves without exactly one key per frame
};

/// Whether a curve has one key per frame.
bool is_baked(const FbxCurve& curve, const FbxFrames& frames);

/// Finds the frames of a take. `curves`: the joints' curves, by index in `motion`. Frames are the
/// keys if these lie on one grid, else the grid of the file's time mode from the first key to the
/// last. `most_frames`: a larger number is an error. Errors: `unreadable_input`.
FbxFrames find_fbx_frames(const FbxTree& tree, const FbxScene& scene, const FbxMotion& motion,
                          const std::vector<std::size_t>& curves, std::size_t most_frames);

/// A key whose value is not finite in the file, and was held from a neighbour.
struct FbxMendedKey {
  std::size_t curve = 0;
  std::size_t key = 0;
};

/// An FBX file as it was read: its records and the decoded scene.
struct FbxDocument : SourceDocument {
  FbxTree tree;
  FbxScene scene;
  FbxStack stack;
  FbxMotion motion;  ///< motion of `stack`; empty if the file has no animation
  FbxRig rig;
  FbxFrames frames;
  std::vector<FbxMendedKey> mended;

  std::vector<double> channel_values() const override;
};

/// Returns the document's take, without its source. The same document gives the same bits. The take
/// has markers if no model turns or has a child: see `holds_fbx_markers`.
Take take_of_fbx(const FbxDocument& document);
/// Returns the joints of the document as a take without frames.
Take skeleton_of_fbx(const FbxDocument& document);

/// Returns the curves that move the joints, each once, ascending.
std::vector<std::size_t> fbx_joint_curves(const FbxMotion& motion, const FbxRig& rig);

/// Whether some curve of the joints is not constant.
bool moves_joints(const FbxMotion& motion, const FbxRig& rig);

/// Whether the joints are points without rotation: nulls or markers with curves of translation
/// alone, none of them below another.
bool holds_fbx_markers(const FbxScene& scene, const FbxMotion& motion, const FbxRig& rig);

/// Throws `unreadable_input` naming the first model whose position overflows.
void check_fbx_take(const FbxDocument& document, const Take& take);

}  // namespace kinemend
