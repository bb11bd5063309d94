// Reads the rows of a marker table, finds the rate from their times or from the head, and writes
// changed markers into the bytes of their source.
#include "io/table/marker_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/portable.hpp"
#include "io/reading_limits.hpp"
#include "io/table/marker_zeros.hpp"
#include "io/text/cells.hpp"
#include "io/text/fixed_digits.hpp"
#include "io/text/number.hpp"
#include "io/text/text.hpp"

namespace kinemend {

namespace {

class TableReader {
 public:
  TableReader(const SourceText& text, Diagnostics& diagnostics, std::size_t declared_frames,
              MarkerTable& table, Take& clip)
      : text_(text),
        diagnostics_(diagnostics),
        declared_frames_(declared_frames),
        table_(table),
        clip_(clip),
        markers_(clip.marker_count()),
        width_(table.width()),
        rows_(text.bytes, table.begin, table.style),
        values_(width_) {}

  TableFinding read() {
    table_.end = table_.begin;
    reserve(std::min(declared_frames_, estimate_rows(text_.bytes, table_.begin)));
    while (rows_.next()) {
      row_begin_ = rows_.position();
      const CellRow row = rows_.read(values_.data(), width_);
      if (row.fault != nullptr && is_trailing_text(row)) break;
      if (row.fault != nullptr && !is_cut_number(row))
        fail_at_cell(text_, row.fault, table_.style.separator);
      if (row.used > width_) return wider_than(row.used);
      if (table_.is_filler(row)) continue;
      store(row);
    }
    finish();
    return std::move(finding_);
  }

 private:
  std::size_t bytes_per_frame() const { return markers_ * (sizeof(Vec3) + 2) + 16; }

  // Reserves memory, but not for more frames than the limit allows.
  void reserve(std::size_t frames) {
    const std::size_t affordable = memory_limit(text_.bytes.size()) / bytes_per_frame();
    const std::size_t count = std::min(frames, affordable);
    clip_.positions.reserve(count * markers_);
    clip_.observed.reserve(count * markers_);
  }

  bool is_trailing_text(const CellRow& row) {
    if (table_.frames < declared_frames_) return false;
    std::string_view line = line_from(text_.bytes, row_begin_);
    const auto place = static_cast<std::size_t>(row.fault - text_.bytes.data());
    line = line.substr(0, place - row_begin_);
    if (std::any_of(line.begin(), line.end(), [](char c) { return !is_space(c); })) return false;
    note_repair(text_, diagnostics_, "trailing_text", place, "text after the last frame");
    return true;
  }

  TableFinding wider_than(std::size_t widest) {
    while (rows_.next()) widest = std::max(widest, rows_.read(nullptr, 0).used);
    clip_.positions.clear();
    clip_.observed.clear();
    table_.frames = 0;
    TableFinding finding;
    finding.widest = widest;
    finding.wide_row = row_begin_;
    return finding;
  }

  void store(const CellRow& row) {
    if ((table_.frames + 1) * bytes_per_frame() > memory_limit(text_.bytes.size())) {
      throw text_.error_at(row_begin_,
                           fmt::format("{} markers in rows that hold few of them: too much memory "
                                       "for a file of {} bytes",
                                       markers_, text_.bytes.size()));
    }
    // An empty last cell needs no separator after it.
    if (row.cells + 1 < width_) too_short_.add(row_begin_);
    label(table_.frame_column, finding_.labels.frames);
    label(table_.time_column, finding_.labels.times_s);
    const std::size_t first = clip_.positions.size();
    // The table has more frames than expected: reserves memory for all possible frames at once
    // instead of doubling.
    if (first + markers_ > clip_.positions.capacity()) reserve(text_.bytes.size());
    clip_.positions.resize(first + markers_);
    clip_.observed.resize(first + markers_);
    Vec3* const positions = clip_.positions.data() + first;
    std::uint8_t* const observed = clip_.observed.data() + first;
    const std::size_t incomplete_before = incomplete_.count;
    for (std::size_t m = 0; m < markers_; ++m) {
      const auto& [x, y, z] = table_.columns[m];
      const Vec3 position{values_[x], values_[y], values_[z]};
      const double sum = position.x + position.y + position.z;
      if (!std::isnan(sum)) [[likely]] {
        positions[m] = position;
        observed[m] = 1;
      } else {
        store_missing(position);
      }
    }
    incomplete_in_row_ = incomplete_.count - incomplete_before;
    ++table_.frames;
    table_.end = static_cast<std::size_t>(row.end - text_.bytes.data());
    last_row_ = row;
  }

  void store_missing(Vec3 position) {
    const bool in_part =
        !std::isnan(position.x) || !std::isnan(position.y) || !std::isnan(position.z);
    if (in_part) incomplete_.add(row_begin_);
  }

  void label(std::int32_t column, std::vector<double>& labels) const {
    if (column >= 0) labels.push_back(values_[static_cast<std::size_t>(column)]);
  }

  // Whether the fault is the start of a last number that was cut.
  bool is_cut_number(const CellRow& row) const {
    if (row.end != text_.bytes.data() + text_.bytes.size()) return false;
    const std::string_view word(row.fault, static_cast<std::size_t>(row.end - row.fault));
    return may_start_number(word) && word.find(table_.style.separator) == word.npos;
  }

  // Whether the file was cut off in the last row.
  bool ends_in_row() const {
    if (table_.frames == 0 || table_.end != text_.bytes.size()) return false;
    if (last_row_.fault != nullptr) return true;
    const bool is_empty = last_row_.used != last_row_.cells;
    if (is_empty || text_.bytes.back() == table_.style.separator) return false;
    const std::string_view rows = text_.bytes.substr(table_.begin, table_.end - table_.begin);
    return last_row_.cells + 1 < width_ ||
           last_number_may_be_cut(rows, table_.style.commas, table_.style.separator);
  }

  // The last number of a file that ends in the middle of a row may have lost digits.
  void leave_out_cut_value() {
    if (!ends_in_row()) return;
    // The repair `file_cut` covers these faults too.
    too_short_.count -= last_row_.cells + 1 < width_ ? 1 : 0;
    incomplete_.count -= incomplete_in_row_;
    note_repair(text_, diagnostics_, "file_cut", table_.end,
                "the file ends in the middle of a row: its last value is not used");
    const std::size_t column = last_row_.used - 1;
    const auto begins_behind = [&](const auto& columns) {
      return column < *std::min_element(columns.begin(), columns.end());
    };
    if (std::all_of(table_.columns.begin(), table_.columns.end(), begins_behind))
      return drop_last_row();
    for (std::size_t m = 0; m < markers_; ++m) {
      const auto& columns = table_.columns[m];
      if (std::find(columns.begin(), columns.end(), column) == columns.end()) continue;
      const std::size_t sample = (table_.frames - 1) * markers_ + m;
      clip_.observed[sample] = 0;
      clip_.positions[sample] = {};
    }
  }

  // Removes a last row without samples.
  void drop_last_row() {
    --table_.frames;
    clip_.positions.resize(table_.frames * markers_);
    clip_.observed.resize(table_.frames * markers_);
    for (std::vector<double>* labels : {&finding_.labels.frames, &finding_.labels.times_s}) {
      if (!labels->empty()) labels->pop_back();
    }
    finding_.cut_row = row_begin_;
    table_.end = row_begin_;
  }

  void finish() {
    leave_out_cut_value();
    if (rows_.not_finite() > 0) {
      note_repair(text_, diagnostics_, "value_not_finite",
                  static_cast<std::size_t>(rows_.first_not_finite() - text_.bytes.data()),
                  "a coordinate is not finite: the marker is missing", rows_.not_finite());
    }
    note(too_short_, "row_too_short", "a row ends early: the rest of it is missing");
    note(incomplete_, "marker_incomplete", "a marker lacks some of its coordinates: it is missing");
    if (table_.zeros_are_missing) hide_zeros();
    const MissingZeros zeros = mark_zeros_missing(clip_);
    if (zeros.samples > 0) {
      note_repair(text_, diagnostics_, "zero_is_missing", place_of_frame(zeros.first_frame),
                  "a marker is at 0 0 0 but was not near before or after: it is missing",
                  zeros.samples);
    }
    table_.observed = clip_.observed;
  }

  // Marks zeros as missing, unless empty cells mark missing samples.
  void hide_zeros() {
    if (std::find(clip_.observed.begin(), clip_.observed.end(), 0) != clip_.observed.end()) return;
    for (std::size_t i = 0; i < clip_.positions.size(); ++i) {
      if (clip_.positions[i] == Vec3{}) clip_.observed[i] = 0;
    }
  }

  void note(const CountedRepair& repair, std::string_view kind, std::string_view message) {
    if (repair.count > 0)
      note_repair(text_, diagnostics_, kind, repair.first, message, repair.count);
  }

  std::size_t place_of_frame(std::size_t frame) const {
    CellRows rows(text_.bytes, table_.begin, table_.style);
    for (std::size_t f = 0; rows.next() && f < frame; ++f) rows.read(nullptr, 0);
    return rows.position();
  }

  const SourceText& text_;
  Diagnostics& diagnostics_;
  std::size_t declared_frames_;
  MarkerTable& table_;
  Take& clip_;
  std::size_t markers_;
  std::size_t width_;
  CellRows rows_;
  std::vector<double> values_;
  std::size_t row_begin_ = 0;
  CellRow last_row_;
  TableFinding finding_;
  CountedRepair too_short_;
  CountedRepair incomplete_;
  std::size_t incomplete_in_row_ = 0;  // incomplete markers in the last row
};

// Returns half a unit of the last decimal place among the first times.
double rounding_of(const std::vector<double>& times_s) {
  unsigned decimals = 0;
  char text[fixed_number_room];
  for (std::size_t i = 0; i < std::min<std::size_t>(times_s.size(), 100); ++i) {
    if (std::isnan(times_s[i])) continue;
    const std::string_view digits(
        text, static_cast<std::size_t>(write_shortest(text, times_s[i]) - text));
    const std::size_t dot = digits.find('.');
    if (dot != digits.npos)
      decimals = std::max(decimals, static_cast<unsigned>(digits.size() - dot - 1));
  }
  return 0.5 * portable::pow(10.0, -static_cast<double>(decimals));
}

// Returns the usual rate, or whole number of hertz, that matches rounded times.
double rate_of(double mean_step_s, double tolerance_s) {
  // Chosen by hand.
  constexpr std::array<double, 20> in_use{23.976, 24,  25,  29.97,  30,  50,  59.94,
                                          60,     90,  100, 119.88, 120, 200, 239.76,
                                          240,    250, 300, 400,    500, 1000};
  const auto error_of = [&](double rate) { return std::fabs(1 / rate - mean_step_s); };
  const auto fits = [&](double rate) { return error_of(rate) <= tolerance_s; };
  const double nearest = *std::min_element(
      in_use.begin(), in_use.end(), [&](double a, double b) { return error_of(a) < error_of(b); });
  if (fits(nearest)) return nearest;
  const double rate = 1 / mean_step_s, whole = std::round(rate);
  return whole > 0 && fits(whole) ? whole : rate;
}

}  // namespace

std::size_t MarkerTable::width() const {
  std::size_t last = 0;
  for (const std::int32_t column : {frame_column, time_column}) {
    if (column >= 0) last = std::max(last, static_cast<std::size_t>(column) + 1);
  }
  for (const auto& marker : columns)
    last = std::max(last, *std::max_element(marker.begin(), marker.end()) + 1);
  return last;
}

TableFinding read_marker_table(const SourceText& text, Diagnostics& diagnostics,
                               std::size_t declared_frames, MarkerTable& table, Take& clip) {
  return TableReader(text, diagnostics, declared_frames, table, clip).read();
}

bool is_not_finite(std::string_view text) {
  if (text.empty()) return false;
  const char* const end = text.data() + text.size();
  const NumberToken token = read_number(text.data(), end, CommaStyle::decimal);
  return token.kind == TokenKind::not_finite && token.end == end;
}

void fail_at_cell(const SourceText& text, const char* place, char separator) {
  std::string_view cell =
      line_from(text.bytes, static_cast<std::size_t>(place - text.bytes.data()));
  cell = cell.substr(0, separator == ' ' ? cell.find_first_of(" \t") : cell.find(separator));
  throw text.error_at(place, fmt::format("expected a number, found {}", quote(cell)));
}

RowRate check_row_labels(const SourceText& text, Diagnostics& diagnostics, const MarkerTable& table,
                         const RowLabels& labels, Take& clip) {
  const auto count_steps = [](const std::vector<double>& values, auto is_odd) {
    std::size_t odd = 0;
    for (std::size_t i = 1; i < values.size(); ++i)
      odd += is_odd(values[i] - values[i - 1]) ? 1 : 0;
    return odd;
  };
  constexpr double largest_frame = 9e15;
  if (!labels.frames.empty() && std::fabs(labels.frames[0]) < largest_frame) {
    clip.first_frame = std::llround(labels.frames[0]);
  }
  const std::size_t jumps = count_steps(labels.frames, [](double step) { return step != 1; });
  if (jumps > 0) {
    note_repair(text, diagnostics, "frame_number_gap", table.begin,
                "frame numbers do not go up by one: rows are read as successive frames", jumps);
  }
  const auto& times = labels.times_s;
  if (times.size() < 2) return {};
  const double steps = static_cast<double>(times.size() - 1);
  const double mean_step_s = (times.back() - times.front()) / steps;
  if (!(mean_step_s > 0) || !std::isfinite(1 / mean_step_s)) return {};
  const double rounding_s = rounding_of(times);
  const std::size_t uneven = count_steps(times, [&](double step) {
    return !(std::fabs(step - mean_step_s) <= 0.1 * mean_step_s + 2 * rounding_s);
  });
  if (uneven > 0) {
    note_repair(text, diagnostics, "time_uneven", table.begin,
                "times are uneven: rows are read as evenly spaced", uneven);
  }
  const double tolerance_s = 2.01 * rounding_s / steps;
  return {rate_of(mean_step_s, tolerance_s), mean_step_s, tolerance_s};
}

std::string_view coordinate_text(double value, char* room, unsigned most_decimals) {
  const auto text_until = [&](const char* end) {
    return std::string_view(room, static_cast<std::size_t>(end - room));
  };
  const auto single = static_cast<float>(value);
  if (static_cast<double>(single) == value) {
    return text_until(
        write_round_trip(room, room + fixed_number_room, single == 0 ? 0.0F : single));
  }
  const std::string_view digits = text_until(write_shortest(room, value));
  const std::size_t dot = digits.find('.');
  const bool short_enough = most_decimals > most_fixed_decimals || dot == digits.npos ||
                            digits.size() - dot - 1 <= most_decimals;
  return short_enough ? digits : text_until(write_fixed(room, value, most_decimals));
}

namespace {

unsigned decimals_in(TokenSpan token, CommaStyle commas) {
  const std::string_view text(token.begin, static_cast<std::size_t>(token.end - token.begin));
  constexpr unsigned shortest_digits = most_fixed_decimals + 1;
  if (text.find_first_of("eE") != text.npos) return shortest_digits;
  const std::size_t point = text.find_first_of(commas == CommaStyle::decimal ? ".," : ".");
  if (point == text.npos) return 0;
  std::size_t end = point + 1;
  while (end < text.size() && text[end] >= '0' && text[end] <= '9') ++end;
  return static_cast<unsigned>(std::min<std::size_t>(end - point - 1, shortest_digits));
}

class TableRewriter {
 public:
  TableRewriter(const Take& clip, std::string_view bytes, const MarkerTable& table)
      : clip_(clip),
        bytes_(bytes),
        table_(table),
        patch_(bytes, table.begin, table.style, table.width()) {
    for (std::size_t i = 0; i < table.observed.size(); ++i)
      empties_cells_ = empties_cells_ || (table.observed[i] != 0 && clip.observed[i] == 0);
  }

  std::optional<std::string> rewrite() {
    for (std::size_t f = 0; f < table_.frames && patch_.next();) {
      if (table_.is_filler(patch_.row())) continue;
      mend_labels(f);
      for (std::size_t m = 0; m < clip_.marker_count(); ++m) compare(f, m);
      // The row may look complete after the rewrite, so a sample with cut digits is removed.
      for (const std::size_t column : cut_) {
        if (patch_.has_replacements()) empty(column);
      }
      cut_.clear();
      if (patch_.empties_row()) return std::nullopt;
      ++f;
    }
    if (needs_empty_cells_ && table_.style.separator == ' ') return std::nullopt;
    return std::move(patch_).finish();
  }

 private:
  // Replaces a frame number or time that is not finite; frame numbers continue from the first.
  void mend_labels(std::size_t frame) {
    if (is_no_number(table_.frame_column)) {
      patch_.replace(static_cast<std::size_t>(table_.frame_column),
                     static_cast<double>(clip_.first_frame) + static_cast<double>(frame), 0);
    }
    if (is_no_number(table_.time_column)) empty(static_cast<std::size_t>(table_.time_column));
  }

  bool is_no_number(std::int32_t column) const {
    return column >= 0 && patch_.is_no_number(static_cast<std::size_t>(column));
  }

  void empty(std::size_t column) {
    needs_empty_cells_ = true;
    patch_.replace(column, not_a_number, 0);
  }

  void compare(std::size_t frame, std::size_t marker) {
    const bool known = clip_.is_observed(frame, marker);
    const bool was_known = table_.observed[frame * clip_.marker_count() + marker] != 0;
    const auto& columns = table_.columns[marker];
    const Vec3 before{patch_.value(columns[0]), patch_.value(columns[1]), patch_.value(columns[2])};
    const Vec3 now = clip_.position(frame, marker);
    if (!known && !was_known) {
      const bool was_cut = !std::isnan(before.x + before.y + before.z) && !(before == Vec3{});
      if (was_cut) cut_.insert(cut_.end(), columns.begin(), columns.end());
      // In a file with empty cells, zeros no longer mean missing samples, so they are emptied.
      if (before == Vec3{} && empties_cells_) {
        for (const std::size_t column : columns) empty(column);
      }
      // If one cell is a word such as nan, the rest of the position is missing too.
      const bool has_word = std::any_of(columns.begin(), columns.end(), [&](std::size_t column) {
        return patch_.is_no_number(column);
      });
      if (has_word) {
        for (const std::size_t column : columns) empty(column);
      }
    } else if (!known) {
      for (const std::size_t column : columns) empty(column);
    } else if (!(was_known && now == before)) {
      patch_.replace(columns[0], now.x, decimals());
      patch_.replace(columns[1], now.y, decimals());
      patch_.replace(columns[2], now.z, decimals());
    }
  }

  // Reads the text again, which only a changed take needs.
  unsigned decimals() {
    if (!decimals_) decimals_ = decimals_of(bytes_, table_);
    return *decimals_;
  }

  const Take& clip_;
  std::string_view bytes_;
  const MarkerTable& table_;
  CellPatch patch_;
  bool empties_cells_ = false;      // a sample that was observed is now missing
  bool needs_empty_cells_ = false;  // only a table with separators can have empty cells
  std::vector<std::size_t> cut_;    // columns of a sample that was cut by the end of the file
  std::optional<unsigned> decimals_;
};

}  // namespace

unsigned decimals_of(std::string_view bytes, const MarkerTable& table) {
  const std::size_t width = table.width();
  std::vector<double> values(width);
  std::vector<TokenSpan> tokens(width);
  CellRows rows(bytes, table.begin, table.style);
  unsigned most = 0;
  while (rows.next() && rows.position() < table.end) {
    rows.read(values.data(), width, tokens.data());
    for (const auto& marker : table.columns) {
      for (const std::size_t column : marker) {
        if (std::isnan(values[column])) continue;
        most = std::max(most, decimals_in(tokens[column], table.style.commas));
      }
    }
  }
  return most;
}

std::optional<std::string> rewrite_marker_table(const Take& clip, std::string_view bytes,
                                                const MarkerTable& table) {
  return TableRewriter(clip, bytes, table).rewrite();
}

void name_the_unnamed(const SourceText& text, Diagnostics& diagnostics, std::size_t place,
                      Take& clip) {
  std::size_t unnamed = 0;
  for (std::size_t m = 0; m < clip.names.size(); ++m) {
    if (!clip.names[m].empty()) continue;
    clip.names[m] = fmt::format("*{}", m + 1);
    ++unnamed;
  }
  if (unnamed > 0) {
    note_repair(text, diagnostics, "marker_unnamed", place,
                "a marker has no name: it is called *1, *2, ... by its position", unnamed);
  }
}

double table_rate(const SourceText& text, Diagnostics& diagnostics, const RowRate& times,
                  const TableRate& said) {
  // Relative difference of the stated rate and the times' rate. Chosen by hand, not swept.
  constexpr double tolerance = 0.01;
  const double stated = usable_rate(text, diagnostics, said.stated_hz, said.stated_place);
  if (stated > 0) {
    const double off_s = std::fabs(1 / stated - times.step_s);
    if (times.rate_hz > 0 && off_s > tolerance / stated + times.tolerance_s) {
      note_repair(text, diagnostics, "time_mismatch", said.mismatch_place,
                  fmt::format("{0} states {1} Hz, the times {2:.6g} Hz: {0} is used",
                              said.stated_by, stated, times.rate_hz));
    }
    return stated;
  }
  const double of_times = usable_rate(text, diagnostics, times.rate_hz, said.rows_place);
  const bool by_times = of_times > 0, by_options = said.asked_hz > 0;
  const double rate = by_times ? of_times : by_options ? said.asked_hz : said.unknown_hz;
  if (said.must_be_stated || !(by_times || by_options)) {
    note_repair(text, diagnostics, "frame_rate_assumed", said.stated_place,
                fmt::format("{}: {:.6g} Hz {}", said.missing, rate,
                            by_times     ? "from the times"
                            : by_options ? "as requested"
                                         : "assumed"));
  }
  return rate;
}

}  // namespace kinemend
