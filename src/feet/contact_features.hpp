// Features of the motion of both feet and of the body's middle for the network that finds standing
// feet. They depend neither on the place and heading of the body nor on its size.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "feet/body_points.hpp"

namespace kinemend::feet {

/// The rate of the network's steps, and the number of features of a foot at each. By definition;
/// the network has learned with them.
inline constexpr double contact_rate_hz = 60;
inline constexpr std::size_t contact_features = 36;
/// The lowest rate of takes in which the network looks for contacts. At lower ones a step of the
/// feet has too few frames, and thresholds decide. Chosen by hand: it has learned from 20 Hz on.
inline constexpr double least_contact_rate_hz = 12;

/// Whether a step may depend on later frames.
enum class Lookahead : std::uint8_t { whole, none };

/// Features of L feet at n steps, each foot's in the same form: lengths in body heights, in axes
/// along the foot, towards the other foot, and up.
struct ContactSteps {
  std::size_t feet = 0, count = 0;
  std::vector<float> features;  ///< L x n x `contact_features`
};

/// `soles`: heel and toe of each foot as points 2 l and 2 l + 1, and the middle of the hips, or of
/// the markers, in `centres`. The other foot of foot l is l ^ 1, if it exists. `touching`: F x 2 L,
/// 1 where thresholds on height and speed find a contact, or empty: not asked. In clean takes they
/// are right, and the network has learned when to believe them.
ContactSteps contact_steps(const BodyPoints& soles, Up up, Lookahead lookahead,
                           std::span<const std::uint8_t> touching = {});

/// The features of a stream of frames, as of `contact_steps` with `Lookahead::none`. Memory is
/// bounded.
class LiveContactSteps {
 public:
  LiveContactSteps(std::size_t feet, double frame_rate_hz, double height, Up up);
  ~LiveContactSteps();
  LiveContactSteps(LiveContactSteps&&) noexcept;

  /// `parts`: 2 L places of the next frame, heel and toe of each foot; `centre`: of the hips.
  void push(std::span<const Vec3> parts, Vec3 centre);
  /// Writes the next step (L x `contact_features`); false if it is later than the last frame.
  bool next_step(std::span<float> rows);

 private:
  struct Body;
  std::unique_ptr<Body> body_;
};

}  // namespace kinemend::feet
