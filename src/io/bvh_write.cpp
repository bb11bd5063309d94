#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/bvh.hpp"
#include "io/bvh_document.hpp"
#include "io/bvh_hierarchy.hpp"
#include "io/bvh_text.hpp"
#include "io/motion_columns.hpp"
#include "io/text.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

std::string frame_time_text(double frame_rate_hz) {
  const double frame_time_s = 1 / frame_rate_hz;
  std::array<char, fixed_number_room> text;
  for (unsigned decimals = 6; decimals <= 9; ++decimals) {
    const std::string_view written(
        text.data(),
        static_cast<std::size_t>(write_fixed(text.data(), frame_time_s, decimals) - text.data()));
    const NumberToken number = read_number(written.data(), written.data() + written.size());
    if (number.value > 0 && rate_from_frame_time(number.value, written) == frame_rate_hz)
      return std::string(written);
  }
  return {text.data(), write_shortest(text.data(), frame_time_s)};
}

namespace {

Vec3 position_of(const Clip& clip, std::size_t frame, std::size_t joint) {
  if (joint == 0) return clip.root_positions[frame];
  const auto& translated = clip.translated_joints;
  const auto found =
      std::lower_bound(translated.begin(), translated.end(), static_cast<std::int32_t>(joint));
  if (found == translated.end() || *found != static_cast<std::int32_t>(joint))
    return clip.skeleton.offsets[joint];
  return clip.joint_translations[frame * translated.size() +
                                 static_cast<std::size_t>(found - translated.begin())];
}

double component(Vec3 v, Axis axis) { return axis == Axis::x ? v.x : axis == Axis::y ? v.y : v.z; }

bool same_end_sites(const std::vector<EndSite>& a, const std::vector<EndSite>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const EndSite& x, const EndSite& y) {
    return x.parent == y.parent && x.offset == y.offset && x.name == y.name;
  });
}

bool same_skeleton(const Skeleton& a, const Skeleton& b) {
  return a.names == b.names && a.parents == b.parents && a.offsets == b.offsets &&
         a.rest_rotations == b.rest_rotations && a.channels == b.channels &&
         same_end_sites(a.end_sites, b.end_sites);
}

void check_lengths(const Clip& clip) {
  clip.skeleton.validate();
  const std::size_t frames = clip.frame_count();
  if (clip.local_rotations.size() != frames * clip.joint_count() ||
      clip.joint_translations.size() != frames * clip.translated_joints.size()) {
    throw Error(ErrorKind::usage, "the clip's arrays do not have its number of frames");
  }
  if (!(std::isfinite(clip.frame_rate_hz) && clip.frame_rate_hz > 0)) {
    throw Error(ErrorKind::usage, "the clip's frame rate is not positive");
  }
}

// A motion that no channel can hold is not dropped in silence.
void check_channels(const Clip& clip) {
  constexpr double tolerance_rad = 1e-6;
  const Skeleton& skeleton = clip.skeleton;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const bool turns = skeleton.rotation_order(j).count > 0;
    const bool moves = skeleton.has_position_channels(j);
    for (std::size_t f = 0; f < clip.frame_count() && !(turns && moves); ++f) {
      const Quat rotation = skeleton.rest_rotations[j] * clip.rotation(f, j);
      if (!turns && angle_between(rotation, Quat{}) > tolerance_rad) {
        throw Error(ErrorKind::usage, fmt::format("joint {} turns but has no rotation channels",
                                                  quote(skeleton.names[j])));
      }
      if (!moves && !(position_of(clip, f, j) == skeleton.offsets[j])) {
        throw Error(ErrorKind::usage, fmt::format("joint {} moves but has no position channels",
                                                  quote(skeleton.names[j])));
      }
    }
  }
}

// The hierarchy as text, children after their parent at once; and the order of joints that this
// gives.
class HierarchyWriter {
 public:
  HierarchyWriter(const Skeleton& skeleton, TextBuffer& out) : skeleton_(skeleton), out_(out) {
    children_.resize(skeleton.joint_count());
    sites_.resize(skeleton.joint_count());
    for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
      if (skeleton.parents[j] >= 0)
        children_[static_cast<std::size_t>(skeleton.parents[j])].push_back(j);
    }
    for (const EndSite& site : skeleton.end_sites)
      sites_[static_cast<std::size_t>(site.parent)].push_back(&site);
  }

  std::vector<std::size_t> write() {
    out_.append("HIERARCHY\n");
    for (std::size_t j = 0; j < skeleton_.joint_count(); ++j) {
      if (skeleton_.parents[j] < 0) write_tree(j);
    }
    return std::move(order_);
  }

 private:
  struct Open {
    std::size_t joint;
    std::size_t next_child = 0;
  };

  void write_tree(std::size_t root) {
    std::vector<Open> open{{root}};
    begin_joint(root, 0);
    while (!open.empty()) {
      Open& top = open.back();
      if (top.next_child < children_[top.joint].size()) {
        const std::size_t child = children_[top.joint][top.next_child++];
        begin_joint(child, open.size());
        open.push_back({child});
      } else {
        end_joint(top.joint, open.size() - 1);
        open.pop_back();
      }
    }
  }

  void line(std::size_t depth, std::string_view text) {
    for (std::size_t i = 0; i < depth; ++i) out_.append("\t");
    out_.append(text);
    out_.append("\n");
  }

  static void check_name(const std::string& name) {
    if (name.find_first_of("{}\r\n") != name.npos) {
      throw Error(ErrorKind::usage, fmt::format("BVH cannot hold the name {}", quote(name)));
    }
  }

  void offset_line(std::size_t depth, Vec3 offset) {
    for (std::size_t i = 0; i < depth; ++i) out_.append("\t");
    out_.append("OFFSET");
    for (const double value : {offset.x, offset.y, offset.z}) {
      out_.append(" ");
      out_.append_shortest(value);
    }
    out_.append("\n");
  }

  void begin_joint(std::size_t joint, std::size_t depth) {
    constexpr std::array<std::string_view, 6> channel_names{"Xposition", "Yposition", "Zposition",
                                                            "Xrotation", "Yrotation", "Zrotation"};
    order_.push_back(joint);
    check_name(skeleton_.names[joint]);
    line(depth, fmt::format("{} {}", depth == 0 ? "ROOT" : "JOINT", skeleton_.names[joint]));
    line(depth, "{");
    offset_line(depth + 1, skeleton_.offsets[joint]);
    std::string channels = fmt::format("CHANNELS {}", skeleton_.channels[joint].size());
    for (const Channel channel : skeleton_.channels[joint]) {
      channels += ' ';
      channels += channel_names[static_cast<std::size_t>(channel)];
    }
    line(depth + 1, channels);
  }

  void end_joint(std::size_t joint, std::size_t depth) {
    for (const EndSite* site : sites_[joint]) {
      check_name(site->name);
      line(depth + 1, site->name.empty() ? "End Site" : "End Site " + site->name);
      line(depth + 1, "{");
      offset_line(depth + 2, site->offset);
      line(depth + 1, "}");
    }
    line(depth, "}");
  }

  const Skeleton& skeleton_;
  TextBuffer& out_;
  std::vector<std::vector<std::size_t>> children_;
  std::vector<std::vector<const EndSite*>> sites_;
  std::vector<std::size_t> order_;
};

std::string write_plain(const Clip& clip) {
  check_channels(clip);
  TextBuffer out(4096);
  const std::vector<std::size_t> order = HierarchyWriter(clip.skeleton, out).write();
  const std::string frame_time = frame_time_text(clip.frame_rate_hz);
  append_motion(out, clip, order, {"\n", 6, frame_time});
  return std::move(out).take();
}

// The source's hierarchy to the byte, for a clip that has other frames than the source.
std::string write_with_hierarchy(const Clip& clip, const BvhDocument& document) {
  TextBuffer out(4096);
  const std::string_view hierarchy =
      std::string_view(document.bytes).substr(0, document.hierarchy_end);
  const std::size_t end = hierarchy.find_first_of("\r\n");
  const std::string_view line_end = end == hierarchy.npos                ? "\n"
                                    : hierarchy[end] == '\n'             ? "\n"
                                    : hierarchy.substr(end, 2) == "\r\n" ? "\r\n"
                                                                         : "\r";
  out.append(hierarchy);
  out.append(line_end);
  const bool same_rate =
      clip.frame_rate_hz == document.frame_rate_hz && document.frame_time.size > 0;
  const std::string frame_time = same_rate ? std::string(document.text(document.frame_time))
                                           : frame_time_text(clip.frame_rate_hz);
  std::vector<std::size_t> order(clip.joint_count());
  for (std::size_t j = 0; j < order.size(); ++j) order[j] = j;
  append_motion(out, clip, order, {line_end, std::clamp(document.decimals, 4u, 9u), frame_time});
  return std::move(out).take();
}

}  // namespace

void append_motion(TextBuffer& out, const Clip& clip, const std::vector<std::size_t>& joints,
                   const MotionStyle& style) {
  const Skeleton& skeleton = clip.skeleton;
  out.append(fmt::format("MOTION{0}Frames: {1}{0}Frame Time: {2}{0}", style.line_end,
                         clip.frame_count(), style.frame_time));
  std::vector<RotationOrder> orders;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j)
    orders.push_back(skeleton.rotation_order(j));
  std::vector<std::array<double, 3>> angles(skeleton.joint_count());
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    std::string_view separator;
    for (const std::size_t j : joints) {
      if (orders[j].count > 0) {
        angles[j] =
            to_euler_near(skeleton.rest_rotations[j] * clip.rotation(f, j), orders[j], angles[j]);
      }
      std::size_t turn = 0;
      for (const Channel channel : skeleton.channels[j]) {
        out.append(separator);
        separator = " ";
        const double value = is_rotation(channel)
                                 ? angles[j][turn++] * degrees_per_radian
                                 : component(position_of(clip, f, j), axis_of(channel));
        out.append_fixed(value, style.decimals);
      }
    }
    out.append(style.line_end);
  }
}

std::string write_bvh(const Clip& clip) {
  check_lengths(clip);
  const auto* document = dynamic_cast<const BvhDocument*>(clip.source.document.get());
  if (document == nullptr || !same_skeleton(clip.skeleton, document->skeleton))
    return write_plain(clip);
  const MotionColumns columns(clip.skeleton);
  const auto translated = columns.translated_joints();
  const bool same_translated =
      std::equal(translated.begin(), translated.end(), clip.translated_joints.begin(),
                 clip.translated_joints.end());
  const bool same_rate =
      clip.frame_rate_hz == document->frame_rate_hz || document->frame_time.size > 0;
  if (clip.frame_count() == document->frame_count && same_rate && same_translated)
    return rewrite_bvh(clip, *document);
  return write_with_hierarchy(clip, *document);
}

}  // namespace kinemend
