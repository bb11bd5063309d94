// A report as one page for a browser: the body in 3D, curves, findings and changes.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinemend/experimental/batch_rows.hpp"
#include "kinemend/report.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

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
