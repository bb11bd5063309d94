// Runs a filter network of Mall et al. frame by frame, with a fixed delay.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/rotation.hpp"
#include "learned/papers/filter_network.hpp"

namespace kinemend {

/// A network of Mall et al. frame by frame: frame t goes in, frame t - 15 comes out, filtered from
/// the frames about it. Recurrent layers carry their forward states on from the past; backward ones
/// begin at the newest frame. That is done anew for three frames at a time, and begins as soon as
/// frame t + 13 is there for frames t, t + 1 and t + 2: the work is spread over the three frames
/// that come in meanwhile. They therefore see 13, 12 and 11 frames ahead; what they have seen of
/// the network's inputs (roughness, turning) ends there too. Their filters see all 15 frames. A
/// network of dense layers alone runs for each frame, and sees 15.
///
/// A sample that is missing is the one before until the next is seen, and then on the straight line
/// between the two as far as it has not come out.
class LiveFilterNetwork {
 public:
  static constexpr std::size_t delay = predicted_filter_reach;  ///< frames
  // Chosen by hand, not swept.
  static constexpr std::size_t period = 3;  ///< frames from one backward pass to the next

  /// `network` outlives this. Errors: `ErrorKind::usage` for one that fills gaps, has a stride, or
  /// sees more than 15 frames on either side.
  LiveFilterNetwork(const FilterNetwork& network, double frame_rate_hz);
  /// Errors: the same.
  static void check(const FilterNetwork& network);

  struct Input {
    std::span<const float> values;          ///< C, degrees
    std::span<const std::uint8_t> missing;  ///< C / 3, 1 where not measured
    Quat root;  ///< its rotation in the world, up to a turn of the world
    bool root_is_missing = false;
  };
  /// True when `out` (C, degrees) holds the next frame. Takes nothing from the heap.
  bool push(const Input& in, std::span<float> out);
  /// After the last frame: gives the remaining frames one by one, then false.
  bool flush(std::span<float> out);
  void reset();

  /// Products of weights with inputs for a frame, in the mean over `period` frames.
  double products_per_frame() const;

 private:
  struct Layer {
    nn::RecurrentState forward;  ///< after the last frame whose outputs are known
    nn::RecurrentState ahead, backward;
  };
  /// A part of a pass: the passes of a network are made of the same ones, in the same order.
  struct Part {
    enum class Kind : std::uint8_t { encode, go_on, look_back, go_back, decode };
    Kind kind;
    std::size_t layer;
    double products;
    std::size_t share;  ///< of `period`: with which frame it is done
  };

  float* value_row(std::size_t row) { return values_.data() + row * channels_; }
  void append(const Input& in);
  void bridge(std::size_t track, std::size_t missed);
  void give(std::span<float> out);
  void plan_parts();
  void begin_pass(std::size_t wanted);
  void run_parts(std::size_t shares);
  void run_part(const Part& part);
  void encode();
  void go_on(std::size_t layer);
  void look_back(std::size_t layer);
  void go_back(std::size_t layer);
  void decode();
  void run_dense(const nn::Dense& layer);
  void fill_features();
  void fill_roughness();
  Vec3 turning(std::size_t row) const;
  bool is_recurrent() const { return !layers_.empty(); }

  const FilterNetwork& network_;
  double rate_hz_;
  std::size_t channels_, width_;
  // The newest frames, as far back as anything looks.
  std::vector<float> values_;
  std::vector<Quat> roots_;
  std::size_t base_ = 0;         ///< number of the first of them
  std::size_t count_ = 0;        ///< of them
  std::size_t next_ = 0;         ///< number of the frame that comes out next
  std::size_t known_ = 0;        ///< outputs are known of frames up to this one, and
  std::size_t first_known_ = 0;  ///< from this one on
  bool is_ending_ = false;
  // The pass that is being made, of outputs for the frames from `known_` on.
  bool is_passing_ = false;
  std::size_t next_part_ = 0, shares_done_ = 0;
  std::size_t rows_ = 0;             ///< frames that it sees
  std::size_t wanted_ = 0;           ///< frames that it is for, the first of these
  nn::MatrixViewF x_;                ///< what the layers so far have made
  std::vector<std::size_t> missed_;  ///< C / 3, frames since it was seen
  std::vector<std::uint8_t> seen_;   ///< C / 3, 1 where it ever was
  // Scratch.
  std::vector<float> features_, outputs_;
  std::vector<float> here_, there_, gates_;  ///< rows of layers
  std::vector<double> squares_, sums_;
  std::vector<Layer> layers_;
  std::vector<Part> parts_;
  PredictedFilterRow filter_;
};

}  // namespace kinemend
