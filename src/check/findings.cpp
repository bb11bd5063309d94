// Names kinds of findings and sorts findings by their importance.
#include "check/checks.hpp"

#include <algorithm>
#include <array>
#include <tuple>

namespace kinemend {

std::string_view to_string(FindingKind kind) {
  static constexpr std::array<std::string_view, 25> names{"gap",
                                                          "spike",
                                                          "frozen",
                                                          "bridged",
                                                          "noise",
                                                          "swap",
                                                          "rate",
                                                          "unit",
                                                          "length",
                                                          "slide",
                                                          "sink",
                                                          "euler_flip",
                                                          "repeated_frames",
                                                          "zero_frames",
                                                          "calibration",
                                                          "left_out",
                                                          "no_contact",
                                                          "expected_noise",
                                                          "joint_speed",
                                                          "joint_acceleration",
                                                          "penetration",
                                                          "floating",
                                                          "flight",
                                                          "jump",
                                                          "floor"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view to_string(Severity severity) {
  static constexpr std::array<std::string_view, 3> names{"note", "warning", "serious"};
  return names[static_cast<std::size_t>(severity)];
}

namespace check {

namespace {

// Findings that affect most uses of a take come first.
std::size_t rank_of(FindingKind kind) {
  static constexpr std::array<FindingKind, 25> order{FindingKind::swap,
                                                     FindingKind::zero_frames,
                                                     FindingKind::jump,
                                                     FindingKind::rate,
                                                     FindingKind::unit,
                                                     FindingKind::spike,
                                                     FindingKind::gap,
                                                     FindingKind::frozen,
                                                     FindingKind::bridged,
                                                     FindingKind::joint_speed,
                                                     FindingKind::joint_acceleration,
                                                     FindingKind::repeated_frames,
                                                     FindingKind::length,
                                                     FindingKind::slide,
                                                     FindingKind::sink,
                                                     FindingKind::no_contact,
                                                     FindingKind::penetration,
                                                     FindingKind::floating,
                                                     FindingKind::noise,
                                                     FindingKind::expected_noise,
                                                     FindingKind::euler_flip,
                                                     FindingKind::flight,
                                                     FindingKind::floor,
                                                     FindingKind::calibration,
                                                     FindingKind::left_out};
  return static_cast<std::size_t>(std::find(order.begin(), order.end(), kind) - order.begin());
}

}  // namespace

void sort_worst_first(std::vector<Finding>& findings) {
  const auto key = [](const Finding& f) {
    return std::make_tuple(-static_cast<int>(f.severity), rank_of(f.kind), -f.figure, f.first_frame,
                           std::string_view(f.track));
  };
  std::stable_sort(findings.begin(), findings.end(),
                   [&](const Finding& a, const Finding& b) { return key(a) < key(b); });
}

}  // namespace check

}  // namespace kinemend
