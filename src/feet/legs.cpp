// Finds legs and their sides by names and by the tree of joints.
#include "feet/legs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "kinemend/experimental/letter_case.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/metrics.hpp"

namespace kinemend {

namespace {

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

// Returns "left", "right", or nothing.
std::string_view side_of(const std::string& joint) {
  const std::string name = lower_case(joint.substr(joint.rfind(':') + 1));
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

// Returns the joint at the other end of the bone above `joint`; -1 if there is none.
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

namespace feet {

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

}  // namespace feet

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
