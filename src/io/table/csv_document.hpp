// Keeps a CSV file as it was read so that it can be written back in its own layout, and reads the
// lines above its rows: its own head, and those of single programs' exports.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/table/marker_table.hpp"
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

/// A column that is kept in the file, and not read.
struct CsvIgnored {
  std::string label;
  std::size_t place = 0;
};

/// The lines above the rows of a CSV file.
struct CsvHeader {
  std::vector<CsvNote> notes;
  std::vector<CsvGroup> groups;
  std::vector<CsvIgnored> ignored;  ///< columns that are not frame, time or in a group
  CellStyle style;
  std::int32_t frame_column = -1;
  std::int32_t time_column = -1;
  double seconds_per_time = 1;
  bool time_has_unit = false;        ///< the label of the times names their unit
  std::size_t labelled_columns = 0;  ///< columns up to the last label
  double frame_rate_hz = 0;          ///< 0 if the head states no rate
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

/// A CSV file as it was read; `table` has no markers in a file of joints, whose samples the members
/// from `groups` on describe.
struct CsvDocument : FollowingDocument, TableFile {
  std::string beside;  ///< description of the file's other data; empty: none

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

/// Whether the text begins with a section of Vicon's programs (Nexus and its predecessors), which
/// has a name and a rate.
bool starts_with_vicon_section(std::string_view text);
/// Reads the head of the trajectories. Errors: an export without trajectories.
CsvHeader read_vicon_header(const SourceText& text);

/// Whether the text begins with a head of OptiTrack's Motive.
bool starts_as_motive_export(std::string_view text);
/// Reads the columns of its markers. Errors: an export without markers.
CsvHeader read_motive_header(const SourceText& text);

/// Reads a table of joints. Repairs: `skeleton_missing`, `rotation_missing`, `position_missing`,
/// `rotation_not_unit`, `value_not_finite`, `row_too_short`. Errors: `unreadable_input`, naming the
/// line.
Take read_csv_joints(const SourceText& text, const CsvHeader& header, CsvDocument& document,
                     RowLabels& labels);

/// The document's bytes with every changed sample replaced. The clip has its skeleton and frames.
std::string rewrite_csv_joints(const Take& clip, const CsvDocument& document);

/// Returns the lines of a skeleton, joint by joint, then end sites:
///   # joint 3: LeftKnee; parent 2; offset 0 -8.1 0; channels Zrotation Yrotation Xrotation
///   # end 0: Toe; parent 5; offset 0 0 1.2 `rest w x y z` is added if the rest rotation is not the
///   identity, `limits low high ...` if there are limits. A name with a semicolon, a quote or
///   blanks at its ends is quoted. Errors: `usage` for a name with a line end.
std::string skeleton_lines(const Skeleton& skeleton);

/// Returns the skeleton of such lines, without joints if there are no such lines. Errors:
/// `unreadable_input`, naming the line.
Skeleton read_skeleton_lines(const SourceText& text, const std::vector<CsvNote>& notes);

}  // namespace kinemend
