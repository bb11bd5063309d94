// The space in which a body moves: its up direction, the floor, and the ground contacts of feet.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "feet/body_points.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/take.hpp"

namespace kinemend::page {

/// The time of a ground contact.
struct StageContact {
  std::vector<std::size_t> points;  ///< joints, then end sites, or markers, with ground contact
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive
};

struct Stage {
  feet::Up up;
  double floor = 0;   ///< along `up`, file units
  double height = 0;  ///< of the body, file units; positive
  std::vector<StageContact> contacts;
};

Stage stage_of(const Take& take);
/// Returns the contacts that `clean` used.
std::vector<StageContact> contacts_of(const FeetReport& report, const Take& clip);

}  // namespace kinemend::page
