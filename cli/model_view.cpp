// Collects the card and facts of a model and escapes them for each output form.
#include "model_view.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "json.hpp"
#include "kinemend/extend/text.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

using Facts = std::vector<std::pair<std::string, std::string>>;

std::string minutes_text(double seconds) { return fmt::format("{:.1f} min", seconds / 60); }

std::string size_text(std::size_t bytes) {
  return bytes < 1000000 ? fmt::format("{:.1f} kB", static_cast<double>(bytes) / 1e3)
                         : fmt::format("{:.2f} MB", static_cast<double>(bytes) / 1e6);
}

// The card and other facts, most important first.
Facts facts_of(const ModelFile& file) {
  const Model& model = file.model;
  const ModelCard& card = model.card;
  Facts facts = {{"method", fmt::format("{}, version {}", model.method, model.version)},
                 {"body", body_text(model.layout)},
                 {"rate", fmt::format("{:.6g} Hz", model.rate_hz)},
                 {"learned from",
                  fmt::format("{}, {}", counted(model.takes, "take"), minutes_text(model.seconds))},
                 {"data", card.data},
                 {"licence", card.licence},
                 {"command", card.command},
                 {"figures", card.figures},
                 {"size", size_text(file.bytes)},
                 {"checksum", file.checksum}};
  if (model.method == "learned") {
    facts.insert(facts.begin() + 2,
                 {"rigs",
                  "all whose joints have names that it knows; other joints and markers are "
                  "cleaned one by one"});
  }
  std::erase_if(facts, [](const auto& fact) { return fact.second.empty(); });
  return facts;
}

std::string title_of(const ModelFile& file) {
  const std::string& title = file.model.card.title;
  return title.empty() ? fmt::format("A model for {}", file.model.method) : title;
}

std::string parts_text(const BodyLayout& layout) {
  Table table({Align::left, Align::left}, 4);
  const bool joints = layout.kind == BodyKind::joints;
  table.add({joints ? "joint" : "marker", joints ? "parent" : ""});
  for (std::size_t i = 0; i < layout.track_count(); ++i) {
    const std::int32_t parent = joints ? layout.parents[i] : -1;
    table.add({printable_name(layout.names[i]),
               parent < 0 ? "" : printable_name(layout.names[static_cast<std::size_t>(parent)])});
  }
  return "\n" + table.text();
}

std::string numbers_text(const Model& model) {
  if (model.numbers.empty()) return "";
  Table table({Align::left, Align::right}, 4);
  for (const auto& [name, value] : model.numbers)
    table.add({printable_name(name), fmt::format("{:.6g}", value)});
  return "\n" + table.text();
}

// Escapes text of a card, so that Markdown renders a plain paragraph.
std::string paragraph(std::string_view text) {
  std::string result;
  for (const char c : printable(text)) {
    if (c == '<' || c == '>' || c == '|' || c == '#' || c == '*' || c == '_') result += '\\';
    result += c;
  }
  return result;
}

}  // namespace

ModelFile model_file_of(std::string_view bytes, std::string_view name) {
  return {std::string(name), parse_model(bytes, name), bytes.size(), model_checksum(bytes)};
}

bool is_model_path(std::string_view path) { return path.ends_with(".kmodel"); }

std::string body_text(const BodyLayout& layout) {
  return fmt::format(
      "{}, {}", counted(layout.track_count(), layout.kind == BodyKind::joints ? "joint" : "marker"),
      counted(layout.channel_count(), "channel"));
}

std::string model_text(const ModelFile& file, bool with_parts) {
  std::string text = Colours::of_out().paint(Paint::bold, printable(file.name)) + ": " +
                     printable(title_of(file)) + "\n";
  Table table({Align::left, Align::left});
  for (const auto& [name, fact] : facts_of(file)) table.add({name, printable(fact)});
  text += table.text();
  if (with_parts) text += parts_text(file.model.layout) + numbers_text(file.model);
  return text;
}

Json model_json(const ModelFile& file) {
  const Model& model = file.model;
  const ModelCard& card = model.card;
  return {{"input", file.name},          {"kind", "model"},
          {"method", model.method},      {"version", model.version},
          {"title", card.title},         {"body", to_string(model.layout.kind)},
          {"parts", model.layout.names}, {"channel_count", model.layout.channel_count()},
          {"rate_hz", model.rate_hz},    {"takes", model.takes},
          {"seconds", model.seconds},    {"data", card.data},
          {"licence", card.licence},     {"command", card.command},
          {"figures", card.figures},     {"bytes", file.bytes},
          {"checksum", file.checksum},   {"numbers", model.numbers}};
}

std::string card_markdown(const ModelFile& file) {
  std::string text = fmt::format("# {}\n\n| | |\n|---|---|\n", paragraph(title_of(file)));
  for (const auto& [name, fact] : facts_of(file)) {
    const bool is_code = name == "command" || name == "checksum";
    text += is_code ? fmt::format("| {} | `{}` |\n", name, printable(fact))
                    : fmt::format("| {} | {} |\n", name, paragraph(fact));
  }
  const BodyLayout& layout = file.model.layout;
  text += fmt::format("\nIt covers the {} ", to_string(layout.kind));
  for (std::size_t i = 0; i < layout.track_count(); ++i)
    text += (i == 0 ? "" : ", ") + paragraph(layout.names[i]);
  text += ".\n";
  if (file.model.numbers.empty()) return text;
  text += "\n| number | |\n|---|---:|\n";
  for (const auto& [name, value] : file.model.numbers)
    text += fmt::format("| {} | {:.6g} |\n", paragraph(name), value);
  return text;
}

}  // namespace kinemend::cli
