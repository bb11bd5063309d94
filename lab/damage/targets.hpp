// The joints or tracks that a damage may touch, alone or in groups, and access to their samples.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/options.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/take.hpp"

namespace kinemend::corrupt {

/// The height of a person if a take has no unit. A round number, chosen by hand.
inline constexpr double usual_height_cm = 170;

/// The joints that a damage may touch. Every damage has these options.
struct TargetOptions {
  TargetOptions() {}   // g++ 12 reports an implicit one as a use of uninitialised memory
  std::string joints;  ///< names or shell patterns (`Left*`), separated by commas; empty: all
  bool root = true;    ///< also roots
};

template <class Options>
OptionTable<Options>& add_target_options(OptionTable<Options>& table) {
  return table
      .choice(&Options::joints, "joints", {},
              "joints to damage: names or patterns (Left*), separated by commas; empty: all")
      .flag(&Options::root, "root", "damage the root too");
}

/// Returns the joints that can be damaged, ascending: the selected ones that have rotation channels
/// (or all, if no joint of the skeleton has any, as in a clip made in memory). Throws
/// `ErrorKind::usage` for a pattern that no joint matches.
std::vector<std::size_t> target_joints(const Skeleton& skeleton, const TargetOptions& options);

std::vector<std::size_t> target_tracks(const Take& clip, const TargetOptions& options);
std::vector<std::size_t> target_tracks(const VectorMotion& motion, const TargetOptions& options);

inline std::size_t frame_count(const Take& clip) { return clip.frame_count(); }
inline std::size_t frame_count(const VectorMotion& motion) { return motion.values.frames; }

/// Returns the limb of each joint, as consecutive numbers: roots alone, then the chains between
/// branchings. Only the first two branchings of a path divide it (hips and chest, not fingers), and
/// a chain of fewer than three joints is joined to its parent's.
std::vector<std::size_t> limbs(const Skeleton& skeleton);

/// A unit of damage: rotation channel `channel` of one joint, or (-1) whole joints.
struct Unit {
  std::vector<std::size_t> joints;
  int channel = -1;
};

inline const std::vector<std::string> scopes{"channel", "joint", "limb", "all"};
std::vector<Unit> units(const Skeleton& skeleton, const TargetOptions& options,
                        std::string_view scope);
std::vector<Unit> units(const Take& clip, const TargetOptions& options, std::string_view scope);
std::vector<Unit> units(const VectorMotion& motion, const TargetOptions& options,
                        std::string_view scope);

/// Sets the rotation of a sample to the nearest one that the joint's channels can express.
void set_rotation(Take& clip, std::size_t frame, std::size_t joint, Quat rotation);

/// Sets q to q Exp(n), or p to p + n as an arc; missing vectors are not changed.
void turn(Take& clip, std::size_t frame, std::size_t joint, Vec3 n);
void turn(VectorMotion& motion, std::size_t frame, std::size_t track, Vec3 n);

/// A sample of vectors.
Vec3 vector_at(const VectorMotion& motion, std::size_t frame, std::size_t track);
void set_vector(VectorMotion& motion, std::size_t frame, std::size_t track, Vec3 value);
bool is_observed(const VectorMotion& motion, std::size_t frame, std::size_t track);
/// Returns the mean of the positions seen in a frame; zero if there are none.
Vec3 mean_position(const VectorMotion& motion, std::size_t frame);

/// Returns the Euler angles (radians) of a joint over the whole clip, continued from frame to
/// frame.
std::vector<std::array<double, 3>> euler_track(const Take& clip, std::size_t joint);

}  // namespace kinemend::corrupt
