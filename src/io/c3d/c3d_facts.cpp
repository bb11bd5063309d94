// Gathers the facts of a C3D file: its encoding, cameras, force plates and programs.
#include "io/c3d/c3d_facts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>

namespace kinemend {

namespace {

std::string_view processor_name(C3dProcessor processor) {
  switch (processor) {
    case C3dProcessor::dec:
      return "DEC";
    case C3dProcessor::mips:
      return "MIPS";
    case C3dProcessor::intel:
      break;
  }
  return "Intel";
}

std::string counted(std::size_t count, std::string_view word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

std::string plates_text(const C3dParameters& parameters, std::size_t count) {
  std::string text = std::to_string(count);
  const std::vector<double> types = parameters.numbers("FORCE_PLATFORM", "TYPE");
  for (std::size_t i = 0; i < std::min(count, types.size()); ++i)
    text += fmt::format("{}{:.0f}", i == 0 ? " (type " : ", ", types[i]);
  return text + (types.empty() ? "" : ")");
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) {
    if (!text.empty()) all += (all.empty() ? "" : ", ") + as_utf8(text);
  }
  return all;
}

std::string software_text(const C3dParameters& parameters) {
  std::vector<std::string> parts;
  for (const char* const name : {"COMPANY", "SOFTWARE"})
    parts.push_back(parameters.text("MANUFACTURER", name));
  std::string text = joined(parts);
  const C3dParameter* const version = parameters.find("MANUFACTURER", "VERSION");
  if (version == nullptr || text.empty()) return text;
  if (version->type == C3dType::text) {
    const std::string label = parameters.text("MANUFACTURER", "VERSION");
    return label.empty() ? text : text + " " + as_utf8(label);
  }
  return text + fmt::format(" {:g}", fmt::join(version->numbers, "."));
}

}  // namespace

std::string c3d_encoding(const C3dDocument& document) {
  if (document.layout.is_float) return fmt::format("{} reals", processor_name(document.processor));
  return fmt::format("{} integers in steps of {:.4g}", processor_name(document.processor),
                     document.layout.scale);
}

std::vector<SourceFact> c3d_facts(const C3dDocument& document, const C3dPointCounts& counts) {
  const C3dParameters& parameters = document.parameters;
  const C3dLayout& layout = document.layout;
  std::vector<SourceFact> facts{{"encoding", c3d_encoding(document)}};
  const auto add = [&](const char* name, const std::string& text) {
    if (!text.empty()) facts.push_back({name, text});
  };
  if (layout.analog_count > 0 && layout.analog_values > 0) {
    add("analog", fmt::format("{} at {:g} Hz", counted(layout.analog_count, "channel"),
                              layout.rate_hz * static_cast<double>(layout.analog_instants())));
    if (layout.point_count == 0)
      add("analog frames", std::to_string(layout.frame_count * layout.analog_instants()));
  }
  if (!document.events.empty()) add("events", std::to_string(document.events.size()));
  if (const std::size_t plates = parameters.count("FORCE_PLATFORM", "USED").value_or(0); plates > 0)
    add("force plates", plates_text(parameters, plates));
  if (counts.cameras != 0)
    add("cameras", fmt::format("{} saw a marker", std::popcount(counts.cameras)));
  if (const std::size_t segments = parameters.count("ROTATION", "USED").value_or(0); segments > 0)
    add("rotations", counted(segments, "segment"));
  std::vector<std::string> subjects = parameters.texts("SUBJECTS", "NAMES");
  if (joined(subjects).empty()) subjects = parameters.texts("SUBJECT", "NAME");
  add("subjects", joined(subjects));
  add("software", software_text(parameters));
  return facts;
}

}  // namespace kinemend
