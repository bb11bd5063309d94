// Suggests the name that a misspelt one may mean.
#include <algorithm>
#include <cstddef>
#include <numeric>

#include "kinemend/options.hpp"

namespace kinemend {

namespace {

// Longer names are not misspelt names, and the distance costs the product of the lengths. Chosen by
// hand.
constexpr std::size_t longest_name = 60;

// The least number of letters to insert, remove, replace or swap with their neighbour (Damerau
// 1964, each place edited once), three rows at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = last[j] + (a[i] == b[j] ? 0 : 1);
      row[j + 1] = std::min({replaced, row[j] + 1, last[j + 1] + 1});
      const bool is_swap = i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j];
      if (is_swap) row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

// The most edits between a name and its suggestion: a third of the letters of the longer one, and
// one in a shorter name. Two thirds of the letters then agree. With two edits in words of up to
// five letters, unrelated words would be near, such as "on" and "off", or "undo" and "info".
std::size_t most_edits(std::string_view a, std::string_view b) {
  const std::size_t length = std::max(a.size(), b.size());
  return length < 2 ? 0 : std::max<std::size_t>(1, length / 3);
}

}  // namespace

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  if (name.size() > longest_name) return "";
  std::string best;
  std::size_t least = longest_name;
  for (const std::string& candidate : candidates) {
    const bool begins = name.size() >= 3 && candidate.starts_with(name);
    const std::size_t distance = begins ? 1 : edit_distance(name, candidate);
    if (distance < least && distance <= most_edits(name, candidate)) {
      best = candidate;
      least = distance;
    }
  }
  return best;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_name(name, candidates);
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

}  // namespace kinemend
