#include "fill/joint_methods.hpp"

#include <algorithm>
#include <cmath>

#include "fill/cycles.hpp"

namespace kinemend::fill {

namespace {

template <Curve curve>
bool fill_by_curve(JointTrack& track, FrameSpan span, const JointContext& context) {
  return fill_with_curve(track.track(), span, curve, context.curve());
}

bool fill_by_cycles(JointTrack& track, FrameSpan span, const JointContext& context) {
  const CurveSettings settings = context.curve();
  const auto cycles = find_cycles(track.track(), span, settings);
  return fill_with_cycles(track.track(), span, cycles, settings);
}

// squad (Shoemake 1987): slerp(slerp(a, b, t), slerp(a', b', t), 2 t (1 - t)). Its inner rotations
// a' = a Exp((L v - d) / 2) and b' = b Exp((d - L w) / 2), with d = Log(a^-1 b), give the curve the
// velocities v and w at its ends, L steps apart.
bool fill_by_squad(JointTrack& track, FrameSpan span, const JointContext& context) {
  const CurveSettings settings = context.curve();
  const EndState before = state_before(track.track(), span, settings);
  const EndState behind = state_behind(track.track(), span, settings);
  if (track.is_position || !before.known || !behind.known) {
    return fill_with_curve(track.track(), span, Curve::hermite, settings);
  }
  const auto as_vector = [](const std::vector<double>& v) { return Vec3{v[0], v[1], v[2]}; };
  const Quat a = track.rotation(span.first - 1);
  const Quat b = align_hemisphere(track.rotation(span.last + 1), a);
  const Vec3 d = log(conjugate(a) * b);
  const auto length = static_cast<double>(span.length() + 1);
  const Quat inner_a = a * exp(0.5 * (length * as_vector(before.velocity) - d));
  const Quat inner_b = b * exp(0.5 * (d - length * as_vector(behind.velocity)));
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const double t = static_cast<double>(f - span.first + 1) / length;
    const Quat q = slerp(slerp(a, b, t), slerp(inner_a, inner_b, t), 2 * t * (1 - t));
    track.set(f, track.chart.vector_of(f, q));
  }
  return true;
}

// The pose's guess needs frames beside the gap, where it is compared with what was observed.
bool fill_by_poses(JointTrack& track, FrameSpan span, const JointContext& context) {
  constexpr double stiffness = 1 * radians_per_degree;
  const CurveSettings settings = context.curve();
  const auto beside = std::max<std::size_t>(
      5, static_cast<std::size_t>(std::lround(settings.velocity_window_s * context.frame_rate_hz)));
  const std::size_t first = span.first - std::min(beside, span.first);
  const std::size_t last = std::min(span.last + beside, track.observed.size() - 1);
  const std::size_t shift = track.first_frame;
  const std::vector<Quat> rotations = context.poses.predict(
      track.joint, {span.first + shift, span.last + shift}, first + shift, last + shift, stiffness);
  if (rotations.empty()) return false;
  Guess guess{first, {}};
  for (std::size_t f = first; f <= last; ++f) {
    const Vec3 v = track.chart.vector_of(f, rotations[f - first]);
    guess.values.insert(guess.values.end(), {v.x, v.y, v.z});
  }
  place_guess(track.track(), span, guess, settings);
  return true;
}

constexpr std::string_view no_samples = "none of its samples is observed";

constexpr JointMethod methods[] = {
    {"slerp", 0.25, 0.1, true, fill_by_curve<Curve::linear>, no_samples, {1, 1, 1, 1, 1, 1}},
    {"squad", 0.25, 0.1, true, fill_by_squad, no_samples, {0.95, 1.0, 0.8, 1.1, 1.15, 1.3}},
    {"spline",
     0.25,
     0.1,
     true,
     fill_by_curve<Curve::cubic>,
     no_samples,
     {1.02, 1.02, 1.03, 1.5, 1.6, 1.9}},
    {"quintic",
     0.25,
     0.1,
     true,
     fill_by_curve<Curve::quintic>,
     no_samples,
     {0.87, 0.86, 0.88, 1.6, 2.0, 2.8}},
    {"pchip",
     0.25,
     0.1,
     true,
     fill_by_curve<Curve::shape_preserving>,
     no_samples,
     {0.88, 0.8, 0.84, 0.91, 0.91, 0.95}},
    {"hermite",
     0.25,
     0.1,
     true,
     fill_by_curve<Curve::hermite>,
     no_samples,
     {0.95, 0.92, 0.77, 0.93, 0.97, 1.0}},
    {"cyclic",
     2.0,
     1.0,
     true,
     fill_by_cycles,
     "no other part of the take is alike around it",
     {0.88, 0.8, 0.8, 0.85, 0.85, 0.9}},
    {"pca",
     5.0,
     1.0,
     false,
     fill_by_poses,
     "too few other joints or frames are observed to predict it from",
     {0.98, 0.93, 0.8, 0.72, 0.6, 0.55}},
};

}  // namespace

std::span<const JointMethod> joint_methods() { return methods; }

const JointMethod* find_joint_method(std::string_view name) {
  const auto* found = std::find_if(std::begin(methods), std::end(methods),
                                   [&](const JointMethod& method) { return method.name == name; });
  return found == std::end(methods) ? nullptr : found;
}

}  // namespace kinemend::fill
