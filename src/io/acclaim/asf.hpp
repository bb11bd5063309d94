// The format ASF: recognises, reads and writes skeletons, splits the text into words, and plans the
// bones that a new file needs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/number.hpp"
#include "io/text/text.hpp"
#include "kinemend/io.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// A degree of freedom as ASF names it: `tx` to `rz`, or empty for `l`, the stretch of a bone,
/// which has a column but no effect on the pose.
using AsfDof = std::optional<Channel>;
/// The names but `l`, in the order of `Channel`.
inline constexpr std::array<std::string_view, 6> asf_dof_names{"tx", "ty", "tz", "rx", "ry", "rz"};

/// A skeleton as an ASF file states it, joints depth first: joint 0 is `root`, every other joint is
/// at the beginning of its bone and has the bone's name; the end of a bone without children is an
/// end site.
struct AsfSkeleton {
  Skeleton skeleton;
  std::vector<std::vector<AsfDof>> dofs;  ///< J, in the order of the AMC columns
  double metres_per_unit = 0;             ///< 0.0254 / `length`; 0 if `length` is missing or 1
  bool radians = false;
};

/// Returns the channels of a joint. ASF rotates about fixed axes in the order of their names, and a
/// `Skeleton` writes the product from left to right, so the rotations are reversed: `rx ry rz` is R
/// = Rz Ry Rx.
std::vector<Channel> channels_of(const std::vector<AsfDof>& dofs);
/// Returns for each degree of freedom its index in `channels_of(dofs)`; empty for `l`.
std::vector<std::optional<std::size_t>> channel_slots(const std::vector<AsfDof>& dofs);

/// Parses an ASF file. Errors: `unreadable_input` with the line.
AsfSkeleton parse_asf(const SourceText& text, Diagnostics& diagnostics, std::size_t max_depth);

/// Returns how likely the head of a file is ASF, 0 to 100.
int sniff_asf(std::string_view head);
/// Reads a skeleton alone as a clip of zero frames. Errors: `unreadable_input` with the line.
TakeResult read_asf(std::string bytes, std::string_view name, const ReadOptions& options);
/// Writes the skeleton of a clip: the bytes it was read from if it is unchanged, else a file that
/// fits the output of `write_amc`. Errors: `usage` if the format cannot hold the skeleton.
std::string write_asf(const Take& clip);

/// A bone for a joint, or a connecting bone from a joint to a child that is not at its end.
struct PlannedBone {
  std::string name;
  std::int32_t parent = -1;  ///< index of a bone; -1 for the root
  std::int32_t joint = -1;   ///< -1 for a connecting bone
  Quat axis;                 ///< its frame at rest, in the world
  Vec3 extent;               ///< from its beginning to its end, at rest, in the world
  std::vector<AsfDof> dofs;
};

/// Returns the bones of a skeleton for ASF, in which a child begins at its parent's end. Bone 0 is
/// the root, and parents precede their children. A joint becomes a bone of its name that ends where
/// all its children are. If the children are apart, the bone has no length, and a bone without
/// degrees of freedom leads to each child. Names that the format cannot hold are changed and stay
/// different from each other. Errors: `usage` if the format cannot hold the skeleton.
std::vector<PlannedBone> plan_bones(const Skeleton& skeleton);

/// Adds the missing position channels of the root at the front, because ASF gives the root all
/// three.
Skeleton with_root_positions(Skeleton skeleton);

/// Walks over the words of an ASF file: white space, commas and parentheses separate them, and #
/// starts a comment.
class AsfScanner {
 public:
  explicit AsfScanner(std::string_view bytes, std::size_t position = 0)
      : bytes_(bytes), position_(position) {}

  /// Returns the next word, empty at the end, without moving past it.
  std::string_view peek() {
    while (position_ < bytes_.size()) {
      const char c = bytes_[position_];
      if (c == '#') {
        skip_line();
      } else if (is_blank(c)) {
        ++position_;
      } else {
        break;
      }
    }
    std::size_t end = position_;
    while (end < bytes_.size() && !is_blank(bytes_[end]) && bytes_[end] != '#') ++end;
    return bytes_.substr(position_, end - position_);
  }
  /// Returns the next word and moves past it.
  std::string_view next() {
    const std::string_view word = peek();
    position_ += word.size();
    return word;
  }
  /// Returns the next word of this line, or empty, and moves past it.
  std::string_view next_in_line() {
    while (position_ < bytes_.size() && is_blank(bytes_[position_]) &&
           !is_line_end(bytes_[position_])) {
      ++position_;
    }
    const bool more =
        position_ < bytes_.size() && !is_line_end(bytes_[position_]) && bytes_[position_] != '#';
    return more ? next() : std::string_view{};
  }
  void skip_line() {
    while (position_ < bytes_.size() && !is_line_end(bytes_[position_])) ++position_;
  }

  /// Returns the place of the next word, after a call of `peek`.
  std::size_t position() const { return position_; }

 private:
  static bool is_blank(char c) { return is_space(c) || c == ',' || c == '(' || c == ')'; }

  std::string_view bytes_;
  std::size_t position_;
};

}  // namespace kinemend
