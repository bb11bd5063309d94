// Reports as pages of HTML, curves and pictures of takes, and the rows of a batch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinemend/report.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// A drawing in SVG, in pixels from the top left corner. Coordinates are written to a tenth, lines
/// as steps from point to point, so that long curves stay small. `attributes` and `element` are
/// inserted as SVG; escape any other text with `xml_escaped` first.
class Svg {
 public:
  struct Point {
    double x = 0, y = 0;
  };

  Svg(double width, double height, std::string_view title);

  void open_group(std::string_view attributes);
  void close_group();
  void raw(std::string_view element);
  void rectangle(double x, double y, double width, double height, std::string_view attributes);
  void circle(Point centre, double radius, std::string_view attributes = "");
  void text(double x, double y, std::string_view attributes, std::string_view content);
  void line(Point from, Point to, std::string_view attributes = "");
  /// Adds one element of several lines.
  void path(const std::vector<std::vector<Point>>& lines, std::string_view attributes = "");

  /// Returns the whole drawing, to which no more can be added.
  std::string finish() &&;

 private:
  void append_number(long tenths);
  void append_pair(long x, long y);
  void append_line(const std::vector<Point>& points);

  std::string text_;
};

/// Returns text that is valid in an element or attribute of XML. Control characters, which XML
/// cannot hold, and bytes that are not UTF-8 are replaced.
std::string xml_escaped(std::string_view text);

/// Curves of one joint or marker. A sample that was not observed is NaN.
struct TrackCurves {
  std::string name;
  std::string quantity;  ///< "rotation" or "position", as in `ReportFinding`
  std::string unit;      ///< "deg" for rotations; for positions the file's, empty if not stated
  std::int64_t first_frame = 1;  ///< the number that the file gives to the first frame
  double frame_rate_hz = 0;
  std::vector<std::string> axes;            ///< "X", "Y", "Z", in the file's order
  std::vector<std::vector<double>> before;  ///< a curve of F values for each axis
  std::vector<std::vector<double>> after;
  /// F: the angle between the rotations, or the distance; NaN if either value is NaN.
  std::vector<double> difference;
};

/// Returns the rotation of a joint as the angles of its channels, without jumps from frame to
/// frame; the angles after cleaning are the ones nearest to the angles before. A joint without
/// rotation channels uses ZXY. All three functions throw `ErrorKind::usage` for takes of different
/// length and for a track that one of them does not have.
TrackCurves rotation_curves(const Take& before, const Take& after, std::size_t joint);
/// Returns the position of joint 0.
TrackCurves root_curves(const Take& before, const Take& after);
TrackCurves marker_curves(const Take& before, const Take& after, std::size_t marker);

struct CurveStyle {
  /// Frames [first, last] to draw, counted from 0; frames beyond the take are ignored.
  std::size_t first_frame = 0, last_frame = SIZE_MAX;
  bool one_take = false;  ///< only the curve after, without a difference
};
/// Draws a panel for each axis with the curve before under the curve after, and a panel of the
/// difference. If there are more frames than pixels, each pixel shows the smallest and the largest
/// value of its frames.
std::string curves_svg(const TrackCurves& curves, const CurveStyle& style = {});

/// Frames [first, last], counted from 0; frames beyond the take are ignored.
using FrameSpanToDraw = std::pair<std::size_t, std::size_t>;

/// Draws `poses` poses from left to right, seen from the direction in which the body is broadest,
/// with up at the top and the frame's number below each pose. `after` is drawn over `before`; null
/// for a single take. Markers are dots. Errors: `ErrorKind::usage` for takes of different length.
std::string film_strip_svg(const Take& before, const Take* after, FrameSpanToDraw frames,
                           std::size_t poses = 9);

/// Draws the take in motion, as an animation (SMIL) that browsers repeat: a fixed camera shows the
/// side along which the motion reaches farthest, at up to 30 poses per second. With `after` the two
/// takes move side by side. Errors: `ErrorKind::usage` for takes of different length, and for more
/// than 1800 poses (a minute).
std::string moving_picture_svg(const Take& before, const Take* after, FrameSpanToDraw frames);

/// Power density of a track over frequency.
struct TrackSpectrum {
  std::vector<double> hertz;
  std::vector<double> before, after;  ///< unit^2 / Hz, all axes together
};
/// Computes the spectrum by Welch's method: Hann windows of up to 1024 samples that overlap by
/// half, each without its mean. Windows with a gap are left out; the result is empty if every
/// window has a gap.
TrackSpectrum track_spectrum(const TrackCurves& curves);
/// Draws both spectra as curves on a logarithmic scale; `one_take`: only the curve after.
std::string spectrum_svg(const TrackCurves& curves, bool one_take = false);

/// A take of a batch: the summary of its report, without lists.
struct BatchRow {
  std::string name;  ///< path below the output folder
  /// "begun", "cleaned", "failed", "copied"; a take that was only filled or converted is "cleaned".
  std::string status;
  std::string input;
  std::string verdict;
  std::string error;  ///< why the take failed; else empty
  std::vector<std::string> warnings;
  std::size_t frames = 0;
  std::size_t frames_repaired = 0;
  std::size_t spikes = 0;
  std::size_t gaps = 0;
  double frame_rate_hz = 0;
  double seconds = 0;
  std::string json;  ///< the whole row on one line, without the line end
};
/// Makes the row of a take without results, which was begun or copied.
BatchRow plain_row(std::string_view name, std::string_view status);
/// Makes the row of a cleaned take. `warnings` replaces the report's own list and includes warnings
/// of reading and writing.
BatchRow cleaned_row(std::string_view name, const Report& report,
                     const std::vector<std::string>& warnings);
BatchRow failed_row(std::string_view name, std::string_view input, std::string_view error,
                    int exit_code, const std::vector<std::string>& warnings = {});
/// Returns a row, or empty if the text is not a row.
std::optional<BatchRow> parse_row(std::string_view json);

/// Returns the takes that most need review, worst first: takes with warnings, then by the share of
/// frames repaired. Failed takes are left out.
std::vector<BatchRow> worst_rows(std::span<const BatchRow> rows, std::size_t most = 10);

/// Sums over all takes of a batch, over all runs.
struct BatchSums {
  std::size_t takes = 0, cleaned = 0, failed = 0, to_do = 0;
  std::size_t frames = 0, spikes = 0, gaps = 0;
  double duration_s = 0, seconds = 0;
  std::vector<std::pair<std::string, std::string>> failures;  ///< name and error

  /// Adds a take. `row`: nullptr if the take has not been cleaned yet.
  void add(std::string_view name, const BatchRow* row);
};
/// Returns the summary as a separate document.
std::string to_json(const BatchSums& sums, std::string_view options_hash);

/// Counts of one run.
struct BatchCounts {
  std::string_view work = "cleaned";  ///< what this run did with its takes: "filled", "converted"
  std::size_t cleaned = 0;            ///< takes done by this run
  std::size_t kept = 0;               ///< done by an earlier run
  std::size_t copied = 0;
  std::size_t failed = 0;
  std::size_t with_warnings = 0;    ///< takes with warnings that did not fail
  std::size_t part = 1, parts = 1;  ///< this run cleans part `part` of `parts` of the batch
  int exit_code = 0;                ///< the highest exit code of all takes

  void add(const BatchRow& row, bool is_new, int code);
};
std::string to_text(const BatchCounts& counts, const BatchSums& sums,
                    std::span<const BatchRow> worst);

/// Whether this build contains the page's program. A build without the bundle in web/dist does not.
bool has_report_page();

struct PageSettings {
  std::string command{};                ///< the command that made the report: "clean"
  std::string command_line{};           ///< as typed by the user; the page shows it
  std::string before_label = "before";  ///< names of the two takes
  std::string after_label = "after";
  /// Further data for the page's program, such as the gap plan in `kinemend view`: name and JSON.
  std::vector<std::pair<std::string, std::string>> parts{};
  /// Makes the data alone, without the program, for a page that is open already (`served_page`).
  bool is_served = false;
  /// Called between steps while the page is made. An exception that it throws ends the work.
  std::function<void()> check{};
};

/// The page: one HTML file that needs no other file, no network and no server. It contains the
/// report as `kinemend.report/1`, and the motion: joint angles to 0.02 degrees, positions to a
/// 34,000th of the body's height (0.05 mm for a person), and up to 64 times finer where the page
/// stays below two megabytes. `before` and `after` have the same joints and frames; `after` is null
/// for a single take. Takes of more than 10 million channel values (fifteen minutes of 96 channels
/// at 120 Hz) are stored with every second frame, every third, and so on, and the page says so.
/// Names are inserted as text, whatever characters they contain. Errors: `ErrorKind::usage` for a
/// build without the page, and for takes of different size.
std::string report_page(const Report& report, const Take& before, const Take* after,
                        const PageSettings& settings);

/// Returns the page of `kinemend view` before a result exists: the program, which may send requests
/// to the server that it came from, and `parts` (name and JSON). Errors: those of `report_page`.
std::string served_page(std::string_view title, std::string_view summary,
                        std::span<const std::pair<std::string, std::string>> parts);

/// A take of a batch and its own page.
struct BatchPageRow {
  BatchRow row;
  std::string page;       ///< relative path from the index, with /; empty if it has no page
  std::string picture{};  ///< SVG of a few poses, for the takes that most need review
};
/// The index of a batch: a row for each take, failed takes first, then those that most need review,
/// with filters and links to the pages of the takes. Errors: those of `report_page`.
std::string batch_page(std::span<const BatchPageRow> rows, const BatchSums& sums,
                       const PageSettings& settings);

}  // namespace kinemend
