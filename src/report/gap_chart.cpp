// Draws the missing spans of each track of a take.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "kinemend/experimental/frame_numbers.hpp"
#include "kinemend/experimental/pictures.hpp"
#include "kinemend/experimental/svg.hpp"
#include "kinemend/experimental/text.hpp"
#include "kinemend/gaps.hpp"
#include "kinemend/report.hpp"
#include "report/inks.hpp"

namespace kinemend {

namespace {

// Chosen by hand.
constexpr double chart_width = 960, chart_left = 150, chart_right = 90, chart_top = 34,
                 row_height = 18;  // pixels

struct Row {
  std::string name;
  std::vector<Gap> before, after;
};

std::size_t missing_frames(const std::vector<Gap>& gaps) {
  std::size_t sum = 0;
  for (const Gap& gap : gaps) sum += gap.length();
  return sum;
}

void draw_gaps(Svg& svg, const std::vector<Gap>& gaps, std::size_t frames, double y, double height,
               std::string_view ink) {
  const double scale = (chart_width - chart_left - chart_right) / static_cast<double>(frames);
  for (const Gap& gap : gaps) {
    svg.rectangle(chart_left + scale * static_cast<double>(gap.first_frame), y,
                  std::max(1.0, scale * static_cast<double>(gap.length())), height,
                  fmt::format("fill=\"{}\"", ink));
  }
}

void draw_row(Svg& svg, const Row& row, std::size_t frames, bool two, double y) {
  const double bar = two ? row_height / 2 - 2 : row_height - 5;
  svg.text(chart_left - 8, y + 13, fmt::format("text-anchor=\"end\" fill=\"{}\"", inks::text),
           xml_escaped(printable_name(row.name)));
  svg.rectangle(chart_left, y + 1, chart_width - chart_left - chart_right, row_height - 3,
                "fill=\"#f1f3f5\"");
  draw_gaps(svg, row.before, frames, y + 2, bar, inks::before);
  if (two) draw_gaps(svg, row.after, frames, y + 2 + row_height / 2 - 1, bar, inks::after);
  const double share = 100 * static_cast<double>(missing_frames(two ? row.after : row.before)) /
                       static_cast<double>(frames);
  svg.text(chart_width - 6, y + 13, fmt::format("text-anchor=\"end\" fill=\"{}\"", inks::quiet),
           fmt::format("{:.1f} %", share));
}

}  // namespace

std::string gap_chart_svg(const Take& before, const Take* after) {
  const TakeFacts facts = take_facts(before);
  std::vector<Row> rows(facts.tracks.size());
  for (const Gap& gap : find_gaps(before)) rows[gap.track].before.push_back(gap);
  if (after != nullptr) {
    for (const Gap& gap : find_gaps(*after)) {
      if (gap.track < rows.size()) rows[gap.track].after.push_back(gap);
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].name = facts.tracks[i];
  // Points that are angles or forces have no gaps.
  const std::size_t all = before.has_joints() ? rows.size() : before.position_count();
  rows.erase(std::remove_if(rows.begin(), rows.end(),
                            [](const Row& row) { return row.before.empty() && row.after.empty(); }),
             rows.end());
  const double bottom = chart_top + row_height * static_cast<double>(rows.size());
  Svg svg(chart_width, bottom + 26, "gaps");
  svg.open_group(inks::font);
  const char* const noun = facts.kind == TakeKind::markers ? "marker" : "joint";
  svg.text(8, 20, fmt::format("font-weight=\"600\" fill=\"{}\"", inks::text),
           fmt::format("gaps: {} of {} with some", grouped(rows.size()), counted(all, noun)));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    draw_row(svg, rows[i], facts.frames, after != nullptr,
             chart_top + row_height * static_cast<double>(i));
  }
  if (!rows.empty()) {
    const std::string quiet = fmt::format("font-size=\"11\" fill=\"{}\"", inks::quiet);
    svg.text(chart_left, bottom + 15, quiet, fmt::format("{}", facts.first_frame));
    svg.text(chart_width - chart_right, bottom + 15, quiet + " text-anchor=\"end\"",
             fmt::format("{}", frame_number(facts.frames - 1, facts.first_frame)));
  }
  svg.close_group();
  return std::move(svg).finish();
}

}  // namespace kinemend
