#include <algorithm>
#include <cmath>

#include "io/marker_table.hpp"
#include "io/text_buffer.hpp"

namespace kinemend {

namespace {

constexpr unsigned most_fixed_decimals = 9;
constexpr unsigned shortest_digits = most_fixed_decimals + 1;

double coordinate(Vec3 v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

class TableRewriter {
 public:
  TableRewriter(const MarkerClip& clip, std::string_view bytes, const MarkerTable& table)
      : clip_(clip),
        bytes_(bytes),
        table_(table),
        width_(table.width()),
        rows_(bytes, table.begin, table.style),
        values_(width_),
        tokens_(width_),
        out_(bytes.size() + bytes.size() / 8 + 4096),
        copied_(bytes.data()) {}

  std::string rewrite() {
    for (std::size_t f = 0; f < table_.frames && rows_.next(); ++f) {
      const CellRow row = rows_.read(values_.data(), width_, tokens_.data());
      for (std::size_t m = 0; m < clip_.marker_count(); ++m) compare(f, m);
      if (!replacements_.empty()) write_replacements(row);
    }
    out_.append({copied_, static_cast<std::size_t>(bytes_.data() + bytes_.size() - copied_)});
    return std::move(out_).take();
  }

 private:
  struct Replacement {
    std::size_t column = 0;
    double value = 0;  // NaN: missing
  };

  void compare(std::size_t frame, std::size_t marker) {
    const bool known = clip_.is_observed(frame, marker);
    const bool was_known = table_.observed[frame * clip_.marker_count() + marker] != 0;
    if (!known && !was_known) return;
    const auto& columns = table_.columns[marker];
    const Vec3 now = clip_.position(frame, marker);
    if (known && was_known &&
        now == Vec3{values_[columns[0]], values_[columns[1]], values_[columns[2]]}) {
      return;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = known ? coordinate(now, axis) : std::nan("");
      // Digits that already say the new value, as well as so many decimals can, stay.
      if (known && std::fabs(value - values_[columns[axis]]) <= keep_below()) continue;
      replacements_.push_back({columns[axis], value});
    }
  }

  // Another walk over the text, which only a changed take needs.
  unsigned decimals() {
    if (!measured_) decimals_ = decimals_of(bytes_, table_);
    measured_ = true;
    return decimals_;
  }
  double keep_below() {
    return decimals() > most_fixed_decimals
               ? 0
               : 0.5 * std::pow(10.0, -static_cast<double>(decimals()));
  }

  void append(double value) {
    const bool words = table_.style.separator == ' ';
    if (std::isnan(value)) return out_.append(words ? "NaN" : "");
    const CommaStyle commas = table_.style.commas;
    const bool quoted = table_.style.separator == ',' && commas == CommaStyle::decimal;
    if (quoted) out_.append("\"");
    if (decimals() <= most_fixed_decimals) {
      out_.append_fixed(value, decimals(), commas);
    } else {
      out_.append_shortest(value, commas);
    }
    if (quoted) out_.append("\"");
  }

  void copy_until(const char* place) {
    out_.append({copied_, static_cast<std::size_t>(place - copied_)});
    copied_ = place;
  }

  void write_replacements(const CellRow& row) {
    std::sort(replacements_.begin(), replacements_.end(),
              [](const Replacement& a, const Replacement& b) { return a.column < b.column; });
    auto absent = std::find_if(tokens_.begin(), tokens_.end(),
                               [](const TokenSpan& token) { return token.begin == nullptr; });
    auto column = static_cast<std::size_t>(absent - tokens_.begin());
    for (const Replacement& replacement : replacements_) {
      const TokenSpan token = tokens_[replacement.column];
      if (token.begin != nullptr) {
        copy_until(token.begin);
        append(replacement.value);
        copied_ = token.end;
      } else if (!std::isnan(replacement.value)) {
        copy_until(row.end);
        // Cells that the row ended before.
        for (; column <= replacement.column; ++column) {
          out_.append({&table_.style.separator, 1});
          append(column == replacement.column ? replacement.value : std::nan(""));
        }
      }
    }
    replacements_.clear();
  }

  const MarkerClip& clip_;
  std::string_view bytes_;
  const MarkerTable& table_;
  std::size_t width_;
  CellRows rows_;
  std::vector<double> values_;
  std::vector<TokenSpan> tokens_;
  std::vector<Replacement> replacements_;
  bool measured_ = false;
  unsigned decimals_ = 0;
  TextBuffer out_;
  const char* copied_;
};

unsigned decimals_of(TokenSpan token, CommaStyle commas) {
  const std::string_view text(token.begin, static_cast<std::size_t>(token.end - token.begin));
  if (text.find_first_of("eE") != text.npos) return shortest_digits;
  const std::size_t point = text.find_first_of(commas == CommaStyle::decimal ? ".," : ".");
  if (point == text.npos) return 0;
  std::size_t end = point + 1;
  while (end < text.size() && text[end] >= '0' && text[end] <= '9') ++end;
  return static_cast<unsigned>(std::min<std::size_t>(end - point - 1, shortest_digits));
}

}  // namespace

unsigned decimals_of(std::string_view bytes, const MarkerTable& table) {
  const std::size_t width = table.width();
  std::vector<double> values(width);
  std::vector<TokenSpan> tokens(width);
  CellRows rows(bytes, table.begin, table.style);
  unsigned most = 0;
  for (std::size_t f = 0; f < table.frames && rows.next(); ++f) {
    rows.read(values.data(), width, tokens.data());
    for (const auto& marker : table.columns) {
      for (const std::size_t column : marker) {
        if (std::isnan(values[column])) continue;
        most = std::max(most, decimals_of(tokens[column], table.style.commas));
      }
    }
  }
  return most;
}

std::string rewrite_marker_table(const MarkerClip& clip, std::string_view bytes,
                                 const MarkerTable& table) {
  return TableRewriter(clip, bytes, table).rewrite();
}

}  // namespace kinemend
