// Heels and toes of a motion, and the contacts that are found from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "feet/floor.hpp"
#include "feet/leg_motion.hpp"

namespace kinemend::feet {

/// Heels and toes of a motion and their speeds, from which contacts are detected.
struct Soles {
  BodyPoints body;                ///< as measured; points 2 l + part
  std::vector<SolePoint> points;  ///< smoothed according to the noise; 2 l + part
  std::vector<std::uint8_t> has;  ///< 2 l + part; 0 for a missing part
  std::vector<double> paces;      ///< F: speed of the body relative to walking, at least 1
  Up up;
  double height = 0;  ///< of the body

  static std::size_t point_of(std::size_t leg, FootPart part) {
    return 2 * leg + static_cast<std::size_t>(part);
  }
  static std::size_t point_of(const FootContact& contact) {
    return point_of(contact.leg, contact.part);
  }
  std::size_t legs() const { return points.size() / 2; }
};

Soles find_soles(const LegMotion& motion, Up up, const ContactSettings& settings);
/// The same of heels and toes as points 2 l and 2 l + 1, all of which exist.
Soles find_soles(BodyPoints heels_and_toes, Up up, const ContactSettings& settings);

/// Contacts by leg, part, then frame.
struct FoundContacts {
  std::vector<FootContact> contacts;
  /// `StandingTime::expected_s`, of legs that the network knows; empty without a network.
  std::optional<double> expected_s = {};
};
/// Finds the contacts as the settings ask. Legs without toes are left to the thresholds.
FoundContacts find_contacts(const Soles& soles, const ContactSettings& settings);

struct ContactNetwork;
/// Returns the contacts that the network finds likely: of each foot the most likely sequence of
/// standing on heel, toe, both or neither, where changes have a cost. The confidence of a contact
/// is its mean likelihood. `by_thresholds`: contacts of the same take that thresholds find.
FoundContacts likely_contacts(const ContactNetwork& network, const Soles& soles,
                              const std::vector<FootContact>& by_thresholds,
                              const ContactSettings& settings);

/// Returns F x points, 1 where one of the contacts holds the point.
std::vector<std::uint8_t> contact_flags(const std::vector<FootContact>& contacts,
                                        std::size_t frames, std::size_t points);

/// Returns the time found in contacts, with their confidence, and what is expected of it.
StandingTime standing_time(const std::vector<FootContact>& contacts,
                           std::optional<double> expected_s, std::size_t frames, std::size_t legs,
                           double frame_rate_hz);
/// Returns the seconds of `contacts` with a flag, summed over legs; all of them without flags.
double standing_s(const std::vector<FootContact>& contacts, std::span<const std::uint8_t> flags,
                  std::size_t frames, std::size_t legs, double frame_rate_hz);

/// Throws `ErrorKind::usage` for settings out of range.
void check_settings(const ContactSettings& settings);
/// Throws `ErrorKind::usage` for contacts of legs, parts or frames that do not exist.
void check_contacts(const std::vector<FootContact>& contacts, const LegMotion& motion,
                    std::size_t first_frame);
void sort_contacts(std::vector<FootContact>& contacts);

}  // namespace kinemend::feet
