#include "view_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <variant>

#include "clean_flags.hpp"
#include "clean_plan.hpp"
#include "clean_take.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "compare_page.hpp"
#include "fill_take.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/fill.hpp"
#include "method_options.hpp"
#include "page_report.hpp"
#include "takes.hpp"

namespace kinemend::cli {

namespace {

constexpr std::string_view overtaken = "another run was asked for";

/// Flags that the page may set; what reads or writes a file is not among them.
constexpr std::array cleaning_flags = {
    "method",   "strength",      "max_change_deg", "max_change",      "fill",
    "fill_all", "feet",          "fix_swaps",      "peak_loss_limit", "joints",
    "exclude",  "root_position", "range",          "preset"};
constexpr std::array filling_flags = {"method", "names",       "range",
                                      "donor",  "longest_gap", "fill_all"};

const Method* method_of(const Json& flags) {
  const auto named = flags.find("method");
  return method_called(named == flags.end() ? "auto" : named->get<std::string>());
}

bool is_option(const Method* method, std::string_view name) {
  return method != nullptr &&
         std::any_of(method->options.begin(), method->options.end(), [&](const OptionSpec& spec) {
           return spec.name == name && !names_file(spec);
         });
}

void check_flag(bool is_fill, const Json& flags, const std::string& name) {
  const auto among = [&](const auto& list) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  const bool known =
      is_fill ? among(filling_flags) : among(cleaning_flags) || is_option(method_of(flags), name);
  if (!known) throw Error(ErrorKind::usage, fmt::format("view: the page may not set \"{}\"", name));
}

/// "--cutoff-hz=6", "--no-root-position".
std::string word_of(const std::string& name, const Json& value) {
  if (value.is_boolean()) return (value.get<bool>() ? "--" : "--no-") + dashed(name);
  return fmt::format("--{}={}", dashed(name),
                     value.is_string() ? value.get<std::string>() : value.dump());
}

bool is_fill(const Json& asked) { return asked.value("command", "clean") == "fill"; }

std::optional<std::string> text_in(const Json& asked, const char* name) {
  const auto found = asked.find(name);
  if (found == asked.end() || !found->is_string()) return std::nullopt;
  return found->get<std::string>();
}

Arguments parsed(const std::vector<std::string>& words) {
  Arguments arguments = parse_command_line(words).arguments;
  arguments.words = words;
  return arguments;
}

std::string line_of(const std::vector<std::string>& words) {
  Arguments arguments;
  arguments.words = words;
  return command_line_of(arguments);
}

ViewReply failure(int status, std::string_view words) {
  return {status, "application/json", json_text({{"error", words}})};
}

Json methods_json() {
  Json list = Json::array();
  for (const Method& method : methods()) {
    Json entry = {{"name", method.name}, {"summary", method.summary}, {"options", Json::array()}};
    for (const OptionSpec& spec : method.options) {
      if (names_file(spec)) continue;
      Json option = json_of(spec);
      option["kind"] = std::holds_alternative<bool>(spec.default_value)           ? "switch"
                       : std::holds_alternative<std::string>(spec.default_value)  ? "choice"
                       : std::holds_alternative<std::int64_t>(spec.default_value) ? "whole"
                                                                                  : "number";
      entry["options"].push_back(std::move(option));
    }
    list.push_back(std::move(entry));
  }
  return list;
}

Json fill_methods_json() {
  Json list = Json::array();
  for (const FillMethod& method : fill_methods())
    list.push_back({{"name", method.name},
                    {"summary", method.summary},
                    {"joints", method.joints},
                    {"markers", method.markers}});
  return list;
}

}  // namespace

ViewReply ViewSession::answer(std::string_view method, std::string_view action,
                              const std::string& body) {
  constexpr int bad_request = 400, not_found = 404, gone = 409, internal = 500;
  try {
    if (method == "GET" && action.empty()) return page(Json::object(), ++latest_);
    if (method != "POST" || !files_.other.empty())
      return failure(not_found, "there is nothing here");
    const Json asked = Json::parse(body);
    if (!asked.is_object()) return failure(bad_request, "expected an object");
    if (action == "run") return page(asked, ++latest_);
    if (action == "save") return save(asked);
    if (action == "contacts") return contacts();
    return failure(not_found, "there is nothing here");
  } catch (const Json::exception&) {
    return failure(bad_request, "this is no request of the page");
  } catch (const Error& error) {
    if (error.what() == overtaken) return failure(gone, overtaken);
    return failure(bad_request, error.what());
  } catch (const std::bad_alloc&) {
    return failure(internal, "out of memory");
  } catch (const std::exception& error) {
    return failure(internal, error.what());
  }
}

std::vector<std::string> ViewSession::words_of(const Json& asked) const {
  const bool fills = is_fill(asked);
  std::vector<std::string> words = {fills ? "fill" : "clean", files_.input};
  words.insert(words.end(), files_.reading.begin(), files_.reading.end());
  if (!files_.gaps.empty()) words.push_back("--gaps=" + files_.gaps);
  const Json flags = asked.value("flags", Json::object());
  for (const auto& [name, value] : flags.items()) {
    check_flag(fills, flags, name);
    words.push_back(word_of(name, value));
  }
  words.push_back("--output=" + (fills ? files_.filled : files_.cleaned));
  if (!fills && text_in(asked, "contacts")) words.push_back("--contacts=" + files_.contacts);
  if (fills && text_in(asked, "plan")) words.push_back("--plan=" + files_.plan);
  return words;
}

ViewReply ViewSession::page(const Json& asked, std::uint64_t turn) {
  constexpr const char* html = "text/html; charset=utf-8";
  const std::lock_guard lock(work_);
  if (turn != latest_) throw Error(ErrorKind::usage, std::string(overtaken));
  if (!files_.other.empty()) return {200, html, comparison()};
  return {200, html, is_fill(asked) ? fill_page(asked) : clean_page(asked, turn)};
}

std::string ViewSession::comparison() const {
  std::vector<std::string> words = {"compare", files_.input, files_.other};
  words.insert(words.end(), files_.reading.begin(), files_.reading.end());
  return comparison_page(parsed(words), true);
}

std::string ViewSession::clean_page(const Json& asked, std::uint64_t turn) {
  const std::vector<std::string> words = words_of(asked);
  std::vector<std::string> without_side = words;
  std::erase_if(without_side,
                [](const std::string& word) { return word.starts_with("--contacts="); });
  CleanPlan plan = make_clean_plan(parsed(without_side));
  if (const auto text = text_in(asked, "contacts")) {
    if (!plan.settings.feet) plan.settings.feet.emplace();
    plan.contacts.emplace(*text, "contacts");
  }
  plan.dry_run = plan.quiet = true;
  plan.report_path = "page";
  plan.page.emplace();
  plan.page->command = "clean";
  plan.page->command_line = line_of(words);
  plan.page->is_served = true;
  plan.page->parts = {{"view", session_json()}};
  Outcome outcome = try_take(plan.jobs.front(), plan, [&](std::string_view, double) {
    if (turn != latest_) throw Error(ErrorKind::quality_limit, std::string(overtaken));
  });
  if (turn != latest_) throw Error(ErrorKind::usage, std::string(overtaken));
  if (outcome.code != 0) throw Error(ErrorKind::usage, outcome.error);
  return std::move(outcome.report);
}

std::string ViewSession::fill_page(const Json& asked) {
  const std::vector<std::string> words = words_of(asked);
  std::vector<std::string> own = words;
  std::erase_if(own, [](const std::string& word) { return word.starts_with("--plan="); });
  own.emplace_back("--dry-run");
  FillRun run = fill_run_of(parsed(own));
  if (const auto text = text_in(asked, "plan")) run.plan.emplace(*text, "plan");
  run.plan_out_path = "plan.json";
  run.preview = asked.value("preview", false);
  const FilledTake filled = fill_take(run, true);
  PageSettings settings;
  settings.command = "fill";
  settings.command_line = line_of(words);
  settings.is_served = true;
  settings.parts = {{"view", session_json()}, {"plan", filled.plan_text}};
  return page_of(filled.report, filled.before, &filled.after, settings);
}

std::string ViewSession::session_json() const {
  std::error_code ignored;
  Json json = {{"input", files_.input},
               {"cleaned", files_.cleaned},
               {"filled", files_.filled},
               {"contacts", files_.contacts},
               {"plan", files_.plan},
               {"methods", methods_json()},
               {"fill_methods", fill_methods_json()}};
  return json_text(json);
}

void ViewSession::write_side(const std::string& path, std::string_view bytes, Json& written) {
  write_output(path, bytes, files_.force || written_.count(path) > 0);
  written_.insert(path);
  written.push_back(path);
}

ViewReply ViewSession::save(const Json& asked) {
  const std::lock_guard lock(work_);
  Json written = Json::array();
  std::vector<std::string> words = words_of(asked);
  const std::string line = line_of(words);
  const std::string output = is_fill(asked) ? files_.filled : files_.cleaned;
  const bool force = files_.force || written_.count(output) > 0;
  // Before any side file is made.
  check_free(output, force);
  const auto contacts = text_in(asked, "contacts");
  const auto plan = text_in(asked, "plan");
  if (!is_fill(asked) && contacts) write_side(files_.contacts, *contacts, written);
  if (is_fill(asked) && plan) {
    std::vector<std::string> own = words;
    std::erase_if(own, [](const std::string& word) { return word.starts_with("--plan="); });
    own.emplace_back("--dry-run");
    FillRun run = fill_run_of(parsed(own));
    run.plan.emplace(*plan, "plan");
    run.plan_out_path = files_.plan;
    write_side(files_.plan, fill_take(run, false).plan_text, written);
  }
  if (force) words.emplace_back("--force");
  const Arguments arguments = parsed(words);
  if (is_fill(asked)) {
    const FillRun run = fill_run_of(arguments);
    const FilledTake filled = fill_take(run, false);
    write_take_output(run.output, filled.after, format_for(run.output, source_of(filled.after)),
                      run.force);
  } else {
    CleanPlan plan_of_take = make_clean_plan(arguments);
    const Outcome outcome = try_take(plan_of_take.jobs.front(), plan_of_take);
    if (outcome.code != 0) throw Error(ErrorKind::usage, outcome.error);
  }
  written_.insert(output);
  written.push_back(output);
  return {200, "application/json", json_text({{"written", written}, {"command_line", line}})};
}

ViewReply ViewSession::contacts() {
  const std::lock_guard lock(work_);
  std::vector<std::string> words = {"contacts", files_.input};
  words.insert(words.end(), files_.reading.begin(), files_.reading.end());
  std::error_code ignored;
  if (std::filesystem::is_regular_file(files_.contacts, ignored))
    return {200, "text/plain; charset=utf-8", read_file(files_.contacts)};
  TakeResult read = read_take(std::filesystem::path(files_.input), read_options(parsed(words)));
  Clip* clip = std::get_if<Clip>(&read.take);
  if (clip == nullptr) throw Error(ErrorKind::usage, "contacts are of takes of joints");
  Clip copy = *clip;
  const FeetReport report = clean_feet(copy);
  return {200, "text/plain; charset=utf-8", contacts_text(*clip, report)};
}

}  // namespace kinemend::cli
