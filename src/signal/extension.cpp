// Computes the samples that a matrix lacks: rows beyond its ends by point reflection, missing
// samples by lines or natural cubic splines.
#include "signal/extension.hpp"

#include <algorithm>
#include <vector>

#include "kinemend/extend/signal.hpp"

namespace kinemend::signal {

void point_reflected_row(const PoseMatrix& matrix, std::ptrdiff_t frame, double* out) {
  const auto last = static_cast<std::ptrdiff_t>(matrix.frames) - 1;
  const double* begin = matrix.row(0).data();
  if (last == 0) {
    std::copy(begin, begin + matrix.channels, out);
    return;
  }
  const double* end = matrix.row(static_cast<std::size_t>(last)).data();
  const std::ptrdiff_t turn = frame >= 0 ? frame / last : -((last - 1 - frame) / last);
  const std::ptrdiff_t rest = frame - turn * last;
  const bool forward = turn % 2 == 0;
  const double* row = matrix.row(static_cast<std::size_t>(forward ? rest : last - rest)).data();
  // Each pair of reflections adds twice the rise from the first to the last sample; an odd one
  // mirrors in the nearer end.
  const double* pivot = turn < 0 ? begin : end;
  const auto rises = static_cast<double>(forward ? turn : (turn < 0 ? turn + 1 : turn - 1));
  for (std::size_t c = 0; c < matrix.channels; ++c) {
    const double value = forward ? row[c] : 2 * pivot[c] - row[c];
    out[c] = rises == 0 ? value : value + rises * (end[c] - begin[c]);
  }
}

}  // namespace kinemend::signal

namespace kinemend {

namespace {

struct Knots {
  std::vector<std::size_t> frames;
  std::vector<double> values;
  std::vector<double> curvatures;  // second derivatives of the spline
};

void find_knots(const PoseMatrix& matrix, std::span<const std::uint8_t> missing,
                std::size_t channel, Knots& knots) {
  knots.frames.clear();
  knots.values.clear();
  for (std::size_t t = 0; t < matrix.frames; ++t) {
    if (missing[t * matrix.channels + channel]) continue;
    knots.frames.push_back(t);
    knots.values.push_back(matrix(t, channel));
  }
}

double step(const Knots& knots, std::size_t k) {
  return static_cast<double>(knots.frames[k + 1] - knots.frames[k]);
}

// The natural spline's second derivatives, from its tridiagonal system: 0 at both ends, and for
// each inner knot h0 m0 + 2 (h0 + h1) m1 + h1 m2 = 6 (slope1 - slope0).
void find_curvatures(Knots& knots) {
  const std::size_t count = knots.frames.size();
  knots.curvatures.assign(count, 0.0);
  if (count < 3) return;
  std::vector<double> upper(count, 0.0);
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const double h0 = step(knots, k - 1);
    const double h1 = step(knots, k);
    const double slope0 = (knots.values[k] - knots.values[k - 1]) / h0;
    const double slope1 = (knots.values[k + 1] - knots.values[k]) / h1;
    const double pivot = 2 * (h0 + h1) - h0 * upper[k - 1];
    upper[k] = h1 / pivot;
    knots.curvatures[k] = (6 * (slope1 - slope0) - h0 * knots.curvatures[k - 1]) / pivot;
  }
  for (std::size_t k = count - 2; k >= 1; --k)
    knots.curvatures[k] -= upper[k] * knots.curvatures[k + 1];
}

double spline_value(const Knots& knots, std::size_t k, std::size_t frame) {
  const double h = step(knots, k);
  const double b = static_cast<double>(frame - knots.frames[k]) / h;
  const double a = static_cast<double>(knots.frames[k + 1] - frame) / h;
  const double bend =
      (a * a * a - a) * knots.curvatures[k] + (b * b * b - b) * knots.curvatures[k + 1];
  return a * knots.values[k] + b * knots.values[k + 1] + bend * (h * h / 6);
}

std::vector<std::uint8_t> marked_channels(const PoseMatrix& matrix,
                                          std::span<const std::uint8_t> missing) {
  std::vector<std::uint8_t> marked(matrix.channels, 0);
  for (std::size_t t = 0; t < matrix.frames; ++t) {
    const std::uint8_t* row = missing.data() + t * matrix.channels;
    for (std::size_t c = 0; c < matrix.channels; ++c) marked[c] |= row[c];
  }
  return marked;
}

void fill(PoseMatrix& matrix, std::span<const std::uint8_t> missing, bool cubic) {
  signal::require_marks(matrix, missing);
  if (missing.empty()) return;
  Knots knots;
  const std::vector<std::uint8_t> touched = marked_channels(matrix, missing);
  for (std::size_t c = 0; c < matrix.channels; ++c) {
    if (!touched[c]) continue;
    find_knots(matrix, missing, c, knots);
    const std::size_t count = knots.frames.size();
    if (count == 0) continue;
    if (cubic) {
      find_curvatures(knots);
    } else {
      knots.curvatures.assign(count, 0.0);
    }
    for (std::size_t t = 0; t < knots.frames.front(); ++t) matrix(t, c) = knots.values.front();
    for (std::size_t k = 0; k + 1 < count; ++k) {
      for (std::size_t t = knots.frames[k] + 1; t < knots.frames[k + 1]; ++t) {
        matrix(t, c) = spline_value(knots, k, t);
      }
    }
    for (std::size_t t = knots.frames.back() + 1; t < matrix.frames; ++t) {
      matrix(t, c) = knots.values.back();
    }
  }
}

}  // namespace

void fill_linear(PoseMatrix& matrix, std::span<const std::uint8_t> missing) {
  fill(matrix, missing, false);
}

void fill_cubic(PoseMatrix& matrix, std::span<const std::uint8_t> missing) {
  fill(matrix, missing, true);
}

}  // namespace kinemend
