// Keeps an AMC file as it was read so that it can be written back in its own layout, finds which
// line of a frame belongs to which bone, and reads the values of the frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "io/acclaim/asf.hpp"
#include "io/motion/motion_document.hpp"
#include "io/motion/motion_rows.hpp"
#include "io/text/text.hpp"

namespace kinemend {

/// The part of a file before the first frame.
struct AmcHeader {
  std::string_view skeleton_file;  ///< path of a line `#!OML:ASF path`; else empty
  std::optional<bool> radians;
  bool three_dofs = false;     ///< every bone has rx ry rz, whatever the skeleton says
  std::size_t data_begin = 0;  ///< offset of the number of the first frame
};

/// The line of a bone within a frame.
struct AmcBone {
  static constexpr std::size_t no_column = std::numeric_limits<std::size_t>::max();

  std::string name;  ///< as the AMC spells it
  std::size_t joint = 0;
  /// The column of `MotionColumns` for each value; `no_column` for a value without effect.
  std::vector<std::size_t> columns;
};

/// The lines of every frame, in the order of the first frame.
using AmcLayout = std::vector<AmcBone>;

/// Reads the head of an AMC file. Errors: `unreadable_input` with the line.
AmcHeader read_amc_header(const SourceText& text);
/// Finds the bones of the first frame in the skeleton. If the take has three values per bone, the
/// skeleton gets three degrees of freedom per bone. Errors: `unreadable_input`, naming the bone
/// that does not fit.
AmcLayout read_amc_layout(const SourceText& text, const AmcHeader& header, AsfSkeleton& asf,
                          std::string_view asf_name);
/// Returns the lines of the joints that have degrees of freedom, in the order of the skeleton.
AmcLayout make_amc_layout(const AsfSkeleton& asf);

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

/// Returns the first column of each joint in `MotionColumns`.
std::vector<std::size_t> first_columns(const Skeleton& skeleton);

/// Walks over the frames of an AMC: a number on a line of its own, then a line for each bone.
class AmcRows {
 public:
  /// `degrees_per_value` applies to the columns that `is_angle` marks.
  AmcRows(const SourceText& text, std::size_t begin, const AmcLayout& layout,
          const std::vector<std::uint8_t>& is_angle, double degrees_per_value);

  /// Reads the next frame; a value that is not finite becomes NaN. Returns false at the end of the
  /// text, and for a frame that was cut off by the end of the file. `tokens`, unless null, receives
  /// the place of each value. Errors: `unreadable_input` with the line.
  bool next(double* values, TokenSpan* tokens = nullptr);

  std::size_t last_end() const { return static_cast<std::size_t>(last_end_ - text_.bytes.data()); }
  const RowFindings& found() const { return found_; }
  /// Returns the number of the first frame that was read.
  double first_frame_number() const { return first_frame_number_; }
  /// Returns the frames whose number is not one more than the previous frame's.
  const CountedRepair<const char*>& number_jumps() const { return number_jumps_; }
  /// Returns the start of a frame that was cut off by the end of the file, or nullptr.
  const char* cut_frame() const { return cut_frame_; }

 private:
  bool read_frame(double* values, TokenSpan* tokens);
  bool last_value_may_be_cut() const;
  [[noreturn]] void fail(const char* p, std::string_view word, bool may_be_cut,
                         const std::string& message) const;
  const char* skip_lines(const char* p) const;
  const char* skip_blanks(const char* p) const;
  std::string_view word_at(const char* p) const;
  bool read_frame_number();
  bool starts_bone(const char* p, const std::string& name) const;
  void read_bone(const AmcBone& bone, const char* p, double* values, TokenSpan* tokens);
  void read_bones_in_any_order(std::size_t first, double* values, TokenSpan* tokens);
  std::size_t bone_at(const char* p, const std::vector<bool>& seen) const;
  double read_value(const char*& p);
  double read_joined(const char*& p, std::string_view word);
  [[noreturn]] void fail_value(const AmcBone& bone, const char* line, const char* p) const;
  [[noreturn]] void fail_missing(const std::vector<bool>& seen, const char* p) const;

  SourceText text_;
  const char* position_;
  const char* end_;
  PlainPlaces plain_places_;
  const char* last_end_;
  const AmcLayout& layout_;
  const std::vector<std::uint8_t>& is_angle_;
  double degrees_per_value_;
  std::unordered_map<std::string_view, std::size_t> index_of_;
  double frame_number_ = 0, first_frame_number_ = 1;
  bool has_frame_number_ = false;
  RowFindings found_;
  CountedRepair<const char*> number_jumps_;
  const char* data_begin_;
  const char* cut_frame_ = nullptr;
};

}  // namespace kinemend
