// Reads the rows of a marker table, finds the rate from their times or from the head, and writes
// changed markers into the bytes of their source.
#include "io/table/marker_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/portable.hpp"
#include "io/reading_limits.hpp"
#include "io/table/marker_zeros.hpp"
#include "io/text/fixed_digits.hpp"
#include "kinemend/extend/frames.hpp"

namespace kinemend {

namespace {

class TableReader {
 public:
  TableReader(const SourceText& text, std::size_t declared_frames, TableFile& file, Take& clip)
      : text_(text),
        declared_frames_(declared_frames),
        file_(file),
        table_(file.table),
        clip_(clip),
        markers_(clip.marker_count()),
        width_(table_.width()),
        least_width_(table_.width_of_samples()),
        rows_(text.bytes, table_.begin, table_.style),
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
    text_.note("trailing_text", place, "text after the last frame");
    return true;
  }

  TableFinding wider_than(std::size_t widest) {
    while (rows_.next()) widest = std::max(widest, rows_.read(nullptr, 0).used);
    clip_.positions.clear();
    clip_.observed.clear();
    table_.frames = 0;
    return {{}, widest, row_begin_};
  }

  void store(const CellRow& row) {
    if ((table_.frames + 1) * bytes_per_frame() > memory_limit(text_.bytes.size())) {
      throw text_.error_at(row_begin_,
                           fmt::format("{} markers in rows that hold few of them: too much memory "
                                       "for a file of {} bytes",
                                       markers_, text_.bytes.size()));
    }
    // An empty last cell needs no separator after it.
    if (row.cells + 1 < least_width_) too_short_.add(row_begin_);
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
    return last_row_.cells + 1 < least_width_ ||
           last_number_may_be_cut(rows, table_.style.commas, table_.style.separator);
  }

  // The last number of a file that ends in the middle of a row may have lost digits.
  void leave_out_cut_value() {
    if (!ends_in_row()) return;
    // The repair `file_cut` covers these faults too.
    too_short_.count -= last_row_.cells + 1 < least_width_ ? 1 : 0;
    incomplete_.count -= incomplete_in_row_;
    text_.note("file_cut", table_.end,
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
    has_cut_row_ = true;
    table_.end = row_begin_;
  }

  void finish() {
    leave_out_cut_value();
    text_.note("value_not_finite", rows_.not_finite(),
               "a coordinate is not finite: the marker is missing");
    text_.note("row_too_short", too_short_, "a row ends early: the rest of it is missing");
    text_.note("marker_incomplete", incomplete_,
               "a marker lacks some of its coordinates: it is missing");
    if (table_.zeros_are_missing) hide_zeros();
    const MissingZeros zeros = mark_zeros_missing(clip_);
    if (zeros.samples > 0) {
      text_.note("zero_is_missing", place_of_frame(zeros.first_frame),
                 "a marker is at 0 0 0 but was not near before or after: it is missing",
                 zeros.samples);
    }
    table_.observed = clip_.observed;
    if (has_cut_row_) file_.bytes.resize(table_.end);
  }

  // Marks zeros as missing, unless empty cells mark missing samples.
  void hide_zeros() {
    if (std::find(clip_.observed.begin(), clip_.observed.end(), 0) != clip_.observed.end()) return;
    for (std::size_t i = 0; i < clip_.positions.size(); ++i) {
      if (clip_.positions[i] == Vec3{}) clip_.observed[i] = 0;
    }
  }

  std::size_t place_of_frame(std::size_t frame) const {
    CellRows rows(text_.bytes, table_.begin, table_.style);
    for (std::size_t f = 0; rows.next() && f < frame; ++f) rows.read(nullptr, 0);
    return rows.position();
  }

  const SourceText& text_;
  std::size_t declared_frames_;
  TableFile& file_;
  MarkerTable& table_;
  Take& clip_;
  std::size_t markers_;
  std::size_t width_, least_width_;
  CellRows rows_;
  std::vector<double> values_;
  std::size_t row_begin_ = 0;
  bool has_cut_row_ = false;  // the last row was cut before its first sample
  CellRow last_row_;
  TableFinding finding_;
  CountedRepair<std::size_t> too_short_, incomplete_;
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

std::size_t MarkerTable::width() const { return std::max(width_of_samples(), labelled_columns); }

std::size_t MarkerTable::width_of_samples() const {
  std::size_t last = 0;
  for (const std::int32_t column : {frame_column, time_column}) {
    if (column >= 0) last = std::max(last, static_cast<std::size_t>(column) + 1);
  }
  for (const auto& marker : columns)
    last = std::max(last, *std::max_element(marker.begin(), marker.end()) + 1);
  return last;
}

bool TableFile::fits(const Take& clip) const {
  return table.head_is_finite && !names.empty() && clip.names == names && clip.unit == unit &&
         clip.frame_count() == table.frames && clip.frame_rate_hz == frame_rate_hz &&
         clip.first_frame == first_frame;
}

TableFinding read_marker_table(const SourceText& text, std::size_t declared_frames, TableFile& file,
                               Take& clip) {
  return TableReader(text, declared_frames, file, clip).read();
}

void note_head_not_finite(const SourceText& text, std::size_t place, MarkerTable& table) {
  table.head_is_finite = false;
  text.note("head_not_finite", place,
            "a number in the head is not finite: it is ignored and not written");
}

bool is_not_finite(std::string_view text) {
  const NumberToken token = read_number(text, CommaStyle::decimal);
  return token.kind == TokenKind::not_finite && token.end == text.data() + text.size();
}

void fail_at_cell(const SourceText& text, const char* place, char separator) {
  std::string_view cell = line_from(text.bytes, text.offset_of(place));
  cell = cell.substr(0, separator == ' ' ? cell.find_first_of(" \t") : cell.find(separator));
  throw text.error_at(place, fmt::format("expected a number, found {}", quote(cell)));
}

RowRate check_row_labels(const SourceText& text, const MarkerTable& table, const RowLabels& labels,
                         Take& clip) {
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
  text.note("frame_number_gap", table.begin,
            "frame numbers do not go up by one: rows are read as successive frames", jumps);
  const auto& times = labels.times_s;
  if (times.size() < 2) return {};
  const double steps = static_cast<double>(times.size() - 1);
  const double mean_step_s = (times.back() - times.front()) / steps;
  if (!(mean_step_s > 0) || !std::isfinite(1 / mean_step_s)) return {};
  const double rounding_s = rounding_of(times);
  const std::size_t uneven = count_steps(times, [&](double step) {
    return !(std::fabs(step - mean_step_s) <= 0.1 * mean_step_s + 2 * rounding_s);
  });
  text.note("time_uneven", table.begin, "times are uneven: rows are read as evenly spaced", uneven);
  const double tolerance_s = 2.01 * rounding_s / steps;
  return {rate_of(mean_step_s, tolerance_s), mean_step_s, tolerance_s, uneven == 0};
}

namespace {

// `room` must hold `fixed_number_room` characters.
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
  TableRewriter(const Take& clip, const TableFile& file)
      : clip_(clip),
        file_(file),
        table_(file.table),
        patch_(file.bytes, table_.begin, table_.style, table_.width()) {
    for (std::size_t i = 0; i < table_.observed.size(); ++i)
      empties_cells_ = empties_cells_ || (table_.observed[i] != 0 && clip.observed[i] == 0);
  }

  std::optional<std::string> rewrite() {
    for (std::size_t f = 0; f < table_.frames && patch_.next();) {
      if (table_.is_filler(patch_.row())) continue;
      const double number = static_cast<double>(clip_.first_frame) + static_cast<double>(f);
      if (mend_row_labels(table_, number, patch_)) needs_empty_cells_ = true;
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
      // In a file with empty cells, zeros no longer mean missing samples, so they are emptied. If
      // one cell is a word such as nan, the rest of the position is missing too.
      const bool has_word = std::any_of(columns.begin(), columns.end(), [&](std::size_t column) {
        return patch_.is_no_number(column);
      });
      if (has_word || (before == Vec3{} && empties_cells_)) {
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
    if (!decimals_) decimals_ = decimals_of(file_);
    return *decimals_;
  }

  const Take& clip_;
  const TableFile& file_;
  const MarkerTable& table_;
  CellPatch patch_;
  bool empties_cells_ = false;      // a sample that was observed is now missing
  bool needs_empty_cells_ = false;  // only a table with separators can have empty cells
  std::vector<std::size_t> cut_;    // columns of a sample that was cut by the end of the file
  std::optional<unsigned> decimals_;
};

}  // namespace

unsigned decimals_of(const TableFile& file) {
  const MarkerTable& table = file.table;
  const std::size_t width = table.width();
  std::vector<double> values(width);
  std::vector<TokenSpan> tokens(width);
  CellRows rows(file.bytes, table.begin, table.style);
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

std::optional<std::string> rewrite_marker_table(const Take& clip, const TableFile* file) {
  if (file == nullptr || !file->fits(clip)) return std::nullopt;
  return TableRewriter(clip, *file).rewrite();
}

bool mend_row_labels(const MarkerTable& table, double frame_number, CellPatch& patch) {
  const auto replace = [&](std::int32_t column, double value) {
    const auto cell = static_cast<std::size_t>(column);
    if (column < 0 || !patch.is_no_number(cell)) return false;
    patch.replace(cell, value, 0);
    return true;
  };
  replace(table.frame_column, frame_number);
  return replace(table.time_column, not_a_number);
}

void append_row_labels(TextBuffer& out, std::int64_t frame, double time_s, char separator) {
  // Microseconds. Chosen by hand.
  constexpr unsigned time_decimals = 6;
  out.append(std::to_string(frame));
  out.append({&separator, 1});
  out.append_fixed(time_s, time_decimals);
}

void append_marker_rows(TextBuffer& out, const Take& clip, const TableStyle& style) {
  char room[fixed_number_room];
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    append_row_labels(out, clip.first_frame + static_cast<std::int64_t>(f),
                      static_cast<double>(f) / clip.frame_rate_hz, style.separator);
    for (std::size_t m = 0; m < clip.marker_count(); ++m) {
      const Vec3 position = clip.position(f, m);
      for (const double value : {position.x, position.y, position.z}) {
        out.append({&style.separator, 1});
        if (!clip.is_observed(f, m)) continue;
        if (style.decimals <= most_fixed_decimals) {
          out.append_fixed(value, style.decimals);
        } else {
          out.append(coordinate_text(value, room, style.most_decimals));
        }
      }
    }
    out.append(style.line_end);
  }
}

void name_the_unnamed(const SourceText& text, std::size_t place, Take& clip) {
  std::size_t unnamed = 0;
  for (std::size_t m = 0; m < clip.names.size(); ++m) {
    if (!clip.names[m].empty()) continue;
    clip.names[m] = fmt::format("*{}", m + 1);
    ++unnamed;
  }
  text.note("marker_unnamed", place,
            "a marker has no name: it is called *1, *2, ... by its position", unnamed);
}

namespace {

// Returns the rate if a take can have it, else 0 for unknown. A missing rate is no repair.
double usable_rate(const SourceText& text, double stated_hz, std::size_t place) {
  if (is_usable_frame_rate(stated_hz)) return stated_hz;
  if (stated_hz > 0) text.note("frame_rate_unusable", place, unusable_rate_text(stated_hz));
  return 0;
}

}  // namespace

double table_rate(const SourceText& text, const RowRate& times, std::size_t rows_place,
                  const TableRate& said) {
  // Relative difference of the stated rate and the times' rate. Chosen by hand, not swept.
  constexpr double tolerance = 0.01;
  const double stated = usable_rate(text, said.stated_hz, said.stated_place);
  if (stated > 0) {
    const double off_s = std::fabs(1 / stated - times.step_s);
    const bool differs = times.rate_hz > 0 && off_s > tolerance / stated + times.tolerance_s;
    if (!differs) return stated;
    // Each row states its time, and the head one number, which stays behind when rows are left out.
    const bool beats_head =
        times.is_even && times.rate_hz >= least_capture_hz && times.rate_hz <= most_capture_hz;
    text.note("time_mismatch", said.mismatch_place,
              fmt::format("{} states {} Hz, the times {:.6g} Hz: {} used", said.stated_by, stated,
                          times.rate_hz,
                          beats_head ? "the even times are" : std::string(said.stated_by) + " is"));
    return beats_head ? times.rate_hz : stated;
  }
  const double of_times = usable_rate(text, times.rate_hz, rows_place);
  const bool by_times = of_times > 0, by_options = said.asked_hz > 0;
  const double rate = by_times ? of_times : by_options ? said.asked_hz : said.unknown_hz;
  if (said.must_be_stated || !(by_times || by_options)) {
    text.note("frame_rate_assumed", said.stated_place,
              fmt::format("{}: {:.6g} Hz {}", said.missing, rate,
                          by_times     ? "from the times"
                          : by_options ? "as requested"
                                       : "assumed"));
  }
  return rate;
}

void finish_markers(const SourceText& text, const RowLabels& labels, const TableRate& said,
                    TableFile& file, Take& clip) {
  clip.frame_rate_hz =
      table_rate(text, check_row_labels(text, file.table, labels, clip), file.table.begin, said);
  clip.is_position.assign(clip.marker_count(), 1);
  file.names = clip.names;
  file.frame_rate_hz = clip.frame_rate_hz;
  file.first_frame = clip.first_frame;
  file.unit = clip.unit;
}

double number_of(std::string_view text) {
  const NumberToken token = read_number(text, CommaStyle::decimal);
  const bool is_whole = token.end == text.data() + text.size();
  return is_whole && token.kind == TokenKind::number ? token.value : not_a_number;
}

char separator_of(std::string_view line) {
  constexpr std::string_view separators = ",;\t";
  std::array<std::size_t, 3> counts{};
  bool quoted = false;
  for (const char c : line) {
    quoted = quoted != (c == '"');
    const std::size_t at = separators.find(c);
    if (!quoted && at != separators.npos) ++counts[at];
  }
  return separators[static_cast<std::size_t>(std::max_element(counts.begin(), counts.end()) -
                                             counts.begin())];
}

CommaStyle commas_of(std::string_view rows, char separator) {
  const Cells cells = split_cells(line_from(rows, 0), separator);
  const bool decimal = separator == ','
                           ? std::any_of(cells.begin(), cells.end(),
                                         [](const auto& c) { return c.find(',') != c.npos; })
                           : rows.find(',') != rows.npos;
  return decimal ? CommaStyle::decimal : CommaStyle::none;
}

std::string_view HeadLines::take() {
  place_ = next_;
  next_ = next_line(text_->bytes, next_);
  return line_from(text_->bytes, place_);
}

Cells HeadLines::take_cells() {
  const std::string_view line = take();
  separator_ = separator_of(line);
  const auto separators = std::count(line.begin(), line.end(), separator_);
  if (static_cast<std::size_t>(separators) > most_columns) {
    throw text_->error_at(place_, fmt::format("at most {} columns can be read", most_columns));
  }
  return split_cells(line, separator_);
}

}  // namespace kinemend
