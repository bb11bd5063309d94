// Gathers the facts of a C3D file (its encoding, cameras, force plates and programs), and reads
// events from the parameters, or else from the header.
#include "io/c3d/c3d_document.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>

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

std::string count_text(std::size_t count, std::string_view word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

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
    add("analog", fmt::format("{} at {:g} Hz", count_text(layout.analog_count, "channel"),
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
    add("rotations", count_text(segments, "segment"));
  std::vector<std::string> subjects = parameters.texts("SUBJECTS", "NAMES");
  if (joined(subjects).empty()) subjects = parameters.texts("SUBJECT", "NAME");
  add("subjects", joined(subjects));
  add("software", software_text(parameters));
  return facts;
}

namespace {

// Reads events of a group, whose times are pairs: minutes, seconds.
std::vector<MarkerEvent> group_events(const C3dSource& source, const C3dParameters& parameters,
                                      std::string_view group) {
  const std::vector<double> times = parameters.numbers(group, "TIMES");
  const std::vector<std::string> labels = parameters.texts(group, "LABELS");
  const std::vector<std::string> contexts = parameters.texts(group, "CONTEXTS");
  std::size_t count = parameters.count(group, "USED").value_or(times.size() / 2);
  const C3dParameter* const first = parameters.find(group, "TIMES");
  if (count > times.size() / 2) {
    source.note("event_count_mismatch", first == nullptr ? source.bytes.size() : first->data_begin,
                "the file has fewer event times than events");
    count = times.size() / 2;
  }
  std::vector<MarkerEvent> events;
  for (std::size_t i = 0; i < count; ++i) {
    const double time_s = 60 * times[2 * i] + times[2 * i + 1];
    if (!std::isfinite(time_s)) {
      source.note("event_time_not_finite", first->data_begin,
                  "the time of an event is not finite: the event is left out");
      continue;
    }
    events.push_back({i < labels.size() ? as_utf8(labels[i]) : std::string(),
                      i < contexts.size() ? as_utf8(contexts[i]) : std::string(), time_s});
  }
  return events;
}

std::vector<MarkerEvent> header_events(const C3dSource& source, const C3dHeader& header) {
  if (source.word(header.place_of(c3d_event_key_word)) != c3d_event_key) return {};
  const std::size_t count = std::min<std::size_t>(
      source.word(header.place_of(c3d_event_count_word)), c3d_most_header_events);
  std::vector<MarkerEvent> events;
  for (std::size_t i = 0; i < count; ++i) {
    const double time_s = source.real(header.place_of(c3d_event_times_word) + 4 * i);
    if (!std::isfinite(time_s)) continue;
    std::string label(source.bytes.substr(header.place_of(c3d_event_labels_word) + 4 * i, 4));
    label.erase(label.find_last_not_of(std::string_view(" \0", 2)) + 1);
    events.push_back({as_utf8(label), "", time_s});
  }
  return events;
}

// Returns the length of the UTF-8 sequence at `p`; 0 if it is not valid.
std::size_t sequence_length(std::string_view p) {
  const auto lead = static_cast<unsigned char>(p[0]);
  const std::size_t length = lead < 0x80                     ? 1
                             : lead >> 5 == 6 && lead > 0xC1 ? 2
                             : lead >> 4 == 14               ? 3
                             : lead >> 3 == 30               ? 4
                                                             : 0;
  if (length > p.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(p[i]) & 0xC0) != 0x80) return 0;
  }
  return length;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = sequence_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace

std::string as_utf8(const std::string& text) {
  if (is_utf8(text)) return text;
  std::string converted;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x80) {
      converted += c;
    } else {
      converted += static_cast<char>(0xC0 | code >> 6);
      converted += static_cast<char>(0x80 | (code & 0x3F));
    }
  }
  return converted;
}

bool c3d_event_times_are_finite(const C3dSource& source, const C3dHeader& header,
                                const C3dParameters& parameters) {
  const auto finite = [](double time) { return std::isfinite(time); };
  for (const std::string_view group : {"EVENT", "EVENTS"}) {
    const std::vector<double> times = parameters.numbers(group, "TIMES");
    if (!std::all_of(times.begin(), times.end(), finite)) return false;
  }
  if (source.word(header.place_of(c3d_event_key_word)) != c3d_event_key) return true;
  for (std::size_t i = 0; i < c3d_most_header_events; ++i) {
    if (!finite(source.real(header.place_of(c3d_event_times_word) + 4 * i))) return false;
  }
  return true;
}

std::vector<MarkerEvent> read_c3d_events(const C3dSource& source, const C3dHeader& header,
                                         const C3dParameters& parameters) {
  for (const std::string_view group : {"EVENT", "EVENTS"}) {
    std::vector<MarkerEvent> events = group_events(source, parameters, group);
    if (!events.empty()) return events;
  }
  return header_events(source, header);
}

}  // namespace kinemend
