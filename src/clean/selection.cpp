#include "clean/selection.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <limits>

#include "kinemend/error.hpp"
#include "kinemend/marker_clip.hpp"

namespace kinemend {

namespace {

void check_number(const char* name, double value, double maximum) {
  if (value >= 0 && value <= maximum) return;
  throw Error(ErrorKind::usage, fmt::format("{}: {} is outside 0 to {}", name, value, maximum));
}

bool matches(const std::string& pattern, std::string_view name) {
  return name == pattern || fnmatch(pattern.c_str(), std::string(name).c_str(), 0) == 0;
}

// Sets the marks of what a name or shell pattern means.
void mark(const std::vector<std::string>& names, const std::string& pattern, std::string_view kind,
          std::uint8_t value, std::vector<std::uint8_t>& marks) {
  bool matched = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!matches(pattern, names[i]) && !matches(pattern, without_subject(names[i]))) continue;
    marks[i] = value;
    matched = true;
  }
  if (!matched) {
    throw Error(ErrorKind::usage, fmt::format("no {} matches \"{}\" (the {}s are {})", kind,
                                              pattern, kind, fmt::join(names, ", ")));
  }
}

}  // namespace

void check_settings(const CleanSettings& settings, std::size_t frames) {
  check_number("strength", settings.strength, 1);
  check_number("max_change_deg", settings.max_change_deg, 180);
  check_number("max_change", settings.max_change, std::numeric_limits<double>::infinity());
  check_number("peak_loss_limit", settings.peak_loss_limit, 1);
  if (settings.fill && !settings.fill->names.empty())
    throw Error(ErrorKind::usage,
                "fill: what is filled is what may change; it has no names of its own");
  if (!settings.range) return;
  const auto [first, last] = *settings.range;
  if (first > last || last >= frames) {
    throw Error(ErrorKind::usage,
                fmt::format("range: frames {} to {} are not in a take of frames 0 to {}", first,
                            last, frames == 0 ? 0 : frames - 1));
  }
}

std::vector<std::uint8_t> select_names(const std::vector<std::string>& names,
                                       const CleanSettings& settings, std::string_view kind) {
  std::vector<std::uint8_t> marks(names.size(), settings.joints.empty() ? 1 : 0);
  for (const auto& pattern : settings.joints) mark(names, pattern, kind, 1, marks);
  for (const auto& pattern : settings.exclude) mark(names, pattern, kind, 0, marks);
  return marks;
}

}  // namespace kinemend
