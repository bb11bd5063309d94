#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinemend/clip.hpp"
#include "kinemend/experimental/batch_rows.hpp"
#include "kinemend/marker_clip.hpp"
#include "kinemend/report.hpp"

// A report as one page for a browser: the body in 3D, curves, and all that was found and done.
namespace kinemend {

/// Whether this build holds the page's program; one that was made with KINEMEND_WEB=OFF does not.
bool has_report_page();

struct PageSettings {
  std::string command{};                ///< "clean": of the report's document
  std::string command_line{};           ///< as it was given, to be shown
  std::string before_label = "before";  ///< what the two takes are called
  std::string after_label = "after";
  /// Further data of the page's program: name and JSON, as `kinemend view` has them.
  std::vector<std::pair<std::string, std::string>> parts{};
  /// For a page that is there already (`served_page`): the data alone, without the program.
  bool is_served = false;
  /// Called now and then while the page is made; what it throws ends the work.
  std::function<void()> check{};
};

/// The page: HTML in one file that needs nothing beside it, no network and no server. It holds the
/// report as `kinemend.report/1`, and the motion: angles of joints to 0.02 degrees, positions to a
/// 34,000th of the body's height (0.05 mm of a person), up to 64 times finer where the page stays
/// below two megabytes. `before` and `after` have the same joints
/// and frames; `after` is null where there is one take. Of takes of more than 10 million channel
/// values (fifteen minutes of 96 channels at 120 Hz) every second frame is told, or every third,
/// and so on, and the page says so. Whatever characters names have, they are text there. Errors:
/// `ErrorKind::usage` for a build without the page, and for takes of different length or width.
std::string report_page(const Report& report, const Clip& before, const Clip* after,
                        const PageSettings& settings);
std::string report_page(const Report& report, const MarkerClip& before, const MarkerClip* after,
                        const PageSettings& settings);

/// The page of `kinemend view` before there is anything to show: the program, which may ask the
/// server that it came from, and `parts` (name and JSON). Errors: as of `report_page`.
std::string served_page(std::string_view title, std::string_view summary,
                        std::span<const std::pair<std::string, std::string>> parts);

/// A take of a batch and its own page.
struct BatchPageRow {
  BatchRow row;
  std::string page;  ///< path from the index, with / between its parts; empty where there is none
  std::string picture{};  ///< SVG of a few poses, of the takes that most should be looked at
};
/// The index of a batch: a row a take, what failed and what most should be looked at first, with
/// filters and links to the pages of takes. Errors: as of `report_page`.
std::string batch_page(std::span<const BatchPageRow> rows, const BatchSums& sums,
                       const PageSettings& settings);

}  // namespace kinemend
