// Synthetic clips and findings by kind, for tests of checks.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "kinemend/check.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"

namespace kinemend::test {

inline Take synthetic_clip(const std::string& motion, double duration_s = 6,
                           double frame_rate_hz = 120, bool t_pose_first = false) {
  SynthOptions options;
  options.motion = motion;
  options.duration_s = duration_s;
  options.frame_rate_hz = frame_rate_hz;
  options.t_pose_first = t_pose_first;
  return synthesize(options);
}

inline std::vector<Finding> of_kind(const CheckReport& report, FindingKind kind) {
  std::vector<Finding> found;
  for (const Finding& finding : report.findings) {
    if (finding.kind == kind) found.push_back(finding);
  }
  return found;
}

/// Lists all findings except notes, for messages.
inline std::string faults_of(const CheckReport& report) {
  std::string text;
  for (const Finding& f : report.findings) {
    if (f.severity == Severity::note) continue;
    text += std::string(to_string(f.kind)) + " of " + f.track + " at " +
            std::to_string(f.first_frame) + "; ";
  }
  return text;
}

/// Lists findings that cast doubt on a take without being faults, for messages.
inline std::string doubts_of(const CheckReport& report) {
  std::string text;
  for (const Finding& f : report.findings) {
    if (f.kind == FindingKind::expected_noise || f.kind == FindingKind::no_contact)
      text += std::string(to_string(f.kind)) + ": " + std::to_string(f.figure) + "; ";
  }
  return text;
}

inline std::size_t joint_of(const Take& clip, std::string_view name) {
  return static_cast<std::size_t>(clip.skeleton.find(name));
}

}  // namespace kinemend::test
