// Keeps a CSV file as it was read so that it can be written back in its own layout, and reads the
// lines above its rows: its own head, and those of single programs' exports.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/table/marker_table.hpp"
#include "io/text/text.hpp"
#include "kinemend/take.hpp"
#include "motion/conversions.hpp"

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

using Cells = std::vector<std::string>;

inline constexpr std::size_t most_columns = 4 * most_markers;

std::string_view without_spaces_around(std::string_view text);
/// Returns NaN if the text is not a finite number. A decimal comma is allowed.
double number_of(std::string_view text);
/// Returns a comma, semicolon or tab: the one that occurs most often in the line outside quotes.
char separator_of(std::string_view line);
/// Returns `decimal` if the first row can only be read with decimal commas.
CommaStyle commas_of(std::string_view rows, char separator);

/// Walks over the lines of a head.
class HeadLines {
 public:
  HeadLines(const SourceText& text, std::size_t begin) : text_(&text), next_(begin) {}

  bool at_end() const { return next_ >= text_->bytes.size(); }
  std::size_t place() const { return place_; }  ///< place of the last line taken
  std::size_t next() const { return next_; }
  std::string_view take();
  /// Returns the cells of the next line. Errors: more columns than any table has.
  Cells take_cells();
  char separator() const { return separator_; }  ///< separator of the last cells taken

 private:
  const SourceText* text_;
  std::size_t place_ = 0;
  std::size_t next_ = 0;
  char separator_ = ',';
};

/// Whether the text begins with a section of Vicon's programs (Nexus and its predecessors), which
/// has a name and a rate.
bool starts_with_vicon_section(std::string_view text);
/// Reads the head of the trajectories. Errors: an export without trajectories.
CsvHeader read_vicon_header(const SourceText& text);

/// Whether the text begins with a head of OptiTrack's Motive.
bool starts_as_motive_export(std::string_view text);
/// Reads the columns of its markers. Errors: an export without markers.
CsvHeader read_motive_header(const SourceText& text);

}  // namespace kinemend
