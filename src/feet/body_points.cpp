// Finds legs and feet by the names of joints and markers and by the tree of joints, and the axis
// along which a body is above its feet.
#include "feet/body_points.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/take.hpp"
#include "motion/take.hpp"

namespace kinemend::feet {

double along(Vec3 v, Up up) {
  return up.sign * (up.axis == Axis::x ? v.x : up.axis == Axis::y ? v.y : v.z);
}

Vec3 level_part(Vec3 v, Up up) {
  (up.axis == Axis::x ? v.x : up.axis == Axis::y ? v.y : v.z) = 0;
  return v;
}

std::optional<Up> find_up(const BodyPoints& body) {
  // The least ratio of the distance from feet to the body's middle along one axis to that along any
  // other. Chosen by hand, not swept.
  constexpr double clear_ratio = 2;
  Vec3 sum;
  for (std::size_t f = 0; f < body.frames; ++f) {
    for (const Foot& foot : body.feet) {
      const std::size_t point = foot.points.front();
      if (body.is_observed(f, point)) sum += body.centres[f] - body.at(f, point);
    }
  }
  std::array<std::pair<double, Up>, 3> axes{
      {{std::fabs(sum.x), {Axis::x, sum.x < 0 ? -1.0 : 1.0}},
       {std::fabs(sum.y), {Axis::y, sum.y < 0 ? -1.0 : 1.0}},
       {std::fabs(sum.z), {Axis::z, sum.z < 0 ? -1.0 : 1.0}}}};
  std::sort(axes.begin(), axes.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  if (!(axes[0].first > clear_ratio * axes[1].first)) return std::nullopt;
  return axes[0].second;
}

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
  const std::vector<std::size_t> children = child_counts(skeleton);
  const auto found =
      std::find_if(children.begin(), children.end(), [](std::size_t count) { return count > 1; });
  return found == children.end() ? 0 : static_cast<std::size_t>(found - children.begin());
}

// Returns the uppermost joint of each foot, of those named after parts of a foot (`foot_joints`).
std::vector<std::size_t> ankles_of(const Skeleton& skeleton) {
  const std::vector<std::size_t> named = foot_joints(skeleton);
  std::vector<std::size_t> ankles;
  for (const std::size_t joint : named) {
    bool is_upper = true;
    for (std::int32_t p = skeleton.parents[joint]; p >= 0;
         p = skeleton.parents[static_cast<std::size_t>(p)]) {
      is_upper = is_upper &&
                 std::find(named.begin(), named.end(), static_cast<std::size_t>(p)) == named.end();
    }
    if (is_upper) ankles.push_back(joint);
  }
  return ankles;
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

using Fragments = std::span<const std::string_view>;

bool has_any(std::string_view name, Fragments fragments) {
  return std::any_of(fragments.begin(), fragments.end(), [&](std::string_view fragment) {
    return name.find(fragment) != std::string_view::npos;
  });
}

// Parts of the names of markers, in capitals.
constexpr std::array<std::string_view, 3> heel_names{"HEE", "FCC", "CALC"};
constexpr std::array<std::string_view, 8> toe_names{"TOE", "MT1", "MT2", "MT5",
                                                    "MTP", "FM1", "FM5", "MET"};
constexpr std::array<std::string_view, 6> pelvis_names{"ASI", "PSI", "SACR", "FWT", "BWT", "PELV"};
constexpr std::array<std::string_view, 1> not_of_feet{"HELMET"};

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
      if (!on_side || has_any(marker, not_of_feet)) continue;
      const bool is_heel = has_any(marker, heel_names);
      if (!is_heel && !has_any(marker, toe_names)) continue;
      foot.points.push_back(i);
      foot.parts[is_heel ? 0 : 1].push_back(i);
    }
    if (!foot.points.empty()) feet.push_back(std::move(foot));
  }
  return feet;
}

std::vector<std::size_t> pelvis_of(const Take& clip, const std::vector<std::size_t>& markers,
                                   const KnownNames& names) {
  const std::vector<std::string> known = known_names(clip.names, names);
  std::vector<std::size_t> pelvis;
  for (std::size_t i = 0; i < markers.size(); ++i) {
    if (has_any(upper_case(without_subject(known[markers[i]])), pelvis_names)) pelvis.push_back(i);
  }
  return pelvis;
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
  body.pelvis = pelvis_of(clip, markers, names);
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
  body.height = usual_height_m;
  return body;
}

}  // namespace kinemend::feet

namespace kinemend {

namespace {

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

// Returns "left", "right", or nothing.
std::string_view side_of(const std::string& joint) {
  const std::string name = lower_case(without_subject(joint));
  if (has(name, "left")) return "left";
  if (has(name, "right")) return "right";
  const auto marked = [&](char letter) {
    for (std::size_t i = 0; i < name.size(); ++i) {
      if (name[i] != letter) continue;
      const bool opens = i == 0 || name[i - 1] == '_' || name[i - 1] == '.' || name[i - 1] == ' ';
      const bool closes =
          i + 1 == name.size() || name[i + 1] == '_' || name[i + 1] == '.' || name[i + 1] == ' ';
      if (opens && closes) return true;
    }
    return false;
  };
  if (marked('l')) return "left";
  if (marked('r')) return "right";
  // The short forms of LeftFoot and RightAnkle are lfoot and rAnkle.
  if (name.size() > 1 && (has(name, "foot") || has(name, "ankle"))) {
    if (name.front() == 'l') return "left";
    if (name.front() == 'r') return "right";
  }
  return "";
}

// Returns the joint at the other end of the bone above `joint`; -1 if no bone is above it.
std::int32_t upper_end(const Skeleton& skeleton, std::int32_t joint, double shortest) {
  double length = 0;
  std::int32_t at = joint;
  while (skeleton.parents[static_cast<std::size_t>(at)] >= 0) {
    length += norm(skeleton.offsets[static_cast<std::size_t>(at)]);
    at = skeleton.parents[static_cast<std::size_t>(at)];
    const std::string name = lower_case(skeleton.names[static_cast<std::size_t>(at)]);
    const bool is_part_of_bone = has(name, "twist") || has(name, "roll");
    if (length >= shortest && !is_part_of_bone) return at;
  }
  return -1;
}

// Returns the child of the ankle that is named after a toe, else the farthest one.
std::int32_t toe_of(const Skeleton& skeleton, std::int32_t ankle, double shortest) {
  std::int32_t found = -1;
  double farthest = shortest;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    if (skeleton.parents[j] != ankle) continue;
    const std::string name = lower_case(skeleton.names[j]);
    if (has(name, "heel")) continue;
    double distance = norm(skeleton.offsets[j]);
    if (distance < shortest) continue;
    if (has(name, "toe") || has(name, "ball")) distance *= 10;
    if (distance <= farthest) continue;
    farthest = distance;
    found = static_cast<std::int32_t>(j);
  }
  return found;
}

void name_sides(const Skeleton& skeleton, std::vector<Leg>& legs) {
  for (Leg& leg : legs) leg.side = side_of(skeleton.names[static_cast<std::size_t>(leg.ankle)]);
  std::vector<std::string> sides;
  sides.reserve(legs.size());
  for (const Leg& leg : legs) sides.push_back(leg.side);
  for (Leg& leg : legs) {
    if (leg.side.empty() || std::count(sides.begin(), sides.end(), leg.side) > 1)
      leg.side = skeleton.names[static_cast<std::size_t>(leg.ankle)];
  }
}

}  // namespace

std::vector<Leg> find_legs(const Skeleton& skeleton) {
  // A shorter bone is a twist joint, and a shorter foot is rejected. Chosen by hand, not swept.
  constexpr double shortest_bone = 0.08, shortest_foot = 0.02;  // body heights
  const double height = body_height(skeleton);
  std::vector<Leg> legs;
  if (!(height > 0)) return legs;
  for (const std::size_t ankle : feet::ankles_of(skeleton)) {
    Leg leg;
    leg.ankle = static_cast<std::int32_t>(ankle);
    leg.knee = upper_end(skeleton, leg.ankle, shortest_bone * height);
    if (leg.knee < 0) continue;
    leg.hip = upper_end(skeleton, leg.knee, shortest_bone * height);
    if (leg.hip < 0) continue;
    leg.toe = toe_of(skeleton, leg.ankle, shortest_foot * height);
    legs.push_back(std::move(leg));
  }
  // A joint that turns two legs is not a hip.
  const std::vector<Leg> all = legs;
  legs.erase(std::remove_if(legs.begin(), legs.end(),
                            [&](const Leg& leg) {
                              return std::count_if(all.begin(), all.end(), [&](const Leg& other) {
                                       return other.hip == leg.hip || other.knee == leg.hip;
                                     }) > 1;
                            }),
             legs.end());
  name_sides(skeleton, legs);
  return legs;
}

}  // namespace kinemend
