// Writes changed markers into the bytes of their source table.
#include <algorithm>
#include <cmath>
#include <optional>

#include "io/table/marker_table.hpp"
#include "io/text/cell_patch.hpp"
#include "io/text/number.hpp"

namespace kinemend {

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

}  // namespace kinemend
