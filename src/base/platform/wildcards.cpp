// Matches patterns by backtracking to the last asterisk.
#include "kinemend/extend/text.hpp"

#ifdef __GLIBC__
#include <fnmatch.h>
#endif

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace kinemend {

namespace {

bool is_in(char c, char first, char last) { return c >= first && c <= last; }
bool is_digit(char c) { return is_in(c, '0', '9'); }
bool is_upper(char c) { return is_in(c, 'A', 'Z'); }
bool is_lower(char c) { return is_in(c, 'a', 'z'); }
bool is_alpha(char c) { return is_upper(c) || is_lower(c); }
bool is_alnum(char c) { return is_alpha(c) || is_digit(c); }
bool is_graph(char c) { return is_in(c, '!', '~'); }

struct CharacterClass {
  std::string_view name;
  bool (*holds)(char);
};

// The character classes of the locale "C".
constexpr CharacterClass classes[] = {
    {"alnum", is_alnum},
    {"alpha", is_alpha},
    {"blank", [](char c) { return c == ' ' || c == '\t'; }},
    {"cntrl", [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }},
    {"digit", is_digit},
    {"graph", is_graph},
    {"lower", is_lower},
    {"print", [](char c) { return is_graph(c) || c == ' '; }},
    {"punct", [](char c) { return is_graph(c) && !is_alnum(c); }},
    {"space", [](char c) { return c == ' ' || is_in(c, '\t', '\r'); }},
    {"upper", is_upper},
    {"xdigit", [](char c) { return is_digit(c) || is_in(c, 'a', 'f') || is_in(c, 'A', 'F'); }}};

struct Step {
  bool fits = false;
  std::size_t length = 1;  // of the pattern
};

// The end of "[:name:]" that begins at `place`, and the class; none if there is no such class.
std::optional<std::pair<std::size_t, const CharacterClass*>> class_at(std::string_view pattern,
                                                                      std::size_t place) {
  if (pattern.substr(place, 2) != "[:") return std::nullopt;
  const std::size_t end = pattern.find(":]", place + 2);
  if (end == pattern.npos) return std::nullopt;
  const std::string_view name = pattern.substr(place + 2, end - place - 2);
  const auto* found = std::find_if(std::begin(classes), std::end(classes),
                                   [&](const CharacterClass& entry) { return entry.name == name; });
  if (found == std::end(classes)) return std::nullopt;
  return std::pair(end + 2, found);
}

// One character of a set, possibly after a backslash. Moves `place` past it.
std::optional<char> member_at(std::string_view pattern, std::size_t& place) {
  if (place < pattern.size() && pattern[place] == '\\') ++place;
  if (place >= pattern.size()) return std::nullopt;
  return pattern[place++];
}

// The match of the set that begins at `begin`. None if it has no end: the bracket is then literal.
std::optional<Step> set_step(std::string_view pattern, std::size_t begin, char c) {
  std::size_t place = begin + 1;
  const bool excludes = place < pattern.size() && (pattern[place] == '!' || pattern[place] == '^');
  if (excludes) ++place;
  const std::size_t first = place;
  bool fits = false;
  while (place < pattern.size() && (pattern[place] != ']' || place == first)) {
    if (const auto named = class_at(pattern, place)) {
      fits |= named->second->holds(c);
      place = named->first;
      continue;
    }
    const auto low = member_at(pattern, place);
    if (!low) return std::nullopt;
    auto high = low;
    if (place + 1 < pattern.size() && pattern[place] == '-' && pattern[place + 1] != ']') {
      ++place;
      high = member_at(pattern, place);
      if (!high) return std::nullopt;
    }
    const auto as_byte = [](char value) { return static_cast<unsigned char>(value); };
    fits |= as_byte(c) >= as_byte(*low) && as_byte(c) <= as_byte(*high);
  }
  if (place >= pattern.size()) return std::nullopt;
  return Step{fits != excludes, place + 1 - begin};
}

// Whether the next element of the pattern, other than an asterisk, matches the character.
Step step_at(std::string_view pattern, std::size_t place, char c) {
  if (pattern[place] == '?') return {true, 1};
  if (pattern[place] == '[') {
    if (const auto step = set_step(pattern, place, c)) return *step;
  }
  if (pattern[place] == '\\') {
    if (place + 1 == pattern.size()) return {false, 1};
    return {pattern[place + 1] == c, 2};
  }
  return {pattern[place] == c, 1};
}

}  // namespace

bool matches_wildcards_anywhere(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, after_star = pattern.npos, star_taken = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      after_star = ++p;
      star_taken = n;
      continue;
    }
    const Step step = p < pattern.size() ? step_at(pattern, p, name[n]) : Step{};
    if (step.fits) {
      p += step.length;
      ++n;
    } else if (after_star != pattern.npos) {
      p = after_star;
      n = ++star_taken;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

bool matches_wildcards(const std::string& pattern, const std::string& name) {
#ifdef __GLIBC__
  return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
#else
  return matches_wildcards_anywhere(pattern, name);
#endif
}

}  // namespace kinemend
