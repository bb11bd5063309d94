// Reads and writes the gap plan as a file.
#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/cells.hpp"
#include "base/text.hpp"
#include "fill/plan.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/gap_plan.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view schema = "kinemend.gap-plan/1";
constexpr std::string_view preview_prefix = "preview_";

// Gaps of markers are always of positions, which `is_position` does not state.
bool is_of_rotation(const Take& take, const PlannedGap& row) {
  return take.has_joints() && !row.is_position;
}

std::string_view quantity_of(const Take& take, const PlannedGap& row) {
  return is_of_rotation(take, row) ? "rotation" : "position";
}

std::string unit_of(const Take& take, const PlannedGap& row) {
  return is_of_rotation(take, row) ? "deg" : take.unit;
}

// ---- writing

std::string number(double value) { return value != 0 ? fmt::format("{:.6g}", value) : ""; }

std::string preview_cell(const GapPreview& preview) {
  if (!preview.filled) return "refused";
  return preview.distance ? fmt::format("{:.6g}", *preview.distance) : "fills";
}

Json json_of(const Take& clip, const PlannedGap& row) {
  const std::int64_t first = first_frame_number(clip);
  Json entry = {{"name", clip.owner_names()[row.gap.track]},
                {"quantity", quantity_of(clip, row)},
                {"first_frame", frame_number(row.gap.first_frame, first)},
                {"last_frame", frame_number(row.gap.last_frame, first)},
                {"length_frames", row.gap.length()},
                {"length_s", static_cast<double>(row.gap.length()) / clip.frame_rate_hz},
                {"verdict", to_string(row.verdict)},
                {"method", row.method},
                {"donor", row.donor},
                {"longest_gap_s", nullptr},
                {"filled_by", row.filled_by},
                {"evidence", row.evidence},
                {"expected_error", nullptr},
                {"unit", unit_of(clip, row)},
                {"reason", row.reason}};
  if (row.longest_gap_s > 0) entry["longest_gap_s"] = row.longest_gap_s;
  if (row.expected_error != 0) entry["expected_error"] = row.expected_error;
  if (row.previews.empty()) return entry;
  entry["previews"] = Json::array();
  for (const GapPreview& preview : row.previews) {
    Json shown = {{"method", preview.method},
                  {"filled", preview.filled},
                  {"distance", nullptr},
                  {"reason", preview.reason}};
    if (preview.distance) shown["distance"] = *preview.distance;
    entry["previews"].push_back(std::move(shown));
  }
  return entry;
}

// ---- reading

/// A row as words, and its position in the file.
struct Row {
  std::string where;  ///< "plan.csv:3"
  std::map<std::string, std::string, std::less<>> cells;

  std::string_view at(std::string_view column) const {
    const auto found = cells.find(column);
    return found == cells.end() ? std::string_view() : std::string_view(found->second);
  }
  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(ErrorKind::unreadable_input, where + ": " + problem);
  }
};

constexpr std::array<std::string_view, 15> columns = {
    "name",      "quantity", "first_frame",    "last_frame", "length_frames",
    "length_s",  "verdict",  "method",         "donor",      "longest_gap_s",
    "filled_by", "evidence", "expected_error", "unit",       "reason"};

bool is_column(std::string_view name) {
  return std::find(columns.begin(), columns.end(), name) != columns.end();
}

void check_columns(const std::vector<std::string>& heading, const std::string& where) {
  const auto fail = [&](const std::string& problem) {
    throw Error(ErrorKind::unreadable_input, where + ": " + problem);
  };
  for (const std::string_view needed : {"name", "first_frame", "last_frame"}) {
    if (std::count(heading.begin(), heading.end(), needed) == 0)
      fail(fmt::format("expected a heading with the column {}", needed));
  }
  for (const std::string& column : heading) {
    if (!is_column(column) && !column.starts_with(preview_prefix))
      fail(fmt::format("no column of a gap plan is called {}", quote(column)));
    if (std::count(heading.begin(), heading.end(), column) > 1)
      fail(fmt::format("the column {} stands twice", quote(column)));
  }
}

std::vector<Row> rows_of_table(std::string_view text, std::string_view name) {
  std::vector<Row> rows;
  std::vector<std::string> heading;
  for (auto& [number, cells] : cell_lines(text, name)) {
    Row row{fmt::format("{}:{}", name, number), {}};
    if (heading.empty()) {
      check_columns(cells, row.where);
      heading = std::move(cells);
      continue;
    }
    if (cells.size() != heading.size()) {
      row.fail(fmt::format("expected {} cells as in the heading, found {}", heading.size(),
                           cells.size()));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) row.cells[heading[i]] = std::move(cells[i]);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> rows_of_json(std::string_view text, std::string_view name) {
  Json document;
  try {
    document = parse_json<Json>(text);
  } catch (const Json::out_of_range&) {
    throw Error(ErrorKind::unreadable_input,
                fmt::format("{}: a number is too large for JSON", name));
  } catch (const Json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    throw Error::at_line(name, 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n')),
                         json_within_depth(text).size() < text.size()
                             ? fmt::format("JSON is nested more than {} levels deep", deepest_json)
                             : "this is not valid JSON from here on");
  }
  if (!document.is_object() || document.value("schema", Json()) != schema ||
      !document.value("gaps", Json()).is_array()) {
    throw Error(
        ErrorKind::unreadable_input,
        fmt::format("{}: expected an object with the schema {} and a list of gaps", name, schema));
  }
  std::vector<Row> rows;
  for (const Json& entry : document["gaps"]) {
    Row row{fmt::format("{}: gap {}", name, rows.size() + 1), {}};
    if (!entry.is_object()) row.fail("expected an object");
    for (const auto& [key, value] : entry.items()) {
      if (key == "previews" || key == "evidence") continue;
      if (!is_column(key)) row.fail(fmt::format("nothing in a gap plan is called {}", quote(key)));
      if (value.is_string()) {
        row.cells[key] = value.get<std::string>();
      } else if (value.is_number()) {
        row.cells[key] = value.dump();
      } else if (!value.is_null()) {
        row.fail(fmt::format("expected a word or a number as {}", key));
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

GapVerdict verdict_of(const Row& row) {
  const std::string_view word = row.at("verdict");
  if (word.empty()) return GapVerdict::fill;
  for (const GapVerdict verdict : {GapVerdict::fill, GapVerdict::force, GapVerdict::refuse}) {
    if (word == to_string(verdict)) return verdict;
  }
  row.fail(fmt::format("expected the verdict fill, force or refuse, found {}", quote(word)));
}

double number_of(const Row& row, std::string_view column) {
  const std::string_view word = row.at(column);
  if (word.empty()) return 0;
  double value = 0;
  const char* const last = word.data() + word.size();
  const auto [end, error] = fast_float::from_chars(word.data(), last, value);
  // A nonzero number that underflows to zero is rejected, as an overflow is.
  const bool vanished =
      value == 0 &&
      word.substr(0, word.find_first_of("eE")).find_first_of("123456789") != word.npos;
  if (error != std::errc() || end != last || !(value >= 0) || !std::isfinite(value) || vanished) {
    row.fail(fmt::format("expected a number from 0 as {}, found {}", column, quote(word)));
  }
  return value;
}

std::size_t frame_of(const Row& row, std::string_view column, std::int64_t first_number) {
  const auto frame = whole_number(row.at(column), first_number);
  if (!frame) {
    row.fail(fmt::format("expected a frame number from {} as {}, found {}", first_number, column,
                         quote(row.at(column))));
  }
  return static_cast<std::size_t>(*frame - first_number);
}

bool is_of_position(const Row& row, bool of_joints) {
  const std::string_view word = row.at("quantity");
  if (of_joints && (word.empty() || word == "rotation")) return false;
  if (of_joints ? word == "position" : word.empty() || word == "position") return of_joints;
  row.fail(fmt::format("expected the quantity {}, found {}",
                       of_joints ? "rotation or position" : "position", quote(word)));
}

PlannedGap planned(const Row& row, const fill::PlanRows& rows, const Take& clip) {
  const std::string_view kind = clip.has_joints() ? "joint" : "marker";
  const std::string_view name = row.at("name");
  if (!rows.knows(name)) row.fail(fmt::format("the take has no {} {}", kind, quote(name)));
  PlannedGap planned;
  planned.is_position = is_of_position(row, clip.has_joints());
  const std::int64_t first_number = first_frame_number(clip);
  const Gap asked{0, frame_of(row, "first_frame", first_number),
                  frame_of(row, "last_frame", first_number)};
  const auto gap = rows.find(name, planned.is_position, asked.first_frame, asked.last_frame);
  if (!gap) {
    const std::string gaps = rows.gaps_of(name, planned.is_position);
    row.fail(fmt::format("{} are no gap of the {} {}{}: {}", rows.frames_text(asked), kind,
                         quote(name), planned.is_position ? " (position)" : "",
                         gaps.empty() ? "it has none" : "its gaps are " + gaps));
  }
  planned.gap = *gap;
  planned.verdict = verdict_of(row);
  if (const std::string_view method = row.at("method"); !method.empty()) planned.method = method;
  planned.donor = row.at("donor");
  planned.longest_gap_s = number_of(row, "longest_gap_s");
  planned.filled_by = row.at("filled_by");
  planned.expected_error = number_of(row, "expected_error");
  planned.reason = row.at("reason");
  return planned;
}

}  // namespace

std::string plan_csv(const Take& clip, std::span<const PlannedGap> plan) {
  std::string text =
      "name,quantity,first_frame,last_frame,length_frames,length_s,verdict,method,donor,"
      "longest_gap_s,filled_by,evidence,expected_error,unit,reason";
  if (!plan.empty()) {
    for (const GapPreview& preview : plan.front().previews)
      text += fmt::format(",{}{}", preview_prefix, preview.method);
  }
  text += "\n";
  const std::int64_t first = first_frame_number(clip);
  const auto cell = [](std::string_view words) { return words.empty() ? "" : cell_of(words); };
  for (const PlannedGap& row : plan) {
    text += fmt::format("{},{},{},{},{},{:.6g},{},{},{},{},{},{},{},{},{}",
                        cell_of(clip.owner_names()[row.gap.track]), quantity_of(clip, row),
                        frame_number(row.gap.first_frame, first),
                        frame_number(row.gap.last_frame, first), row.gap.length(),
                        static_cast<double>(row.gap.length()) / clip.frame_rate_hz,
                        to_string(row.verdict), cell(row.method), cell(row.donor),
                        row.longest_gap_s > 0 ? fmt::format("{}", row.longest_gap_s) : "",
                        cell(row.filled_by), cell(fmt::format("{}", fmt::join(row.evidence, ";"))),
                        number(row.expected_error), cell(unit_of(clip, row)), cell(row.reason));
    for (const GapPreview& preview : row.previews) text.append(",").append(preview_cell(preview));
    text += "\n";
  }
  return text;
}

std::string plan_json(const Take& clip, std::span<const PlannedGap> plan) {
  Json gaps = Json::array();
  for (const PlannedGap& row : plan) gaps.push_back(json_of(clip, row));
  const Json document = {{"schema", schema}, {"gaps", std::move(gaps)}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<PlannedGap> parse_plan(std::string_view text, std::string_view name, const Take& clip) {
  const std::string_view content = without_byte_order_mark(text);
  const std::size_t begin = content.find_first_not_of(" \t\r\n");
  const bool is_json = begin != std::string_view::npos && content[begin] == '{';
  fill::PlanRows rows(clip);
  std::vector<PlannedGap> plan;
  for (const Row& row : is_json ? rows_of_json(content, name) : rows_of_table(text, name)) {
    plan.push_back(planned(row, rows, clip));
    if (const std::string problem = rows.add(plan.back()); !problem.empty()) row.fail(problem);
  }
  return plan;
}

}  // namespace kinemend
