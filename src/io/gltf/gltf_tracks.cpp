// Gathers the curves of an animation by node, and bounds the memory of a take.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/quote.hpp"
#include "io/gltf/gltf_matrix.hpp"
#include "io/gltf/gltf_motion.hpp"
#include "io/memory_limit.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

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

GltfCurves::GltfCurves(const GltfFile& file, const GltfModel& model, GltfBuffers& buffers,
                       std::size_t animation, const std::vector<std::uint8_t>& wanted)
    : channels_(3 * model.nodes.size(), GltfTrack::none) {
  if (animation == GltfTrack::none) return;
  const GltfAnimation& chosen = model.animations[animation];
  curves_.resize(chosen.channels.size());
  GltfClocks clocks;
  std::size_t read = 0;
  for (std::size_t c = 0; c < chosen.channels.size(); ++c) {
    const GltfChannel& channel = chosen.channels[c];
    paths_.push_back(channel.path);
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
    // Channels may share a sampler; the memory of each is counted.
    read += curves_[c].keys() * (curves_[c].parts() + 1) * sizeof(double);
    check_gltf_memory(file, buffers, 1, read);
  }
}

std::size_t GltfCurves::channel(std::size_t node, GltfPath path) const {
  return channels_[3 * node + static_cast<std::size_t>(path)];
}

const GltfCurve* GltfCurves::curve(std::size_t channel) const {
  return channel == GltfTrack::none ? nullptr : &curves_[channel];
}

std::vector<const GltfCurve*> GltfCurves::moving_curves() const {
  std::vector<const GltfCurve*> curves;
  for (std::size_t c = 0; c < curves_.size(); ++c) {
    if (curves_[c].keys() > 0 && paths_[c] != GltfPath::scale) curves.push_back(&curves_[c]);
  }
  return curves;
}

void note_gltf_keys(const GltfCurve& curve, GltfTrack& track, GltfMotion& motion) {
  track.has_key_each_frame = has_key_each_frame(curve, motion.grid.times);
  if (!track.has_key_each_frame && !is_constant(curve)) ++motion.interpolated;
  motion.held_keys += static_cast<std::size_t>(std::count(curve.held.begin(), curve.held.end(), 1));
}

void check_gltf_memory(const GltfFile& file, const GltfBuffers& buffers, std::size_t frames,
                       std::size_t bytes_per_frame) {
  const double needed = static_cast<double>(frames) * static_cast<double>(bytes_per_frame);
  const std::size_t bytes = file.bytes.size() + buffers.size_beside();
  if (needed <= static_cast<double>(memory_limit(bytes))) return;
  throw Error::at_byte(file.name, file.json.begin,
                       fmt::format("{} frames of {} bytes: too much memory for a file of {} bytes",
                                   frames, bytes_per_frame, bytes));
}

}  // namespace kinemend
