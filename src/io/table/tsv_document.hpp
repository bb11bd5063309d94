// Keeps a TSV file as it was read so that it can be written back in its own layout.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/table/marker_table.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// A table of Qualisys Track Manager as it was read: the bytes hold every digit.
struct TsvDocument : SourceDocument {
  std::string bytes;
  MarkerTable table;
  std::vector<std::string> names;
  std::vector<MarkerEvent> events;
  double frame_rate_hz = 0;
  std::int64_t first_frame = 1;
  std::string unit;
};

}  // namespace kinemend
