// Chooses the nodes that are joints or markers, decodes their motion from the curves of an
// animation, and bounds the memory of a take.
#include "io/gltf/gltf_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "base/portable.hpp"
#include "base/text.hpp"
#include "io/gltf/gltf_model.hpp"
#include "io/reading_limits.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

// Returns the nodes with each node after its parent, children in the order of the file.
std::vector<std::size_t> gltf_tree_order(const GltfModel& model) {
  std::vector<std::size_t> order, open(model.roots.rbegin(), model.roots.rend());
  order.reserve(model.nodes.size());
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    order.push_back(node);
    const auto& children = model.nodes[node].children;
    open.insert(open.end(), children.rbegin(), children.rend());
  }
  return order;
}

// Marks the nodes that the animation moves.
std::vector<std::uint8_t> animated_nodes(const GltfModel& model, std::size_t animation,
                                         bool with_scale) {
  std::vector<std::uint8_t> animated(model.nodes.size());
  if (animation == GltfTrack::none) return animated;
  for (const GltfChannel& channel : model.animations[animation].channels) {
    const bool places = channel.path == GltfPath::translation ||
                        channel.path == GltfPath::rotation ||
                        (with_scale && channel.path == GltfPath::scale);
    if (places && channel.node >= 0) animated[static_cast<std::size_t>(channel.node)] = 1;
  }
  return animated;
}

// Spreads marks from children to their ancestors.
std::vector<std::uint8_t> with_ancestors(const GltfModel& model, std::vector<std::uint8_t> marked,
                                         const std::vector<std::size_t>& order) {
  for (auto node = order.rbegin(); node != order.rend(); ++node) {
    const std::int64_t parent = model.nodes[*node].parent;
    if (marked[*node] != 0 && parent >= 0) marked[static_cast<std::size_t>(parent)] = 1;
  }
  return marked;
}

std::vector<std::uint8_t> with_descendants(const GltfModel& model, std::vector<std::uint8_t> marked,
                                           const std::vector<std::size_t>& order) {
  for (const std::size_t node : order) {
    const std::int64_t parent = model.nodes[node].parent;
    if (parent >= 0 && marked[static_cast<std::size_t>(parent)] != 0) marked[node] = 1;
  }
  return marked;
}

// Marks the nodes that must be joints, without the nodes between them.
std::vector<std::uint8_t> chosen_nodes(const GltfModel& model, std::size_t animation,
                                       const std::vector<std::size_t>& order) {
  if (model.skins.empty()) return animated_nodes(model, animation, false);
  std::vector<std::uint8_t> skinned(model.nodes.size());
  for (const auto& joints : model.skins) {
    for (const std::size_t joint : joints) skinned[joint] = 1;
  }
  const auto above = with_ancestors(model, skinned, order);
  const auto below = with_descendants(model, skinned, order);
  const auto placed = animated_nodes(model, animation, false);
  const auto animated = animated_nodes(model, animation, true);
  for (std::size_t n = 0; n < skinned.size(); ++n) {
    if ((above[n] != 0 && animated[n] != 0) || (below[n] != 0 && placed[n] != 0)) skinned[n] = 1;
  }
  return skinned;
}

}  // namespace

std::vector<std::size_t> gltf_joints(const GltfModel& model, std::size_t animation) {
  const std::vector<std::size_t> order = gltf_tree_order(model);
  const auto chosen = chosen_nodes(model, animation, order);
  const auto above = with_ancestors(model, chosen, order);
  const auto below = with_descendants(model, chosen, order);
  std::vector<std::size_t> joints;
  for (const std::size_t node : order) {
    if (above[node] != 0 && below[node] != 0) joints.push_back(node);
  }
  return joints;
}

namespace {

// Returns a mark for each node of the file: 1 for those listed.
std::vector<std::uint8_t> marked_nodes(const GltfModel& model,
                                       const std::vector<std::size_t>& nodes) {
  std::vector<std::uint8_t> marks(model.nodes.size());
  for (const std::size_t node : nodes) marks[node] = 1;
  return marks;
}

// Throws `unreadable_input` if the frames need far more memory than the file has bytes.
void check_gltf_memory(const GltfFile& file, const GltfBuffers& buffers, std::size_t frames,
                       std::size_t bytes_per_frame) {
  const double needed = static_cast<double>(frames) * static_cast<double>(bytes_per_frame);
  const std::size_t bytes = file.bytes.size() + buffers.size_beside();
  if (needed <= static_cast<double>(memory_limit(bytes))) return;
  throw Error::at_byte(file.name, file.json.begin,
                       fmt::format("{} frames of {} bytes: too much memory for a file of {} bytes",
                                   frames, bytes_per_frame, bytes));
}

// The curves of an animation for the nodes of a take, and their common frames.
class GltfCurves {
 public:
  // Reads translation, rotation and scale of the nodes.
  GltfCurves(const GltfFile& file, const GltfModel& model, GltfBuffers& buffers,
             std::size_t animation, const std::vector<std::size_t>& nodes)
      : channels_(3 * model.nodes.size(), GltfTrack::none) {
    if (animation == GltfTrack::none) return;
    const GltfAnimation& chosen = model.animations[animation];
    const std::vector<std::uint8_t> wanted = marked_nodes(model, nodes);
    curves_.resize(chosen.channels.size());
    GltfClocks clocks;
    std::size_t read = 0;
    for (std::size_t c = 0; c < chosen.channels.size(); ++c) {
      const GltfChannel& channel = chosen.channels[c];
      const bool is_wanted = channel.path != GltfPath::other && channel.node >= 0 &&
                             wanted[static_cast<std::size_t>(channel.node)] != 0;
      if (!is_wanted) continue;
      const auto node = static_cast<std::size_t>(channel.node);
      std::size_t& slot = channels_[3 * node + static_cast<std::size_t>(channel.path)];
      if (slot != GltfTrack::none) {
        repeated_.push_back(node);
        continue;
      }
      slot = c;
      curves_[c] = read_gltf_curve(file, model, buffers, chosen.samplers[channel.sampler],
                                   channel.path, clocks);
      if (channel.path != GltfPath::scale) moving_.push_back(&curves_[c]);
      // Channels may share a sampler; the memory of each is counted.
      read += curves_[c].keys() * (curves_[c].parts() + 1) * sizeof(double);
      check_gltf_memory(file, buffers, 1, read);
    }
  }

  // Returns the number of a node's channel, or `GltfTrack::none`.
  std::size_t channel(std::size_t node, GltfPath path) const {
    return channels_[3 * node + static_cast<std::size_t>(path)];
  }
  // Returns the curve of a channel that was read; null for `GltfTrack::none`.
  const GltfCurve* curve(std::size_t channel) const {
    return channel == GltfTrack::none ? nullptr : &curves_[channel];
  }
  // Returns the curves of rotations and translations.
  const std::vector<const GltfCurve*>& moving() const { return moving_; }
  // Returns a node once for each of its channels that repeats another.
  const std::vector<std::size_t>& repeated() const { return repeated_; }

 private:
  std::vector<std::size_t> channels_;  // three per node
  std::vector<GltfCurve> curves_;      // by channel
  std::vector<const GltfCurve*> moving_;
  std::vector<std::size_t> repeated_;
};

// Holds the nodes of a take and their curves, for the decoders of joints and of markers.
class GltfDecoder {
 protected:
  GltfDecoder(const GltfFile& file, const GltfModel& model, GltfBuffers& buffers,
              std::size_t animation, double rate_hz, std::vector<std::size_t> nodes,
              std::size_t bytes_per_node)
      : file_(file),
        model_(model),
        nodes_(std::move(nodes)),
        curves_(file, model, buffers, animation, nodes_) {
    motion_.animation = animation;
    motion_.grid = grid_of_curves(curves_.moving(), rate_hz);
    check_gltf_memory(file, buffers, motion_.grid.times.count, nodes_.size() * bytes_per_node);
    for (const std::size_t node : curves_.repeated())
      motion_.repeated.push_back(name_of_node(model, node));
  }

  std::size_t frames() const { return motion_.grid.times.count; }

  // Stores in the track whether its curve has a key in each frame, and updates the motion's counts
  // of keys.
  void note_keys(const GltfCurve& curve, GltfTrack& track) {
    track.has_key_each_frame = has_key_each_frame(curve, motion_.grid.times);
    if (!track.has_key_each_frame && !is_constant(curve)) ++motion_.interpolated;
    motion_.held_keys +=
        static_cast<std::size_t>(std::count(curve.held.begin(), curve.held.end(), 1));
  }

  const GltfFile& file_;
  const GltfModel& model_;
  std::vector<std::size_t> nodes_;
  GltfCurves curves_;
  GltfMotion motion_;
};

// The frame of a node's children: a rotation, an origin, and a scale for each frame or for all.
struct GltfFrameOfNode {
  Quat rotation;
  Vec3 origin;
  std::vector<Vec3> scale = std::vector<Vec3>(1, Vec3{1, 1, 1});
};

// The positions of a joint in its parent, and their source.
struct GltfPlaces {
  GltfTrack track;
  std::vector<Vec3> positions;  // empty for a joint that never moves
};

bool is_uniform_scale(Vec3 s) {
  // Chosen by hand, not swept.
  constexpr double tolerance = 1e-4;  // far above the error of single precision
  const double largest = std::max({std::fabs(s.x), std::fabs(s.y), std::fabs(s.z)});
  return std::fabs(s.x - s.y) <= tolerance * largest && std::fabs(s.y - s.z) <= tolerance * largest;
}

Vec3 mean_scale(Vec3 s) {
  const double mean = portable::cbrt(s.x) * portable::cbrt(s.y) * portable::cbrt(s.z);
  return {mean, mean, mean};
}

class GltfJointDecoder : GltfDecoder {
 public:
  GltfJointDecoder(const GltfFile& file, const GltfModel& model, GltfBuffers& buffers,
                   std::size_t animation, double rate_hz)
      : GltfDecoder(file, model, buffers, animation, rate_hz,
                    bounded(file, gltf_joints(model, animation)), sizeof(Quat) + 2 * sizeof(Vec3)),
        joint_of_node_(model.nodes.size(), -1) {
    for (std::size_t j = 0; j < nodes_.size(); ++j)
      joint_of_node_[nodes_[j]] = static_cast<std::int32_t>(j);
  }

  GltfMotion decode() {
    Take& take = motion_.take;
    take.frame_rate_hz = motion_.grid.times.rate_hz;
    take.metres_per_unit = 1;
    take.rotations.resize(frames() * nodes_.size());
    for (std::size_t j = 0; j < nodes_.size(); ++j) add_joint(j);
    place_joints();
    gather_positions();
    if (!held_rotations_.empty()) take.observed = std::move(held_rotations_);
    add_end_sites();
    check_finite();
    return std::move(motion_);
  }

 private:
  static std::vector<std::size_t> bounded(const GltfFile& file, std::vector<std::size_t> joints) {
    constexpr std::size_t most_gltf_joints = 16384;  // as in BVH
    if (joints.empty()) throw Error::at_byte(file.name, file.json.begin, "no node is a joint");
    if (joints.size() > most_gltf_joints)
      throw gltf_error(file, "nodes", joints[most_gltf_joints], "too many joints");
    return joints;
  }

  void add_joint(std::size_t j) {
    const std::size_t node = nodes_[j];
    const std::int64_t above = model_.nodes[node].parent;
    const std::int32_t parent = above < 0 ? -1 : joint_of_node_[static_cast<std::size_t>(above)];
    GltfFrameOfNode outer;
    if (parent >= 0) {
      outer.scale = scales_[static_cast<std::size_t>(parent)];
    } else if (above >= 0) {
      outer = static_frame(static_cast<std::size_t>(above));
    }
    add_rotation(j);
    motion_.take.skeleton.add_joint(name_of_node(model_, node), parent, {}, {});
    add_position(j, outer);
    motion_.take.skeleton.rest_rotations[j] =
        unit_rotation(outer.rotation * model_.nodes[node].rotation);
    if (model_.nodes[node].is_sheared) motion_.sheared.push_back(name_of_node(model_, node));
    scales_.push_back(scale_below(node, outer.scale));
  }

  // Returns the frame of a node that is not animated, like all nodes above it.
  const GltfFrameOfNode& static_frame(std::size_t node) {
    std::vector<std::size_t> chain;
    std::int64_t above = static_cast<std::int64_t>(node);
    for (; above >= 0 && !static_frames_.contains(static_cast<std::size_t>(above));
         above = model_.nodes[chain.back()].parent)
      chain.push_back(static_cast<std::size_t>(above));
    GltfFrameOfNode frame;
    if (above >= 0) frame = static_frames_[static_cast<std::size_t>(above)];
    for (auto n = chain.rbegin(); n != chain.rend(); ++n) {
      const GltfNode& at = model_.nodes[*n];
      frame.origin += rotate(frame.rotation, scaled(frame.scale[0], at.translation));
      frame.rotation = unit_rotation(frame.rotation * at.rotation);
      frame.scale = scale_below(*n, frame.scale);
      if (at.is_sheared) motion_.sheared.push_back(name_of_node(model_, *n));
      static_frames_[*n] = frame;
    }
    return static_frames_[node];
  }

  // Returns the scale of a node's children. A rotation under different scales of the axes shears,
  // which a joint cannot express, so the mean of the axes replaces them.
  std::vector<Vec3> scale_below(std::size_t node, const std::vector<Vec3>& above) {
    const std::vector<Vec3> own = own_scale(node);
    std::vector<Vec3> below(std::max(above.size(), own.size()));
    const bool turns = curves_.channel(node, GltfPath::rotation) != GltfTrack::none ||
                       angle_between(model_.nodes[node].rotation, {}) > 1e-9;
    bool is_odd = false;
    for (std::size_t i = 0; i < below.size(); ++i) {
      Vec3 outer = above[above.size() == 1 ? 0 : i];
      if (turns && !is_uniform_scale(outer)) {
        outer = mean_scale(outer);
        is_odd = true;
      }
      below[i] = scaled(outer, own[own.size() == 1 ? 0 : i]);
    }
    if (is_odd && !model_.nodes[node].children.empty())
      motion_.odd_scales.push_back(name_of_node(model_, node));
    return below;
  }

  std::vector<Vec3> own_scale(std::size_t node) const {
    const GltfCurve* const curve = curves_.curve(curves_.channel(node, GltfPath::scale));
    if (curve == nullptr) return {model_.nodes[node].scale};
    std::vector<Vec3> scales = vectors_at(*curve, motion_.grid.times);
    if (scales.empty()) return {curve->vector(0)};
    const auto same = [&](Vec3 s) { return norm(s - scales[0]) <= 1e-6 * norm(scales[0]); };
    if (std::all_of(scales.begin(), scales.end(), same)) scales.resize(1);
    return scales;
  }

  void add_rotation(std::size_t j) {
    GltfTrack track;
    track.owner = j;
    track.node = nodes_[j];
    track.rest = model_.nodes[track.node].rotation;
    track.channel = curves_.channel(track.node, GltfPath::rotation);
    if (const GltfCurve* const curve = curves_.curve(track.channel)) {
      note_keys(*curve, track);
      const std::vector<Quat> turns = rotations_at(*curve, motion_.grid.times);
      for (std::size_t f = 0; f < turns.size(); ++f) {
        motion_.take.rotations[f * nodes_.size() + j] =
            unit_rotation(conjugate(track.rest) * turns[f]);
      }
      if (track.has_key_each_frame) mark_held(held_rotations_, curve->held, j, nodes_.size());
    }
    motion_.tracks.push_back(std::move(track));
  }

  void mark_held(std::vector<std::uint8_t>& mask, const std::vector<std::uint8_t>& held,
                 std::size_t owner, std::size_t stride) const {
    if (held.empty()) return;
    mask.resize(frames() * stride, 1);
    for (std::size_t f = 0; f < held.size(); ++f) {
      if (held[f] != 0) mask[f * stride + owner] = 0;
    }
  }

  void add_position(std::size_t j, const GltfFrameOfNode& outer) {
    GltfTrack track;
    track.node = nodes_[j];
    track.path = GltfPath::translation;
    track.outer = outer.rotation;
    track.origin = outer.origin;
    track.scale = outer.scale;
    track.channel = curves_.channel(track.node, GltfPath::translation);
    const Vec3 rest = model_.nodes[track.node].translation;
    motion_.take.skeleton.offsets[j] = track.to_take(rest, 0);
    const GltfCurve* const curve = curves_.curve(track.channel);
    std::vector<Vec3> positions;
    if (curve != nullptr) {
      positions = vectors_at(*curve, motion_.grid.times);
      note_keys(*curve, track);
    } else if (j == 0 || track.scale.size() > 1) {
      positions.assign(frames(), rest);
    }
    for (std::size_t f = 0; f < positions.size(); ++f)
      positions[f] = track.to_take(positions[f], f);
    places_.push_back({std::move(track), std::move(positions)});
  }

  // Decides which joints move in their parents. Exporters write bone lengths in each frame, with
  // single precision errors at the size of the whole body.
  void place_joints() {
    // Share of the longest offset. Chosen by hand, not swept.
    constexpr double noise = 5e-6;
    Skeleton& skeleton = motion_.take.skeleton;
    double longest = 0;
    for (std::size_t j = 0; j < nodes_.size(); ++j) {
      if (skeleton.parents[j] >= 0) longest = std::max(longest, norm(skeleton.offsets[j]));
    }
    for (std::size_t j = 0; j < nodes_.size(); ++j) {
      GltfPlaces& places = places_[j];
      const GltfCurve* const curve = curves_.curve(places.track.channel);
      const bool is_whole = curve == nullptr || curve->held.empty();
      const bool moves = !is_whole || farthest(places.positions) > noise * longest;
      skeleton.channels[j] = make_channels(j == 0 || moves, parse_rotation_order("ZXY"));
      if (j > 0 && !moves) {
        if (!places.positions.empty()) skeleton.offsets[j] = places.positions[0];
        places.positions.clear();
        continue;
      }
      if (j > 0) motion_.take.translated_joints.push_back(static_cast<std::int32_t>(j));
      places.track.owner = points_.size();
      points_.push_back(j);
    }
  }

  // Returns the largest distance from the first position.
  static double farthest(const std::vector<Vec3>& positions) {
    double distance = 0;
    for (const Vec3& p : positions) distance = std::max(distance, norm(p - positions[0]));
    return distance;
  }

  void gather_positions() {
    Take& take = motion_.take;
    const std::size_t points = points_.size();
    take.positions.resize(frames() * points);
    for (std::size_t k = 0; k < points; ++k) {
      GltfPlaces& places = places_[points_[k]];
      for (std::size_t f = 0; f < frames(); ++f)
        take.positions[f * points + k] = places.positions[f];
      const GltfCurve* const curve = curves_.curve(places.track.channel);
      if (curve != nullptr && places.track.has_key_each_frame)
        mark_held(take.observed_positions, curve->held, k, points);
      motion_.tracks.push_back(std::move(places.track));
      places = {};
    }
  }

  // Adds the ends of chains: nodes below a joint without children or content. An end has a fixed
  // position in its joint, so joints whose scale changes are skipped.
  void add_end_sites() {
    for (std::size_t j = 0; j < nodes_.size(); ++j) {
      if (scales_[j].size() > 1) continue;
      for (const std::uint32_t child : model_.nodes[nodes_[j]].children) {
        const GltfNode& node = model_.nodes[child];
        if (joint_of_node_[child] >= 0 || !node.children.empty() || node.holds_more) continue;
        motion_.take.skeleton.end_sites.push_back(
            {static_cast<std::int32_t>(j), scaled(scales_[j][0], node.translation), node.name});
      }
    }
  }

  // Numbers in the JSON text may be large enough to overflow.
  void check_finite() const {
    const auto is_finite = [](Vec3 v) { return std::isfinite(v.x + v.y + v.z); };
    const Skeleton& skeleton = motion_.take.skeleton;
    for (std::size_t j = 0; j < nodes_.size(); ++j) {
      if (!is_finite(skeleton.offsets[j]))
        throw gltf_error(file_, "nodes", nodes_[j], "its place is not finite");
    }
    const bool ends = std::all_of(skeleton.end_sites.begin(), skeleton.end_sites.end(),
                                  [&](const EndSite& site) { return is_finite(site.offset); });
    if (!ends ||
        !std::all_of(motion_.take.positions.begin(), motion_.take.positions.end(), is_finite))
      throw gltf_error(file_, "nodes", nodes_[0], "a position below it is not finite");
  }

  std::vector<std::int32_t> joint_of_node_;
  std::unordered_map<std::size_t, GltfFrameOfNode> static_frames_;
  std::vector<std::vector<Vec3>> scales_;  // by joint: the scale of its children
  std::vector<GltfPlaces> places_;         // by joint
  std::vector<std::size_t> points_;        // joints with positions
  std::vector<std::uint8_t> held_rotations_;
};

// Files of markers are made by this project's writer.
std::size_t marker_group(const GltfModel& model) {
  for (const std::size_t root : model.roots) {
    if (model.nodes[root].name == "markers") return root;
  }
  return GltfTrack::none;
}

// Returns the nodes of a file of markers; empty for any other file.
std::vector<std::size_t> gltf_markers(const GltfModel& model, std::size_t animation) {
  const std::size_t group = marker_group(model);
  if (group == GltfTrack::none || animation == GltfTrack::none || !model.skins.empty()) return {};
  std::vector<std::uint8_t> moved(model.nodes.size());
  for (const GltfChannel& channel : model.animations[animation].channels) {
    if (channel.node < 0 || channel.path == GltfPath::other) continue;
    const auto node = static_cast<std::size_t>(channel.node);
    const bool is_marker = model.nodes[node].parent == static_cast<std::int64_t>(group);
    if (!is_marker || channel.path == GltfPath::rotation) return {};
    if (channel.path == GltfPath::translation) moved[node] = 1;
  }
  std::vector<std::size_t> markers;
  for (const std::uint32_t child : model.nodes[group].children) {
    if (moved[child] != 0) markers.push_back(child);
  }
  return markers;
}

class GltfMarkerDecoder : GltfDecoder {
 public:
  GltfMarkerDecoder(const GltfFile& file, const GltfModel& model, GltfBuffers& buffers,
                    std::size_t animation, double rate_hz, std::vector<std::size_t> markers)
      : GltfDecoder(file, model, buffers, animation, rate_hz, std::move(markers),
                    2 * sizeof(Vec3) + 1) {}

  GltfMotion decode() {
    std::vector<std::string> names;
    for (const std::size_t node : nodes_) names.push_back(model_.nodes[node].name);
    motion_.take =
        make_marker_take(std::move(names), motion_.grid.times.count, motion_.grid.times.rate_hz);
    motion_.take.unit = std::string("m");
    for (std::size_t m = 0; m < nodes_.size(); ++m) {
      add_places(m);
      add_presence(m);
    }
    return std::move(motion_);
  }

 private:
  GltfTrack track_of(std::size_t marker, GltfPath path) const {
    const GltfNode& group = model_.nodes[marker_group(model_)];
    GltfTrack track;
    track.owner = marker;
    track.node = nodes_[marker];
    track.path = path;
    track.outer = group.rotation;
    track.origin = group.translation;
    track.scale = {group.scale};
    track.channel = curves_.channel(track.node, path);
    return track;
  }

  void add_places(std::size_t m) {
    GltfTrack track = track_of(m, GltfPath::translation);
    Take& take = motion_.take;
    std::vector<Vec3> places(take.frame_count(), model_.nodes[track.node].translation);
    const GltfCurve* const curve = curves_.curve(track.channel);
    if (curve != nullptr) {
      note_keys(*curve, track);
      places = vectors_at(*curve, motion_.grid.times);
    }
    for (std::size_t f = 0; f < places.size(); ++f) {
      const Vec3 place = track.to_take(places[f], f);
      if (!std::isfinite(place.x + place.y + place.z))
        throw gltf_error(file_, "nodes", track.node, "its place is not finite");
      take.position(f, m) = place;
      const bool was_held = curve != nullptr && track.has_key_each_frame && !curve->held.empty() &&
                            curve->held[f] != 0;
      take.observed[f * nodes_.size() + m] = was_held ? 0 : 1;
    }
    motion_.tracks.push_back(std::move(track));
  }

  // A marker with scale 0 is missing.
  void add_presence(std::size_t m) {
    GltfTrack track = track_of(m, GltfPath::scale);
    Take& take = motion_.take;
    if (const GltfCurve* const curve = curves_.curve(track.channel)) {
      note_keys(*curve, track);
      const std::vector<Vec3> sizes = vectors_at(*curve, motion_.grid.times);
      for (std::size_t f = 0; f < sizes.size(); ++f) {
        if (sizes[f] == Vec3{}) take.observed[f * nodes_.size() + m] = 0;
      }
    }
    for (std::size_t f = 0; f < take.frame_count(); ++f) {
      if (!take.is_observed(f, m)) take.position(f, m) = {};
    }
    motion_.tracks.push_back(std::move(track));
  }
};

}  // namespace

GltfMotion decode_gltf(const GltfFile& file, const GltfModel& model, GltfBuffers& buffers,
                       std::size_t animation, double rate_hz) {
  std::vector<std::size_t> markers = gltf_markers(model, animation);
  if (markers.empty()) return GltfJointDecoder(file, model, buffers, animation, rate_hz).decode();
  return GltfMarkerDecoder(file, model, buffers, animation, rate_hz, std::move(markers)).decode();
}

Vec3 GltfTrack::to_take(Vec3 translation, std::size_t frame) const {
  return origin + rotate(outer, scaled(scale_at(frame), translation));
}

Vec3 GltfTrack::to_file(Vec3 position, std::size_t frame, const std::string& name) const {
  const Vec3 s = scale_at(frame), v = rotate(conjugate(outer), position - origin);
  const Vec3 translation{v.x / s.x, v.y / s.y, v.z / s.z};
  if (std::isfinite(translation.x + translation.y + translation.z)) return translation;
  throw Error(ErrorKind::usage,
              fmt::format("node {}: it cannot be moved, because a node above it has a scale of 0",
                          quote(name)));
}

}  // namespace kinemend
