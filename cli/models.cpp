// kinemend models: lists the shipped models, and maps names of a take to those of a model.

#include <fmt/format.h>

#include <algorithm>

#include "commands.hpp"
#include "json.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/io.hpp"
#include "model_view.hpp"
#include "run_files.hpp"
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
    write_out(text.empty() ? "this program ships without models\n" : text);
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
                fmt::format("models: no model ships for {}{} (models ship for {})", method,
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
  RunFiles()
      .reads("TAKE", arguments.positionals.front())
      .reads("--map", model_name)
      .writes("--output", output)
      .check();
  const std::vector<ShippedModel> models = shipped_models();
  const ShippedModel* shipped = find_shipped(models, model_name);
  const Model model =
      shipped != nullptr ? parse_model(shipped->bytes, model_name) : read_model(model_name);
  const TakeResult read =
      read_take(std::filesystem::path(arguments.positionals.front()), read_options(arguments));
  const std::string text = name_map_text(model.layout, read.take);
  write_output(output.empty() ? "-" : output, text, arguments.flag("force"));
  return 0;
}

int run_models(const Arguments& arguments) {
  const std::string exported = arguments.text("export"), mapped = arguments.text("map");
  if (!exported.empty() && !mapped.empty())
    throw Error(ErrorKind::usage, "models: --export and --map cannot be combined");
  if (mapped.empty() && !arguments.positionals.empty())
    throw Error(ErrorKind::usage, "models: TAKE needs --map MODEL (see kinemend models -h)");
  if (!exported.empty()) return export_model(exported, arguments);
  if (!mapped.empty()) return write_map(mapped, arguments);
  return list_models(arguments.flag("json"));
}

std::vector<Flag> models_flags() {
  Flag exported =
      text_flag("export", "METHOD", "Work", "write the model that ships for METHOD to --output");
  Flag map =
      file_flag("map", "MODEL", "Work", "print a map from the parts of MODEL to names in TAKE",
                "MODEL is a file, or the method of a model that ships. Names that are not "
                "found are left empty. Complete them and use the map with clean --map.");
  std::vector<Flag> list = {output_flag("where to write the model or the map"), force_flag(),
                            json_flag("print the list as JSON instead of text"), exported, map};
  append(list, reading_flags());
  return list;
}

}  // namespace

Command models_command() {
  Command command;
  command.name = "models";
  command.summary = "list the learned models that ship; map a model to a take";
  command.description =
      "Lists the models that are part of the program, each with its training data, licence, "
      "training "
      "command and checksum. kinemend info prints the same about a model file.";
  command.positionals = {{"TAKE", "take for --map; - is standard input", 0, 1, {}}};
  command.flags = models_flags();
  command.examples = {
      {"kinemend models", "list the models"},
      {"kinemend models --export wiener -o wiener.kmodel", "save a model as a file"},
      {"kinemend models --map walk.kmodel take.bvh -o names.csv",
       "write a map to complete by hand"}};
  command.run = run_models;
  return command;
}

}  // namespace kinemend::cli
