#include "view_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
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

/// Without flags that begin so, and what they say.
std::vector<std::string> without(std::vector<std::string> words,
                                 std::initializer_list<std::string_view> flags) {
  std::erase_if(words, [&](const std::string& word) {
    return std::any_of(flags.begin(), flags.end(),
                       [&](std::string_view flag) { return word.starts_with(flag); });
  });
  return words;
}

std::string tab_of(const Json& asked) {
  constexpr std::size_t longest = 64;
  return text_in(asked, "tab").value_or("").substr(0, longest);
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
  for (const FillMethod& method : fill_methods()) {
    if (method.learned) continue;  // the page asks for no model
    list.push_back({{"name", method.name},
                    {"summary", method.summary},
                    {"joints", method.joints},
                    {"markers", method.markers}});
  }
  return list;
}

Json session_json(const ViewFiles& files) {
  return {{"input", files.input},
          {"other", files.other},
          {"kind", files.of_joints ? "joints" : "markers"},
          {"cleaned", files.cleaned},
          {"filled", files.filled},
          {"contacts", files.contacts},
          {"plan", files.plan},
          {"gaps", files.gaps},
          {"with_gaps", files.with_gaps},
          {"methods", methods_json()},
          {"fill_methods", fill_methods_json()}};
}

// Of one axis, frame by frame; null where the sample stays missing.
Json values_json(const std::vector<std::optional<Vec3>>& values, std::size_t axis) {
  // Curves are drawn, not measured.
  constexpr double finest = 1e-5;
  Json list = Json::array();
  for (const std::optional<Vec3>& value : values) {
    if (!value) {
      list.push_back(nullptr);
      continue;
    }
    const std::array<double, 3> at = {value->x, value->y, value->z};
    list.push_back(std::round(at[axis] / finest) * finest);
  }
  return list;
}

Json json_of(const GapCurves& curves) {
  Json list = Json::array();
  for (const GapCurve& curve : curves.curves) {
    const GapPreview& preview = curve.preview;
    Json values = Json::array();
    for (std::size_t axis = 0; axis < curves.axes.size(); ++axis)
      values.push_back(values_json(curve.values, axis));
    Json entry = {{"method", preview.method},  {"filled", preview.filled},
                  {"reason", preview.reason},  {"distance", nullptr},
                  {"expected_error", nullptr}, {"values", std::move(values)}};
    if (preview.distance) entry["distance"] = *preview.distance;
    if (preview.filled && curve.expected_error > 0) entry["expected_error"] = curve.expected_error;
    list.push_back(std::move(entry));
  }
  return {{"first", curves.first_frame},
          {"last", curves.last_frame},
          {"axes", curves.axes},
          {"curves", std::move(list)}};
}

constexpr const char* html = "text/html; charset=utf-8";
constexpr const char* plain = "text/plain; charset=utf-8";

}  // namespace

ViewReply ViewSession::answer(std::string_view method, std::string_view action,
                              const std::string& body) {
  constexpr int bad_request = 400, not_found = 404, gone = 409, internal = 500;
  try {
    if (method == "GET" && action.empty()) return first_page();
    if (method != "POST" || (!files_.other.empty() && action != "run" && action != "leave"))
      return failure(not_found, "there is nothing here");
    const Json asked = Json::parse(body);
    if (!asked.is_object()) return failure(bad_request, "expected an object");
    ViewReply reply = act(action, asked);
    return reply.body.empty() && reply.type.empty() ? failure(not_found, "there is nothing here")
                                                    : reply;
  } catch (const Json::exception&) {
    return failure(bad_request, "this is no request of the page");
  } catch (const Error& error) {
    return failure(std::string_view(error.what()) == overtaken ? gone : bad_request, error.what());
  } catch (const std::bad_alloc&) {
    return failure(internal, "out of memory");
  } catch (const std::exception& error) {
    return failure(internal, error.what());
  }
}

ViewReply ViewSession::act(std::string_view action, const Json& asked) {
  const std::string tab = tab_of(asked);
  if (action == "run") return run(asked, turns_.begin(tab, ViewTurn::run));
  if (action == "curves") return curves(asked, turns_.begin(tab, ViewTurn::curves));
  if (action == "save") return save(asked);
  if (action == "contacts") return contacts();
  if (action == "gaps") return gaps();
  if (action == "progress") return progress();
  if (action != "leave") return {404, "", ""};
  turns_.leave(tab);
  return {200, "application/json", json_text(Json::object())};
}

ViewReply ViewSession::first_page() const {
  const std::string name = std::filesystem::path(files_.input).filename().string();
  const std::array<std::pair<std::string, std::string>, 1> parts = {
      {{"view", json_text(session_json(files_))}}};
  return {200, html, served_page(name + ": kinemend view", "reading " + name, parts)};
}

void ViewSession::tell(const Turn& turn, std::string_view stage, double done) {
  turn.check();
  const std::lock_guard lock(telling_);
  stage_ = stage;
  done_ = done;
}

ViewReply ViewSession::progress() {
  const std::lock_guard lock(telling_);
  return {200, "application/json", json_text({{"stage", stage_}, {"done", done_}})};
}

std::vector<std::string> ViewSession::words_of(const Json& asked) const {
  const bool fills = is_fill(asked);
  std::vector<std::string> words = {fills ? "fill" : "clean", files_.input};
  words.insert(words.end(), files_.reading.begin(), files_.reading.end());
  if (files_.with_gaps || text_in(asked, "gaps")) words.push_back("--gaps=" + files_.gaps);
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

ViewReply ViewSession::run(const Json& asked, const Turn& turn) {
  tell(turn, "waiting", 0);
  const std::lock_guard lock(work_);
  tell(turn, "reading", 0);
  if (!files_.other.empty()) return {200, html, comparison()};
  return {200, html, is_fill(asked) ? fill_page(asked, turn) : clean_page(asked, turn)};
}

std::string ViewSession::comparison() const {
  std::vector<std::string> words = {"compare", files_.input, files_.other};
  words.insert(words.end(), files_.reading.begin(), files_.reading.end());
  return comparison_page(parsed(words), true);
}

std::string ViewSession::clean_page(const Json& asked, const Turn& turn) {
  const std::vector<std::string> words = words_of(asked);
  const auto gaps = text_in(asked, "gaps");
  CleanPlan plan = make_clean_plan(
      parsed(gaps ? without(words, {"--contacts=", "--gaps="}) : without(words, {"--contacts="})));
  if (gaps) plan.gaps.emplace(*gaps, "gaps");
  if (const auto text = text_in(asked, "contacts")) {
    if (!plan.settings.feet) plan.settings.feet.emplace();
    plan.contacts.emplace(*text, "contacts");
  }
  plan.dry_run = plan.quiet = true;
  plan.page.emplace();
  plan.page->command = "clean";
  plan.page->command_line = line_of(words);
  plan.page->is_served = true;
  plan.page->check = [&] { tell(turn, "drawing", 0); };
  Outcome outcome = try_take(plan.jobs.front(), plan,
                             [&](std::string_view stage, double done) { tell(turn, stage, done); });
  turn.check();
  if (outcome.code != 0) throw Error(ErrorKind::usage, outcome.error);
  return std::move(outcome.page);
}

FillRun ViewSession::fill_run(const Json& asked) const {
  const auto plan = text_in(asked, "plan"), gaps = text_in(asked, "gaps");
  std::vector<std::string> words = without(words_of(asked), {"--plan="});
  if (gaps) words = without(std::move(words), {"--gaps="});
  words.emplace_back("--dry-run");
  FillRun run = fill_run_of(parsed(words));
  if (plan) run.plan.emplace(*plan, "plan");
  if (gaps) run.gaps.emplace(*gaps, "gaps");
  return run;
}

std::string ViewSession::fill_page(const Json& asked, const Turn& turn) {
  FillRun run = fill_run(asked);
  run.plan_out_path = "plan.json";
  run.preview = asked.value("preview", false);
  run.reading.progress = [&](double done) { tell(turn, "reading", done); };
  const FilledTake filled = fill_take(run, true, [&] { tell(turn, "filling", 0); });
  PageSettings settings;
  settings.command = "fill";
  settings.command_line = line_of(words_of(asked));
  settings.is_served = true;
  settings.parts = {{"plan", filled.plan_text}};
  settings.check = [&] { tell(turn, "drawing", 0); };
  return page_of(filled.report, filled.before, &filled.after, settings);
}

ViewReply ViewSession::curves(const Json& asked, const Turn& turn) {
  const std::lock_guard lock(work_);
  turn.check();
  FillRun run = fill_run(asked);
  run.reading.progress = [&](double) { turn.check(); };
  const GapCurves found =
      gap_curves(run, asked.at("row").get<std::size_t>(), [&] { tell(turn, "filling", 0); });
  return {200, "application/json", json_of(found).dump()};
}

bool ViewSession::may_replace(const std::string& path) const {
  return files_.force || written_.count(path) > 0;
}

void ViewSession::write_side(const std::string& path, std::string_view bytes, Json& written) {
  write_output(path, bytes, may_replace(path));
  written_.insert(path);
  written.push_back(path);
}

ViewReply ViewSession::save(const Json& asked) {
  const std::lock_guard lock(work_);
  Json written = Json::array();
  std::vector<std::string> words = words_of(asked);
  const std::string line = line_of(words);
  const bool fills = is_fill(asked);
  const std::string output = fills ? files_.filled : files_.cleaned;
  const auto gaps = text_in(asked, "gaps"), plan = text_in(asked, fills ? "plan" : "contacts");
  const std::string side = fills ? files_.plan : files_.contacts;
  // All of them before any is made.
  check_free(output, may_replace(output));
  if (plan) check_free(side, may_replace(side));
  if (gaps) check_free(files_.gaps, may_replace(files_.gaps));
  if (gaps) write_side(files_.gaps, *gaps, written);
  if (plan && !fills) write_side(side, *plan, written);
  if (plan && fills) {
    FillRun run = fill_run(asked);
    run.plan_out_path = side;
    write_side(side, fill_take(run, false).plan_text, written);
  }
  const bool force = may_replace(output);
  if (force) words.emplace_back("--force");
  const Arguments arguments = parsed(words);
  if (fills) {
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
    return {200, plain, read_file(files_.contacts)};
  TakeResult read = read_take(std::filesystem::path(files_.input), read_options(parsed(words)));
  Clip* clip = std::get_if<Clip>(&read.take);
  if (clip == nullptr) throw Error(ErrorKind::usage, "contacts are of takes of joints");
  Clip copy = *clip;
  const FeetReport report = clean_feet(copy);
  return {200, plain, contacts_text(*clip, report)};
}

ViewReply ViewSession::gaps() {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(files_.gaps, ignored)) return {200, plain, ""};
  return {200, plain, read_file(files_.gaps)};
}

}  // namespace kinemend::cli
