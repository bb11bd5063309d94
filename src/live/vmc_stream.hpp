// Filters live the bones that VMC may name, which become known one by one: for a new bone the
// filter restarts unnoticeably with the last frames.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "feet/live_feet.hpp"
#include "kinemend/live.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Bones are numbered from 0: the root, those of Unity's humanoid, then added ones.
class VmcBones {
 public:
  static constexpr std::size_t root = 0, hips = 1;

  explicit VmcBones(const std::vector<std::string>& more);

  std::size_t count() const { return names_.size(); }
  const std::string& name(std::size_t bone) const { return names_[bone]; }
  /// Returns -1 if no bone has that name. Matching ignores case.
  std::int32_t find(std::string_view name) const;

  /// Returns a take without frames, of the root and of the bones that `present` marks, in the order
  /// of their numbers. Each bone's parent is its nearest present ancestor. `offsets`: for each
  /// bone.
  Take take_of(const std::vector<std::uint8_t>& present, const std::vector<Vec3>& offsets,
               double frame_rate_hz) const;

 private:
  std::vector<std::string> names_;
  std::vector<std::string> keys_;  ///< in lower case
  std::vector<std::int32_t> parents_;
};

/// Poses of all bones of the table at one time.
struct VmcFrame {
  std::vector<Quat> rotations;         ///< for each bone; a missing one repeats its last rotation
  std::array<Vec3, 2> positions{};     ///< root and hips
  std::vector<std::uint8_t> measured;  ///< for each bone: 0 if the rotation must be bridged
};

class VmcStream {
 public:
  /// Takes the number of a frame, counted from 0, and the received frame; the stream then holds its
  /// cleaned poses.
  using Give = std::function<void(std::size_t number, const VmcFrame& frame)>;

  /// `cleaner` and `bones` must outlive the stream. Throws as `make_stream` does.
  VmcStream(const Cleaner& cleaner, const VmcBones& bones, double frame_rate_hz, bool feet,
            Source source, Give give);

  std::size_t latency_frames() const { return latency_; }
  bool has(std::size_t bone) const { return present_[bone] != 0; }
  /// Adds a new bone with its first rotation and its position relative to its parent.
  void add(std::size_t bone, Quat rotation, Vec3 offset);
  void push(VmcFrame frame);

  /// Returns the cleaned rotation in the current frame.
  Quat rotation(std::size_t bone) const { return out_.rotations[joints_[bone]]; }
  Vec3 position(std::size_t bone) const { return out_.positions[bone]; }  ///< root or hips
  /// Returns the first position of a present bone.
  Vec3 offset(std::size_t bone) const { return offsets_[bone]; }

 private:
  void begin_anew();
  void pass(const VmcFrame& frame);

  const Cleaner& cleaner_;
  const VmcBones& bones_;
  double frame_rate_hz_;
  Source source_;
  Give give_;
  std::vector<std::uint8_t> present_;
  std::vector<Vec3> offsets_;
  std::vector<std::size_t> joints_;  ///< for each present bone
  std::vector<std::size_t> order_;   ///< the bone of each joint
  std::size_t latency_ = 0;
  std::size_t kept_frames_ = 0;
  bool is_outdated_ = false;  ///< a bone is not in the stream yet
  std::unique_ptr<Stream> stream_;
  bool holds_feet_ = false;
  std::optional<feet::LiveFeet> feet_;
  std::deque<VmcFrame> history_;
  std::size_t pushed_ = 0;  ///< frames
  std::size_t given_ = 0;   ///< frames
  std::size_t made_ = 0;    ///< number of the frame that the stream gives next
  Frame in_, out_;
};

}  // namespace kinemend
