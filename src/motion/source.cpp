// Names of sources, and of the programs whose name in a file shows what recorded its motion.
#include "kinemend/take.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include "base/options.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

struct NamedSource {
  Source source;
  std::string name;
};

const std::array<NamedSource, 6>& named_sources() {
  static const std::array<NamedSource, 6> list = {{{Source::optical, "optical"},
                                                   {Source::suit, "suit"},
                                                   {Source::video, "video"},
                                                   {Source::depth, "depth"},
                                                   {Source::keyframed, "keyframed"},
                                                   {Source::unknown, "unknown"}}};
  return list;
}

// Makers and programs that record with one kind of system only, in lower case. Editors (Blender,
// Maya, MotionBuilder) and programs for several kinds of system are left out: their names are not
// certain evidence.
constexpr std::array<std::pair<std::string_view, Source>, 33> recorders = {{
    {"vicon", Source::optical},
    {"oxford metrics", Source::optical},
    {"qualisys", Source::optical},
    {"optitrack", Source::optical},
    {"naturalpoint", Source::optical},
    {"motion analysis", Source::optical},
    {"phasespace", Source::optical},
    {"codamotion", Source::optical},
    {"charnwood dynamics", Source::optical},
    {"northern digital", Source::optical},
    {"optotrak", Source::optical},
    {"xsens", Source::suit},
    {"mvn", Source::suit},
    {"movella", Source::suit},
    {"noitom", Source::suit},
    {"perception neuron", Source::suit},
    {"axis neuron", Source::suit},
    {"axis studio", Source::suit},
    {"rokoko", Source::suit},
    {"smartsuit", Source::suit},
    {"motion workshop", Source::suit},
    {"nansense", Source::suit},
    {"synertial", Source::suit},
    {"theia", Source::video},
    {"theia3d", Source::video},
    {"opencap", Source::video},
    {"openpose", Source::video},
    {"mediapipe", Source::video},
    {"captury", Source::video},
    {"kinatrax", Source::video},
    {"deepmotion", Source::video},
    {"kinect", Source::depth},
    {"nuitrack", Source::depth},
}};

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
  for (const auto& [words, source] : recorders) {
    if (!has_words(lower, words)) continue;
    if (found && *found != source) return std::nullopt;
    found = source;
  }
  return found;
}

}  // namespace

std::string_view to_string(Source source) {
  const auto& list = named_sources();
  return std::find_if(list.begin(), list.end(),
                      [&](const NamedSource& entry) { return entry.source == source; })
      ->name;
}

Source parse_source(std::string_view name) {
  return find_named(named_sources(), name, "unknown source").source;
}

std::vector<std::string> source_names() { return names_of(named_sources()); }

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
