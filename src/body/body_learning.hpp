// The sums over many takes from which a layout is learned.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/body.hpp"
#include "motion/rotation.hpp"

namespace kinemend::representation {

class JointLearning {
 public:
  JointLearning(std::vector<std::string> patterns, double trend_s);
  void add(const Take& clip);
  BodyLayout finish() const;

 private:
  struct Track {
    rotation::Matrix4 moment{};  // sum of q q^T
    Quat first;
    double largest_turn = 0;  // from the first, radians
    std::size_t samples = 0, takes = 0;
  };

  void start(const Take& clip);
  void add_rotations(const Take& clip, const BodyMatch& match, std::size_t track,
                     const std::vector<Quat>& rotations);

  std::vector<std::string> patterns_;
  BodyLayout layout_;  // all tracks that may turn; references are identity, the place is the floor
  std::vector<Track> tracks_;
  Vec3 place_sum_, place_low_, place_high_;
  std::size_t places_ = 0, takes_ = 0;
};

class MarkerLearning {
 public:
  MarkerLearning(std::vector<std::string> patterns, double trend_s);
  void add(const Take& clip);
  BodyLayout finish() const;

 private:
  struct Track {
    Vec3 mean_sum;   // of positions in the body's frame, body heights
    Vec3 shape_sum;  // in a frame that leans with the anchors
    std::size_t samples = 0, shaped = 0, takes = 0;
  };
  struct Distance {  // between two tracks, body heights
    double sum = 0, square_sum = 0;
    std::size_t samples = 0;
  };

  BodyMatch start(const Take& clip);
  void sum_distances(const Take& clip, const BodyMatch& match);
  void sum_shape(const Take& clip, const BodyMatch& match);
  void sum_means(const Take& clip, const BodyMatch& match);
  double unsteadiness(std::size_t track) const;
  void choose_anchors();
  void stand_upright(const Take& clip, const BodyMatch& match);

  std::vector<std::string> patterns_;
  BodyLayout layout_;  // the part known so far
  std::vector<Track> tracks_;
  std::vector<Distance> distances_;  // N x N, from a track to later ones
  std::size_t takes_ = 0;
};

}  // namespace kinemend::representation
