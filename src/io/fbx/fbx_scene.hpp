// Describes the models of an FBX file, their place in the tree and their animation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "io/fbx/fbx_curve.hpp"
#include "io/fbx/fbx_tree.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend {

/// The three animated vectors of a model: Lcl Translation, Lcl Rotation (degrees), Lcl Scaling.
enum FbxVector : std::size_t { fbx_translation, fbx_rotation, fbx_scaling };

/// A node of the scene with its transform at rest; angles in degrees.
struct FbxModel {
  std::string name;
  std::string_view kind;  ///< "LimbNode", "Null", "Root", "Mesh"
  std::uint32_t record = 0;
  std::int32_t parent = -1;
  std::array<Vec3, 3> local{Vec3{}, Vec3{}, Vec3{1, 1, 1}};  ///< by `FbxVector`
  Vec3 pre_rotation, post_rotation;
  Vec3 rotation_offset, rotation_pivot, scaling_offset, scaling_pivot;
  std::int64_t rotation_order = 0;  ///< 0 XYZ, 1 XZY, 2 YZX, 3 YXZ, 4 ZXY, 5 ZYX, 6 spheric
  bool rotation_active = false;     ///< if false, order and pre- and post-rotation are ignored
  std::int64_t inherit_type = 0;    ///< 0 RrSs, 1 RSrs, 2 Rrs
};

/// How one layer animates a vector of a model: a curve per axis (index in `FbxMotion::curves`, or
/// -1), else a constant.
struct FbxAnimatedVector {
  std::array<std::int32_t, 3> curves{-1, -1, -1};
  Vec3 constant;
};

struct FbxLayer {
  double weight = 1;                       ///< 0 to 1
  bool is_override = false;                ///< if false, it is added to the layers before
  bool adds_rotations_by_channel = false;  ///< if false, rotations are composed
  bool is_muted = false;
  /// The key is 3 * model + `FbxVector`.
  std::unordered_map<std::size_t, FbxAnimatedVector> vectors;
};

/// The animation of one take, with its curves.
struct FbxMotion {
  std::vector<FbxLayer> layers;
  std::vector<FbxCurve> curves;
};

/// An animation stack (version 7), or a take (6).
struct FbxStack {
  std::string name;
  std::int64_t id = 0;
  std::uint32_t record = 0;
};

struct FbxConnection {
  std::int64_t from = 0;  ///< child, or the source of the animation
  std::int64_t to = 0;    ///< parent, or the animated object
  std::string_view property;
};

struct FbxScene {
  std::vector<FbxModel> models;
  std::unordered_map<std::int64_t, std::int32_t> model_of_id;
  std::vector<FbxStack> stacks;
  std::string active_stack;  ///< name of the active stack; may be empty or unknown
  std::vector<FbxConnection> connections;
  std::unordered_map<std::int64_t, std::uint32_t> record_of_id;
  double ticks_per_second = 46186158000.0;  ///< FBX SDK, FbxTime
  double frame_rate_hz = 30;                ///< rate of the file's time mode
  double unit_cm = 1;                       ///< UnitScaleFactor
  std::int64_t up_axis = 1;                 ///< 0 x, 1 y, 2 z
};

/// Reads models, connections, settings and the list of takes. Errors: `unreadable_input` for
/// versions before 6, and for files without objects.
FbxScene read_fbx_scene(const FbxTree& tree);

/// Returns the curves of one take that animate translation, rotation or scaling of a model.
FbxMotion read_fbx_motion(const FbxTree& tree, const FbxScene& scene, const FbxStack& stack);

/// Returns the id of an object in a file of version 6, which has only names.
std::int64_t fbx_id_of_name(std::string_view name);

}  // namespace kinemend
