// Passes a sequence to the damages of the room damage and bridges the samples that are lost.
#include "lab/samples/sequence_damage.hpp"

#include <utility>

#include "base/portable.hpp"
#include "kinemend/extend/signal.hpp"

namespace kinemend {

DamageReport damage_sequence(const BodyLayout& layout, double rate_hz, PoseMatrix& poses,
                             std::vector<std::uint8_t>& observed, std::string_view name,
                             const OptionValues& values, Random& random) {
  const bool is_joints = layout.kind == BodyKind::joints;
  const std::size_t tracks = poses.channels / 3;
  VectorMotion motion;
  motion.names = layout.names;
  if (tracks > layout.track_count()) motion.names.emplace_back("place");
  motion.is_rotation.assign(tracks, 0);
  motion.is_root.assign(tracks, 0);
  for (std::size_t n = 0; n < tracks; ++n) {
    const bool is_place = n >= layout.track_count();
    motion.is_rotation[n] = is_joints && !is_place ? 1 : 0;
    motion.is_root[n] = is_joints && (is_place || layout.parents[n] < 0) ? 1 : 0;
  }
  motion.frame_rate_hz = rate_hz;
  motion.per_radian = degrees_per_radian;
  motion.values = poses;
  motion.observed = observed;
  if (observed.empty()) motion.observed.assign(poses.frames * tracks, 1);
  DamageReport report = apply_damage(motion, name, values, random);
  poses = std::move(motion.values);
  observed = std::move(motion.observed);
  return report;
}

void bridge_lost(PoseMatrix& poses, const std::vector<std::uint8_t>& observed) {
  if (observed.empty()) return;
  const std::size_t tracks = poses.channels / 3;
  std::vector<std::uint8_t> missing(poses.values.size());
  for (std::size_t f = 0; f < poses.frames; ++f) {
    for (std::size_t c = 0; c < poses.channels; ++c)
      missing[f * poses.channels + c] = observed[f * tracks + c / 3] == 0 ? 1 : 0;
  }
  fill_linear(poses, missing);
}

double log_uniform(Random& random, double low, double high) {
  return portable::exp(random.uniform(portable::log(low), portable::log(high)));
}

}  // namespace kinemend
