// Converts requests to command lines, runs them in turn, and answers with pages, curves, progress
// or saved files.
#include "view_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <variant>

#include "clean_file.hpp"
#include "clean_flags.hpp"
#include "clean_plan.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "config.hpp"
#include "fill_take.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/fill.hpp"
#include "method_options.hpp"
#include "page_report.hpp"
#include "run_files.hpp"
#include "takes.hpp"
#include "view_controls.hpp"

namespace kinemend::cli {

namespace {

/// "--cutoff-hz=6", "--no-root-position".
std::string word_of(const AskedFlag& flag) {
  if (const bool* is_on = std::get_if<bool>(&flag.value))
    return (*is_on ? "--" : "--no-") + dashed(flag.name);
  return fmt::format("--{}={}", dashed(flag.name), std::get<std::string>(flag.value));
}

Arguments parsed(const std::vector<std::string>& words) {
  Arguments arguments = parse_command_line(words).arguments;
  arguments.words = words;
  return arguments;
}

ViewReply failure(int status, std::string_view words) {
  return {status, "application/json", json_text({{"error", words}})};
}

/// Removes the flags that begin so, with their values.
std::vector<std::string> without(std::vector<std::string> words,
                                 std::initializer_list<std::string_view> flags) {
  std::erase_if(words, [&](const std::string& word) {
    return std::any_of(flags.begin(), flags.end(),
                       [&](std::string_view flag) { return word.starts_with(flag); });
  });
  return words;
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
          {"default_method", default_method},
          {"source", files.source},
          {"controls", view_controls()}};
}

// The values of one axis by frame; null where the sample stays missing.
Json values_json(const std::vector<std::optional<Vec3>>& values, std::size_t axis) {
  // Curves are only drawn, so fewer digits are enough.
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

constexpr const char* parts_of_page = "application/octet-stream";  // web/src/served.ts
constexpr const char* html = "text/html; charset=utf-8";
constexpr const char* plain = "text/plain; charset=utf-8";

/// walk.bvh to walk.contacts for the ending "contacts".
std::string beside(const std::string& input, std::string_view ending) {
  std::filesystem::path path(input);
  path.replace_filename(fmt::format("{}.{}", path.stem().string(), ending));
  return path.string();
}

}  // namespace

ViewFiles view_files_beside(const std::string& input, const std::string& from) {
  ViewFiles files;
  files.input = input;
  files.cleaned = output_beside(input, "clean", from);
  files.filled = output_beside(input, "filled", from);
  files.contacts = beside(input, "contacts");
  files.plan = beside(input, "plan.csv");
  files.gaps = beside(input, "gaps.csv");
  return files;
}

ViewReply ViewSession::answer(std::string_view method, std::string_view action,
                              const std::string& body) {
  constexpr int bad_request = 400, not_found = 404, gone = 409, internal = 500;
  try {
    if (method == "GET" && action.empty()) return first_page();
    if (method != "POST" || (!files_.other.empty() && action != "run" && action != "leave"))
      return failure(not_found, "this page does not exist");
    ViewReply reply = act(action, parse_view_asked(body));
    return reply.body.empty() && reply.type.empty() ? failure(not_found, "this page does not exist")
                                                    : reply;
  } catch (const Error& error) {
    return failure(std::string_view(error.what()) == overtaken ? gone : bad_request, error.what());
  } catch (const std::bad_alloc&) {
    return failure(internal, "out of memory");
  } catch (const std::exception& error) {
    return failure(internal, error.what());
  }
}

ViewReply ViewSession::act(std::string_view action, const ViewAsked& asked) {
  if (action == "run") return run(asked, turns_.begin(asked.tab, ViewTurn::run));
  if (action == "curves") return curves(asked, turns_.begin(asked.tab, ViewTurn::curves));
  if (action == "save") return save(asked);
  if (action == "contacts") return contacts();
  if (action == "gaps") return gaps();
  if (action == "progress") return progress();
  if (action != "leave") return {404, "", ""};
  turns_.leave(asked.tab);
  return {200, "application/json", json_text(Json::object())};
}

std::string ViewSession::session() const { return json_text(session_json(files_)); }

ViewReply ViewSession::first_page() const {
  const std::string name = std::filesystem::path(files_.input).filename().string();
  const std::array<std::pair<std::string, std::string>, 1> parts = {{{"view", session()}}};
  return {200, html, served_page(name + ": kinemend view", "reading " + name, parts)};
}

void ViewSession::tell(const Turn& turn, std::string_view stage, double done) {
  turn.check();
  const std::lock_guard lock(telling_);
  stage_ = stage;
  done_ = done;
  if (told_) told_(stage, done);
}

ViewReply ViewSession::progress() {
  const std::lock_guard lock(telling_);
  return {200, "application/json", json_text({{"stage", stage_}, {"done", done_}})};
}

std::string ViewSession::output_of(const ViewAsked& asked) const {
  const std::string& standard = asked.is_fill ? files_.filled : files_.cleaned;
  if (asked.file.empty()) return standard;
  const bool is_plain =
      asked.file != "." && asked.file != ".." &&
      std::none_of(asked.file.begin(), asked.file.end(), [](char c) {
        return c == '/' || c == '\\' || static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
      });
  if (!is_plain)
    throw Error(ErrorKind::usage,
                fmt::format("{}: expected a file name without a folder", printable(asked.file)));
  std::filesystem::path output = standard;
  output.replace_filename(asked.file);
  // A name that begins with a dash would be read as an option.
  const std::string text = output.string();
  return text.starts_with('-') ? "./" + text : text;
}

std::vector<std::string> ViewSession::words_of(const ViewAsked& asked) const {
  std::vector<std::string> words = {asked.is_fill ? "fill" : "clean", files_.input};
  words.insert(words.end(), files_.reading.begin(), files_.reading.end());
  if (files_.with_gaps || asked.gaps) words.push_back("--gaps=" + files_.gaps);
  for (const AskedFlag& flag : asked.flags) {
    check_view_flag(asked, flag.name);
    words.push_back(word_of(flag));
  }
  words.push_back("--output=" + output_of(asked));
  const bool has_source = std::any_of(asked.flags.begin(), asked.flags.end(),
                                      [](const AskedFlag& flag) { return flag.name == "source"; });
  if (!asked.is_fill && !has_source && files_.source != to_string(Source::unknown))
    words.push_back("--source=" + files_.source);
  if (!asked.is_fill && asked.contacts) words.push_back("--contacts=" + files_.contacts);
  if (asked.is_fill && asked.plan) words.push_back("--plan=" + files_.plan);
  return words;
}

ViewReply ViewSession::run(const ViewAsked& asked, const Turn& turn) {
  tell(turn, "waiting", 0);
  const std::lock_guard lock(work_);
  tell(turn, "reading", 0);
  if (!files_.other.empty()) return {200, parts_of_page, comparison()};
  return {200, parts_of_page, asked.is_fill ? fill_page(asked, turn) : clean_page(asked, turn)};
}

std::string ViewSession::comparison() const {
  std::vector<std::string> words = {"compare", files_.input, files_.other};
  words.insert(words.end(), files_.reading.begin(), files_.reading.end());
  return comparison_page(parsed(words), true);
}

std::string ViewSession::clean_page(const ViewAsked& asked, const Turn& turn) {
  const std::vector<std::string> words = words_of(asked);
  const auto& gaps = asked.gaps;
  CleanPlan plan = make_clean_plan(
      parsed(gaps ? without(words, {"--contacts=", "--gaps="}) : without(words, {"--contacts="})));
  if (gaps) plan.gaps.emplace(*gaps, "gaps");
  if (asked.contacts) {
    if (!plan.settings.feet) plan.settings.feet.emplace();
    plan.contacts.emplace(*asked.contacts, "contacts");
  }
  plan.dry_run = plan.quiet = true;
  plan.page.emplace();
  plan.page->command = "clean";
  plan.page->command_line = shell_line(words);
  plan.page->is_served = true;
  plan.page->check = [&] { tell(turn, "drawing", 0); };
  plan.on_read = [&](const Take& take) {
    plan.page->parts.emplace_back("why_not", json_text(why_not_methods(take)));
  };
  Outcome outcome =
      clean_file(plan.takes.jobs.front(), plan,
                 [&](std::string_view stage, double done) { tell(turn, stage, done); });
  turn.check();
  if (outcome.code != 0) throw Error(ErrorKind::usage, outcome.error);
  return std::move(outcome.page);
}

FillRun ViewSession::fill_run(const ViewAsked& asked) const {
  std::vector<std::string> words = without(words_of(asked), {"--plan="});
  if (asked.gaps) words = without(std::move(words), {"--gaps="});
  words.emplace_back("--dry-run");
  FillRun run = fill_run_of(parsed(words));
  if (asked.plan) run.plan.emplace(*asked.plan, "plan");
  if (asked.gaps) run.gaps.emplace(*asked.gaps, "gaps");
  return run;
}

std::string ViewSession::fill_page(const ViewAsked& asked, const Turn& turn) {
  FillRun run = fill_run(asked);
  run.plan_out_path = "plan.json";
  run.preview = asked.preview;
  run.reading.progress = [&](double done) { tell(turn, "reading", done); };
  const FilledTake filled =
      fill_take(run, run.takes.jobs.front(), true, [&] { tell(turn, "filling", 0); });
  PageSettings settings;
  settings.command = "fill";
  settings.command_line = shell_line(words_of(asked));
  settings.is_served = true;
  settings.parts = {{"plan", filled.plan_text}};
  settings.check = [&] { tell(turn, "drawing", 0); };
  return report_page(filled.report, filled.before, &filled.after, settings);
}

ViewReply ViewSession::curves(const ViewAsked& asked, const Turn& turn) {
  const std::lock_guard lock(work_);
  turn.check();
  FillRun run = fill_run(asked);
  run.reading.progress = [&](double) { turn.check(); };
  const GapCurves found = gap_curves(run, asked.row, [&] { tell(turn, "filling", 0); });
  return {200, "application/json", json_of(found).dump()};
}

bool ViewSession::may_replace(const std::string& path, const ViewAsked& asked) const {
  return files_.force || asked.replace || written_.count(path) > 0;
}

void ViewSession::write_side(const std::string& path, std::string_view bytes,
                             const ViewAsked& asked, Json& written) {
  write_output(path, bytes, may_replace(path, asked));
  written_.insert(path);
  written.push_back(path);
}

ViewReply ViewSession::save(const ViewAsked& asked) {
  const std::lock_guard lock(work_);
  Json written = Json::array();
  std::vector<std::string> words = words_of(asked);
  const std::string line = shell_line(words);
  const bool fills = asked.is_fill;
  const std::string output = output_of(asked);
  const std::optional<std::string>& plan = fills ? asked.plan : asked.contacts;
  const std::string side = fills ? files_.plan : files_.contacts;
  // An input is never replaced, whatever the user confirms.
  RunFiles().reads("TAKE", inputs()).writes("--output", output).check();
  // All files are checked before the first is written.
  Json existing = Json::array();
  const auto look_at = [&](const std::string& path) {
    std::error_code ignored;
    if (!may_replace(path, asked) && std::filesystem::exists(path, ignored))
      existing.push_back(path);
  };
  if (asked.gaps) look_at(files_.gaps);
  if (plan) look_at(side);
  look_at(output);
  if (!existing.empty()) {
    constexpr int conflict = 409;
    return {conflict, "application/json",
            json_text({{"error", existing.front().get<std::string>() + ": exists already"},
                       {"existing", existing}})};
  }
  if (asked.gaps) write_side(files_.gaps, *asked.gaps, asked, written);
  if (plan && !fills) write_side(side, *plan, asked, written);
  if (plan && fills) {
    FillRun run = fill_run(asked);
    run.plan_out_path = side;
    write_side(side, fill_take(run, run.takes.jobs.front(), false).plan_text, asked, written);
  }
  if (may_replace(output, asked)) words.emplace_back("--force");
  const Arguments arguments = parsed(words);
  if (fills) {
    const FillRun run = fill_run_of(arguments);
    const TakeJob& job = run.takes.jobs.front();
    if (!run.dry_run) check_result(job, run.takes, run.force);
    const FilledTake filled = fill_take(run, job, false);
    write_take_output(job.output, filled.after, format_for(job.output, filled.after.source),
                      run.force);
  } else {
    CleanPlan plan_of_take = make_clean_plan(arguments);
    const Outcome outcome = clean_file(plan_of_take.takes.jobs.front(), plan_of_take);
    if (outcome.code != 0) throw Error(ErrorKind::usage, outcome.error);
  }
  written_.insert(output);
  written.push_back(output);
  return {200, "application/json", json_text({{"written", written}, {"command_line", line}})};
}

std::vector<std::string> ViewSession::inputs() const {
  std::vector<std::string> paths = {files_.input, files_.other, files_.contacts, files_.plan,
                                    files_.gaps};
  constexpr std::string_view skeleton = "--asf=";
  for (const std::string& word : files_.reading) {
    if (word.starts_with(skeleton)) paths.push_back(word.substr(skeleton.size()));
  }
  return paths;
}

ViewReply ViewSession::contacts() {
  const std::lock_guard lock(work_);
  std::vector<std::string> words = {"contacts", files_.input};
  words.insert(words.end(), files_.reading.begin(), files_.reading.end());
  std::error_code ignored;
  if (std::filesystem::is_regular_file(files_.contacts, ignored))
    return {200, plain, read_file(files_.contacts)};
  TakeResult read = read_take(std::filesystem::path(files_.input), read_options(parsed(words)));
  if (!read.take.has_joints())
    throw Error(ErrorKind::usage, "contacts exist only in takes of joints");
  Take copy = read.take;
  const FeetReport report = clean_feet(copy);
  return {200, plain, contacts_text(read.take, report)};
}

ViewReply ViewSession::gaps() {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(files_.gaps, ignored)) return {200, plain, ""};
  return {200, plain, read_file(files_.gaps)};
}

}  // namespace kinemend::cli
