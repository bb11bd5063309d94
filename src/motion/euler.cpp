// Converts between rotations and Euler angles in any order, with one to three axes.
#include <algorithm>
#include <cctype>

#include "base/portable.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend {

namespace {

using Angles = std::array<double, 3>;

constexpr std::size_t index_of(Axis axis) { return static_cast<std::size_t>(axis); }

Quat turn(Axis axis, double angle) {
  const auto [s, c] = portable::sine_and_cosine(angle / 2);
  Quat q{c, 0, 0, 0};
  (axis == Axis::x ? q.x : axis == Axis::y ? q.y : q.z) = s;
  return q;
}

double component(Quat q, Axis axis) { return axis == Axis::x ? q.x : axis == Axis::y ? q.y : q.z; }

double nearest_turn(double angle, double previous) {
  if (std::fabs(angle - previous) < pi) return angle;
  return previous + wrap_angle(angle - previous, pi);
}

// Moves each angle by whole turns to be nearest to `previous`; returns the largest change.
double continue_from(Angles& angles, const Angles& previous, std::size_t count) {
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    angles[i] = nearest_turn(angles[i], previous[i]);
    largest = std::max(largest, std::fabs(angles[i] - previous[i]));
  }
  return largest;
}

// The branches differ by half a turn in their first angle.
Angles nearer(Angles first, Angles second, const Angles& previous, std::size_t count) {
  const double change_first = continue_from(first, previous, count);
  if (change_first < pi / 2) return first;  // the other one's first angle changes by more
  const double change_second = continue_from(second, previous, count);
  return change_second < change_first ? second : first;
}

// One axis: the nearest rotation to q keeps the component about the axis and drops the others.
Angles hinge_angles(Quat q, RotationOrder order, const Angles& previous) {
  const double angle = 2 * portable::atan2(component(q, order.axes[0]), q.w);
  return {nearest_turn(angle, previous[0]), 0, 0};
}

// Two axes a, b: qa(2x) qb(2y) has the components (cos x cos y, sin x cos y, cos x sin y, e sin x
// sin y) on (1, a, b, c) with e = 1 when a x b = +c. Its product with q is u(x)^T M u(y), u = (cos,
// sin), so the best x and y are the angles of the leading singular vectors of the 2 x 2 matrix M.
Angles saddle_angles(Quat q, RotationOrder order, const Angles& previous) {
  const Axis a = order.axes[0], b = order.axes[1];
  const auto c = static_cast<Axis>(3 - index_of(a) - index_of(b));
  const double sign = (index_of(a) + 1) % 3 == index_of(b) ? 1.0 : -1.0;
  const double m00 = q.w, m01 = component(q, b), m10 = component(q, a),
               m11 = sign * component(q, c);
  // Singular value decomposition of 2 x 2 in closed form: sum and difference of the two angles.
  const double sum = portable::atan2(m10 + m01, m00 - m11);
  const double difference = portable::atan2(m10 - m01, m00 + m11);
  const Angles first{sum + difference, sum - difference, 0};
  const Angles second{first[0] + 2 * pi, first[1],
                      0};  // for the other sign of q, equal after whole turns
  return nearer(first, second, previous, 2);
}

}  // namespace

std::span<const RotationOrder> all_rotation_orders() {
  static const auto orders = [] {
    std::array<RotationOrder, 12> list{};
    std::size_t next = 0;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        for (int c = 0; c < 3; ++c) {
          if (a == b || b == c) continue;
          list[next++] = {{static_cast<Axis>(a), static_cast<Axis>(b), static_cast<Axis>(c)}, 3};
        }
      }
    }
    return list;
  }();
  return orders;
}

RotationOrder parse_rotation_order(std::string_view text) {
  RotationOrder order;
  if (text.empty() || text.size() > 3) {
    throw Error(ErrorKind::usage, "rotation order \"" + std::string(text) +
                                      "\": expected one to three letters of X, Y, Z");
  }
  for (const char letter : text) {
    const int axis = std::tolower(static_cast<unsigned char>(letter)) - 'x';
    const bool repeats =
        order.count > 0 && index_of(order.axes[order.count - 1U]) == static_cast<std::size_t>(axis);
    if (axis < 0 || axis > 2 || repeats) {
      throw Error(ErrorKind::usage, "rotation order \"" + std::string(text) +
                                        "\": expected letters X, Y, Z, neighbours different");
    }
    order.axes[order.count++] = static_cast<Axis>(axis);
  }
  return order;
}

std::string to_string(RotationOrder order) {
  std::string text;
  for (std::size_t i = 0; i < order.count; ++i) text += "XYZ"[index_of(order.axes[i])];
  return text;
}

Quat from_euler(const Angles& angles, RotationOrder order) {
  Quat q;
  for (std::size_t i = 0; i < order.count; ++i) q = q * turn(order.axes[i], angles[i]);
  return q;
}

Angles to_euler_near(Quat q, RotationOrder order, const Angles& previous) {
  if (order.count == 0) return {};
  if (order.count == 1) return hinge_angles(q, order, previous);
  if (order.count == 2) return saddle_angles(q, order, previous);

  // After Bernardes & Viollet 2022. With e = 1 when i x j = +k, Rk(t) = Rj(-pi/2) Ri(e t) Rj(pi/2),
  // so that Ri(a) Rj(b) Rk(c) Rj(-pi/2) = Ri(a) Rj(b - pi/2) Ri(e c): Tait-Bryan orders become
  // proper Euler angles.
  const Axis i = order.axes[0], j = order.axes[1];
  const bool proper = order.axes[0] == order.axes[2];
  const auto k = proper ? static_cast<Axis>(3 - index_of(i) - index_of(j)) : order.axes[2];
  const double e = (index_of(i) + 1) % 3 == index_of(j) ? 1.0 : -1.0;
  double a = q.w, b = component(q, i), c = component(q, j), d = component(q, k) * e;
  if (!proper) {
    const double w = a, u = b, v = c, x = d;
    a = w + v;
    b = u + x;
    c = v - w;
    d = x - u;
  }
  const double middle = 2 * portable::atan2(std::sqrt(c * c + d * d), std::sqrt(a * a + b * b));
  const double plus = portable::atan2(b, a);
  const double minus = portable::atan2(d, c);

  // Closer to gimbal lock than this, rounding decides between the first and last angle; the error
  // is twice this. Chosen by hand, not swept.
  constexpr double locked = 1e-9;
  Angles angles;
  angles[1] = middle;
  if (middle < locked || pi - middle < locked) {
    // Only first + last (or their difference) is determined: split the change between the two.
    const bool at_zero = middle < locked;
    const double last_sign = proper ? 1.0 : e;
    const double whole = at_zero ? 2 * plus : 2 * minus;
    const double p0 = previous[0], p2 = last_sign * previous[2];
    const double kept = at_zero ? p0 + p2 : p0 - p2;
    const double change = wrap_angle(whole - kept, pi);
    angles[0] = p0 + change / 2;
    angles[2] = at_zero ? p2 + change / 2 : p2 - change / 2;
  } else {
    angles[0] = plus + minus;
    angles[2] = plus - minus;
  }
  if (!proper) {
    angles[2] *= e;
    angles[1] += pi / 2;
  }
  Angles other{angles[0] + pi, proper ? -angles[1] : pi - angles[1], angles[2] + pi};
  return nearer(angles, other, previous, 3);
}

Angles to_euler(Quat rotation, RotationOrder order) { return to_euler_near(rotation, order, {}); }

}  // namespace kinemend
