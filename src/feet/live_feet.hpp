// Holds standing feet frame by frame, without knowledge of later frames and without a delay of its
// own.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "feet/contact_network.hpp"
#include "feet/leg_motion.hpp"
#include "kinemend/feet.hpp"

namespace kinemend::feet {

/// Holds the feet of one stream of joints. A foot that likely stands (`ContactNetwork` without
/// lookahead; without it, a low and slow foot) is held in place; when it lifts, its correction
/// fades. Only legs change, and only horizontally. Does nothing for a skeleton without legs.
class LiveFeet {
 public:
  /// `like`: a take of joints; its frames are not used.
  explicit LiveFeet(const Take& like);

  /// Corrects the rotations (J) of a frame; `positions` are as in a take.
  void hold(std::vector<Quat>& rotations, const std::vector<Vec3>& positions);
  std::size_t feet() const { return feet_.size(); }

 private:
  static constexpr std::size_t parts = 2;  ///< heel and toe
  /// A point of a foot over the last input frames.
  struct Part {
    std::deque<Vec3> path;
    std::deque<double> heights;
    double level = 0;  ///< its height in ground contact
    double speed = 0;  ///< body heights a second
    double odds = 0;   ///< logarithm of the odds that it stands
  };
  struct Foot {
    std::array<Part, parts> at;
    int anchor = -1;  ///< the part that is held; -1: none
    Vec3 target;      ///< place at which the anchor is held
    Vec3 offset;      ///< displacement of the foot from the input
  };

  void track(Part& part, Vec3 place, double height) const;
  void start();
  void estimate();
  int anchor_of(const Foot& foot) const;
  int likely_anchor_of(const Foot& foot) const;
  void move(Foot& foot) const;

  std::vector<Leg> legs_;
  Take one_;  ///< a take of one frame
  LegMotion motion_;
  std::optional<Up> up_;
  std::vector<Foot> feet_;
  /// The network on the steps of the stream.
  struct Estimate {
    LiveContactSteps steps;
    LiveContactNetwork network;
    std::vector<float> rows;
  };
  std::shared_ptr<const ContactNetwork> network_;  // null: thresholds decide
  std::optional<Estimate> estimate_;
};

}  // namespace kinemend::feet
