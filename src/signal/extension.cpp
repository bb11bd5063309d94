// Computes a row beyond the ends of a matrix.
#include "signal/extension.hpp"

#include <algorithm>

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
