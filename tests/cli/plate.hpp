// A small TRC take with a gap and a spike, for tests of the program.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace kinemend::test {

/// A TRC take of four markers on a rigid plate that sways: millimetres, 100 Hz, 150 frames from
/// frame number `first`. B is missing in the 41st to 46th frame; C jumps in the 80th.
inline std::string plate_take(int first = 1) {
  std::string text = fmt::format(
      "PathFileType\t4\t(X/Y/Z)\tplate.trc\n"
      "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNu"
      "mFrames\n100\t100\t150\t4\tmm\t100\t{}\t150\nFrame#"
      "\tTime\tA\t\t\tB\t\t\tC\t\t\tD\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\tX3\tY3\tZ3\tX4\tY4\tZ4\n\n",
      first);
  const double corners[4][3] = {{0, 0, 0}, {100, 0, 0}, {0, 120, 0}, {90, 110, 30}};
  for (int f = 0; f < 150; ++f) {
    const double sway = 200 * std::sin(0.04 * f), jitter = f % 2 == 0 ? 1.5 : -1.5;
    text += fmt::format("{}\t{:.5f}", first + f, f / 100.0);
    for (int m = 0; m < 4; ++m) {
      if (m == 1 && f >= 40 && f < 46) {
        text += "\t\t\t";
        continue;
      }
      const double spike = m == 2 && f == 79 ? 150 : 0;
      const double wobble = jitter * std::cos(1.7 * f * (m + 1));
      text +=
          fmt::format("\t{:.4f}\t{:.4f}\t{:.4f}", corners[m][0] + sway + wobble,
                      corners[m][1] + 0.5 * sway - wobble + spike, corners[m][2] + 900 + wobble);
    }
    text += "\n";
  }
  return text;
}

}  // namespace kinemend::test
