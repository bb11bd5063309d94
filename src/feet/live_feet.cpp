// Detects standing feet from the frames so far, and moves legs in closed form.
#include "feet/live_feet.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/frame_span.hpp"
#include "base/portable.hpp"
#include "feet/leg_solver.hpp"

namespace kinemend::feet {

namespace {

// The speed of a point is measured over this time, which reduces noise compared with one frame.
constexpr double speed_s = 0.07;
// The floor is the lowest level within this time.
constexpr double floor_s = 2;
// A larger correction, relative to the body's height, is not a slide.
constexpr double most_offset = 0.1;
// The time in which a correction fades to a third once the foot lifts. The swing hides it; a faster
// fade makes the knee pop.
constexpr double fade_s = 0.15;
// The time in which a correction follows the foot. Following every jitter of a nearly straight leg
// makes the knee pop. Chosen on the takes of docs/measured/live.md.
constexpr double follow_s = 0.015;
// As `FeetSettings::soft_reach`: more than offline, because the root does not move.
constexpr double soft_reach = 0.04;

std::array<Vec3, 2> places_of(const LegPose& pose, const LegModel& model) {
  const Vec3 heel = model.has[0] ? pose.sole_at(model, FootPart::heel) : pose.ankle_at;
  return {heel, model.has[1] ? pose.sole_at(model, FootPart::toe) : heel};
}

// Returns the mean of `count` places from `first` on.
Vec3 mean_place(const std::deque<Vec3>& path, std::size_t first, std::size_t count) {
  Vec3 sum;
  for (std::size_t i = first; i < first + count; ++i) sum += path[i];
  return (1.0 / static_cast<double>(count)) * sum;
}

}  // namespace

LiveFeet::LiveFeet(const Take& like) : legs_(find_legs(like.skeleton)) {
  one_.skeleton = like.skeleton;
  one_.frame_rate_hz = like.frame_rate_hz;
  one_.translated_joints = like.translated_joints;
  one_.rotations.resize(like.joint_count());
  one_.positions.resize(like.point_count());
  if (legs_.empty()) return;
  motion_ = leg_motion(one_, legs_);
  feet_.resize(legs_.size());
}

void LiveFeet::hold(std::vector<Quat>& rotations, const std::vector<Vec3>& positions) {
  if (feet_.empty()) return;
  one_.rotations = rotations;
  one_.positions = positions;
  update_poses(one_, legs_, motion_);
  if (!up_) start();
  if (!up_) return;
  if (estimate_) estimate();
  for (std::size_t l = 0; l < feet_.size(); ++l) {
    Foot& foot = feet_[l];
    const LegPose& pose = motion_.pose(0, l);
    const LegModel& model = motion_.models[l];
    const std::array<Vec3, parts> places = places_of(pose, model);
    for (std::size_t p = 0; p < parts; ++p) track(foot.at[p], places[p], along(places[p], *up_));
    move(foot);
    if (!(norm(foot.offset) > 1e-6 * motion_.height)) continue;
    FootTarget target;
    target.moves = true;
    target.hold = 1;
    target.rotation = pose.ankle;
    target.place = pose.ankle_at + foot.offset;
    const LegRotations solved = solve_leg(pose, model, target, {}, soft_reach);
    rotations[model.hip.index] = align_hemisphere(solved.hip, rotations[model.hip.index]);
    rotations[model.knee.index] = align_hemisphere(solved.knee, rotations[model.knee.index]);
    rotations[model.ankle.index] = align_hemisphere(solved.ankle, rotations[model.ankle.index]);
  }
}

// The direction that is up is found in the first frame in which the body shows it.
void LiveFeet::start() {
  up_ = up_of(motion_, std::nullopt);
  if (!up_) return;
  set_heels(one_, *up_, motion_);
  const bool has_toes = std::all_of(motion_.models.begin(), motion_.models.end(),
                                    [](const LegModel& model) { return model.has[1]; });
  const bool is_fast = motion_.frame_rate_hz >= least_contact_rate_hz;
  network_ = has_toes && is_fast ? shipped_contact_network(Lookahead::none) : nullptr;
  if (network_ == nullptr) return;
  estimate_.emplace(
      Estimate{LiveContactSteps(feet_.size(), motion_.frame_rate_hz, motion_.height, *up_),
               LiveContactNetwork(*network_, feet_.size()),
               std::vector<float>(feet_.size() * contact_features)});
}

void LiveFeet::estimate() {
  std::vector<Vec3> places;
  for (std::size_t l = 0; l < feet_.size(); ++l) {
    for (const Vec3 place : places_of(motion_.pose(0, l), motion_.models[l]))
      places.push_back(place);
  }
  estimate_->steps.push(places, motion_.hips_at(0));
  while (estimate_->steps.next_step(estimate_->rows)) {
    const std::span<const float> odds = estimate_->network.run(estimate_->rows);
    for (std::size_t i = 0; i < odds.size(); ++i) feet_[i / parts].at[i % parts].odds = odds[i];
  }
}

void LiveFeet::track(Part& part, Vec3 place, double height) const {
  const std::size_t reach = frames_in(speed_s, motion_.frame_rate_hz, 1);
  part.path.push_back(place);
  if (part.path.size() > reach + 1) part.path.pop_front();
  if (estimate_) return;  // only thresholds ask for level and speed
  part.heights.push_back(height);
  if (part.heights.size() > frames_in(floor_s, motion_.frame_rate_hz, 1)) part.heights.pop_front();
  part.level = *std::min_element(part.heights.begin(), part.heights.end());
  // The travel is measured between thirds at both ends, so that single frames add less noise.
  const std::size_t third = std::max<std::size_t>(1, part.path.size() / 3);
  const double apart = static_cast<double>(part.path.size() - third) / motion_.frame_rate_hz;
  const Vec3 travel =
      mean_place(part.path, part.path.size() - third, third) - mean_place(part.path, 0, third);
  part.speed =
      apart > 0 && part.path.size() > reach ? norm(travel) / (apart * motion_.height) : HUGE_VAL;
}

// Returns the part that most likely stands, with a margin in favour of the held one.
int LiveFeet::likely_anchor_of(const Foot& foot) const {
  // Logarithms of odds. Chosen by hand, not swept.
  constexpr double begin = 0.5, keep = -0.5, margin = 1;
  int best = -1;
  double best_odds = -HUGE_VAL;
  for (int p = 0; p < static_cast<int>(parts); ++p) {
    const double own = foot.at[static_cast<std::size_t>(p)].odds;
    if (own < (foot.anchor >= 0 ? keep : begin)) continue;
    const double odds = foot.anchor == p ? own + margin : own;
    if (odds <= best_odds) continue;
    best = p;
    best_odds = odds;
  }
  return best;
}

// Returns the standing part: the slower one, with a margin in favour of the held one.
int LiveFeet::anchor_of(const Foot& foot) const {
  if (estimate_) return likely_anchor_of(foot);
  const ContactSettings settings;
  int best = -1;
  double best_speed = HUGE_VAL;
  for (int p = 0; p < static_cast<int>(parts); ++p) {
    const Part& part = foot.at[static_cast<std::size_t>(p)];
    const bool is_held = foot.anchor == p;
    const double height = (part.heights.back() - part.level) / motion_.height;
    if (height > (foot.anchor >= 0 ? settings.keep_height : settings.begin_height)) continue;
    if (part.speed > (foot.anchor >= 0 ? settings.keep_speed : settings.begin_speed)) continue;
    const double speed = is_held ? 0.5 * part.speed : part.speed;
    if (speed >= best_speed) continue;
    best = p;
    best_speed = speed;
  }
  return best;
}

void LiveFeet::move(Foot& foot) const {
  const int anchor = anchor_of(foot);
  if (anchor >= 0) {
    const Vec3 place = foot.at[static_cast<std::size_t>(anchor)].path.back();
    if (anchor != foot.anchor) foot.target = place + foot.offset;
    const Vec3 wanted = level_part(foot.target - place, *up_);
    const double share = 1 - portable::exp(-1 / (follow_s * motion_.frame_rate_hz));
    foot.offset = foot.offset + share * (wanted - foot.offset);
    const double length = norm(foot.offset), most = most_offset * motion_.height;
    if (length > most) {
      foot.offset = (most / length) * foot.offset;
      foot.target = place + foot.offset;
    }
  } else {
    const double fade = portable::exp(-1 / (fade_s * motion_.frame_rate_hz));
    foot.offset = fade * foot.offset;
  }
  foot.anchor = anchor;
}

}  // namespace kinemend::feet
