// Parses and checks the values of options, checks frame rates, and suggests the name that a
// misspelt one may mean.
#include "base/options.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <numeric>
#include <optional>
#include <type_traits>

#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/options.hpp"

namespace kinemend {

namespace {

[[noreturn]] void refuse(const OptionSpec& spec, std::string_view value, std::string_view reason) {
  throw Error(ErrorKind::usage, fmt::format("{}: {} {}", spec.name, value, reason));
}

std::string range_text(const OptionSpec& spec) {
  return fmt::format("is outside {} to {}{}{}", spec.minimum, spec.maximum,
                     spec.unit.empty() ? "" : " ", spec.unit);
}

void check_range(const OptionSpec& spec, double value) {
  if (!(value >= spec.minimum && value <= spec.maximum))
    refuse(spec, fmt::format("{}", value), range_text(spec));
}

template <class Number>
std::optional<Number> parse_whole(std::string_view text) {
  Number value{};
  const char* end = text.data() + text.size();
  if constexpr (std::is_floating_point_v<Number>) {
    const auto result = fast_float::from_chars(text.data(), end, value);
    if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  } else {
    const auto result = std::from_chars(text.data(), end, value);
    if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  }
  return value;
}

}  // namespace

std::string to_string(const OptionValue& value) {
  struct Visitor {
    std::string operator()(double v) const { return fmt::format("{}", v); }
    std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(const std::string& v) const { return v; }
  };
  return std::visit(Visitor{}, value);
}

OptionValue parse_option(const OptionSpec& spec, std::string_view text) {
  if (std::holds_alternative<double>(spec.default_value)) {
    const auto number = parse_whole<double>(text);
    if (!number) refuse(spec, fmt::format("\"{}\"", text), "is not a number");
    return check_option(spec, *number);
  }
  if (std::holds_alternative<std::int64_t>(spec.default_value)) {
    const auto number = parse_whole<std::int64_t>(text);
    if (!number) refuse(spec, fmt::format("\"{}\"", text), "is not a whole number");
    return check_option(spec, *number);
  }
  if (std::holds_alternative<bool>(spec.default_value)) {
    if (text == "true" || text == "1" || text == "on" || text.empty()) return true;
    if (text == "false" || text == "0" || text == "off") return false;
    refuse(spec, fmt::format("\"{}\"", text), "is neither true nor false");
  }
  return check_option(spec, std::string(text));
}

OptionValue check_option(const OptionSpec& spec, const OptionValue& value) {
  if (std::holds_alternative<double>(spec.default_value)) {
    const auto* whole = std::get_if<std::int64_t>(&value);
    const auto* number = std::get_if<double>(&value);
    if (!whole && !number) refuse(spec, to_string(value), "is not a number");
    const double checked = whole ? static_cast<double>(*whole) : *number;
    check_range(spec, checked);
    return checked;
  }
  if (value.index() != spec.default_value.index())
    refuse(spec, to_string(value), "has the wrong type");
  if (const auto* whole = std::get_if<std::int64_t>(&value))
    check_range(spec, static_cast<double>(*whole));
  if (const auto* text = std::get_if<std::string>(&value); text && !spec.choices.empty()) {
    if (std::find(spec.choices.begin(), spec.choices.end(), *text) == spec.choices.end()) {
      refuse(spec, fmt::format("\"{}\"", *text),
             fmt::format("is not one of {}", fmt::join(spec.choices, ", ")));
    }
  }
  return value;
}

void check_frame_rate(double frame_rate_hz) {
  if (is_usable_frame_rate(frame_rate_hz)) return;
  throw Error(ErrorKind::usage,
              fmt::format("a frame rate of {} Hz is outside {} to {} Hz", frame_rate_hz,
                          least_frame_rate_hz, most_frame_rate_hz));
}

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
