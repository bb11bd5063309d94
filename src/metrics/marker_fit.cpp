// Fits each marker by a rigid motion, or by a gain and an offset along each axis.
#include "metrics/marker_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "kinemend/error.hpp"

namespace kinemend::metrics {

namespace {

// Chosen by hand, not swept.
constexpr double rate_tolerance = 1e-3;  // relative: 29.97 and 30 are not the same

double scale_between(const Take& reference, const Take& other) {
  const double of_reference = metres_per_unit(reference.unit);
  const double of_other = metres_per_unit(other.unit);
  return of_reference > 0 && of_other > 0 ? of_other / of_reference : 1;
}

// Sums over the samples of one channel that both takes have.
struct ChannelSums {
  double count = 0, x = 0, y = 0, xx = 0, xy = 0;

  void add(double reference, double other) {
    count += 1;
    x += reference;
    y += other;
    xx += reference * reference;
    xy += reference * other;
  }
  double variance() const { return xx - x * x / count; }
  double gain() const {
    // Rounding errors, as a share of the squared size. Not swept.
    constexpr double standing_still = 1e-12;
    return variance() > standing_still * xx ? (xy - x * y / count) / variance() : 1;
  }
};

FittedMarker gains_and_offsets(const MarkerPair& pair, std::size_t marker) {
  ChannelSums x, y, z;
  // Coordinates relative to a point of the path lose no digits in sums of squares.
  Vec3 origin;
  for (std::size_t f = 0; f < pair.frames; ++f) {
    if (!pair.is_seen(f, marker)) continue;
    if (x.count == 0) origin = pair.reference_at(f, marker);
    const Vec3 p = pair.reference_at(f, marker) - origin, q = pair.other_at(f, marker) - origin;
    x.add(p.x, q.x);
    y.add(p.y, q.y);
    z.add(p.z, q.z);
  }
  FittedMarker fitted;
  if (x.count == 0) return fitted;
  fitted.gain = {x.gain(), y.gain(), z.gain()};
  const auto offset = [](const ChannelSums& sums, double gain, double start) {
    return (sums.y - gain * sums.x) / sums.count + start - gain * start;
  };
  fitted.shift = {offset(x, fitted.gain.x, origin.x), offset(y, fitted.gain.y, origin.y),
                  offset(z, fitted.gain.z, origin.z)};
  return fitted;
}

Eigen::Vector3d vector_of(Vec3 v) { return {v.x, v.y, v.z}; }

FittedMarker rigid(const MarkerPair& pair) {
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = from;
  double count = 0;
  const auto for_each_sample = [&](const auto& work) {
    for (std::size_t f = 0; f < pair.frames; ++f) {
      for (std::size_t m = 0; m < pair.markers(); ++m) {
        if (pair.is_seen(f, m))
          work(vector_of(pair.reference_at(f, m)), vector_of(pair.other_at(f, m)));
      }
    }
  };
  for_each_sample([&](const auto& p, const auto& q) {
    from += p;
    to += q;
    count += 1;
  });
  if (count == 0) return {};
  from /= count;
  to /= count;
  Eigen::Matrix3d product = Eigen::Matrix3d::Zero();
  for_each_sample(
      [&](const auto& p, const auto& q) { product += (q - to) * (p - from).transpose(); });
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d turn = svd.matrixU() * svd.matrixV().transpose();
  if (turn.determinant() < 0) {
    Eigen::Matrix3d u = svd.matrixU();
    u.col(2) = -u.col(2);
    turn = u * svd.matrixV().transpose();
  }
  const Eigen::Quaterniond q(turn);
  const Eigen::Vector3d shift = to - turn * from;
  return {{q.w(), q.x(), q.y(), q.z()}, {1, 1, 1}, {shift.x(), shift.y(), shift.z()}};
}

}  // namespace

bool MarkerPair::is_seen(std::size_t frame, std::size_t marker) const {
  const std::size_t f = first_frame + frame;
  return reference.is_observed(f, reference_markers[marker]) &&
         other.is_observed(f + static_cast<std::size_t>(lag), other_markers[marker]);
}

Vec3 MarkerPair::reference_at(std::size_t frame, std::size_t marker) const {
  return reference.position(first_frame + frame, reference_markers[marker]);
}

Vec3 MarkerPair::other_at(std::size_t frame, std::size_t marker) const {
  return scale *
         other.position(first_frame + frame + static_cast<std::size_t>(lag), other_markers[marker]);
}

MarkerPair pair_markers(const Take& reference, const Take& other, std::ptrdiff_t lag_frames) {
  const std::size_t frames = reference.frame_count();
  if (frames != other.frame_count())
    throw Error(ErrorKind::usage, fmt::format("the reference has {} frames, the other take {}",
                                              frames, other.frame_count()));
  const double rate_hz = reference.frame_rate_hz;
  if (!(std::fabs(other.frame_rate_hz - rate_hz) <= rate_tolerance * rate_hz))
    throw Error(ErrorKind::usage,
                fmt::format("the reference has {:g} frames a second, the other take {:g}; kinemend "
                            "convert --fps brings one to the rate of the other",
                            rate_hz, other.frame_rate_hz));
  MarkerPair pair{reference, other, {}, {}};
  for (std::size_t m = 0; m < reference.marker_count(); ++m) {
    const std::int32_t found = other.find(reference.names[m]);
    if (found < 0 || !reference.holds_positions(m) ||
        !other.holds_positions(static_cast<std::size_t>(found)))
      continue;
    pair.reference_markers.push_back(m);
    pair.other_markers.push_back(static_cast<std::size_t>(found));
  }
  if (pair.markers() == 0)
    throw Error(ErrorKind::usage, "the two takes have no marker of the same name");
  const auto shift = static_cast<std::size_t>(std::abs(lag_frames));
  if (shift >= frames)
    throw Error(ErrorKind::usage,
                fmt::format("a lag of {} frames leaves nothing of {}", lag_frames, frames));
  pair.lag = lag_frames;
  pair.first_frame = lag_frames < 0 ? shift : 0;
  pair.frames = frames - shift;
  pair.scale = scale_between(reference, other);
  return pair;
}

Vec3 FittedMarker::operator()(Vec3 p) const {
  const Vec3 q = rotate(turn, p);
  return Vec3{gain.x * q.x, gain.y * q.y, gain.z * q.z} + shift;
}

std::vector<FittedMarker> fit_markers(const MarkerPair& pair, MarkerFit fit) {
  std::vector<FittedMarker> fitted(pair.markers());
  if (fit == MarkerFit::rigid) std::fill(fitted.begin(), fitted.end(), rigid(pair));
  for (std::size_t m = 0; m < fitted.size() && fit == MarkerFit::gain_offset; ++m)
    fitted[m] = gains_and_offsets(pair, m);
  return fitted;
}

}  // namespace kinemend::metrics
