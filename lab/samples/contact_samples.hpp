// Training samples of the network that finds standing feet: stretches of takes with damage of every
// kind, before and after cleaning, beside the contacts of the clean takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "feet/body_points.hpp"
#include "feet/contact_network.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Heels and toes of one clean take with its contacts, and of damaged versions of it.
struct ContactSource {
  double frame_rate_hz = 0;          ///< of the contacts
  std::vector<std::uint8_t> stands;  ///< F x 2 L: the thresholds find it standing in the clean take
  std::vector<std::uint8_t> has;     ///< 2 L: the foot has this part
  feet::Up up;
  /// Heels and toes of one version, and what thresholds find in it, F x 2 L.
  struct Version {
    feet::BodyPoints soles;
    std::vector<std::uint8_t> touching;
  };
  std::vector<Version> versions;  ///< the first is clean; at rates of their own
};

/// Makes `versions` versions: the clean take, then by turns each capture system, white and
/// correlated noise, some with biases, outliers and held samples, at several rates; every other one
/// cleaned by the default method. None if no legs with toes are found or no foot ever stands.
std::optional<ContactSource> contact_source(const Take& clean, std::size_t versions, Random random);

/// A stretch of a version: played faster or slower, at another rate, on a sloping floor, drifting
/// as a whole, on another body's feet.
struct ContactSample {
  feet::ContactSteps steps;
  std::vector<float> truth;   ///< L x n x 2, 0 or 1
  std::vector<float> weight;  ///< L x n x 2, 0 where the foot lacks the part
};

/// The same `random` gives the same sample.
ContactSample random_contact_sample(std::span<const ContactSource> sources, std::size_t steps,
                                    feet::Lookahead lookahead, Random random);

}  // namespace kinemend
