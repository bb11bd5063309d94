// Replaces cells row by row, and adds the cells that a short row lacks.
#include "io/text/cell_patch.hpp"

#include <algorithm>
#include <cstdint>

#include "base/portable.hpp"

namespace kinemend {

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
