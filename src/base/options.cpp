// Parses and checks the values of options.
#include "kinemend/options.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <type_traits>

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

}  // namespace kinemend
