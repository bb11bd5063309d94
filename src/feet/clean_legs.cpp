// The steps that stop foot slide, in the order of Kovar 2002, and `clean_feet` around them.
#include "feet/clean_legs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "feet/contact_smoother.hpp"
#include "feet/floor.hpp"
#include "feet/leg_motion.hpp"
#include "feet/leg_solver.hpp"
#include "kinemend/error.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace feet {

namespace {

// Body heights: smaller changes are rounding; larger remaining slides are reported. The noticeable
// size is chosen by hand, not swept.
constexpr double least_shift = 1e-9, noticeable_rest = 0.002;
constexpr double least_turn_rad = 1e-11;  // rounding
// The error of the root's place, in body heights, for a radian of error of the joints: of a root in
// whose place no noise was found, and of others. Square radians of a joint for a square body height
// of a part, from the mean squares of the levers, with half of the error in the place itself. Times
// for which errors stay similar, in seconds, and rounds of Gauss and Newton. Body heights from the
// common floor within which errors leave standing feet. Chosen on takes that no table uses
// (docs/details/feet.md).
constexpr double root_share = 0.05, noisy_root_share = 0.25, squares_per_part = 5;
constexpr double quick_error_s = 0.05, slow_error_s = 0.2;
constexpr int rounds = 2;
// How far an error of a radian of the joints moves a standing foot, in body heights: smoothing
// removes most of a quick one. Set by hand after a look at the takes of docs/feet.md, not swept.
constexpr double quick_travel = 4, slow_travel = 8;
constexpr double noisy_close_to_floor = 0.03;

void check_settings(const FeetSettings& settings) {
  feet::check_settings(settings.contact);
  const auto check = [](const char* name, double value, double least, double most) {
    if (value >= least && value <= most) return;
    throw Error(ErrorKind::usage,
                fmt::format("feet: {} is {:g}, expected {:g} to {:g}", name, value, least, most));
  };
  check("blend_s", settings.blend_s, 0.02, 1);
  check("soft_reach", settings.soft_reach, 0.001, 0.2);
}

bool may_turn(const LegModel& model, const FeetLimits& limits) {
  return limits.joints.empty() ||
         (limits.joints[model.hip.index] != 0 && limits.joints[model.knee.index] != 0 &&
          limits.joints[model.ankle.index] != 0);
}

// Cleans one motion by the steps in the order of the paper.
class FeetCleaning {
 public:
  FeetCleaning(Take& motion, const FeetSettings& settings, const FeetLimits& limits)
      : clip_(motion), settings_(settings), limits_(limits) {}

  FeetReport run() {
    report_.changed.resize(clip_.rotations.size());
    report_.root_changed.resize(clip_.frame_count());
    if (settings_.mode == FeetMode::off || !find_feet()) return std::move(report_);
    const Soles soles = find_soles(legs_, up_, settings_.contact);
    find_and_judge(soles);
    const std::vector<double> offsets = level_offsets(soles);
    report_.before = figures_of(legs_, report_.contacts, up_, offsets);
    if (std::count(report_.held.begin(), report_.held.end(), 1) == 0) {
      report_.after = report_.before;
      return std::move(report_);
    }
    if (is_noisy_) estimate_errors(soles);
    if (holds_exactly()) hold(is_noisy_ ? find_soles(legs_, up_, settings_.contact) : soles);
    report_.after = figures_of(legs_, report_.contacts, up_, offsets);
    return std::move(report_);
  }

 private:
  bool find_feet() {
    found_ = find_legs(clip_.skeleton);
    for (const Leg& leg : found_) report_.sides.push_back(leg.side);
    report_.metres_per_unit = likely_metres_per_unit(clip_);
    report_.frame_rate_hz = clip_.frame_rate_hz;
    legs_ = leg_motion(clip_, found_);
    if (settings_.contacts) check_contacts(*settings_.contacts, legs_, 0);
    if (found_.empty()) {
      report_.warnings.emplace_back("feet: no legs are known by name; nothing was held");
      return false;
    }
    const std::optional<Up> up = up_of(legs_, settings_.contact.up);
    if (!up) {
      report_.warnings.emplace_back(
          "feet: the body does not tell which way is up; nothing was held");
      return false;
    }
    up_ = *up;
    set_heels(clip_, up_, legs_);
    return true;
  }

  void find_and_judge(const Soles& soles) {
    const FoundContacts found = find_contacts(soles, settings_.contact);
    report_.contacts = settings_.contacts ? *settings_.contacts : found.contacts;
    sort_contacts(report_.contacts);
    const std::size_t count = report_.contacts.size();
    if (settings_.contacts || settings_.mode == FeetMode::force) {
      report_.held.assign(count, 1);
      report_.still.resize(count);
      report_.reasons.resize(count);
    } else {
      Verdicts verdicts = judge(soles, legs_, report_.contacts, 100 * report_.metres_per_unit,
                                (limits_.is_slow ? slow_travel : quick_travel) * limits_.error);
      report_.held = std::move(verdicts.held);
      report_.still = std::move(verdicts.still);
      report_.reasons = std::move(verdicts.reasons);
      is_noisy_ = verdicts.jitters || limits_.is_noisy;
      if (limits_.is_noisy) believe_still_feet();
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (may_turn(legs_.models[report_.contacts[i].leg], limits_)) continue;
      report_.held[i] = report_.still[i] = 0;
      report_.reasons[i] = "hip, knee and ankle may not all turn";
    }
    report_.time = standing_time(report_.contacts, found.expected_s, legs_.frames, legs_.legs(),
                                 legs_.frame_rate_hz);
    const auto seconds = [&](const std::vector<std::uint8_t>& flags) {
      return standing_s(report_.contacts, flags, legs_.frames, legs_.legs(), legs_.frame_rate_hz);
    };
    report_.time.held_s = seconds(report_.held);
    report_.time.still_s = seconds(report_.still);
  }

  // In a noisy take a foot that hardly moves is as good a measurement as any.
  void believe_still_feet() {
    for (std::size_t i = 0; i < report_.contacts.size(); ++i) {
      if (report_.still[i] == 0) continue;
      report_.still[i] = 0;
      report_.held[i] = 1;
      report_.reasons[i].clear();
    }
  }

  // Puts parts in contact exactly at their places.
  void hold(const Soles& soles) {
    std::vector<FootTarget> targets = find_targets(soles);
    move(targets);
    update_poses(clip_, found_, legs_);
    warn_of_rest(targets);
  }

  // Whether every contact is put at one place. In a noisy take the most likely errors already make
  // standing feet nearly still, and more would turn joints without need.
  bool holds_exactly() const {
    return !is_noisy_ || settings_.contacts || settings_.mode == FeetMode::force;
  }

  // Removes the most likely errors of root and legs, which standing feet show.
  void estimate_errors(const Soles& soles) {
    const MotionError error{uncertainty(std::max(limits_.error, joint_deviation(soles))),
                            limits_.is_slow ? slow_error_s : quick_error_s};
    ContactSmoother smoother(legs_, up_, standing_parts(soles), error);
    for (int round = 0; round < rounds; ++round) {
      const std::vector<PoseUpdate> updates = smoother.step(legs_);
      for_blocks(0, legs_.frames, [&](std::size_t first, std::size_t end) {
        for (std::size_t f = first; f < end; ++f) apply(f, updates[f]);
      });
      update_poses(clip_, found_, legs_);
    }
  }

  // Returns the error of the joints, radians per axis, from the movement of standing feet.
  double joint_deviation(const Soles& soles) const {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < report_.contacts.size(); ++i) {
      const FootContact& c = report_.contacts[i];
      if (report_.held[i] == 0) continue;
      const Vec3 place = mean_place(soles, c);
      for (std::size_t f = c.first_frame; f <= c.last_frame; ++f) {
        const Vec3 away = soles.body.at(f, Soles::point_of(c)) - place;
        sum += dot(away, away);
        count += 3;
      }
    }
    return count > 0 ? std::sqrt(squares_per_part * sum / count) / legs_.height : 0;
  }

  // All contacts that are held lie on one floor, if most of them do nearly.
  std::vector<StandingPart> standing_parts(const Soles& soles) const {
    const std::vector<double> offsets = level_offsets(soles);
    std::vector<StandingPart> parts(soles.body.points);
    for (StandingPart& part : parts) {
      part.certainty.resize(legs_.frames);
      part.floor.assign(legs_.frames, std::nan(""));
    }
    std::vector<Vec3> places;
    for (const FootContact& c : report_.contacts)
      places.push_back(mean_place(soles, c) - offsets[Soles::point_of(c)] * up_.direction());
    const std::vector<double> depths = depths_below_floor(
        places, up_, noisy_close_to_floor * legs_.height, legs_.height / usual_height_m);
    for (std::size_t i = 0; i < report_.contacts.size(); ++i) {
      if (report_.held[i] == 0) continue;
      const FootContact& c = report_.contacts[i];
      StandingPart& part = parts[Soles::point_of(c)];
      for (std::size_t f = c.first_frame; f <= c.last_frame; ++f) {
        part.certainty[f] = c.confidence;
        if (!depths.empty() && std::fabs(depths[i]) < 3 * noisy_close_to_floor * legs_.height)
          part.floor[f] = along(places[i], up_) + depths[i] + offsets[Soles::point_of(c)];
      }
    }
    return parts;
  }

  // `deviation`: of the joints, radians.
  PoseUncertainty uncertainty(double deviation) const {
    PoseUncertainty result;
    result.joint_rotation = deviation;
    for (const LegModel& model : legs_.models)
      result.legs.push_back(may_turn(model, limits_) ? 1 : 0);
    const Carrier& carrier = legs_.carrier;
    if (!may_move_carrier() || carrier.track != 0) return result;
    if (clip_.skeleton.rotation_order(carrier.joint).count == 3) result.root_rotation = deviation;
    if (limits_.root_position && clip_.skeleton.channels[carrier.joint].size() >= 6)
      result.root_position =
          (limits_.has_noisy_root ? noisy_root_share : root_share) * legs_.height * deviation;
    return result;
  }

  void apply(std::size_t frame, const PoseUpdate& update) {
    if (update.legs.empty()) return;
    const Carrier& carrier = legs_.carrier;
    if (norm(update.root_shift) > least_shift * legs_.height) {
      clip_.root_position(frame) += rotate(conjugate(carrier.frames_of[frame]), update.root_shift);
      report_.root_changed[frame] = 1;
    }
    const auto turn = [&](const LegJoint& joint, Quat before, Vec3 by) {
      if (norm(by) < least_turn_rad) return;
      Quat& own = clip_.rotation(frame, joint.index);
      const Quat rest = before * joint.rest;
      const Quat turned = normalized(conjugate(rest) * exp(by) * rest * own);
      own = align_hemisphere(within_channels(turned, joint), own);
      report_.changed[frame * clip_.joint_count() + joint.index] = 1;
    };
    if (carrier.found) {
      const Skeleton& skeleton = clip_.skeleton;
      turn({carrier.joint, skeleton.rest_rotations[carrier.joint],
            skeleton.rotation_order(carrier.joint)},
           carrier.frames_of[frame], update.root_turn);
    }
    for (std::size_t l = 0; l < legs_.legs(); ++l) {
      const LegModel& model = legs_.models[l];
      const LegPose& pose = legs_.pose(frame, l);
      turn(model.hip, pose.hip_parent, update.legs[l].hip);
      turn(model.knee, pose.knee_parent, update.legs[l].knee);
      turn(model.ankle, pose.ankle_parent, update.legs[l].ankle);
    }
  }

  std::vector<FootTarget> find_targets(const Soles& soles) const {
    const std::vector<PartCorrection> parts =
        place_contacts(soles, legs_, report_.contacts, report_.held, settings_.blend_s);
    std::vector<FootTarget> targets(legs_.poses.size());
    for_blocks(0, targets.size(), [&](std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i) {
        const std::size_t f = i / legs_.legs(), l = i % legs_.legs();
        targets[i] = foot_target(legs_.poses[i], legs_.models[l], parts[2 * l], parts[2 * l + 1], f,
                                 least_shift * legs_.height);
      }
    });
    return targets;
  }

  // The joint that carries the legs moves all feet, which only legs that may turn can undo.
  bool may_move_carrier() const {
    const Carrier& carrier = legs_.carrier;
    return carrier.found && (limits_.joints.empty() || limits_.joints[carrier.joint] != 0) &&
           std::all_of(legs_.models.begin(), legs_.models.end(),
                       [&](const LegModel& model) { return may_turn(model, limits_); });
  }

  bool may_lower() const {
    if (!may_move_carrier()) return false;
    const Carrier& carrier = legs_.carrier;
    const bool is_root = carrier.track == 0;
    if (!(is_root ? limits_.root_position : limits_.translations)) return false;
    const auto& channels = clip_.skeleton.channels[carrier.joint];
    const auto has = [&](Axis axis) {
      return std::any_of(channels.begin(), channels.end(), [&](Channel channel) {
        return !is_rotation(channel) && axis_of(channel) == axis;
      });
    };
    return is_root ? has(up_.axis) : has(Axis::x) && has(Axis::y) && has(Axis::z);
  }

  void move(std::vector<FootTarget>& targets) {
    const std::vector<Reach> reaches = reaches_of(legs_, targets, settings_.soft_reach);
    const bool lowered = may_lower();
    std::vector<double> drops(legs_.frames);
    if (lowered) drops = root_drops(legs_, reaches, targets, up_, settings_.blend_s);
    ease_knees(legs_, reaches, up_, lowered, targets, drops);
    for_blocks(0, legs_.frames, [&](std::size_t first, std::size_t end) {
      for (std::size_t f = first; f < end; ++f) move(f, drops[f], targets);
    });
  }

  void move(std::size_t frame, double drop, const std::vector<FootTarget>& targets) {
    const bool lowers = std::fabs(drop) > least_shift * legs_.height;
    const Vec3 shift = lowers ? -drop * up_.direction() : Vec3{};
    if (lowers) lower(frame, shift);
    for (std::size_t l = 0; l < legs_.legs(); ++l) {
      const FootTarget& target = targets[frame * legs_.legs() + l];
      if (target.moves || lowers) turn(frame, legs_.models[l], legs_.pose(frame, l), target, shift);
    }
  }

  void lower(std::size_t frame, Vec3 shift) {
    const Carrier& carrier = legs_.carrier;
    clip_.position(frame, carrier.track) += rotate(conjugate(carrier.frames_of[frame]), shift);
    report_.root_changed[frame] = 1;
  }

  void turn(std::size_t frame, const LegModel& model, const LegPose& pose, const FootTarget& target,
            Vec3 hip_shift) {
    const LegRotations turned = solve_leg(pose, model, target, hip_shift, settings_.soft_reach);
    const auto set = [&](const LegJoint& joint, Quat rotation) {
      Quat& own = clip_.rotation(frame, joint.index);
      const Quat aligned = align_hemisphere(rotation, own);
      if (joint.order.count == 0 || 2 * norm(aligned + -own) < least_turn_rad) return;
      own = aligned;
      report_.changed[frame * clip_.joint_count() + joint.index] = 1;
    };
    set(model.hip, turned.hip);
    set(model.knee, turned.knee);
    set(model.ankle, turned.ankle);
  }

  // Warns of feet that do not reach their targets.
  void warn_of_rest(const std::vector<FootTarget>& targets) {
    double farthest = 0;
    std::size_t frames = 0;
    for (std::size_t f = 0; f < legs_.frames; ++f) {
      double rest = 0;
      for (std::size_t l = 0; l < legs_.legs(); ++l) {
        const FootTarget& target = targets[f * legs_.legs() + l];
        if (target.hold < 1 || !target.moves) continue;
        const LegPose& pose = legs_.pose(f, l);
        rest =
            std::max(rest, norm(pose.ankle_at + rotate(pose.ankle, target.pivot) - target.place));
      }
      farthest = std::max(farthest, rest);
      frames += rest > noticeable_rest * legs_.height ? 1 : 0;
    }
    if (frames == 0) return;
    const double unit_cm = 100 * report_.metres_per_unit;
    const std::string length = unit_cm > 0 ? fmt::format("{:.1f} cm", farthest * unit_cm)
                                           : fmt::format("{:.3g} units", farthest);
    report_.warnings.push_back(
        fmt::format("feet: in {} frame{} a leg does not reach its place by up to {}", frames,
                    frames == 1 ? "" : "s", length));
  }

  Take& clip_;
  const FeetSettings& settings_;
  const FeetLimits& limits_;
  std::vector<Leg> found_;
  LegMotion legs_;
  Up up_;
  bool is_noisy_ = false;  // and not asked to hold every contact
  FeetReport report_;
};

/// Renames joints during its lifetime.
class Renamed {
 public:
  Renamed(Skeleton& skeleton, std::vector<std::string> names)
      : names_(skeleton.names), own_(std::exchange(names_, std::move(names))) {}
  ~Renamed() { names_ = std::move(own_); }
  Renamed(const Renamed&) = delete;
  Renamed& operator=(const Renamed&) = delete;

 private:
  std::vector<std::string>& names_;
  std::vector<std::string> own_;
};

}  // namespace

FeetReport clean_legs(Take& motion, const FeetSettings& settings, const FeetLimits& limits) {
  check_settings(settings);
  if (settings.names.empty()) return FeetCleaning(motion, settings, limits).run();
  const Renamed renamed(motion.skeleton, known_names(motion.skeleton.names, settings.names));
  return FeetCleaning(motion, settings, limits).run();
}

void shift_contacts(std::vector<FootContact>& contacts, std::size_t from, std::size_t to) {
  for (FootContact& contact : contacts) {
    if (contact.first_frame < from || contact.last_frame < contact.first_frame) {
      throw Error(ErrorKind::usage,
                  fmt::format("contact in frames {} to {}: the motion begins with frame {}",
                              contact.first_frame + 1, contact.last_frame + 1, from + 1));
    }
    contact.first_frame = contact.first_frame - from + to;
    contact.last_frame = contact.last_frame - from + to;
  }
}

}  // namespace feet

FeetReport clean_feet(Take& clip, const FeetSettings& settings) {
  const std::size_t first = leading_calibration_frames(clip);
  if (first == 0) return feet::clean_legs(clip, settings);
  FeetSettings own = settings;
  if (own.contacts) feet::shift_contacts(*own.contacts, first, 0);
  FeetReport report;
  on_motion(clip, first, [&](Take& motion) { report = feet::clean_legs(motion, own); });
  feet::shift_contacts(report.contacts, 0, first);
  report.changed.insert(report.changed.begin(), first * clip.joint_count(), 0);
  report.root_changed.insert(report.root_changed.begin(), first, 0);
  return report;
}

}  // namespace kinemend
