// Names of sources, and of the programs whose name in a file shows what recorded its motion.
#include "kinemend/take.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <span>

#include "base/options.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

struct NamedSource {
  Source source;
  std::string_view name;
};
constexpr std::array<NamedSource, 6> named_sources{{{Source::optical, "optical"},
                                                    {Source::suit, "suit"},
                                                    {Source::video, "video"},
                                                    {Source::depth, "depth"},
                                                    {Source::keyframed, "keyframed"},
                                                    {Source::unknown, "unknown"}}};

// Makers and programs that record with one kind of system only, in lower case. Editors (Blender,
// Maya, MotionBuilder) and programs for several kinds of system are left out: their names are not
// certain evidence.
constexpr std::string_view optical_recorders[] = {
    "vicon",           "oxford metrics", "qualisys",   "optitrack",          "naturalpoint",
    "motion analysis", "phasespace",     "codamotion", "charnwood dynamics", "northern digital",
    "optotrak"};
constexpr std::string_view suit_recorders[] = {
    "xsens",       "mvn",    "movella",   "noitom",          "perception neuron", "axis neuron",
    "axis studio", "rokoko", "smartsuit", "motion workshop", "nansense",          "synertial"};
constexpr std::string_view video_recorders[] = {"theia",     "theia3d", "opencap",  "openpose",
                                                "mediapipe", "captury", "kinatrax", "deepmotion"};
constexpr std::string_view depth_recorders[] = {"kinect", "nuitrack"};

struct Recorders {
  Source source;
  std::span<const std::string_view> words;
};
constexpr Recorders recorders[] = {{Source::optical, optical_recorders},
                                   {Source::suit, suit_recorders},
                                   {Source::video, video_recorders},
                                   {Source::depth, depth_recorders}};

// Whether a text contains these words, not as parts of longer words.
bool has_words(std::string_view text, std::string_view words) {
  const auto is_letter = [&](std::size_t at) {
    return at < text.size() && std::isalnum(static_cast<unsigned char>(text[at])) != 0;
  };
  for (std::size_t at = text.find(words); at != text.npos; at = text.find(words, at + 1)) {
    if ((at == 0 || !is_letter(at - 1)) && !is_letter(at + words.size())) return true;
  }
  return false;
}

// Returns the source of the recorder that the text names; empty if it names none, or two that
// contradict each other.
std::optional<Source> source_named_in(std::string_view text) {
  const std::string lower = lower_case(text);
  std::optional<Source> found;
  for (const auto& [source, list] : recorders) {
    const auto is_named = [&](std::string_view words) { return has_words(lower, words); };
    if (std::none_of(list.begin(), list.end(), is_named)) continue;
    if (found) return std::nullopt;
    found = source;
  }
  return found;
}

}  // namespace

std::string_view to_string(Source source) {
  return std::find_if(named_sources.begin(), named_sources.end(),
                      [&](const NamedSource& entry) { return entry.source == source; })
      ->name;
}

Source parse_source(std::string_view name) {
  return find_named(named_sources, name, "unknown source").source;
}

std::vector<std::string> source_names() { return names_of(named_sources); }

bool expects_slow_noise(Source source) noexcept {
  return source == Source::video || source == Source::depth || source == Source::suit;
}

TakeSource source_of(const Take& take, Source given) {
  if (given != Source::unknown) return {given, "given"};
  for (const SourceFact& fact : take.source.facts) {
    if (fact.name != "software") continue;
    if (const auto found = source_named_in(fact.text))
      return {*found, fmt::format("read from the file, software: {}", printable(fact.text))};
  }
  return {};
}

}  // namespace kinemend
