// Turns the poses of an FBX rig into a take, and finds its frames: baked takes have a key per
// frame, others are keyed by hand.
#include "io/fbx/fbx_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "base/parallel.hpp"
#include "base/text.hpp"
#include "io/motion/motion_columns.hpp"
#include "kinemend/extend/frames.hpp"
#include "motion/rotation.hpp"

namespace kinemend {

namespace {

// Relative tolerance for rounding; chosen by hand, not swept.
constexpr double same_scale = 1e-6;
// A bone whose length or direction changes by less is rigid, because baked curves are rounded.
// Chosen by hand, not swept.
constexpr double rigid = 1e-5;

Channel fbx_rotation_channel(Axis axis) {
  return static_cast<Channel>(static_cast<int>(Channel::x_rotation) + static_cast<int>(axis));
}

std::vector<Channel> channels_of(const FbxRigNode& node, bool is_translated) {
  std::vector<Channel> channels;
  if (is_translated) channels = {Channel::x_position, Channel::y_position, Channel::z_position};
  for (std::size_t i = node.first_turn; i < node.end_turn; ++i)
    channels.push_back(fbx_rotation_channel(node.order.axes[i]));
  return channels;
}

bool is_uniform(Vec3 s) {
  const double most = std::max({std::fabs(s.x), std::fabs(s.y), std::fabs(s.z)});
  return std::fabs(s.x - s.y) <= same_scale * most && std::fabs(s.y - s.z) <= same_scale * most;
}

class FbxTakeBuilder {
 public:
  explicit FbxTakeBuilder(const FbxDocument& document)
      : document_(document), rig_(document.rig), poser_(document.scene, document.motion, rig_) {}

  // Builds a take without frames.
  Take build_skeleton() {
    start();
    return std::move(take_);
  }

  Take build() {
    const std::size_t joints = rig_.joints.size();
    start();
    const std::size_t frames = document_.frames.times.size();
    take_.rotations.resize(frames * joints);
    take_.positions.resize(frames * take_.point_count());
    for_each_range(0, frames, fbx_frames_a_range,
                   [&](std::size_t first, std::size_t last) { set_frames(first, last); });
    mark_mended();
    return std::move(take_);
  }

 private:
  void start() {
    take_.frame_rate_hz = document_.frames.rate_hz;
    take_.metres_per_unit = document_.scene.unit_cm / 100;
    find_moving();
    add_joints(poser_.at(document_.frames.times.front()));
  }

  const FbxRigNode& node(std::size_t joint) const { return rig_.nodes[rig_.joints[joint]]; }

  // Returns the position of a joint in the frame of the joint above.
  Vec3 offset_of(const std::vector<FbxNodePose>& poses, std::size_t joint) const {
    const Vec3 centre = poses[rig_.joints[joint]].centre;
    const std::int32_t parent = node(joint).parent_joint;
    if (parent < 0) return centre;
    const FbxNodePose& above = poses[rig_.joints[static_cast<std::size_t>(parent)]];
    return rotate(conjugate(above.joint_turn), centre - above.centre);
  }

  // Finds joints with translation curves, and joints that are moved by scales.
  void find_moving() {
    moving_.assign(rig_.joints.size(), false);
    for (std::size_t j = 0; j < moving_.size(); ++j) moving_[j] = is_translated(node(j));
    scales_are_odd_ = has_odd_scales();
    if (!scales_are_odd_) return;
    const auto& frames = document_.frames.times;
    std::vector<Vec3> first;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const std::vector<FbxNodePose>& poses = poser_.at(frames[f]);
      for (std::size_t j = 0; j < moving_.size(); ++j) {
        const Vec3 offset = offset_of(poses, j);
        if (f == 0) {
          first.push_back(offset);
        } else if (!(norm(offset - first[j]) <= rigid * norm(first[j]))) {
          moving_[j] = true;
        }
      }
    }
  }

  // Whether curves of translation move the joint, beyond rounding.
  bool is_translated(const FbxRigNode& each) const {
    Vec3 spread, size = document_.scene.models[each.model].local[fbx_translation];
    std::size_t layers = 0;
    for (const FbxLayer& layer : document_.motion.layers) {
      const auto found = layer.vectors.find(3 * each.model + fbx_translation);
      if (found == layer.vectors.end()) continue;
      ++layers;
      size = found->second.constant;
      for (std::size_t a = 0; a < 3; ++a) {
        if (found->second.curves[a] < 0) continue;
        const FbxCurve& curve =
            document_.motion.curves[static_cast<std::size_t>(found->second.curves[a])];
        const auto [least, most] = std::minmax_element(curve.values.begin(), curve.values.end());
        component_of(size, a) = curve.values.front();
        component_of(spread, a) = *most - *least;
      }
    }
    return layers > 1 || norm(spread) > rigid * norm(size);
  }

  bool has_odd_scales() {
    for (const FbxRigNode& each : rig_.nodes) {
      if (!is_uniform(document_.scene.models[each.model].local[fbx_scaling])) return true;
      for (const FbxLayer& layer : document_.motion.layers) {
        const auto found = layer.vectors.find(3 * each.model + fbx_scaling);
        if (found != layer.vectors.end() && changes_scale(found->second)) return true;
      }
    }
    return false;
  }

  bool changes_scale(const FbxAnimatedVector& scale) const {
    Vec3 value = scale.constant;
    for (std::size_t a = 0; a < 3; ++a) {
      if (scale.curves[a] < 0) continue;
      const FbxCurve& curve = document_.motion.curves[static_cast<std::size_t>(scale.curves[a])];
      if (!curve.is_constant()) return true;
      component_of(value, a) = curve.values.front();
    }
    return !is_uniform(value);
  }

  void add_joints(const std::vector<FbxNodePose>& poses) {
    Skeleton& skeleton = take_.skeleton;
    for (std::size_t j = 0; j < rig_.joints.size(); ++j) {
      const FbxRigNode& each = node(j);
      skeleton.add_joint(document_.scene.models[each.model].name, each.parent_joint,
                         offset_of(poses, j), channels_of(each, moving_[j]));
      skeleton.rest_rotations.back() = rest_of(poses, each);
      firsts_.push_back({offset_of(poses, j), poses[rig_.joints[j]].local[fbx_translation],
                         fbx_step_matrix(rig_, poses, each)});
      if (j > 0 && moving_[j]) take_.translated_joints.push_back(static_cast<std::int32_t>(j));
    }
  }

  // Returns the rotation between the frame of the joint above and the rotations with curves.
  static Quat rest_of_turns(const FbxRigNode& each, Vec3 rotation) {
    Vec3 before;
    for (std::size_t i = 0; i < each.first_turn; ++i) {
      const auto axis = static_cast<std::size_t>(each.order.axes[i]);
      component_of(before, axis) = component(rotation, axis);
    }
    return each.pre * fbx_turn(before, each.order);
  }

  Quat rest_of(const std::vector<FbxNodePose>& poses, const FbxRigNode& each) const {
    const std::size_t own = static_cast<std::size_t>(&each - rig_.nodes.data());
    Quat rest = rest_of_turns(each, poses[own].local[fbx_rotation]);
    if (each.parent >= 0) rest = poses[static_cast<std::size_t>(each.parent)].turn * rest;
    if (each.parent_joint >= 0) {
      const std::size_t above = rig_.joints[static_cast<std::size_t>(each.parent_joint)];
      rest = conjugate(poses[above].joint_turn) * rest;
    }
    return normalized(rest);
  }

  // One vector of a joint in the frames of a range, and its angles, three per frame.
  struct JointRange {
    std::size_t first = 0, last = 0;
    std::vector<Vec3> local;
    std::vector<double> degrees, sines, cosines;
  };

  // Sets a range of frames; ranges are independent.
  void set_frames(std::size_t first, std::size_t last) {
    FbxPoser poser(document_.scene, document_.motion, rig_);
    JointRange range{first, last, std::vector<Vec3>(last - first), {}, {}, {}};
    std::size_t point = 0;
    for (std::size_t j = 0; j < rig_.joints.size(); ++j) {
      read_local(poser, j, fbx_rotation, range);
      set_rotations(j, range);
      if (scales_are_odd_ || (j > 0 && !moving_[j])) continue;
      read_local(poser, j, fbx_translation, range);
      set_positions(j, point++, range);
    }
    if (scales_are_odd_) set_posed_positions(poser, first, last);
  }

  void read_local(FbxPoser& poser, std::size_t joint, FbxVector vector, JointRange& range) const {
    const std::span<const std::int64_t> times = document_.frames.times;
    poser.locals_over(rig_.joints[joint], vector,
                      times.subspan(range.first, range.last - range.first), range.local);
  }

  // If scales are the same in all frames and directions, positions follow from translations.
  void set_positions(std::size_t joint, std::size_t point, const JointRange& range) {
    const FirstFrame& first = firsts_[joint];
    for (std::size_t i = 0; i < range.local.size(); ++i) {
      take_.position(range.first + i, point) =
          first.offset + first.step * (range.local[i] - first.translation);
    }
  }

  void set_posed_positions(FbxPoser& poser, std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) {
      const std::vector<FbxNodePose>& poses = poser.at(document_.frames.times[f]);
      std::size_t point = 0;
      for (std::size_t j = 0; j < rig_.joints.size(); ++j) {
        if (j == 0 || moving_[j]) take_.position(f, point++) = offset_of(poses, j);
      }
    }
  }

  // Handles all frames at once, because sines and cosines are expensive.
  void set_rotations(std::size_t joint, JointRange& range) {
    const FbxRigNode& each = node(joint);
    const std::size_t frames = range.local.size();
    for (auto* angles : {&range.degrees, &range.sines, &range.cosines}) angles->resize(3 * frames);
    for (std::size_t i = each.first_turn; i < each.end_turn; ++i) {
      const auto axis = static_cast<std::size_t>(each.order.axes[i]);
      for (std::size_t f = 0; f < frames; ++f)
        range.degrees[i * frames + f] = component(range.local[f], axis);
    }
    half_angle_sincos(range.degrees.data(), 3 * frames, range.sines.data(), range.cosines.data());
    for (std::size_t f = 0; f < frames; ++f)
      take_.rotation(range.first + f, joint) = product_of_turns(each, range, f);
  }

  static Quat product_of_turns(const FbxRigNode& each, const JointRange& range, std::size_t frame) {
    const std::size_t frames = range.local.size();
    Quat product;
    for (std::size_t i = each.first_turn; i < each.end_turn; ++i) {
      const double s = range.sines[i * frames + frame], c = range.cosines[i * frames + frame];
      Quat turn{c, 0, 0, 0};
      (each.order.axes[i] == Axis::x   ? turn.x
       : each.order.axes[i] == Axis::y ? turn.y
                                       : turn.z) = s;
      product = i == each.first_turn ? turn : product * turn;
    }
    return product;
  }

  void mark_mended() {
    for (const FbxMendedKey& mended : document_.mended) {
      const std::int64_t time = (*document_.motion.curves[mended.curve].times)[mended.key];
      const auto& times = document_.frames.times;
      const auto found = std::lower_bound(times.begin(), times.end(), time);
      if (found == times.end() || *found != time) continue;
      const auto frame = static_cast<std::size_t>(found - times.begin());
      for (std::size_t j = 0; j < rig_.joints.size(); ++j) mark(mended.curve, frame, j);
    }
  }

  void mark(std::size_t curve, std::size_t frame, std::size_t joint) {
    for (const FbxLayer& layer : document_.motion.layers) {
      const auto found = layer.vectors.find(3 * node(joint).model + fbx_rotation);
      if (found == layer.vectors.end()) continue;
      const auto& curves = found->second.curves;
      if (std::count(curves.begin(), curves.end(), static_cast<std::int32_t>(curve)) == 0) continue;
      take_.observed.resize(take_.rotations.size(), 1);
      take_.observed[frame * rig_.joints.size() + joint] = 0;
    }
  }

  struct FirstFrame {
    Vec3 offset, translation;
    FbxMatrix step;  // from a change of translation to one of offset
  };

  const FbxDocument& document_;
  const FbxRig& rig_;
  FbxPoser poser_;
  Take take_;
  bool scales_are_odd_ = false;
  std::vector<FirstFrame> firsts_;  // by joint
  std::vector<bool> moving_;        // by joint: its position changes in the frame of its parent
};

bool may_be_marker(const FbxModel& model) {
  return model.kind == "Null" || model.kind == "Marker" || model.kind == "OpticalMarker";
}

Take fbx_markers(const FbxDocument& document, Take joints) {
  Take take;
  const std::size_t count = joints.joint_count(), frames = joints.frame_count();
  take.names = joints.skeleton.names;
  take.frame_rate_hz = joints.frame_rate_hz;
  take.unit = document.scene.unit_cm == 0.1   ? "mm"
              : document.scene.unit_cm == 100 ? "m"
              : document.scene.unit_cm == 1   ? "cm"
                                              : "";
  std::vector<std::int32_t> point_of(count, -1);
  point_of[0] = 0;
  for (std::size_t k = 0; k < joints.translated_joints.size(); ++k)
    point_of[static_cast<std::size_t>(joints.translated_joints[k])] =
        static_cast<std::int32_t>(k) + 1;
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t m = 0; m < count; ++m) {
      take.positions.push_back(point_of[m] < 0
                                   ? joints.skeleton.offsets[m]
                                   : joints.position(f, static_cast<std::size_t>(point_of[m])));
    }
  }
  take.observed.assign(frames * count, 1);
  return take;
}

}  // namespace

std::vector<std::size_t> fbx_joint_curves(const FbxMotion& motion, const FbxRig& rig) {
  std::vector<std::size_t> curves;
  for (const FbxRigNode& node : rig.nodes) {
    for (std::size_t v = 0; v < 3; ++v) {
      for (const FbxLayer& layer : motion.layers) {
        const auto found = layer.vectors.find(3 * node.model + v);
        if (found == layer.vectors.end()) continue;
        for (const std::int32_t curve : found->second.curves) {
          if (curve >= 0) curves.push_back(static_cast<std::size_t>(curve));
        }
      }
    }
  }
  std::sort(curves.begin(), curves.end());
  curves.erase(std::unique(curves.begin(), curves.end()), curves.end());
  return curves;
}

bool moves_joints(const FbxMotion& motion, const FbxRig& rig) {
  const std::vector<std::size_t> curves = fbx_joint_curves(motion, rig);
  return std::any_of(curves.begin(), curves.end(),
                     [&](std::size_t curve) { return !motion.curves[curve].is_constant(); });
}

bool holds_fbx_markers(const FbxScene& scene, const FbxMotion& motion, const FbxRig& rig) {
  for (const std::size_t n : rig.joints) {
    const FbxRigNode& node = rig.nodes[n];
    if (!may_be_marker(scene.models[node.model]) || node.parent_joint >= 0 ||
        !node.has_translation_curves || node.first_turn != node.end_turn)
      return false;
    for (const FbxLayer& layer : motion.layers) {
      if (layer.vectors.contains(3 * node.model + fbx_scaling)) return false;
    }
  }
  return true;
}

Take skeleton_of_fbx(const FbxDocument& document) {
  return FbxTakeBuilder(document).build_skeleton();
}

Take take_of_fbx(const FbxDocument& document) {
  Take take = FbxTakeBuilder(document).build();
  if (holds_fbx_markers(document.scene, document.motion, document.rig))
    return fbx_markers(document, std::move(take));
  return take;
}

std::vector<double> FbxDocument::channel_values() const {
  const Take take = take_of_fbx(*this);
  std::vector<double> values;
  if (!take.has_joints()) return values;
  FbxPoser poser(scene, motion, rig);
  for (std::size_t f = 0; f < frames.times.size(); ++f) {
    const std::vector<FbxNodePose>& poses = poser.at(frames.times[f]);
    std::size_t point = 0;
    for (std::size_t j = 0; j < rig.joints.size(); ++j) {
      const FbxRigNode& node = rig.nodes[rig.joints[j]];
      if (take.skeleton.has_position_channels(j)) {
        if (j > 0) ++point;
        const Vec3 p = take.position(f, point);
        values.insert(values.end(), {p.x, p.y, p.z});
      }
      for (std::size_t i = node.first_turn; i < node.end_turn; ++i)
        values.push_back(component(poses[rig.joints[j]].local[fbx_rotation],
                                   static_cast<std::size_t>(node.order.axes[i])));
    }
  }
  return values;
}

void check_fbx_take(const FbxDocument& document, const Take& take) {
  const auto is_finite = [](Vec3 v) { return std::isfinite(norm(v)) && norm(v) < 1e100; };
  const auto refuse = [&](std::size_t joint) {
    const FbxModel& model =
        document.scene.models[document.rig.nodes[document.rig.joints[joint]].model];
    return document.tree.error_at(
        document.tree.records[model.record].begin,
        fmt::format("{} is nowhere: its scales or distances overflow", quote(model.name)));
  };
  for (std::size_t j = 0; j < take.joint_count(); ++j) {
    if (!is_finite(take.skeleton.offsets[j])) throw refuse(j);
  }
  for (std::size_t i = 0; i < take.positions.size(); ++i) {
    if (is_finite(take.positions[i])) continue;
    const std::size_t point = i % take.point_count();
    const bool is_translated = take.has_joints() && point > 0;
    throw refuse(is_translated ? static_cast<std::size_t>(take.translated_joints[point - 1])
                               : point);
  }
}

namespace {

// How far a key may lie from its frame, as a share of the step: programs round times.
constexpr double grid_tolerance = 0.02;
// Motion is baked at 10 Hz or more; slower regular keys are set by hand.
constexpr double least_baked_rate_hz = 10;
constexpr double same_rate = 1e-3;

struct FbxSpan {
  std::int64_t first = 0;
  std::int64_t last = 0;
};

bool lies_on_grid(const std::vector<std::int64_t>& times, double step) {
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double off = static_cast<double>(times[k] - times[0]) - static_cast<double>(k) * step;
    if (std::fabs(off) > grid_tolerance * step) return false;
  }
  return true;
}

class FbxFrameFinder {
 public:
  FbxFrameFinder(const FbxTree& tree, const FbxScene& scene, const FbxMotion& motion,
                 const std::vector<std::size_t>& curves, std::size_t most_frames)
      : tree_(tree), scene_(scene), motion_(motion), most_(most_frames) {
    for (const std::size_t c : curves) {
      if (motion.curves[c].key_count() > 1 && !motion.curves[c].is_constant())
        moving_.push_back(&motion.curves[c]);
    }
    if (!moving_.empty()) return;
    for (const std::size_t c : curves) {
      if (motion.curves[c].key_count() > 1) moving_.push_back(&motion.curves[c]);
    }
  }

  FbxFrames find() {
    FbxFrames frames;
    frames.rate_hz = scene_.frame_rate_hz;
    frames.step_ticks = scene_.ticks_per_second / frames.rate_hz;
    if (moving_.empty()) {
      frames.times.push_back(motion_.curves.empty() ? 0 : motion_.curves.front().times->front());
      return frames;
    }
    FbxSpan span{moving_.front()->times->front(), moving_.front()->times->back()};
    for (const FbxCurve* curve : moving_) {
      span.first = std::min(span.first, curve->times->front());
      span.last = std::max(span.last, curve->times->back());
    }
    if (!take_keys(span, frames)) lay_grid(span, frames);
    for (const FbxCurve* curve : moving_) frames.resampled += is_baked(*curve, frames) ? 0 : 1;
    return frames;
  }

 private:
  // Returns the keys that most curves have.
  const std::vector<std::int64_t>& common_times() const {
    using Kind = std::array<std::int64_t, 3>;
    std::map<Kind, std::pair<std::size_t, const FbxCurve*>> kinds;
    for (const FbxCurve* curve : moving_) {
      const auto& times = *curve->times;
      auto& kind = kinds[{static_cast<std::int64_t>(times.size()), times.front(), times.back()}];
      ++kind.first;
      kind.second = curve;
    }
    const FbxCurve* best = moving_.front();
    std::size_t most = 0;
    for (const auto& [kind, found] : kinds) {
      if (found.first < most) continue;
      most = found.first;
      best = found.second;
    }
    return *best->times;
  }

  // Uses the keys that most curves have if they form a grid over the whole span.
  bool take_keys(FbxSpan span, FbxFrames& frames) const {
    const std::vector<std::int64_t>& times = common_times();
    const double step =
        static_cast<double>(times.back() - times.front()) / static_cast<double>(times.size() - 1);
    const double rate_hz = scene_.ticks_per_second / step;
    const bool is_mode = std::fabs(rate_hz / scene_.frame_rate_hz - 1) < same_rate;
    if (times.front() != span.first || times.back() != span.last || !lies_on_grid(times, step) ||
        !is_usable_frame_rate(rate_hz) || (rate_hz < least_baked_rate_hz && !is_mode))
      return false;
    check_count(static_cast<double>(times.size()));
    FbxFrames found;
    found.times = times;
    found.step_ticks = step;
    found.rate_hz = is_mode ? scene_.frame_rate_hz : std::round(rate_hz * 1e6) / 1e6;
    const auto baked = std::count_if(moving_.begin(), moving_.end(), [&](const FbxCurve* curve) {
      return is_baked(*curve, found);
    });
    if (2 * static_cast<std::size_t>(baked) < moving_.size() && !is_mode) return false;
    frames = std::move(found);
    return true;
  }

  void lay_grid(FbxSpan span, FbxFrames& frames) const {
    const double length = static_cast<double>(span.last) - static_cast<double>(span.first);
    const double steps = std::floor(length / frames.step_ticks + grid_tolerance);
    check_count(steps + 1);
    const auto count = static_cast<std::size_t>(steps) + 1;
    for (std::size_t i = 0; i < count; ++i) {
      const double ticks = static_cast<double>(i) * frames.step_ticks;
      frames.times.push_back(span.first + static_cast<std::int64_t>(std::llround(ticks)));
    }
  }

  void check_count(double count) const {
    if (count <= static_cast<double>(most_)) return;
    throw tree_.error_at(tree_.records[moving_.front()->record].begin,
                         fmt::format("the keys span {:.0f} frames: too much memory for a file of "
                                     "{} bytes",
                                     count, tree_.bytes.size()));
  }

  const FbxTree& tree_;
  const FbxScene& scene_;
  const FbxMotion& motion_;
  std::size_t most_;
  std::vector<const FbxCurve*> moving_;
};

}  // namespace

bool is_baked(const FbxCurve& curve, const FbxFrames& frames) {
  if (curve.key_count() != frames.times.size()) return false;
  const std::vector<std::int64_t>& times = *curve.times;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double off = static_cast<double>(times[k] - frames.times[k]);
    if (std::fabs(off) > grid_tolerance * frames.step_ticks) return false;
  }
  return true;
}

FbxFrames find_fbx_frames(const FbxTree& tree, const FbxScene& scene, const FbxMotion& motion,
                          const std::vector<std::size_t>& curves, std::size_t most_frames) {
  return FbxFrameFinder(tree, scene, motion, curves, most_frames).find();
}

}  // namespace kinemend
