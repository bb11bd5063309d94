// Parses an ASF file into a skeleton, and recognises the format.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "io/acclaim/asf.hpp"
#include "io/bvh/bvh_hierarchy.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

struct Bone {
  std::string name;
  Vec3 direction{0, 0, 1};
  double length = 0;
  Vec3 axis_angles;
  std::array<Axis, 3> axis_order{Axis::x, Axis::y, Axis::z};
  std::vector<AsfDof> dofs;
  std::vector<double> limits;
  std::size_t place = 0;
  bool named = false;
};

struct Family {
  std::int32_t parent = -1;  // -1: no line of the hierarchy has named the bone
  std::vector<std::size_t> children;
};

std::optional<AsfDof> dof_of(std::string_view word) {
  for (std::size_t i = 0; i < asf_dof_names.size(); ++i) {
    if (equal_ignoring_case(word, asf_dof_names[i])) return static_cast<Channel>(i);
  }
  if (equal_ignoring_case(word, "l")) return AsfDof{};
  return std::nullopt;
}

// Index 0 is the root, the others are bones in the order of the file.
class AsfParser {
 public:
  AsfParser(const SourceText& text, Diagnostics& diagnostics, std::size_t max_depth)
      : text_(text),
        diagnostics_(diagnostics),
        max_depth_(max_depth),
        scanner_(text.bytes, byte_order_mark_size(text.bytes)) {
    Bone root;
    root.name = "root";
    bones_.push_back(std::move(root));
  }

  AsfSkeleton parse() {
    if (scanner_.peek().empty()) throw text_.error_at(std::size_t{0}, "the file is empty");
    while (!scanner_.peek().empty()) parse_section();
    if (!seen_root_) fail(":root");
    if (bones_[0].dofs.empty() && !seen_order_) assume_root_order();
    return build();
  }

 private:
  [[noreturn]] void fail(std::string_view expected) {
    const std::string_view found = scanner_.peek();
    throw text_.error_at(scanner_.position(),
                         fmt::format("expected {}, found {}", expected, quote(found)));
  }

  bool at_keyword() { return scanner_.peek().substr(0, 1) == ":"; }
  bool more_of_section() { return !at_keyword() && !scanner_.peek().empty(); }
  bool accept(std::string_view word) {
    if (!equal_ignoring_case(scanner_.peek(), word)) return false;
    scanner_.next();
    return true;
  }

  void parse_section() {
    if (!at_keyword()) fail("a keyword such as :root");
    if (accept(":units")) return parse_units();
    if (accept(":root")) return parse_root();
    if (accept(":bonedata")) return parse_bones();
    if (accept(":hierarchy")) return parse_hierarchy();
    // :version, :name, :documentation and :skin do not affect the pose.
    skip_section();
  }

  void skip_section() {
    do {
      scanner_.skip_line();
    } while (more_of_section());
  }

  double number() {
    const std::string_view word = scanner_.peek();
    NumberToken token;
    if (!word.empty()) token = read_number(word.data(), word.data() + word.size());
    if (token.kind != TokenKind::number || token.end != word.data() + word.size()) fail("a number");
    // Above this, sums and products along a chain could overflow. Chosen by hand, as in
    // `read_sample`.
    constexpr double largest = 1e100;
    if (std::fabs(token.value) > largest) fail("a number of a plausible size");
    scanner_.next();
    return token.value;
  }

  Vec3 vector() {
    const double x = number(), y = number();
    return {x, y, number()};
  }

  void parse_units() {
    while (more_of_section()) {
      if (accept("length")) {
        const std::size_t place = scanner_.position();
        length_unit_ = number();
        if (!(length_unit_ > 0)) throw text_.error_at(place, "the unit of length is not positive");
      } else if (accept("angle")) {
        radians_ = accept("rad") || accept("radians");
        if (!radians_ && !accept("deg") && !accept("degrees")) fail("deg or rad");
      } else {
        scanner_.skip_line();
      }
    }
  }

  void parse_root() {
    if (std::exchange(seen_root_, true)) {
      throw text_.error_at(scanner_.position(), "a second :root");
    }
    Bone& root = bones_[0];
    root.place = scanner_.position();
    while (more_of_section()) {
      if (accept("order")) {
        seen_order_ = true;
        root.dofs = parse_dofs();
      } else if (accept("axis")) {
        root.axis_order = axis_order();
      } else if (accept("position")) {
        root_position_ = vector();
      } else if (accept("orientation")) {
        root.axis_angles = vector();
      } else {
        skip_unknown();
      }
    }
  }

  void assume_root_order() {
    for (std::size_t i = 0; i < asf_dof_names.size(); ++i)
      bones_[0].dofs.emplace_back(static_cast<Channel>(i));
    note_repair(text_, diagnostics_, "root_order_missing", bones_[0].place,
                "no order of the root: TX TY TZ RX RY RZ assumed");
  }

  void skip_unknown() {
    note_repair(text_, diagnostics_, "unknown_keyword", scanner_.position(),
                fmt::format("{} is not a keyword of the format", quote(scanner_.peek())));
    scanner_.skip_line();
  }

  std::array<Axis, 3> axis_order() {
    const std::string_view word = scanner_.peek();
    std::array<Axis, 3> axes{};
    std::array<bool, 3> seen{};
    bool fits = word.size() == 3;
    for (std::size_t i = 0; fits && i < 3; ++i) {
      const int axis = (word[i] | 0x20) - 'x';
      fits = axis >= 0 && axis < 3 && !std::exchange(seen[static_cast<std::size_t>(axis)], true);
      if (fits) axes[i] = static_cast<Axis>(axis);
    }
    if (!fits) fail("an order of axes such as XYZ");
    scanner_.next();
    return axes;
  }

  std::vector<AsfDof> parse_dofs() {
    const std::size_t place = scanner_.position();
    std::vector<AsfDof> dofs;
    while (const auto dof = dof_of(scanner_.peek())) {
      if (std::find(dofs.begin(), dofs.end(), *dof) != dofs.end()) {
        throw text_.error_at(
            place, fmt::format("the degree of freedom {} occurs twice", quote(scanner_.peek())));
      }
      dofs.push_back(*dof);
      scanner_.next();
    }
    return dofs;
  }

  void parse_bones() {
    while (more_of_section()) {
      if (!accept("begin")) fail("begin");
      parse_bone();
      if (bones_.size() > most_joints) {
        throw text_.error_at(scanner_.position(), fmt::format("more than {} bones", most_joints));
      }
    }
  }

  void parse_bone() {
    Bone bone;
    bone.place = scanner_.position();
    while (!accept("end")) {
      if (!more_of_section()) fail("end");
      parse_bone_line(bone);
    }
    if (!bone.named) throw text_.error_at(bone.place, "a bone has no name");
    const bool is_new = index_of_.try_emplace(bone.name, bones_.size()).second;
    if (!is_new || bone.name == "root") {
      throw text_.error_at(bone.place, fmt::format("a second bone {}", quote(bone.name)));
    }
    bones_.push_back(std::move(bone));
  }

  void parse_bone_line(Bone& bone) {
    if (accept("id") || accept("bodymass") || accept("cofmass")) {
      scanner_.skip_line();
    } else if (accept("name")) {
      bone.name = scanner_.next();
      bone.named = !bone.name.empty();
    } else if (accept("direction")) {
      bone.direction = vector();
    } else if (accept("length")) {
      bone.length = number();
    } else if (accept("axis")) {
      bone.axis_angles = vector();
      bone.axis_order = axis_order();
    } else if (accept("dof")) {
      bone.dofs = parse_dofs();
    } else if (accept("limits")) {
      parse_limits(bone);
    } else {
      skip_unknown();
    }
  }

  // `inf` means no limit.
  void parse_limits(Bone& bone) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    bone.limits.clear();
    for (;;) {
      const std::string_view word = scanner_.peek();
      if (word.empty()) return;
      const NumberToken token = read_number(word.data(), word.data() + word.size());
      if (token.kind != TokenKind::number && token.kind != TokenKind::not_finite) return;
      const double open = bone.limits.size() % 2 == 0 ? -infinity : infinity;
      bone.limits.push_back(token.kind == TokenKind::number ? token.value : open);
      scanner_.next();
    }
  }

  void parse_hierarchy() {
    families_.resize(bones_.size());
    if (!accept("begin")) fail("begin");
    while (!accept("end")) {
      if (!more_of_section()) fail("end");
      const std::size_t parent = bone_index(scanner_.peek());
      scanner_.next();
      for (;;) {
        const std::string_view child = scanner_.next_in_line();
        if (child.empty()) break;
        add_child(parent, child);
      }
    }
  }

  std::size_t bone_index(std::string_view name) const {
    if (equal_ignoring_case(name, "root")) return 0;
    const auto found = index_of_.find(std::string(name));
    if (found == index_of_.end()) {
      throw text_.error_at(
          name.data(), fmt::format("the hierarchy names the bone {}, which :bonedata does not have",
                                   quote(name)));
    }
    return found->second;
  }

  void add_child(std::size_t parent, std::string_view name) {
    const std::size_t child = bone_index(name);
    families_.resize(bones_.size());
    if (child == 0 || families_[child].parent >= 0) {
      throw text_.error_at(name.data(),
                           fmt::format("the bone {} has two parents", quote(bones_[child].name)));
    }
    families_[child].parent = static_cast<std::int32_t>(parent);
    families_[parent].children.push_back(child);
  }

  double degrees(double angle) const { return radians_ ? angle * degrees_per_radian : angle; }

  // Returns C of a bone: rotations about fixed axes, in the order of the letters.
  Quat axis_rotation(const Bone& bone) const {
    const std::array<double, 3> by_axis{bone.axis_angles.x, bone.axis_angles.y, bone.axis_angles.z};
    RotationOrder order;
    order.count = 3;
    std::array<double, 3> angles{};
    for (std::size_t i = 0; i < 3; ++i) {
      order.axes[i] = bone.axis_order[2 - i];
      angles[i] = degrees(by_axis[static_cast<std::size_t>(order.axes[i])]) * radians_per_degree;
    }
    return normalized(from_euler(angles, order));
  }

  // Returns the vector from a bone's beginning to its end, in its own frame.
  Vec3 extent(const Bone& bone, Quat axis) {
    const double size = norm(bone.direction);
    if (bone.length != 0 && size == 0) {
      note_repair(
          text_, diagnostics_, "direction_zero", bone.place,
          fmt::format("the bone {} has no direction: its length is taken as 0", quote(bone.name)));
    }
    if (size == 0) return {};
    return rotate(conjugate(axis), (bone.length / size) * bone.direction);
  }

  std::vector<ChannelLimit> limits_of(const Bone& bone) {
    if (bone.limits.empty()) return {};
    if (bone.limits.size() != 2 * bone.dofs.size()) {
      note_repair(text_, diagnostics_, "limits_mismatch", bone.place,
                  fmt::format("the bone {} has {} degrees of freedom and {} limits: limits ignored",
                              quote(bone.name), bone.dofs.size(), bone.limits.size()));
      return {};
    }
    const auto slots = channel_slots(bone.dofs);
    std::vector<ChannelLimit> limits(channels_of(bone.dofs).size());
    for (std::size_t i = 0; i < slots.size(); ++i) {
      if (!slots[i]) continue;
      const bool turns = is_rotation(*bone.dofs[i]);
      const double low = bone.limits[2 * i], high = bone.limits[2 * i + 1];
      limits[*slots[i]] = {turns ? degrees(low) : low, turns ? degrees(high) : high};
    }
    return limits;
  }

  struct Open {
    std::size_t bone;
    std::int32_t joint;
    Quat axis;    // C of the bone, which its children's frames are relative to
    Vec3 extent;  // to its end, in its frame
    std::size_t next_child = 0;
  };

  AsfSkeleton build() {
    families_.resize(bones_.size());
    joined_.resize(bones_.size());
    // The position and orientation of the root move and rotate the whole skeleton; its frame at
    // rest is the world's.
    std::vector<Open> open{{0, add_joint(0, -1, root_position_, axis_rotation(bones_[0])), {}, {}}};
    while (!open.empty()) {
      Open& top = open.back();
      const auto& children = families_[top.bone].children;
      if (top.next_child == children.size()) {
        if (children.empty() && top.bone != 0) {
          result_.skeleton.end_sites.push_back({top.joint, top.extent, ""});
        }
        open.pop_back();
        continue;
      }
      const std::size_t child = children[top.next_child++];
      if (open.size() >= max_depth_) {
        throw text_.error_at(bones_[child].place,
                             fmt::format("bones nested deeper than {}", max_depth_));
      }
      const Quat axis = axis_rotation(bones_[child]);
      const std::int32_t joint =
          add_joint(child, top.joint, top.extent, normalized(conjugate(top.axis) * axis));
      open.push_back({child, joint, axis, extent(bones_[child], axis)});
    }
    check_all_joined();
    finish_limits();
    result_.radians = radians_;
    if (length_unit_ > 0 && length_unit_ != 1) result_.metres_per_unit = 0.0254 / length_unit_;
    return std::move(result_);
  }

  std::int32_t add_joint(std::size_t bone, std::int32_t parent, Vec3 offset, Quat rest) {
    const Bone& source = bones_[bone];
    joined_[bone] = 1;
    const std::int32_t joint =
        result_.skeleton.add_joint(source.name, parent, offset, channels_of(source.dofs));
    result_.skeleton.rest_rotations.back() = rest;
    result_.skeleton.limits.push_back(limits_of(source));
    result_.dofs.push_back(source.dofs);
    return joint;
  }

  void check_all_joined() const {
    for (std::size_t i = 0; i < bones_.size(); ++i) {
      if (joined_[i] != 0) continue;
      throw text_.error_at(bones_[i].place,
                           fmt::format("the hierarchy does not join the bone {} to the root",
                                       quote(bones_[i].name)));
    }
  }

  void finish_limits() {
    auto& limits = result_.skeleton.limits;
    const bool any = std::any_of(limits.begin(), limits.end(),
                                 [](const auto& of_joint) { return !of_joint.empty(); });
    if (!any) limits.clear();
  }

  const SourceText& text_;
  Diagnostics& diagnostics_;
  std::size_t max_depth_;
  AsfScanner scanner_;
  double length_unit_ = 0;
  bool radians_ = false;
  bool seen_root_ = false;
  bool seen_order_ = false;
  Vec3 root_position_;
  std::vector<Bone> bones_;
  std::vector<Family> families_;
  std::vector<std::uint8_t> joined_;
  std::unordered_map<std::string, std::size_t> index_of_;
  AsfSkeleton result_;
};

}  // namespace

AsfSkeleton parse_asf(const SourceText& text, Diagnostics& diagnostics, std::size_t max_depth) {
  return AsfParser(text, diagnostics, max_depth).parse();
}

int sniff_asf(std::string_view head) {
  head = without_byte_order_mark(head);
  AsfScanner scanner(head);
  const std::string_view word = scanner.next();
  constexpr std::array<std::string_view, 8> keywords{
      ":version", ":name", ":units", ":documentation", ":root", ":bonedata", ":hierarchy", ":skin"};
  const auto same = [&](std::string_view keyword) { return equal_ignoring_case(word, keyword); };
  return std::any_of(keywords.begin(), keywords.end(), same) ? 100 : 0;
}

}  // namespace kinemend
