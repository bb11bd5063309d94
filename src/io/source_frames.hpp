#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "io/motion_columns.hpp"
#include "io/motion_document.hpp"

namespace kinemend {

/// The frames of a document's text, decoded as its reader did, a block at a time.
class SourceFrames {
 public:
  explicit SourceFrames(const MotionDocument& document);

  const MotionColumns& columns() const { return columns_; }

  /// Moves to the next block; false after the last.
  bool next();

  std::size_t first() const { return first_; }
  std::size_t count() const { return count_; }
  /// By frame within the block. Position columns are repaired, angles are as the file has them, in
  /// degrees.
  const double* row(std::size_t frame) const { return rows_.data() + frame * columns_.count(); }
  const TokenSpan* tokens(std::size_t frame) const {
    return tokens_.data() + frame * columns_.count();
  }
  const Quat* rotations(std::size_t frame) const { return rotations_.data() + frame * joints_; }

 private:
  void hold();

  const MotionDocument& document_;
  MotionColumns columns_;
  std::size_t joints_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  std::vector<double> rows_;
  std::vector<TokenSpan> tokens_;
  std::vector<Quat> rotations_;
  std::vector<Quat> last_rotations_;
  std::vector<double> last_positions_;
  std::unique_ptr<RowReader> text_;
};

}  // namespace kinemend
