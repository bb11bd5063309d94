// The damage `system`: adds the errors of a family of capture systems to joints, or to tracks of
// vectors such as markers.
#include <algorithm>
#include <cmath>

#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/take_view.hpp"
#include "lab/damage/body_parts.hpp"
#include "lab/damage/damage_kind.hpp"
#include "lab/damage/drift.hpp"
#include "lab/damage/position_targets.hpp"
#include "lab/damage/system_noise.hpp"
#include "lab/damage/targets.hpp"
#include "lab/damage/track_errors.hpp"
#include "motion/take.hpp"

namespace kinemend::corrupt {

namespace {

// This stream lies beyond the numbers of all tracks; any such number would do. By definition.
constexpr std::uint64_t drift_stream = std::uint64_t{1} << 42;

// Joints turn by an arc of this radius, a quarter of a body height of 1.7 m: 5 mm are 0.67 degrees.
// By definition (docs/details/noise.md).
constexpr double lever_mm = 425;

// If a heading drift is given, the place drifts in the ratio of the family `inertial`.
constexpr double root_mm_per_heading_deg = 300 / 8.0;

// A negative number means the default of the kind.
struct SystemOptions : TargetOptions {
  std::string kind = "video";
  double strength = 1;
  double fc_hz = -1;
  double bursts_per_min = -1;
  double heading_deg = -1;
  std::string depth_axis = "auto";
};

// Returns the reach to either side over which a track's speed is measured: a sixtieth of a second.
std::size_t speed_frames(double rate_hz) {
  return static_cast<std::size_t>(std::max(1.0, std::round(rate_hz / 60)));
}

// Returns the speed of each frame in m/s, where `distance(a, b)` is in mm between two frames; 0 if
// it is negative.
template <class Distance>
std::vector<double> speeds(std::size_t frames, double rate_hz, const Distance& distance) {
  std::vector<double> speed(frames);
  const std::size_t reach = speed_frames(rate_hz);
  for (std::size_t f = 0; f < frames; ++f) {
    const std::size_t a = f - std::min(f, reach), b = std::min(f + reach, frames - 1);
    if (a == b) continue;
    const double seconds = static_cast<double>(b - a) / rate_hz;
    speed[f] = std::max(0.0, distance(a, b)) / 1000 / seconds;
  }
  return speed;
}

// Subtracts the mean over the frames for which `counts(f)` is true.
template <class Counts>
void take_mean_off(std::vector<Vec3>& displacements, const Counts& counts) {
  Vec3 sum;
  double count = 0;
  for (std::size_t f = 0; f < displacements.size(); ++f) {
    if (counts(f)) sum += displacements[f], ++count;
  }
  for (std::size_t f = 0; f < displacements.size(); ++f)
    displacements[f] = counts(f) ? displacements[f] - (1 / count) * sum : Vec3{};
}

// Returns the axis along which a body is thinnest: a camera mostly looks at its broad side.
// `extents` are sums over frames.
int thinnest_axis(Vec3 extents) {
  if (extents.x < extents.y && extents.x < extents.z) return 0;
  return extents.y < extents.z ? 1 : 2;
}

struct Box {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  void add(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  Vec3 extent() const { return low.x > high.x ? Vec3{} : high - low; }
};

int guess_depth_axis(const Take& clip) {
  const std::vector<Vec3> positions = joint_positions(clip);
  Vec3 extents;
  for (std::size_t first = 0; first < positions.size(); first += clip.joint_count()) {
    Box box;
    for (std::size_t j = 0; j < clip.joint_count(); ++j) box.add(positions[first + j]);
    extents += box.extent();
  }
  return thinnest_axis(extents);
}

int guess_depth_axis(const VectorMotion& motion) {
  Vec3 extents;
  for (std::size_t f = 0; f < frame_count(motion); ++f) {
    Box box;
    for (std::size_t n = 0; n < motion.track_count(); ++n) {
      if (motion.is_rotation[n] == 0 && is_observed(motion, f, n)) box.add(vector_at(motion, f, n));
    }
    extents += box.extent();
  }
  return thinnest_axis(extents);
}

template <class Motion>
int depth_axis_of(const Motion& motion, const SystemOptions& options) {
  if (options.depth_axis == "auto") return guess_depth_axis(motion);
  return options.depth_axis[0] - 'x';
}

// Returns the depth axis in a joint's own frame. It is random, because joints point in all
// directions.
int joint_depth_axis(const Random& random, std::size_t joint) {
  return static_cast<int>(random.fork(joint).fork(4).below(3));
}

// The parameters of a damage of either kind of motion.
struct Plan {
  SystemNoise noise;
  int depth_axis = 0;
  bool drifts() const { return noise.heading_deg > 0 || noise.root_mm > 0; }
};

Plan plan_of(const SystemOptions& options) {
  const auto families = system_families();
  const auto family =
      std::find_if(families.begin(), families.end(),
                   [&](const SystemFamily& known) { return known.name == options.kind; });
  SystemNoise noise = family->noise;
  if (options.fc_hz == 0) throw Error(ErrorKind::usage, "fc_hz: must be above 0 Hz");
  if (options.fc_hz > 0) noise.fc_hz = options.fc_hz;
  if (options.bursts_per_min >= 0) noise.bursts_per_min = options.bursts_per_min;
  if (options.heading_deg >= 0) {
    noise.heading_deg = options.heading_deg;
    noise.root_mm = root_mm_per_heading_deg * options.heading_deg;
  }
  return {scaled(noise, options.strength)};
}

class ClipDamage {
 public:
  ClipDamage(Take& clip, const Random& random, const SystemOptions& options, Notes& notes)
      : clip_(clip),
        truth_(clip),
        random_(random),
        plan_(plan_of(options)),
        joints_(target_joints(clip.skeleton, options)),
        limbs_(limbs(clip.skeleton)),
        errors_(plan_.noise, clip.frame_count(), clip.frame_rate_hz, random) {
    plan_.depth_axis = depth_axis_of(clip, options);
    mm_per_unit_ = clip.metres_per_unit > 0 ? 1000 * clip.metres_per_unit
                                            : 10 * usual_cm_per_unit(clip.skeleton, notes);
  }

  void run() {
    for (const std::size_t j : joints_) turn_joint(j);
    const bool has_root = !joints_.empty() && joints_[0] == 0 && moves(0);
    if (has_root) move_root();
    for (std::size_t k = 0; k < clip_.translated_joints.size(); ++k) {
      const auto joint = static_cast<std::size_t>(clip_.translated_joints[k]);
      if (std::find(joints_.begin(), joints_.end(), joint) != joints_.end()) translate(joint, k);
    }
    if (has_root && plan_.drifts()) drift();
  }

 private:
  // Whether the position of joint 0 has channels, or the clip was made in memory.
  bool moves(std::size_t joint) const {
    bool any = false, of_joint = false;
    for (std::size_t j = 0; j < clip_.joint_count(); ++j) {
      any = any || !clip_.skeleton.channels[j].empty();
    }
    for (const Channel channel : clip_.skeleton.channels[joint])
      of_joint = of_joint || channel == Channel::x_position || channel == Channel::y_position ||
                 channel == Channel::z_position;
    return !any || of_joint;
  }

  NoisyTrack track(std::size_t number, std::size_t joint, int depth_axis,
                   std::span<const double> speed, std::span<const Vec3> displacement) const {
    return {number,     limbs_[joint], named_part(clip_.skeleton.names[joint]) == NamedPart::arm,
            depth_axis, speed,         displacement};
  }

  void turn_joint(std::size_t joint) {
    const auto speed =
        speeds(clip_.frame_count(), clip_.frame_rate_hz, [&](std::size_t a, std::size_t b) {
          return lever_mm * angle_between(truth_.rotation(a, joint), truth_.rotation(b, joint));
        });
    const auto errors = errors_.errors_of(
        track(joint, joint, joint_depth_axis(random_, joint), speed, swing(joint)));
    for (std::size_t f = 0; f < errors.size(); ++f) {
      if (!(errors[f] == Vec3{})) turn(clip_, f, joint, (1 / lever_mm) * errors[f]);
    }
  }

  // Returns the arcs of a joint's rotations from their mean.
  std::vector<Vec3> swing(std::size_t joint) const {
    const std::vector<Quat> rotations = rotations_of(truth_, joint);
    const Quat mean = chordal_mean(rotations);
    std::vector<Vec3> arcs;
    arcs.reserve(rotations.size());
    for (const Quat q : rotations) arcs.push_back(lever_mm * log(conjugate(mean) * q));
    return arcs;
  }

  // `place(f)`: reference to the moving position.
  template <class Place>
  void move(std::size_t number, std::size_t joint, const Place& place) {
    std::vector<Vec3> before(clip_.frame_count());
    for (std::size_t f = 0; f < before.size(); ++f) before[f] = place(f);
    const auto speed = speeds(
        before.size(), clip_.frame_rate_hz,
        [&](std::size_t a, std::size_t b) { return mm_per_unit_ * norm(before[b] - before[a]); });
    const auto errors = errors_.errors_of(track(number, joint, plan_.depth_axis, speed, {}));
    for (std::size_t f = 0; f < errors.size(); ++f) place(f) += (1 / mm_per_unit_) * errors[f];
  }
  void move_root() {
    move(clip_.joint_count(), 0, [&](std::size_t f) -> Vec3& { return clip_.root_position(f); });
  }
  void translate(std::size_t joint, std::size_t k) {
    move(clip_.joint_count() + 1 + k, joint,
         [&](std::size_t f) -> Vec3& { return clip_.position(f, 1 + k); });
  }

  void drift() {
    const Axis up = guess_up_axis(truth_);
    const Drift path = drifted(positions_of(view_of(truth_).tracks[truth_.joint_count()]),
                               clip_.frame_rate_hz, up, plan_.noise.heading_deg,
                               plan_.noise.root_mm / mm_per_unit_, random_.fork(drift_stream));
    const Quat rest = clip_.skeleton.rest_rotations[0];
    for (std::size_t f = 0; f < clip_.frame_count(); ++f) {
      clip_.root_position(f) += path.places[f] - truth_.root_position(f);
      const Quat turned = conjugate(rest) * path.headings[f] * rest * clip_.rotation(f, 0);
      set_rotation(clip_, f, 0, turned);
    }
  }

  Take& clip_;
  Take truth_;
  Random random_;
  Plan plan_;
  std::vector<std::size_t> joints_, limbs_;
  TrackErrors errors_;
  double mm_per_unit_ = 1;
};

class VectorDamage {
 public:
  VectorDamage(VectorMotion& motion, const Random& random, const SystemOptions& options)
      : motion_(motion),
        truth_(motion),
        random_(random),
        plan_(plan_of(options)),
        tracks_(target_tracks(motion, options)),
        limbs_(named_limbs(motion.names)),
        errors_(plan_.noise, motion.values.frames, motion.frame_rate_hz, random) {
    plan_.depth_axis = depth_axis_of(motion, options);
    for (std::size_t f = 0; f < motion.values.frames; ++f)
      centres_.push_back(mean_position(motion, f));
    per_mm_ = motion.per_cm > 0 ? motion.per_cm / 10 : motion.per_radian / lever_mm;
  }

  void run() {
    for (const std::size_t n : tracks_) damage(n);
    if (plan_.drifts()) drift();
  }

 private:
  double distance(std::size_t track, std::size_t a, std::size_t b) const {
    if (!is_observed(truth_, a, track) || !is_observed(truth_, b, track)) return 0;
    const Vec3 from = vector_at(truth_, a, track), to = vector_at(truth_, b, track);
    if (truth_.is_rotation[track] == 0) return norm(to - from) / per_mm_;
    const double scale = 1 / truth_.per_radian;
    return lever_mm * angle_between(exp(scale * from), exp(scale * to));
  }

  // Returns the arcs of a rotation from its mean.
  std::vector<Vec3> swing(std::size_t track) const {
    std::vector<Quat> rotations(motion_.values.frames);
    for (std::size_t f = 0; f < rotations.size(); ++f)
      rotations[f] = exp((1 / truth_.per_radian) * vector_at(truth_, f, track));
    const Quat mean = chordal_mean(rotations);
    std::vector<Vec3> arcs;
    arcs.reserve(rotations.size());
    for (const Quat q : rotations) arcs.push_back(lever_mm * log(conjugate(mean) * q));
    return arcs;
  }

  // Returns a position's displacement from its mean relative to the body's centre, in mm.
  std::vector<Vec3> displacement(std::size_t track) const {
    std::vector<Vec3> displacements(motion_.values.frames);
    for (std::size_t f = 0; f < displacements.size(); ++f)
      displacements[f] = (1 / per_mm_) * (vector_at(truth_, f, track) - centres_[f]);
    take_mean_off(displacements, [&](std::size_t f) { return is_observed(truth_, f, track); });
    return displacements;
  }

  void damage(std::size_t track) {
    const bool turns = motion_.is_rotation[track] != 0;
    const auto speed = speeds(motion_.values.frames, motion_.frame_rate_hz,
                              [&](std::size_t a, std::size_t b) { return distance(track, a, b); });
    const auto errors =
        errors_.errors_of({track, limbs_[track], named_part(motion_.names[track]) == NamedPart::arm,
                           turns ? joint_depth_axis(random_, track) : plan_.depth_axis, speed,
                           turns ? swing(track) : displacement(track)});
    for (std::size_t f = 0; f < errors.size(); ++f) {
      if (errors[f] == Vec3{} || !is_observed(motion_, f, track)) continue;
      if (turns) {
        turn(motion_, f, track, (1 / lever_mm) * errors[f]);
      } else {
        set_vector(motion_, f, track, vector_at(motion_, f, track) + per_mm_ * errors[f]);
      }
    }
  }

  void drift() {
    const Drift path =
        drifted(centres_, motion_.frame_rate_hz, static_cast<Axis>(motion_.up_axis),
                plan_.noise.heading_deg, per_mm_ * plan_.noise.root_mm, random_.fork(drift_stream));
    for (const std::size_t n : tracks_) {
      const bool turns = motion_.is_rotation[n] != 0;
      if (turns && motion_.is_root[n] == 0) continue;
      for (std::size_t f = 0; f < centres_.size(); ++f) {
        if (!is_observed(motion_, f, n)) continue;
        const Vec3 v = vector_at(motion_, f, n);
        if (!turns) {
          set_vector(motion_, f, n, path.places[f] + rotate(path.headings[f], v - centres_[f]));
          continue;
        }
        // Converts a turn in the world to one in the root's own frame.
        const Quat q = exp((1 / motion_.per_radian) * v);
        turn(motion_, f, n, log(conjugate(q) * path.headings[f] * q));
      }
    }
  }

  VectorMotion& motion_;
  VectorMotion truth_;
  Random random_;
  Plan plan_;
  std::vector<std::size_t> tracks_, limbs_;
  TrackErrors errors_;
  std::vector<Vec3> centres_;
  double per_mm_ = 1;
};

std::vector<std::string> kinds() {
  std::vector<std::string> names;
  for (const SystemFamily& family : system_families()) names.emplace_back(family.name);
  return names;
}

struct System {
  static constexpr auto name = "system";
  static constexpr auto summary =
      "noise as capture systems make it: slow, correlated, with bursts, stronger in motion";
  static constexpr auto paper = "measured; see docs/noise.md";
  using Options = SystemOptions;
  static const OptionTable<Options>& table() {
    static const auto options = [] {
      OptionTable<Options> t;
      t.choice(&Options::kind, "kind", kinds(), "the capture system");
      t.number(&Options::strength, "strength", "", 0, 100, "factor on the size of all its errors");
      t.number(&Options::fc_hz, "fc_hz", "Hz", -1, 100,
               "corner of the slow noise, the slower the lower; -1: that of the kind");
      t.number(&Options::bursts_per_min, "bursts_per_min", "", -1, 1e4,
               "bursts of each joint or marker a minute; -1: those of the kind");
      t.number(&Options::heading_deg, "heading_deg", "deg", -1, 360,
               "drift of the heading in a minute, and of the place by 37.5 mm for each degree; -1: "
               "those of the kind");
      t.choice(&Options::depth_axis, "depth_axis", {"auto", "x", "y", "z"},
               "axis that is depth; auto: along which the body is thinnest. Of joints any axis");
      return add_target_options(t);
    }();
    return options;
  }
  static void damage(Take& clip, const Random& random, const Options& options, Notes& notes) {
    plan_of(options);
    if (options.strength > 0 && clip.frame_count() > 0)
      ClipDamage(clip, random, options, notes).run();
  }
  static void damage(VectorMotion& motion, const Random& random, const Options& options, Notes&) {
    plan_of(options);
    if (options.strength > 0 && motion.values.frames > 0)
      VectorDamage(motion, random, options).run();
  }
};

}  // namespace

void add_systems(std::vector<Damage>& table) { table.push_back(entry<System>()); }

}  // namespace kinemend::corrupt
