// Sets up and solves the least-squares problem of the smoother, in pieces that overlap.
#include "feet/contact_smoother.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "base/frame_span.hpp"
#include "base/parallel.hpp"
#include "feet/banded_least_squares.hpp"
#include "motion/rotation.hpp"

namespace kinemend::feet {

namespace {

// Knots a second at most; a piece and its overlap with the next in seconds. For speed, not swept.
constexpr double knot_rate_hz = 120;
constexpr double piece_s = 10, overlap_s = 2;
// How far a standing part moves in a second, in body heights, and how exactly the floor is known,
// in body heights over a time in seconds. Chosen on takes that no table uses
// (docs/details/feet.md).
constexpr double roll_per_root_second = 0.02, floor_deviation = 0.06, floor_known_s = 0.1;
// The least odds at which a contact counts in full. Chosen by hand, not swept.
constexpr double full_odds = 20;
// Standard deviation, radians, of what may not turn.
constexpr double fixed = 1e-6;

constexpr std::size_t unknowns_of_root = 6, unknowns_of_leg = 9;

using Term = BandedLeastSquares::Term;

std::array<double, 3> numbers(Vec3 v) { return {v.x, v.y, v.z}; }

// The three rows of d (turn x arm) / d turn.
std::array<std::array<double, 3>, 3> rows_by_turn(Vec3 arm) {
  return {{{0, arm.z, -arm.y}, {-arm.z, 0, arm.x}, {arm.y, -arm.x, 0}}};
}

// A standing part at a knot: where it is, and how it moves with the unknowns.
struct PartAtKnot {
  double weight = 0;  // of its certainty
  std::array<double, 3> at{};
  // For each axis the root's turn, hip, knee and ankle; the root's shift is the axis itself.
  std::array<std::array<std::array<double, 3>, 3>, 4> slopes{};
};

double certainty_weight(double certainty) {
  if (!(certainty > 0)) return 0;
  return std::min(certainty / std::max(1 - certainty, 1e-9), full_odds) / full_odds;
}

// Puts the terms of one axis of a part at a knot behind those in `terms`.
void put_terms(const PartAtKnot& part, std::size_t axis, std::size_t leg, std::size_t first_unknown,
               double sign, std::vector<Term>& terms) {
  terms.push_back({first_unknown + axis, sign});
  const auto put = [&](std::size_t unknown, std::size_t slope) {
    for (std::size_t i = 0; i < 3; ++i)
      terms.push_back({first_unknown + unknown + i, sign * part.slopes[slope][axis][i]});
  };
  put(3, 0);
  const std::size_t own = unknowns_of_root + unknowns_of_leg * leg;
  for (std::size_t joint = 0; joint < 3; ++joint) put(own + 3 * joint, 1 + joint);
}

// Returns directions about which a joint's channels cannot turn it.
std::vector<Vec3> blocked_axes(const LegJoint& joint, Quat parent, Quat turned) {
  if (joint.order.count >= 3) return {};
  if (joint.order.count == 0) return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto unit = [](Vec3 v) { return (1 / norm(v)) * v; };
  const Vec3 first = rotate(parent * joint.rest, unit_vector(joint.order.axes[0]));
  const Vec3 other = joint.order.count == 2     ? rotate(turned, unit_vector(joint.order.axes[1]))
                     : std::fabs(first.x) < 0.5 ? Vec3{1, 0, 0}
                                                : Vec3{0, 1, 0};
  const Vec3 across = cross(first, other);
  if (!(norm(across) > 1e-6)) return {};
  if (joint.order.count == 2) return {unit(across)};
  return {unit(across), unit(cross(first, across))};
}

PoseUpdate update_of(const std::vector<double>& x, std::size_t legs) {
  const auto vector_at = [&](std::size_t i) { return Vec3{x[i], x[i + 1], x[i + 2]}; };
  PoseUpdate update{vector_at(0), vector_at(3), {}};
  for (std::size_t l = 0; l < legs; ++l) {
    const std::size_t first = unknowns_of_root + unknowns_of_leg * l;
    update.legs.push_back({vector_at(first), vector_at(first + 3), vector_at(first + 6)});
  }
  return update;
}

}  // namespace

ContactSmoother::ContactSmoother(const LegMotion& motion, Up up, std::vector<StandingPart> parts,
                                 MotionError error)
    : frames_(motion.frames),
      spacing_(frames_in(1 / knot_rate_hz, motion.frame_rate_hz, 1)),
      knots_(motion.frames == 0 ? 0 : 1 + (motion.frames - 1 + spacing_ - 1) / spacing_),
      rate_hz_(motion.frame_rate_hz),
      up_(up),
      parts_(std::move(parts)),
      error_(std::move(error)),
      total_(knots_ * unknowns()) {}

std::size_t ContactSmoother::unknowns() const {
  return unknowns_of_root + unknowns_of_leg * (parts_.size() / 2);
}

std::size_t ContactSmoother::frame_of(std::size_t knot) const {
  return std::min(knot * spacing_, frames_ - 1);
}

std::vector<double> ContactSmoother::solve(const LegMotion& motion, std::size_t first,
                                           std::size_t end) const {
  const std::size_t count = end - first, width = unknowns(), legs = motion.legs();
  const std::size_t points = parts_.size();
  BandedLeastSquares squares(count * width, 2 * width - 1);
  const double spacing_s = static_cast<double>(spacing_) / rate_hz_;

  std::vector<PartAtKnot> standing(count * points);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t frame = frame_of(first + k);
    const std::size_t from = frame - std::min(frame, spacing_ / 2),
                      to = std::min(frame + spacing_ / 2, frames_ - 1);
    for (std::size_t p = 0; p < points; ++p) {
      PartAtKnot& part = standing[k * points + p];
      const std::size_t leg = p / 2;
      if (error_.size.legs[leg] == 0) continue;
      part.weight = certainty_weight(parts_[p].certainty[frame]);
      if (!(part.weight > 0)) continue;
      const auto sole_at = [&](std::size_t f) {
        return motion.pose(f, leg).sole_at(motion.models[leg], static_cast<FootPart>(p % 2));
      };
      Vec3 sum;
      for (std::size_t f = from; f <= to; ++f) sum += sole_at(f);
      part.at = numbers((1 / static_cast<double>(to - from + 1)) * sum);
      const LegPose& pose = motion.pose(frame, leg);
      const Vec3 at = sole_at(frame);
      const Vec3 root_at = motion.carrier.found ? motion.carrier.at[frame] : Vec3{};
      part.slopes = {rows_by_turn(at - root_at), rows_by_turn(at - pose.hip_at),
                     rows_by_turn(at - pose.knee_at), rows_by_turn(at - pose.ankle_at)};
    }
  }

  // Errors that stay similar for a time: their values and differences.
  std::vector<double> deviations(width, fixed);
  const auto set = [&](std::size_t unknown, double deviation) {
    for (std::size_t i = unknown; i < unknown + 3; ++i) deviations[i] = std::max(deviation, fixed);
  };
  set(0, error_.size.root_position);
  set(3, error_.size.root_rotation);
  for (std::size_t l = 0; l < legs; ++l) {
    for (std::size_t joint = 0; joint < 3 && error_.size.legs[l] != 0; ++joint)
      set(unknowns_of_root + unknowns_of_leg * l + 3 * joint, error_.size.joint_rotation);
  }
  const double steps = error_.time_s / spacing_s;
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t u = 0; u < width; ++u) {
      const double weight = 1 / (2 * steps * deviations[u] * deviations[u]);
      const std::size_t at = k * width + u, total = (first + k) * width + u;
      squares.add(std::array<Term, 1>{{{at, 1}}}, total_[total], weight);
      if (k == 0) continue;
      squares.add(std::array<Term, 2>{{{at - width, -1}, {at, 1}}},
                  total_[total] - total_[total - width], steps * steps * weight);
    }
    for (std::size_t l = 0; l < legs; ++l) {
      const LegModel& model = motion.models[l];
      const LegPose& pose = motion.pose(frame_of(first + k), l);
      const std::size_t own = k * width + unknowns_of_root + unknowns_of_leg * l;
      const auto block = [&](const LegJoint& joint, Quat parent, Quat turned, std::size_t unknown) {
        for (const Vec3 axis : blocked_axes(joint, parent, turned)) {
          const std::array<Term, 3> terms{
              {{unknown, axis.x}, {unknown + 1, axis.y}, {unknown + 2, axis.z}}};
          squares.add(terms, 0, 1 / (fixed * fixed));
        }
      };
      block(model.hip, pose.hip_parent, pose.hip, own);
      block(model.knee, pose.knee_parent, pose.knee, own + 3);
      block(model.ankle, pose.ankle_parent, pose.ankle, own + 6);
    }
  }

  std::vector<Term> terms;
  const double roll = roll_per_root_second * motion.height;
  const double sure = floor_deviation * motion.height;
  const auto up_axis = static_cast<std::size_t>(up_.axis);
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t p = 0; p < points; ++p) {
      const PartAtKnot& now = standing[k * points + p];
      if (!(now.weight > 0)) continue;
      const double floor = parts_[p].floor[frame_of(first + k)];
      if (std::isfinite(floor)) {
        terms.clear();
        put_terms(now, up_axis, p / 2, k * width, 1, terms);
        squares.add(std::span<const Term>(terms), now.at[up_axis] - up_.sign * floor,
                    now.weight * spacing_s / (floor_known_s * sure * sure));
      }
      if (k == 0) continue;
      const PartAtKnot& before = standing[(k - 1) * points + p];
      if (!(before.weight > 0)) continue;
      const double weight = std::min(now.weight, before.weight) / (roll * roll * spacing_s);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        terms.clear();
        put_terms(before, axis, p / 2, (k - 1) * width, -1, terms);
        put_terms(now, axis, p / 2, k * width, 1, terms);
        squares.add(std::span<const Term>(terms), now.at[axis] - before.at[axis], weight);
      }
    }
  }
  return squares.solve();
}

std::vector<PoseUpdate> ContactSmoother::step(const LegMotion& motion) {
  const std::size_t width = unknowns();
  const double knots_a_second = rate_hz_ / static_cast<double>(spacing_);
  const std::size_t piece = frames_in(piece_s, knots_a_second, 1),
                    overlap = std::min(piece / 2, frames_in(overlap_s, knots_a_second, 1));
  const std::size_t pieces = std::max<std::size_t>(1, (knots_ + piece - 1) / piece);
  const auto first_of = [&](std::size_t i) { return i * piece - std::min(i * piece, overlap); };
  const auto end_of = [&](std::size_t i) { return std::min(knots_, (i + 1) * piece + overlap); };
  std::vector<std::vector<double>> solutions(pieces);
  for_each_index(pieces,
                 [&](std::size_t i) { solutions[i] = solve(motion, first_of(i), end_of(i)); });
  // Neighbouring pieces fade into one another where they overlap.
  std::vector<double> x(knots_ * width);
  for (std::size_t i = 0; i < pieces; ++i) {
    const auto risen = [&](std::size_t k, std::size_t boundary) {
      const auto into = static_cast<double>(k + overlap - std::min(k + overlap, boundary));
      return std::min(1.0, into / static_cast<double>(2 * overlap));
    };
    for (std::size_t k = first_of(i); k < end_of(i); ++k) {
      const double rise = i > 0 ? risen(k, i * piece) : 1;
      const double fall = i + 1 < pieces ? 1 - risen(k, (i + 1) * piece) : 1;
      for (std::size_t u = 0; u < width; ++u)
        x[k * width + u] += rise * fall * solutions[i][(k - first_of(i)) * width + u];
    }
  }
  for (std::size_t i = 0; i < x.size(); ++i) total_[i] += x[i];
  std::vector<PoseUpdate> updates(frames_);
  for_blocks(0, frames_, [&](std::size_t first, std::size_t end) {
    std::vector<double> between(width);
    for (std::size_t f = first; f < end; ++f) {
      const std::size_t k = f / spacing_, next = std::min(k + 1, knots_ - 1);
      const std::size_t from = frame_of(k), to = frame_of(next);
      const double share =
          to > from ? static_cast<double>(f - from) / static_cast<double>(to - from) : 0;
      for (std::size_t u = 0; u < width; ++u)
        between[u] = (1 - share) * x[k * width + u] + share * x[next * width + u];
      updates[f] = update_of(between, motion.legs());
    }
  });
  return updates;
}

}  // namespace kinemend::feet
