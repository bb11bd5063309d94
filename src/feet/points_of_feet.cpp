// Finds the points of a body and its feet, for skeletons and for markers.
#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include "feet/body_points.hpp"
#include "feet/legs.hpp"
#include "kinemend/experimental/kinematics.hpp"
#include "kinemend/metrics.hpp"

namespace kinemend::feet {

namespace {

std::vector<std::size_t> points_below(const Skeleton& skeleton, std::size_t joint) {
  std::vector<std::uint8_t> below(skeleton.joint_count());
  below[joint] = 1;
  std::vector<std::size_t> points;
  for (std::size_t j = joint + 1; j < skeleton.joint_count(); ++j) {
    const std::int32_t parent = skeleton.parents[j];
    if (parent < 0 || below[static_cast<std::size_t>(parent)] == 0) continue;
    below[j] = 1;
    points.push_back(j);
  }
  for (std::size_t e = 0; e < skeleton.end_sites.size(); ++e) {
    if (below[static_cast<std::size_t>(skeleton.end_sites[e].parent)] != 0)
      points.push_back(skeleton.joint_count() + e);
  }
  return points;
}

// Returns the pelvis: the first joint with several children. Some roots stay at the origin, and a
// joint below them carries the body.
std::size_t carrier_of(const Skeleton& skeleton) {
  std::vector<std::size_t> children(skeleton.joint_count());
  for (const std::int32_t parent : skeleton.parents) {
    if (parent >= 0) ++children[static_cast<std::size_t>(parent)];
  }
  const auto found =
      std::find_if(children.begin(), children.end(), [](std::size_t count) { return count > 1; });
  return found == children.end() ? 0 : static_cast<std::size_t>(found - children.begin());
}

// Returns ankles with their descendants, without the ankle itself, which rolls over the foot.
std::vector<Foot> feet_of(const Skeleton& skeleton, const KnownNames& names) {
  std::vector<Foot> feet;
  Skeleton known = skeleton;
  known.names = known_names(skeleton.names, names);
  for (const std::size_t ankle : ankles_of(known)) {
    Foot foot{skeleton.names[ankle], points_below(skeleton, ankle)};
    if (foot.points.empty()) foot.points.push_back(ankle);
    feet.push_back(std::move(foot));
  }
  return feet;
}

bool names_a_sole(std::string_view name) {
  static constexpr std::array<std::string_view, 12> fragments{
      "TOE", "HEE", "MT1", "MT2", "MT5", "MTP", "FM1", "FM5", "FCC", "CALC", "MET1", "MET5"};
  return std::any_of(fragments.begin(), fragments.end(),
                     [&](std::string_view fragment) { return name.find(fragment) != name.npos; });
}

std::string upper_case(std::string_view name) {
  std::string upper(name);
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return upper;
}

std::vector<Foot> feet_of(const Take& clip, const std::vector<std::size_t>& markers,
                          const KnownNames& names) {
  std::vector<Foot> feet;
  const std::vector<std::string> known = known_names(clip.names, names);
  for (const auto& [letter, word, name] :
       {std::tuple('L', "LEFT", "left foot"), std::tuple('R', "RIGHT", "right foot")}) {
    Foot foot{name, {}};
    for (std::size_t i = 0; i < markers.size(); ++i) {
      const std::string marker = upper_case(without_subject(known[markers[i]]));
      const bool on_side =
          !marker.empty() && (marker.front() == letter || marker.find(word) != std::string::npos);
      if (on_side && names_a_sole(marker)) foot.points.push_back(i);
    }
    if (!foot.points.empty()) feet.push_back(std::move(foot));
  }
  return feet;
}

}  // namespace

BodyPoints body_points(const Take& clip, double metres_per_unit, const KnownNames& names) {
  BodyPoints body;
  body.frames = clip.frame_count();
  body.points = clip.joint_count() + clip.skeleton.end_sites.size();
  body.frame_rate_hz = clip.frame_rate_hz;
  body.feet = feet_of(clip.skeleton, names);
  body.height = metres_per_unit * body_height(clip.skeleton);
  if (body.feet.empty()) return body;
  body.positions = joint_positions(clip, true);
  for (Vec3& p : body.positions) p = metres_per_unit * p;
  const std::size_t carrier = carrier_of(clip.skeleton);
  for (std::size_t f = 0; f < body.frames; ++f) body.centres.push_back(body.at(f, carrier));
  return body;
}

BodyPoints body_points(const Take& clip, const std::vector<std::size_t>& markers,
                       double metres_per_unit, const KnownNames& names) {
  BodyPoints body;
  body.frames = clip.frame_count();
  body.points = markers.size();
  body.frame_rate_hz = clip.frame_rate_hz;
  body.feet = feet_of(clip, markers, names);
  if (body.feet.empty()) return body;
  for (std::size_t f = 0; f < body.frames; ++f) {
    Vec3 sum;
    std::size_t seen = 0;
    for (const std::size_t m : markers) {
      const Vec3 p = metres_per_unit * clip.position(f, m);
      body.positions.push_back(p);
      body.observed.push_back(clip.is_observed(f, m) ? 1 : 0);
      if (!clip.is_observed(f, m)) continue;
      sum += p;
      ++seen;
    }
    body.centres.push_back((1.0 / static_cast<double>(std::max<std::size_t>(seen, 1))) * sum);
  }
  body.height = 1.7;
  return body;
}

}  // namespace kinemend::feet
