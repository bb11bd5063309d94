// Algorithm 1 of Xiao et al. 2015 as published, without the additions of the method `sparse`: local
// coordinates of each pose, all windows, plain losses, and no later steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kinemend/extend/body.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/take.hpp"
#include "papers/xiao2015_sparse/descent_solver.hpp"
#include "papers/xiao2015_sparse/sparse_prior.hpp"

namespace kinemend::papers {

struct XiaoPaperSizes {
  std::size_t window_frames = 15;  ///< M, at the rate of the takes
  std::size_t atoms = 500;         ///< K
  std::size_t windows = 10'000;    ///< for training dictionaries, drawn evenly from all
  std::size_t iterations = 10;     ///< of K-SVD
  bool whole = false;              ///< one part of all markers, in place of poselets (table 2)
};

enum class XiaoPaperLoss : std::uint8_t {
  squares,   ///< eq. 4
  absolute,  ///< eq. 5
  sequence,  ///< eq. 4 on the result of eq. 5
};

struct XiaoPaperSettings {
  XiaoPaperLoss loss = XiaoPaperLoss::squares;
  double lambda_squares = 1, lambda_absolute = 1;  ///< for eq. 4 and 5, lengths in centimetres
  /// Near the minimum. Closer to it, the error of a take changes in the third digit.
  sparse::DescentSettings descent{};
};

/// Every marker's running median over `frames` frames, then its running mean over as many; 1: the
/// take itself. Windows reach as far forth as back, so at the ends they are shorter.
Take steady_take(Take clip, std::size_t frames);

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
  /// The parts with their dictionaries: values of a window are ordered by frame, point and axis.
  const std::vector<SparsePoselet>& poselets() const noexcept { return poselets_; }

 private:
  void find_parts(const std::vector<Take>& clips);
  PoseMatrix filter(const PoseMatrix& local, bool is_absolute, const XiaoPaperSettings& settings,
                    std::size_t hop) const;

  XiaoPaperSizes sizes_;
  LocalPoints local_;
  std::vector<SparsePoselet> poselets_;  // means are not used
};

/// Algorithm 1 in several sizes, each trained when it is first wanted.
class XiaoPapers {
 public:
  /// `sizes`: what all have besides M and K.
  XiaoPapers(std::vector<Take> clips, const XiaoPaperSizes& sizes)
      : clips_(std::move(clips)), sizes_(sizes) {}

  const XiaoPaper& of(std::size_t window_frames, std::size_t atoms) {
    const auto found = papers_.find({window_frames, atoms});
    if (found != papers_.end()) return found->second;
    XiaoPaperSizes sizes = sizes_;
    sizes.window_frames = window_frames;
    sizes.atoms = atoms;
    return papers_.try_emplace({window_frames, atoms}, clips_, sizes).first->second;
  }

 private:
  std::vector<Take> clips_;
  XiaoPaperSizes sizes_;
  std::map<std::pair<std::size_t, std::size_t>, XiaoPaper> papers_;
};

}  // namespace kinemend::papers
