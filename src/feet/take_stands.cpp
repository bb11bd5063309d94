// Finds the feet of a take of joints or of markers, and the times in which they stand.

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/frame_span.hpp"
#include "feet/body_points.hpp"
#include "feet/clean_legs.hpp"
#include "feet/contacts.hpp"
#include "feet/ground_times.hpp"
#include "feet/leg_motion.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/feet.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace feet {

namespace {

// Contacts of legs that have a floor under them, in frames of the take.
struct StandsOfJoints {
  std::vector<Leg> legs;
  FoundContacts found;
  std::vector<GroundTime> ground;
};

StandsOfJoints stands_of_joints(const Take& clip, const ContactSettings& settings) {
  StandsOfJoints stands;
  const std::size_t first = leading_calibration_frames(clip);
  std::optional<Take> part;
  const Take& motion = frames_from(clip, first, part);
  stands.legs = find_legs(clip.skeleton);
  LegMotion legs = leg_motion(motion, stands.legs);
  const std::optional<Up> up = up_of(legs, settings.up);
  if (!up) return {};
  set_heels(motion, *up, legs);
  const Soles soles = find_soles(legs, *up, settings);
  stands.found = find_contacts(soles, settings);
  stands.ground = ground_times(soles, stands.found.contacts);
  shift_contacts(stands.found.contacts, 0, first);
  for (GroundTime& time : stands.ground) {
    time.first_frame += first, time.last_frame += first;
    const double by_s = static_cast<double>(first) / clip.frame_rate_hz;
    if (time.touch_down_s) *time.touch_down_s += by_s;
    if (time.lift_off_s) *time.lift_off_s += by_s;
  }
  return stands;
}

// Returns the point that is observed most often, the first of several.
std::size_t most_observed_of(const BodyPoints& body, const std::vector<std::size_t>& points) {
  std::vector<std::size_t> counts;
  for (const std::size_t point : points) {
    std::size_t count = 0;
    for (std::size_t f = 0; f < body.frames; ++f) count += body.is_observed(f, point) ? 1 : 0;
    counts.push_back(count);
  }
  return points[static_cast<std::size_t>(std::max_element(counts.begin(), counts.end()) -
                                         counts.begin())];
}

// Returns the path of a point, with straight lines over its gaps.
std::vector<Vec3> marker_path(const BodyPoints& body, std::size_t point) {
  std::vector<Vec3> path(body.frames);
  for (std::size_t f = 0; f < body.frames; ++f) path[f] = body.at(f, point);
  kinemend::bridge(
      body.frames, [&](std::size_t f) { return body.is_observed(f, point); },
      [&](std::size_t f) -> Vec3& { return path[f]; });
  return path;
}

// Returns the middle of the pelvis; of all markers if none is on the pelvis.
std::vector<Vec3> middle_path(const BodyPoints& body) {
  if (body.pelvis.empty()) return body.centres;
  std::vector<Vec3> middle(body.frames);
  for (const std::size_t point : body.pelvis) {
    const std::vector<Vec3> path = marker_path(body, point);
    for (std::size_t f = 0; f < body.frames; ++f)
      middle[f] += (1 / static_cast<double>(body.pelvis.size())) * path[f];
  }
  return middle;
}

// The feet of one person that have a marker at either end.
struct MarkerFeet {
  std::vector<const Foot*> feet;
  std::vector<std::array<std::size_t, 2>> points;  // by `FootPart`
};

MarkerFeet feet_with_both_ends(const BodyPoints& body) {
  MarkerFeet result;
  for (const Foot& foot : body.feet) {
    if (foot.parts[0].empty() || foot.parts[1].empty()) continue;
    result.feet.push_back(&foot);
    result.points.push_back(
        {most_observed_of(body, foot.parts[0]), most_observed_of(body, foot.parts[1])});
  }
  return result;
}

BodyPoints heels_and_toes(const BodyPoints& body, const MarkerFeet& feet) {
  BodyPoints soles;
  soles.frames = body.frames;
  soles.points = 2 * feet.points.size();
  soles.frame_rate_hz = body.frame_rate_hz;
  soles.height = body.height;
  soles.centres = middle_path(body);
  soles.positions.resize(soles.frames * soles.points);
  soles.observed.resize(soles.positions.size());
  for (std::size_t p = 0; p < soles.points; ++p) {
    const std::size_t point = feet.points[p / 2][p % 2];
    const std::vector<Vec3> path = marker_path(body, point);
    for (std::size_t f = 0; f < soles.frames; ++f) {
      soles.positions[f * soles.points + p] = path[f];
      soles.observed[f * soles.points + p] = body.is_observed(f, point) ? 1 : 0;
    }
  }
  return soles;
}

// "left foot" becomes "left", after the name of the person.
std::string side_of_foot(const Foot& foot, const Subject& subject) {
  const std::string side = foot.name.substr(0, foot.name.find(' '));
  return subject.name.empty() ? side : subject.name + " " + side;
}

// Adds the feet of one person and returns what `FoundContacts::expected_s` says of them.
std::optional<double> add_stands(const Take& clip, const Subject& subject, double metres_per_unit,
                                 const ContactSettings& settings, const KnownNames& names,
                                 FootStands& stands) {
  // Shorter takes say nothing about contacts. Chosen by hand, not swept.
  constexpr std::size_t fewest_frames = 10;
  const BodyPoints body = body_points(clip, subject.markers, metres_per_unit, names);
  const MarkerFeet feet = feet_with_both_ends(body);
  if (feet.feet.empty() || body.frames < fewest_frames) return 0.0;
  const std::optional<Up> up = settings.up ? Up{*settings.up, 1} : find_up(body);
  if (!up) return 0.0;
  const Soles soles = find_soles(heels_and_toes(body, feet), *up, settings);
  const FoundContacts found = find_contacts(soles, settings);
  const std::size_t first_leg = stands.sides.size();
  for (GroundTime time : ground_times(soles, found.contacts)) {
    time.leg += first_leg;
    stands.ground.push_back(time);
  }
  for (FootContact contact : found.contacts) {
    contact.leg += first_leg;
    stands.contacts.push_back(contact);
  }
  for (std::size_t l = 0; l < feet.feet.size(); ++l) {
    stands.sides.push_back(side_of_foot(*feet.feet[l], subject));
    stands.tracks.push_back(
        {subject.markers[feet.points[l][0]], subject.markers[feet.points[l][1]]});
  }
  return found.expected_s;
}

}  // namespace

}  // namespace feet

std::vector<FootContact> find_contacts(const Take& clip, const ContactSettings& settings) {
  feet::check_settings(settings);
  return feet::stands_of_joints(clip, settings).found.contacts;
}

FootStands find_stands(const Take& take, const ContactSettings& settings, const KnownNames& names,
                       double metres_per_unit) {
  feet::check_settings(settings);
  FootStands stands;
  std::optional<double> expected_s;
  if (take.has_joints()) {
    Take named = take;
    named.skeleton.names = known_names(take.skeleton.names, names);
    feet::StandsOfJoints joints = feet::stands_of_joints(named, settings);
    for (const Leg& leg : joints.legs) {
      stands.sides.push_back(leg.side);
      const auto ankle = static_cast<std::size_t>(leg.ankle);
      stands.tracks.push_back({ankle, leg.toe >= 0 ? static_cast<std::size_t>(leg.toe) : ankle});
    }
    stands.contacts = std::move(joints.found.contacts);
    stands.ground = std::move(joints.ground);
    expected_s = joints.found.expected_s;
  } else {
    const double scale = metres_per_unit > 0 ? metres_per_unit : likely_metres_per_unit(take);
    if (!(scale > 0)) return stands;
    expected_s = 0;
    for (const Subject& subject : subjects_of(take)) {
      const auto own = feet::add_stands(take, subject, scale, settings, names, stands);
      if (expected_s) expected_s = own ? std::optional(*expected_s + *own) : std::nullopt;
    }
  }
  if (stands.sides.empty()) return stands;
  stands.time = feet::standing_time(stands.contacts, expected_s, take.frame_count(),
                                    stands.sides.size(), take.frame_rate_hz);
  return stands;
}

}  // namespace kinemend
