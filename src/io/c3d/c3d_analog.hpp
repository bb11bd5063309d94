// Decodes the analog samples of a C3D file, for example from force plates.
#pragma once

#include <cstddef>
#include <vector>

#include "io/c3d/c3d_document.hpp"

namespace kinemend {

/// Reads the analog samples of a file (force plates, muscle sensors and so on): `(stored - OFFSET)
/// * SCALE * GEN_SCALE`, where both stored integers and OFFSET are unsigned if ANALOG:FORMAT says
/// UNSIGNED.
class C3dAnalogDecoder {
 public:
  explicit C3dAnalogDecoder(const C3dDocument& document);

  /// Reads the stored values of one frame: instant by instant, all channels of each.
  void stored(std::size_t frame, std::vector<double>& values) const;
  /// Converts a stored number to a value in the unit of its channel.
  double value(double stored, std::size_t channel) const {
    return (stored - offsets_[channel]) * scales_[channel];
  }

 private:
  const C3dDocument& document_;
  bool is_unsigned_;
  std::vector<double> offsets_;
  std::vector<double> scales_;
};

}  // namespace kinemend
