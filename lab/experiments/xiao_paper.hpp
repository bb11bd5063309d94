// Algorithm 1 of Xiao et al. 2015 as published, without the additions of the method `sparse`: local
// coordinates of each pose, all windows, plain losses, and no later steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kinemend/extend/body.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/take.hpp"
#include "papers/xiao2015_sparse/sparse_prior.hpp"

namespace kinemend::papers {

struct XiaoPaperSizes {
  std::size_t window_frames = 15;  ///< M, at the rate of the takes
  std::size_t atoms = 500;         ///< K
  std::size_t windows = 10'000;    ///< for training dictionaries, drawn evenly from all
  std::size_t iterations = 10;     ///< of K-SVD
};

enum class XiaoPaperLoss : std::uint8_t {
  squares,   ///< eq. 4
  absolute,  ///< eq. 5
  sequence,  ///< eq. 4 on the result of eq. 5
};

struct XiaoPaperSettings {
  XiaoPaperLoss loss = XiaoPaperLoss::squares;
  double lambda_squares = 1, lambda_absolute = 1;  ///< for eq. 4 and 5, lengths in centimetres
};

class XiaoPaper {
 public:
  /// Trains on clips with the same markers, in metres.
  XiaoPaper(const std::vector<Take>& clips, const XiaoPaperSizes& sizes);

  /// The filtered take, which needs at least M frames. Each pose is converted to the local
  /// coordinates of the same pose in `posed` and back: the noisy take itself, as in the paper, or
  /// the ground truth, as if noise were added to local coordinates. `hop` is the number of frames
  /// between windows; 1 uses all T - M + 1 windows.
  Take filtered(const Take& noisy, const Take& posed, const XiaoPaperSettings& settings,
                std::size_t hop = 1) const;

  const XiaoPaperSizes& sizes() const noexcept { return sizes_; }

 private:
  void find_parts(const std::vector<Take>& clips);
  PoseMatrix filter(const PoseMatrix& local, bool is_absolute, double lambda,
                    std::size_t hop) const;

  XiaoPaperSizes sizes_;
  LocalPoints local_;
  std::vector<SparsePoselet> poselets_;  // means are not used
};

}  // namespace kinemend::papers
