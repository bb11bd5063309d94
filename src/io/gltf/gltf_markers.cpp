// Reads files of markers made by this project's writer.
#include <algorithm>
#include <cmath>
#include <utility>

#include "io/gltf/gltf_model.hpp"
#include "io/gltf/gltf_motion.hpp"
#include "kinemend/error.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

namespace {

std::size_t marker_group(const GltfModel& model) {
  for (const std::size_t root : model.roots) {
    if (model.nodes[root].name == "markers") return root;
  }
  return GltfTrack::none;
}

class GltfMarkerDecoder {
 public:
  GltfMarkerDecoder(const GltfFile& file, const GltfModel& model, GltfBuffers& buffers,
                    std::size_t animation, double rate_hz)
      : file_(file),
        model_(model),
        markers_(gltf_markers(model, animation)),
        curves_(file, model, buffers, animation, wanted()) {
    motion_.animation = animation;
    motion_.grid = grid_of_curves(curves_.moving_curves(), rate_hz);
    check_gltf_memory(file, buffers, motion_.grid.times.count,
                      markers_.size() * (2 * sizeof(Vec3) + 1));
  }

  GltfMotion decode() {
    std::vector<std::string> names;
    for (const std::size_t node : markers_) names.push_back(model_.nodes[node].name);
    motion_.take =
        make_marker_take(std::move(names), motion_.grid.times.count, motion_.grid.times.rate_hz);
    motion_.take.unit = std::string("m");
    for (std::size_t m = 0; m < markers_.size(); ++m) {
      add_places(m);
      add_presence(m);
    }
    for (const std::size_t node : curves_.repeated())
      motion_.repeated.push_back(name_of_node(model_, node));
    return std::move(motion_);
  }

 private:
  std::vector<std::uint8_t> wanted() const {
    std::vector<std::uint8_t> wanted(model_.nodes.size());
    for (const std::size_t node : markers_) wanted[node] = 1;
    return wanted;
  }

  GltfTrack track_of(std::size_t marker, GltfPath path) const {
    const GltfNode& group = model_.nodes[marker_group(model_)];
    GltfTrack track;
    track.owner = marker;
    track.node = markers_[marker];
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
      note_gltf_keys(*curve, track, motion_);
      places = vectors_at(*curve, motion_.grid.times);
    }
    for (std::size_t f = 0; f < places.size(); ++f) {
      const Vec3 place = track.to_take(places[f], f);
      if (!std::isfinite(place.x + place.y + place.z))
        throw gltf_error(file_, "nodes", track.node, "its place is not finite");
      take.position(f, m) = place;
      const bool was_held = curve != nullptr && track.has_key_each_frame && !curve->held.empty() &&
                            curve->held[f] != 0;
      take.observed[f * markers_.size() + m] = was_held ? 0 : 1;
    }
    motion_.tracks.push_back(std::move(track));
  }

  // A marker with scale 0 is missing.
  void add_presence(std::size_t m) {
    GltfTrack track = track_of(m, GltfPath::scale);
    Take& take = motion_.take;
    if (const GltfCurve* const curve = curves_.curve(track.channel)) {
      note_gltf_keys(*curve, track, motion_);
      const std::vector<Vec3> sizes = vectors_at(*curve, motion_.grid.times);
      for (std::size_t f = 0; f < sizes.size(); ++f) {
        if (sizes[f] == Vec3{}) take.observed[f * markers_.size() + m] = 0;
      }
    }
    for (std::size_t f = 0; f < take.frame_count(); ++f) {
      if (!take.is_observed(f, m)) take.position(f, m) = {};
    }
    motion_.tracks.push_back(std::move(track));
  }

  const GltfFile& file_;
  const GltfModel& model_;
  std::vector<std::size_t> markers_;
  GltfCurves curves_;
  GltfMotion motion_;
};

}  // namespace

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

GltfMotion decode_gltf_markers(const GltfFile& file, const GltfModel& model, GltfBuffers& buffers,
                               std::size_t animation, double rate_hz) {
  return GltfMarkerDecoder(file, model, buffers, animation, rate_hz).decode();
}

}  // namespace kinemend
