// Splits lines into cells, with quotes, reads rows with separators or with blanks, replaces cells
// row by row, and adds the cells that a short row lacks.
#include "io/text/cells.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/portable.hpp"
#include "io/text/number.hpp"

namespace kinemend {

namespace {

bool is_cell_blank(char c) { return is_space(c) && !is_line_end(c); }

TokenSpan trimmed(TokenSpan token, char separator) {
  const auto blank = [&](char c) { return c != separator && is_cell_blank(c); };
  while (token.begin != token.end && blank(*token.begin)) ++token.begin;
  while (token.begin != token.end && blank(token.end[-1])) --token.end;
  return token;
}

bool is_quoted(TokenSpan token) {
  return token.end - token.begin >= 2 && *token.begin == '"' && token.end[-1] == '"';
}

// Finds the end of a cell. Quotes hide separators, up to the end of the line; two quotes within
// quotes are one.
const char* cell_end(const char* p, const char* end, char separator) {
  const char* q = p;
  while (q != end && is_cell_blank(*q) && *q != separator) ++q;
  bool quoted = q != end && *q == '"';
  if (quoted) p = q + 1;
  for (; p != end && !is_line_end(*p); ++p) {
    if (*p == '"') {
      if (quoted && p + 1 != end && p[1] == '"') {
        ++p;
        continue;
      }
      quoted = false;
    }
    if (!quoted && *p == separator) return p;
  }
  return p;
}

std::string unquoted(TokenSpan token) {
  if (!is_quoted(token)) return {token.begin, token.end};
  std::string text;
  for (const char* p = token.begin + 1; p != token.end - 1; ++p) {
    if (*p == '"' && p + 1 != token.end - 1 && p[1] == '"') ++p;
    text += *p;
  }
  return text;
}

}  // namespace

TokenSpan content_of(TokenSpan cell, char separator) {
  return is_quoted(cell) ? trimmed({cell.begin + 1, cell.end - 1}, separator) : cell;
}

std::string_view line_from(std::string_view text, std::size_t begin) {
  text.remove_prefix(std::min(begin, text.size()));
  return text.substr(0, text.find_first_of("\r\n"));
}

std::size_t next_line(std::string_view text, std::size_t begin) {
  const std::size_t end = text.find_first_of("\r\n", begin);
  if (end == text.npos) return text.size();
  return end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
}

std::size_t estimate_rows(std::string_view text, std::size_t begin) {
  // Extra rows to reserve, for speed.
  constexpr std::size_t spare = 16;
  return (text.size() - begin) / (line_from(text, begin).size() + 1) + spare;
}

std::vector<std::string> split_cells(std::string_view line, char separator) {
  std::vector<std::string> cells;
  const char* p = line.data();
  const char* const end = p + line.size();
  if (separator == ' ') {
    while ((p = skip_space(p, end)) != end) {
      const char* const word = p;
      while (p != end && !is_space(*p)) ++p;
      cells.emplace_back(word, p);
    }
    return cells;
  }
  while (p != end) {
    const char* const stop = cell_end(p, end, separator);
    cells.push_back(unquoted(trimmed({p, stop}, separator)));
    p = stop == end ? end : stop + 1;
  }
  return cells;
}

std::string cell_of(std::string_view text, char separator) {
  const bool has_mark = text.find('"') != text.npos || text.find(separator) != text.npos;
  const bool has_blank_end = !text.empty() && (is_space(text.front()) || is_space(text.back()));
  if (!has_mark && !has_blank_end) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + "\"";
}

struct CellRows::Output {
  double* values;
  std::size_t count;
  TokenSpan* tokens;

  void put(std::size_t i, double value, TokenSpan token) const {
    values[i] = value;
    if (tokens != nullptr) tokens[i] = token;
  }
  void leave_out(std::size_t from) const {
    for (std::size_t i = from; i < count; ++i) put(i, not_a_number, {});
  }
};

CellRows::CellRows(std::string_view text, std::size_t begin, CellStyle style)
    : begin_(text.data()),
      end_(text.data() + text.size()),
      line_(text.data() + begin),
      next_line_(line_),
      plain_places_(begin_, end_),
      style_(std::move(style)) {}

bool CellRows::next() {
  for (line_ = next_line_; line_ != end_;) {
    const char* p = line_;
    while (p != end_ && is_cell_blank(*p)) ++p;
    if (p == end_) break;
    if (!is_line_end(*p)) return true;
    line_ = p + 1;
  }
  line_ = next_line_ = end_;
  return false;
}

CellRow CellRows::read(double* values, std::size_t count, TokenSpan* tokens) {
  const Output out{values, count, tokens};
  CellRow row;
  switch (style_.separator) {
    case '\t':
      row = read_separated<'\t'>(out);
      break;
    case ',':
      row = read_separated<','>(out);
      break;
    case ';':
      row = read_separated<';'>(out);
      break;
    default:
      row = read_words(out);
  }
  next_line_ = row.end == end_ ? end_ : row.end + 1;
  return row;
}

CellRows::Cell CellRows::find_cell(const char* p) const {
  const char* const end = cell_end(p, end_, style_.separator);
  return {trimmed({p, end}, style_.separator), end};
}

double CellRows::value_of(TokenSpan token, std::size_t column, CellRow& row) {
  if (style_.is_text(column)) return not_a_number;
  const char* const place = token.begin;
  token = content_of(token, style_.separator);
  if (token.begin == token.end) return not_a_number;
  const NumberToken number = read_sample(token.begin, token.end, style_.commas);
  const bool whole = number.end == token.end;
  if (whole && number.kind == TokenKind::number) return number.value;
  if (whole && number.kind == TokenKind::not_finite) {
    not_finite_.add(place);
  } else if (row.fault == nullptr) {
    row.fault = place;
  }
  return not_a_number;
}

template <char separator>
CellRow CellRows::read_separated(const Output& out) {
  CellRow row;
  const char* p = line_;
  for (std::size_t i = 0;; ++i) {
    if (p == end_ || is_line_end(*p)) {
      if (i < out.count && i > 0) out.put(i++, not_a_number, {p, p});
      out.leave_out(i);
      break;
    }
    row.cells = i + 1;
    if (*p == separator) {
      if (i < out.count) out.put(i, not_a_number, {p, p});
      ++p;
      continue;
    }
    PlainNumber number;
    const char* next = nullptr;
    if (i < out.count && plain_places_.holds(p) && read_plain_number<separator>(p, number) &&
        (p[number.length] == separator || is_line_end(p[number.length]))) [[likely]] {
      next = p + number.length;
      out.put(i, number.value, {p, next});
      row.used = i + 1;
    } else {
      const Cell cell = find_cell(p);
      next = cell.next;
      if (cell.token.begin != cell.token.end) row.used = i + 1;
      if (i < out.count) out.put(i, value_of(cell.token, i, row), cell.token);
    }
    if (next == end_ || *next != separator) {
      p = next;
      out.leave_out(i + 1);
      break;
    }
    p = next + 1;
  }
  row.end = p;
  return row;
}

CellRow CellRows::read_words(const Output& out) {
  CellRow row;
  const char* p = line_;
  for (std::size_t i = 0;; ++i) {
    while (p != end_ && is_cell_blank(*p)) ++p;
    if (p == end_ || is_line_end(*p)) break;
    const char* const word = p;
    while (p != end_ && !is_space(*p)) ++p;
    row.cells = row.used = i + 1;
    if (i < out.count) out.put(i, value_of({word, p}, i, row), {word, p});
  }
  out.leave_out(row.cells);
  row.end = p;
  return row;
}

CellPatch::CellPatch(std::string_view bytes, std::size_t begin, const CellStyle& style,
                     std::size_t width)
    : bytes_(bytes),
      style_(style),
      width_(width),
      rows_(bytes, begin, style),
      values_(width),
      tokens_(width),
      out_(bytes.size() + bytes.size() / 8 + 4096),
      copied_(bytes.data()) {}

bool CellPatch::next() {
  if (!replacements_.empty()) write_row();
  if (!rows_.next()) return false;
  row_ = rows_.read(values_.data(), width_, tokens_.data());
  return true;
}

void CellPatch::replace(std::size_t column, double value, unsigned decimals) {
  const double keep_below = decimals > most_fixed_decimals
                                ? 0
                                : 0.5 * portable::pow(10.0, -static_cast<double>(decimals));
  if (std::fabs(value - values_[column]) <= keep_below) return;
  replacements_.push_back({column, value, decimals});
}

bool CellPatch::empties_row() const {
  if (replacements_.empty()) return false;
  std::vector<std::uint8_t> is_filled(width_);
  for (std::size_t i = 0; i < width_; ++i) is_filled[i] = tokens_[i].begin != tokens_[i].end;
  for (const Replacement& r : replacements_) is_filled[r.column] = !std::isnan(r.value);
  return std::find(is_filled.begin(), is_filled.end(), 1) == is_filled.end();
}

std::string CellPatch::finish() && {
  if (!replacements_.empty()) write_row();
  copy_until(bytes_.data() + bytes_.size());
  return std::move(out_).take();
}

void CellPatch::copy_until(const char* place) {
  out_.append({copied_, static_cast<std::size_t>(place - copied_)});
  copied_ = place;
}

void CellPatch::append(const Replacement& replacement) {
  if (std::isnan(replacement.value)) {
    if (style_.separator == ' ') out_.append("NaN");
    return;
  }
  // A decimal comma needs quotes if commas separate the cells.
  const bool quoted = style_.separator == ',' && style_.commas == CommaStyle::decimal;
  if (quoted) out_.append("\"");
  if (replacement.decimals <= most_fixed_decimals) {
    out_.append_fixed(replacement.value, replacement.decimals, style_.commas);
  } else {
    out_.append_shortest(replacement.value, style_.commas);
  }
  if (quoted) out_.append("\"");
}

// Appends the cells missing at the end of the row, from `column` up to the cell of `last`.
std::size_t CellPatch::grow(std::size_t column, const Replacement& last) {
  copy_until(row_.end);
  for (; column <= last.column; ++column) {
    out_.append({&style_.separator, 1});
    append(column == last.column ? last : Replacement{column, std::nan(""), 0});
  }
  return column;
}

void CellPatch::write_row() {
  std::sort(replacements_.begin(), replacements_.end(),
            [](const Replacement& a, const Replacement& b) { return a.column < b.column; });
  const auto absent = std::find_if(tokens_.begin(), tokens_.end(),
                                   [](const TokenSpan& token) { return token.begin == nullptr; });
  auto column = static_cast<std::size_t>(absent - tokens_.begin());
  for (const Replacement& replacement : replacements_) {
    const TokenSpan token = tokens_[replacement.column];
    if (token.begin != nullptr) {
      copy_until(token.begin);
      append(replacement);
      copied_ = token.end;
    } else if (!std::isnan(replacement.value)) {
      column = grow(column, replacement);
    }
  }
  // A row that was cut by the end of the file is completed.
  const bool last_row = row_.end == bytes_.data() + bytes_.size();
  if (last_row && column < width_) grow(column, {width_ - 1, std::nan(""), 0});
  replacements_.clear();
}

}  // namespace kinemend
