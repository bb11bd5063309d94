// Decides on the frame rate of a table.
#pragma once

#include <cstddef>
#include <string_view>

#include "io/table/marker_table.hpp"
#include "io/text/text.hpp"

namespace kinemend {

/// The statements of a table about its rate.
struct TableRate {
  double stated_hz;            ///< NaN or 0 where nothing is stated
  std::size_t stated_place;    ///< byte at which it is, or would be
  std::size_t rows_place;      ///< byte of the first row
  double asked_hz;             ///< of the options; 0: not given
  double unknown_hz;           ///< the format's own guess
  std::string_view stated_by;  ///< in words: `DataRate`
  std::size_t mismatch_place;  ///< byte that a mismatch with the times is noted at
  std::string_view missing;    ///< in words, where nothing usable is stated
  bool must_be_stated;         ///< whether times and options in its place are a repair too
};

/// The rate that is stated, else that of the times, else the one asked for, else the guess.
/// Repairs: `frame_rate_unusable`, `time_mismatch`, `frame_rate_assumed`.
double table_rate(const SourceText& text, Diagnostics& diagnostics, const RowRate& times,
                  const TableRate& said);

}  // namespace kinemend
