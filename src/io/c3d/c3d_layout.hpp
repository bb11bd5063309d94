// Where the sections of a C3D file are, and how its samples are stored.
#pragma once

#include <cstddef>
#include <cstdint>

#include "io/c3d/c3d_parameters.hpp"
#include "io/c3d/c3d_source.hpp"

namespace kinemend {

/// Where the sections of a C3D file are, and how its samples are stored.
struct C3dLayout {
  std::size_t header_begin = 0;  ///< some files start with zero bytes
  std::size_t parameters_begin = 0;
  std::size_t data_begin = 0;
  std::size_t point_count = 0;
  std::size_t frame_count = 0;
  std::int64_t first_frame = 1;
  double rate_hz = 0;             ///< 0 if the file has no usable rate
  bool is_float = false;          ///< 32-bit reals, already scaled; else 16-bit integers
  double scale = 1;               ///< > 0; scale of integers and of residuals
  std::size_t analog_count = 0;   ///< channels
  std::size_t analog_values = 0;  ///< per frame: all channels at all instants

  std::size_t value_bytes() const { return is_float ? 4 : 2; }
  std::size_t point_bytes() const { return 4 * point_count * value_bytes(); }
  /// A frame has its points, then its analog values.
  std::size_t frame_bytes() const { return point_bytes() + analog_values * value_bytes(); }
  std::size_t data_end() const { return data_begin + frame_count * frame_bytes(); }
  /// Returns the analog instants per frame.
  std::size_t analog_instants() const {
    return analog_count == 0 ? 0 : analog_values / analog_count;
  }
};

/// The used fields of the first 512 bytes. Words are numbered as for `c3d_word_offset`.
struct C3dHeader {
  std::size_t begin = 0;
  std::size_t parameters_begin = 0;
  std::size_t point_count = 0;      ///< word 2
  std::size_t analog_values = 0;    ///< word 3, per frame
  std::size_t first_frame = 0;      ///< word 4
  std::size_t last_frame = 0;       ///< word 5; 65,535 if it is larger
  float scale = 0;                  ///< words 7 and 8; negative: the samples are reals
  std::size_t data_block = 0;       ///< word 9, from 1
  std::size_t analog_instants = 0;  ///< word 10, per frame
  float rate_hz = 0;                ///< words 11 and 12

  /// Returns the offset of a word in the file.
  std::size_t place_of(std::size_t word) const { return begin + c3d_word_offset(word); }
};

/// Finds header and parameter section, and sets the processor of `source`. Errors:
/// `unreadable_input` for a file that is not C3D.
C3dHeader read_c3d_header(C3dSource& source);
/// Reads the parameters that follow a header.
C3dParameters read_c3d_parameters(const C3dSource& source, const C3dHeader& header);
/// Header and parameters often disagree. Among all their claims, those that make the data end with
/// the file are used, else those that fit into it, with a diagnostic; parameters take precedence
/// over the header. Errors: `unreadable_input` if the data section is not inside the file.
C3dLayout find_c3d_layout(const C3dSource& source, const C3dHeader& header,
                          const C3dParameters& parameters);

}  // namespace kinemend
