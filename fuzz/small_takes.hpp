// Takes of a few frames, for fuzz targets that read a file beside a take.
#pragma once

#include <string>
#include <variant>

#include "kinemend/io.hpp"
#include "kinemend/take.hpp"

/// Two legs and a spine that stand and walk on the spot, 24 frames at 60 Hz.
inline kinemend::Take small_clip() {
  std::string text =
      "HIERARCHY\nROOT Hips\n{\n OFFSET 0 0 0\n CHANNELS 6 Xposition Yposition "
      "Zposition Zrotation Xrotation Yrotation\n";
  for (const char* side : {"Left", "Right"}) {
    text += std::string(" JOINT ") + side + "UpLeg\n {\n  OFFSET " + (*side == 'L' ? "9" : "-9") +
            " -4 0\n  CHANNELS 3 Zrotation Xrotation Yrotation\n  JOINT " + side +
            "Leg\n  {\n   OFFSET 0 -43 0\n   CHANNELS 3 Zrotation Xrotation Yrotation\n   JOINT " +
            side +
            "Foot\n   {\n    OFFSET 0 -43 0\n    CHANNELS 3 Zrotation Xrotation Yrotation\n"
            "    JOINT " +
            side +
            "ToeBase\n    {\n     OFFSET 0 -5 14\n     CHANNELS 3 Zrotation Xrotation Yrotation\n"
            "     End Site\n     {\n      OFFSET 0 -1 6\n     }\n    }\n   }\n  }\n }\n";
  }
  text +=
      " JOINT Spine\n {\n  OFFSET 0 20 0\n  CHANNELS 3 Zrotation Xrotation Yrotation\n"
      "  End Site\n  {\n   OFFSET 0 30 0\n  }\n }\n}\nMOTION\nFrames: 24\nFrame Time: "
      "0.0166667\n";
  for (int f = 0; f < 24; ++f) {
    text += "0 95 0 0 0 " + std::to_string(f);
    for (int i = 0; i < 9; ++i) text += " 0 " + std::to_string(f * i % 17) + " 0";
    text += "\n";
  }
  return kinemend::read_joints(text, "small.bvh").take;
}

/// Five markers, 24 frames at 60 Hz.
inline kinemend::Take small_markers() {
  std::string text = "# rate_hz: 60\n# units: mm\nframe,time_s";
  for (const char* name : {"LASI", "RASI", "SACR", "LKNE", "RKNE"}) {
    for (const char* axis : {"x", "y", "z"}) text += std::string(",") + name + "_" + axis;
  }
  text += "\n";
  for (int f = 0; f < 24; ++f) {
    text += std::to_string(f + 1) + "," + std::to_string(f / 60.0);
    for (int m = 0; m < 15; ++m) text += "," + std::to_string(100 * m + f * (m % 4));
    text += "\n";
  }
  kinemend::ReadOptions options;
  options.format = "csv";
  return kinemend::read_take(text, "small.csv", options).take;
}
