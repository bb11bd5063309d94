// Keeps a CSV file as it was read so that it can be written back in its own layout.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/table/marker_table.hpp"
#include "io/text/text.hpp"
#include "kinemend/take.hpp"
#include "motion/take_change.hpp"

namespace kinemend {

/// Adjacent columns that belong together.
struct CsvGroup {
  enum class Kind : std::uint8_t {
    position,     ///< LABEL_x, LABEL_y, LABEL_z
    rotation,     ///< LABEL_w, LABEL_x, LABEL_y, LABEL_z, or w last
    translation,  ///< LABEL_tx, LABEL_ty, LABEL_tz
  };
  Kind kind = Kind::position;
  std::string label;
  std::array<std::size_t, 4> columns{};  ///< w, x, y, z for a rotation, else x, y, z
};

/// A line `# key: value`.
struct CsvNote {
  std::string key;
  std::string value;
  std::size_t place = 0;
};

/// The lines above the rows of a CSV file.
struct CsvHeader {
  std::vector<CsvNote> notes;
  std::vector<CsvGroup> groups;
  std::vector<std::string> ignored;  ///< columns that are not frame, time or in a group
  CellStyle style;
  std::int32_t frame_column = -1;
  std::int32_t time_column = -1;
  double seconds_per_time = 1;
  double frame_rate_hz = 0;  ///< 0 if the head states no rate
  std::string unit;
  std::size_t labels_line = 0;
  std::size_t data_begin = 0;
  std::size_t data_end = 0;       ///< upper bound for the end of the last row
  std::size_t foreign_lines = 0;  ///< unrecognised lines above the labels
  std::size_t foreign_place = 0;  ///< place of the first such line
  bool unit_is_custom = false;    ///< the file states no unit; its program always uses this one
  std::string beside;             ///< description of the file's other data; empty: none

  bool has_rotations() const;
  /// Whether a line `# frames: 0` states that there are no rows.
  bool has_no_frames() const;
};

/// Parses up to the first row. Errors: `unreadable_input` with the line.
CsvHeader read_csv_header(const SourceText& text);
/// Whether the text begins with such a head.
bool has_csv_header(std::string_view head);

/// A CSV file as it was read. The bytes hold every digit, so only a few offsets are stored with
/// them.
struct CsvDocument : FollowingDocument {
  std::string bytes;
  std::string beside;  ///< description of the file's other data; empty: none
  double frame_rate_hz = 0;
  MarkerTable table;  ///< for joints: without markers

  std::vector<std::string> names;
  std::int64_t first_frame = 1;
  std::string unit;

  std::vector<CsvGroup> groups;
  Skeleton skeleton;
  double metres_per_unit = 0;
  std::vector<Vec3> positions;  ///< positions after repair; empty if the file has all of them

  std::shared_ptr<const SourceDocument> after(const TakeChange& change) const override;
};

/// The contents of a table besides its markers, for a take that is written without its layout.
struct TableRest : FollowingDocument {
  std::string beside;

  std::shared_ptr<const SourceDocument> after(const TakeChange& change) const override;
};

}  // namespace kinemend
