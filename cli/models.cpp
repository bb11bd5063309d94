// kinemend models: the learned models that ship, and names to use any model with other takes.

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "commands.hpp"
#include "json.hpp"
#include "kinemend/experimental/model.hpp"
#include "kinemend/experimental/version.hpp"
#include "kinemend/io.hpp"
#include "model_view.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

const ShippedModel* find_shipped(const std::vector<ShippedModel>& models, std::string_view method) {
  const auto found = std::find_if(models.begin(), models.end(),
                                  [&](const ShippedModel& m) { return m.method == method; });
  return found == models.end() ? nullptr : &*found;
}

int list_models(bool json) {
  Json list = Json::array();
  std::string text;
  for (const ShippedModel& shipped : shipped_models()) {
    const ModelFile file = model_file_of(shipped.bytes, shipped.method);
    list.push_back(model_json(file));
    text += (text.empty() ? "" : "\n") + model_text(file, false);
  }
  if (json) {
    write_out(json_text({{"kinemend", version()}, {"models", std::move(list)}}));
  } else {
    write_out(text.empty() ? "no model ships with this program\n" : text);
  }
  return 0;
}

int export_model(const std::string& method, const Arguments& arguments) {
  const std::vector<ShippedModel> models = shipped_models();
  const ShippedModel* shipped = find_shipped(models, method);
  if (shipped == nullptr) {
    std::vector<std::string> names;
    names.reserve(models.size());
    for (const ShippedModel& model : models) names.emplace_back(model.method);
    throw Error(ErrorKind::usage,
                fmt::format("models: no model ships for {}{} (there are {})", method,
                            suggestion(method, names),
                            names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  }
  const std::string output = arguments.text("output");
  if (output.empty())
    throw Error(ErrorKind::usage, "models: --output is missing (see kinemend models -h)");
  write_output(output, shipped->bytes, arguments.flag("force"));
  return 0;
}

int write_map(const std::string& model_name, const Arguments& arguments) {
  if (arguments.positionals.empty())
    throw Error(ErrorKind::usage, "models: --map needs a TAKE (see kinemend models -h)");
  const std::string output = arguments.text("output");
  check_is_no_input("--output", output, {arguments.positionals.front(), model_name});
  const std::vector<ShippedModel> models = shipped_models();
  const ShippedModel* shipped = find_shipped(models, model_name);
  const Model model =
      shipped != nullptr ? parse_model(shipped->bytes, model_name) : read_model(model_name);
  const TakeResult read =
      read_take(std::filesystem::path(arguments.positionals.front()), read_options(arguments));
  const std::string text =
      std::visit([&](const auto& clip) { return name_map_text(model.layout, clip); }, read.take);
  write_output(output.empty() ? "-" : output, text, arguments.flag("force"));
  return 0;
}

int run_models(const Arguments& arguments) {
  const std::string exported = arguments.text("export"), mapped = arguments.text("map");
  if (!exported.empty() && !mapped.empty())
    throw Error(ErrorKind::usage, "models: --export and --map are two things (give one)");
  if (mapped.empty() && !arguments.positionals.empty())
    throw Error(ErrorKind::usage, "models: a take is for --map MODEL (see kinemend models -h)");
  if (!exported.empty()) return export_model(exported, arguments);
  if (!mapped.empty()) return write_map(mapped, arguments);
  return list_models(arguments.flag("json"));
}

std::vector<Flag> models_flags() {
  Flag exported = text_flag("export", "METHOD", "Work", "write the model that ships for METHOD",
                            "To --output.");
  Flag map = text_flag("map", "MODEL", "Work",
                       "print which parts of TAKE are those of MODEL, as a file of names",
                       "MODEL is a file, or the method of a model that ships. What was not found "
                       "is left empty: complete it and give it to clean as --map.");
  map.completion = Completion::file;
  std::vector<Flag> list = {output_flag("where to write what --export or --map gives"),
                            force_flag(), json_flag("print the list as JSON instead of text"),
                            exported, map};
  append(list, reading_flags("what needs a repair becomes an error"));
  return list;
}

}  // namespace

Command models_command() {
  Command command;
  command.name = "models";
  command.summary = "list the learned models that ship; match one with a take";
  command.description =
      "Of each model that is part of the program: what it was learned from, under which licence, "
      "by which command, and its checksum. kinemend info tells the same of a model file.";
  command.positionals = {{"TAKE", "take for --map; - is standard input", 0, 1, {}}};
  command.flags = models_flags();
  command.examples = {
      {"kinemend models", "what ships"},
      {"kinemend models --export wiener -o wiener.kmodel", "as a file"},
      {"kinemend models --map walk.kmodel take.bvh -o names.csv", "names to complete by hand"}};
  command.run = run_models;
  return command;
}

}  // namespace kinemend::cli
