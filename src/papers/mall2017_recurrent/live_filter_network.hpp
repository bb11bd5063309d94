// Runs a filter network of Mall et al. frame by frame, with a fixed delay.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/extend/rotation.hpp"
#include "papers/mall2017_recurrent/filter_network.hpp"

namespace kinemend {

/// A network of Mall et al. frame by frame: frame t enters, frame t - 15 leaves, filtered from the
/// frames about it. Recurrent layers keep their forward states from the past; backward passes start
/// at the newest frame. A backward pass serves three frames, t, t + 1 and t + 2, and starts as soon
/// as frame t + 13 is received; its work is spread over the next three frames. The pass therefore
/// sees 13, 12 and 11 frames ahead of them, and the network's inputs (roughness, turning) end there
/// too. Their filters see all 15 frames. A network of dense layers alone runs for each frame, and
/// sees 15.
///
/// A missing sample holds the one before until the next is seen. Then frames of the gap that are
/// not yet out are interpolated linearly.
class LiveFilterNetwork {
 public:
  static constexpr std::size_t delay = predicted_filter_reach;  ///< frames
  // Chosen by hand, not swept.
  static constexpr std::size_t period = 3;  ///< frames from one backward pass to the next

  /// `network` must outlive this. Errors: `ErrorKind::usage` for a network that fills gaps, has a
  /// stride, or sees more than 15 frames on either side.
  LiveFilterNetwork(const FilterNetwork& network, double frame_rate_hz);
  /// Errors: as of the constructor.
  static void check(const FilterNetwork& network);

  struct Input {
    std::span<const float> values;          ///< C, degrees
    std::span<const std::uint8_t> missing;  ///< C / 3, 1 for unmeasured samples
    Quat root;  ///< rotation in the world, up to a constant rotation of the world
    bool root_is_missing = false;
  };
  /// True when `out` (C, degrees) holds the next frame. Does not allocate.
  bool push(const Input& in, std::span<float> out);
  /// Called after the last frame: gives the remaining frames one by one, then returns false.
  bool flush(std::span<float> out);
  void reset();

  /// Multiply-adds for a frame, averaged over `period` frames.
  double products_per_frame() const;

 private:
  struct Layer {
    nn::RecurrentState forward;  ///< after the last frame whose outputs are known
    nn::RecurrentState ahead, backward;
  };
  /// A part of a pass. All passes of a network have the same parts in the same order.
  struct Part {
    enum class Kind : std::uint8_t { encode, go_on, look_back, go_back, decode };
    Kind kind;
    std::size_t layer;
    double products;
    std::size_t share;  ///< of `period`: the frame with which it runs
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
  // The newest frames, as many as filters and passes need.
  std::vector<float> values_;
  std::vector<Quat> roots_;
  std::size_t base_ = 0;   ///< number of the first of these frames
  std::size_t count_ = 0;  ///< number of these frames
  std::size_t next_ = 0;   ///< number of the next output frame
  std::size_t known_ = 0;  ///< outputs exist for frames [first_known_, known_)
  std::size_t first_known_ = 0;
  bool is_ending_ = false;
  // The current pass, for outputs of the frames from `known_` on.
  bool is_passing_ = false;
  std::size_t next_part_ = 0, shares_done_ = 0;
  std::size_t rows_ = 0;             ///< frames of its input
  std::size_t wanted_ = 0;           ///< frames of its output, the first of these
  nn::MatrixViewF x_;                ///< output of the layers so far
  std::vector<std::size_t> missed_;  ///< C / 3, frames since the joint was seen
  std::vector<std::uint8_t> seen_;   ///< C / 3, 1 if the joint was ever seen
  // Scratch.
  std::vector<float> features_, outputs_;
  std::vector<float> here_, there_, gates_;  ///< rows of layers
  std::vector<double> squares_, sums_;
  std::vector<Layer> layers_;
  std::vector<Part> parts_;
  PredictedFilterRow filter_;
};

}  // namespace kinemend
