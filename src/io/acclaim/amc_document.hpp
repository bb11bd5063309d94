// Keeps an AMC file as it was read so that it can be written back in its own layout.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/acclaim/amc_layout.hpp"
#include "io/motion/motion_document.hpp"

namespace kinemend {

/// An AMC file as it was read, with its ASF file; for an ASF alone, `bytes` is empty.
struct AmcDocument : MotionDocument {
  std::string name;           ///< name of the AMC file
  std::string skeleton_name;  ///< name of the ASF file, without its folder
  std::string asf_bytes;
  double metres_per_unit = 0;
  AmcLayout layout;
  std::vector<std::uint8_t> is_angle;  ///< one per column

  std::unique_ptr<RowReader> rows() const override;
};

/// Returns for each column of `MotionColumns` whether it holds an angle.
std::vector<std::uint8_t> angle_columns(const Skeleton& skeleton);

}  // namespace kinemend
