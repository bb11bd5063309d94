// The bytes are a take, and their hash selects changes. A written file must read back as the
// written clip in any layout, and unchanged samples must keep their exact value.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "kinemend/error.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/io.hpp"
#include "laws.hpp"

namespace {

using namespace kinemend;

// Positions small enough for four decimals.
bool is_sensible(const Take& clip) {
  const auto sensible = [](Vec3 v) { return norm(v) < 1e6; };
  return std::all_of(clip.positions.begin(), clip.positions.end(), sensible);
}

// `source`, unless null, holds values that the clip must keep exactly where it is equal.
void check_round_trip(const Take& clip, const Take* source, const std::string& text) {
  const Take again = read_joints(text, "again.bvh").take;
  again.validate();
  check(again.frame_count() == clip.frame_count() && again.joint_count() == clip.joint_count());
  if (!is_sensible(clip)) return;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      const Quat now = clip.rotation(f, j);
      if (source != nullptr && now == source->rotation(f, j)) {
        check(again.rotation(f, j) == now || !clip.observed.empty());
      } else if (clip.skeleton.rotation_order(j).count == 3) {
        check(angle_between(again.rotation(f, j), now) < 1e-4);
      }
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes = text_of(data, size);
  std::uint64_t seed = 14695981039346656037u;
  for (const char byte : bytes) seed = (seed ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  Take clip;
  try {
    clip = read_joints(bytes, "fuzz.bvh").take;
  } catch (const Error&) {
    return 0;
  }
  const Take source = clip;
  Random random(seed);
  const double share = random.uniform(), size_rad = std::pow(10.0, random.uniform(-6, 0.5));
  for (Quat& q : clip.rotations) {
    if (!random.chance(share)) continue;
    q = normalized(q * exp({size_rad * random.normal(), size_rad * random.normal(),
                            size_rad * random.normal()}));
  }
  if (random.chance(0.3)) {
    for (std::size_t f = 0; f < clip.frame_count(); ++f)
      clip.root_position(f) += {0.5, 0.25, -0.125};
  }
  check_round_trip(clip, &source, write_take(clip));
  if (random.chance(0.2) && clip.frame_count() > 0) {
    clip.source.document.reset();
    try {
      check_round_trip(clip, nullptr, write_take(clip));
    } catch (const Error& error) {
      // The plain layout refuses motion that no channel can hold.
      check(error.kind() == ErrorKind::usage);
    }
  }
  return 0;
}
