// kinemend batch: cleans whole trees of takes; it can be stopped and resumed at any moment.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "batch_list.hpp"
#include "batch_record.hpp"
#include "clean_file.hpp"
#include "clean_flags.hpp"
#include "clean_plan.hpp"
#include "commands.hpp"
#include "config.hpp"
#include "json.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/extend/pages.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/io.hpp"
#include "kinemend/methods.hpp"
#include "method_options.hpp"
#include "page_report.hpp"
#include "run_files.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

/// The settings of a batch.
struct Batch {
  CleanPlan plan;
  std::string folder;  ///< for the results
  std::string index;   ///< page of --report; empty: no page
  std::string options_hash;
  Shard shard;
  bool quiet = false;
  bool verbose = false;  ///< prints every error and warning
};

/// Path of the page of a take, relative to the folder of the index.
fs::path page_name(const Batch& batch, const BatchItem& item) {
  return fs::path(fs::path(batch.index).stem().string() + ".takes") /
         extended_name(item.name, ".html");
}
fs::path page_path(const Batch& batch, const BatchItem& item) {
  return fs::path(batch.index).parent_path() / page_name(batch, item);
}
/// Path of a picture of a few poses, for the index.
fs::path picture_path(const Batch& batch, const BatchItem& item) {
  return page_path(batch, item).replace_extension(".svg");
}

/// The result of one file.
struct Done {
  BatchRow row;
  int code = 0;
  bool is_new = false;   ///< false if an earlier run had done it
  bool is_begun = true;  ///< false if it was refused before any file was written
  std::string error;
  std::vector<std::string> warnings;
};

/// Every setting that a result depends on, as one text: neither the output folder nor the number of
/// threads.
std::string options_text(const Arguments& arguments) {
  std::string text = settings_text(*arguments.command, merged_settings(arguments), "");
  if (!arguments.flag("clean")) text += "clean: false\n";
  if (arguments.given("to")) text += fmt::format("to: {}\n", arguments.text("to"));
  for (const Flag& flag : cleaning_flags()) {
    const std::string& name = flag.spec.name;
    if (name == "config" || name == "preset" || flag.configurable) continue;
    if (const auto value = arguments.values.find(name); value != arguments.values.end())
      text += fmt::format("{}: {}\n", name, json_of(value->second).dump());
    if (const auto list = arguments.lists.find(name); list != arguments.lists.end())
      text += fmt::format("{}: {}\n", name, fmt::join(list->second, ","));
  }
  return text;
}

/// The files that the method reads besides the take, as one text of hashes, including a shipped
/// model.
std::string learned_text(const CleanPlan& plan) {
  std::string text;
  for (const std::string& path : option_files(find_method(plan.method), plan.options))
    text += content_hash(read_file(path)) + "\n";
  if (plan.gaps) text += content_hash(plan.gaps->first) + "\n";
  if (plan.settings.feet) {
    for (const auto& [known, name] : plan.settings.feet->names)
      text += fmt::format("{},{}\n", known, name);
  }
  for (const ShippedModel& model : shipped_models()) {
    const bool holds_feet = plan.settings.feet && model.method == "contacts";
    if (model.method == plan.method || holds_feet) text += model_checksum(model.bytes) + "\n";
  }
  return text;
}

/// The ASF skeletons beside an AMC take, any of which it may need.
std::vector<std::string> skeletons_of(const BatchItem& item) {
  std::vector<std::string> skeletons;
  const Format* format = format_of_path(item.input);
  if (format == nullptr || format->name != "amc") return skeletons;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(fs::path(item.input).parent_path(), error)) {
    const Format* known = format_of_path(entry.path());
    if (known != nullptr && known->name == "asf") skeletons.push_back(entry.path().string());
  }
  std::sort(skeletons.begin(), skeletons.end());
  return skeletons;
}

/// Hash of the bytes that a result depends on: the take and its skeletons.
std::string input_hash(const BatchItem& item) {
  std::string hash = content_hash(read_file(item.input));
  const std::vector<std::string> skeletons = skeletons_of(item);
  if (skeletons.empty()) return hash;
  for (const std::string& skeleton : skeletons) hash += content_hash(read_file(skeleton));
  return content_hash(hash);
}

bool is_done(const BatchRecord& record, const BatchKey& key, const std::string& output) {
  std::error_code ignored;
  return record.key == key && !record.output.empty() && fs::is_regular_file(output, ignored) &&
         content_hash(read_file(output)) == record.output;
}

std::string absolute_path(const std::string& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  return (error ? fs::path(path) : absolute.lexically_normal()).string();
}

/// A result that an earlier run finished or began for the same input may be overwritten; a file
/// from elsewhere, or for another input, may not. The result is looked for before its record,
/// because the record is written first.
void check_is_ours(const BatchItem& item, const std::string& output, const BatchKey& key,
                   const Batch& batch) {
  std::error_code ignored;
  if (batch.plan.force || !fs::exists(output, ignored)) return;
  const auto record = read_record(batch.folder, item.name);
  if (!record) return check_free(output, false);
  // The take may have moved since then.
  const bool is_same = record->key.input == key.input || record->input.empty() ||
                       is_same_file(record->input, item.input) ||
                       record->input == absolute_path(item.input);
  if (is_same) return;
  throw Error(
      ErrorKind::cannot_write,
      fmt::format("{}: is the result of {}, not of {}; use another --output-dir, or --force "
                  "to overwrite it",
                  output, printable_name(record->input), printable_name(item.input)));
}

/// Checks in the same way the skeletons of a take, one of which is written beside its result.
void check_skeletons_are_ours(const BatchItem& item, const Batch& batch) {
  for (const std::string& skeleton : skeletons_of(item)) {
    const fs::path name = fs::path(item.name).replace_filename(fs::path(skeleton).filename());
    const fs::path output = fs::path(batch.folder) / name;
    const std::string bytes = read_file(skeleton);
    std::error_code ignored;
    if (fs::is_regular_file(output, ignored) && read_file(output) == bytes) continue;
    check_is_ours({skeleton, name.generic_string(), true}, output.string(),
                  {content_hash(bytes), "", ""}, batch);
  }
}

Done copy_skeleton(const BatchItem& item, const std::string& output, const Batch& batch) {
  Done done;
  done.row = plain_row(item.name, "copied");
  const std::string bytes = read_file(item.input);
  const BatchKey key{content_hash(bytes), "", std::string(version())};
  // A take processed at the same time may have written it.
  const auto is_there = [&] {
    std::error_code ignored;
    return fs::is_regular_file(output, ignored) && read_file(output) == bytes;
  };
  if (!is_there()) check_is_ours(item, output, key, batch);
  make_folder(fs::path(output).parent_path());
  const TakeLock lock(batch.folder, item.name);
  const bool is_copied = is_there();
  if (is_copied && read_record(batch.folder, item.name)) return done;
  if (!is_copied) check_is_ours(item, output, key, batch);
  write_record(batch.folder, item.name,
               {absolute_path(item.input), key, content_hash(bytes), done.row});
  if (is_copied) return done;
  write_output(output, bytes, true);
  done.is_new = true;
  return done;
}

Done clean_item(const BatchItem& item, const std::string& output, const Batch& batch,
                const BatchKey& key) {
  const Outcome outcome = clean_file({item.input, output, true, item.name}, batch.plan);
  Done done;
  done.is_new = true;
  done.code = outcome.code;
  done.error = outcome.error;
  done.warnings = outcome.warnings;
  done.row = *outcome.row;
  if (!batch.index.empty() && outcome.code == 0) {
    make_folder(page_path(batch, item).parent_path());
    write_file(page_path(batch, item), outcome.page, true);
    write_file(picture_path(batch, item), outcome.picture, true);
  }
  const std::string result = outcome.code == 0 ? content_hash(read_file(output)) : std::string();
  write_record(batch.folder, item.name, {absolute_path(item.input), key, result, done.row});
  return done;
}

/// Path of the result.
std::string result_of(const BatchItem& item, const Batch& batch) {
  std::string output = (fs::path(batch.folder) / item.name).string();
  if (batch.plan.to != nullptr) return output;
  return with_right_ending(output, item.input, batch.plan.reading.format);
}

Done do_item(const BatchItem& item, const Batch& batch) {
  const std::string output = result_of(item, batch);
  if (item.is_copied) return copy_skeleton(item, output, batch);
  const BatchKey key{input_hash(item), batch.options_hash, std::string(version())};
  // A refused take leaves neither a folder nor a record.
  check_is_ours(item, output, key, batch);
  check_skeletons_are_ours(item, batch);
  make_folder(fs::path(output).parent_path());
  const TakeLock lock(batch.folder, item.name);
  const auto record = read_record(batch.folder, item.name);
  // A take processed without --report has no page yet.
  std::error_code ignored;
  const bool has_page = batch.index.empty() || fs::is_regular_file(page_path(batch, item), ignored);
  if (record && has_page && is_done(*record, key, output))
    return {record->row, 0, false, true, {}, {}};
  check_is_ours(item, output, key, batch);
  if (!record) {
    write_record(batch.folder, item.name,
                 {absolute_path(item.input), key, "", plain_row(item.name, "begun")});
  }
  return clean_item(item, output, batch, key);
}

/// Runs `do_item` and returns its errors in the result, so that one file does not stop the others.
Done try_item(const BatchItem& item, const Batch& batch) {
  Done done;
  const Outcome outcome = outcome_of(item.input, false, [&](Outcome&) {
    done = do_item(item, batch);
    if (done.is_new && !item.is_copied) append_row(batch.folder, batch.shard, done.row);
  });
  if (outcome.code == 0) return done;
  return {failed_row(item.name, item.input, outcome.error, outcome.code),
          outcome.code,
          true,
          false,
          outcome.error,
          {}};
}

/// Estimates the amount of work for a take.
double size_of(const BatchItem& item) {
  std::error_code error;
  const auto bytes = fs::file_size(item.input, error);
  return error ? 1.0 : 1.0 + static_cast<double>(bytes);
}

/// Prints errors as they occur, at most ten unless `verbose`.
class Sayer {
 public:
  Sayer(const Batch& batch, ProgressBar& bar) : batch_(batch), bar_(bar) {}

  void say_of(const Done& done) {
    const std::lock_guard lock(mutex_);
    const bool warns = batch_.verbose && !done.warnings.empty();
    const bool fails = !done.error.empty() && (++failed_ <= most || batch_.verbose);
    if (!fails && !warns) return;
    bar_.clear();
    if (fails) say_error(done.error);
    for (const std::string& warning : done.warnings) {
      if (warns) say_warning(warning);
    }
  }

  void finish() const {
    if (failed_ <= most || batch_.verbose) return;
    say_error(
        fmt::format("{} more failed; see the rows in {}", grouped(failed_ - most), batch_.folder));
  }

 private:
  static constexpr std::size_t most = 10;
  const Batch& batch_;
  ProgressBar& bar_;
  std::mutex mutex_;
  std::size_t failed_ = 0;
};

/// Returns exit code 3 if a folder holds no take, which is a mistake of the user. Throws if there
/// is no take at all.
int refuse_empty(const std::vector<std::string>& inputs, const std::vector<BatchItem>& all,
                 const Arguments& arguments) {
  const std::string pattern = arguments.text("files");
  const std::string what =
      pattern.empty() ? "no take" : fmt::format("no take that matches {}", pattern);
  const std::vector<std::string> empty =
      empty_folders(inputs, arguments.text("output_dir"), pattern);
  const bool has_takes =
      std::any_of(all.begin(), all.end(), [](const BatchItem& item) { return !item.is_copied; });
  if (!has_takes) {
    const std::string where = empty.empty() ? "batch" : empty.front();
    throw Error(ErrorKind::unreadable_input, fmt::format("{}: holds {}", where, what));
  }
  for (const std::string& folder : empty) say_error(fmt::format("{}: holds {}", folder, what));
  return empty.empty() ? 0 : static_cast<int>(ErrorKind::unreadable_input);
}

std::vector<std::string> inputs_of(const Arguments& arguments) {
  std::vector<std::string> inputs = arguments.positionals;
  const std::string list = arguments.text("list");
  if (list.empty() && inputs.empty())
    throw Error(ErrorKind::usage, "batch: IN or --list is missing (see kinemend batch -h)");
  if (list.empty()) return inputs;
  const std::vector<std::string> listed = listed_inputs(read_file(list), input_name(list));
  if (listed.empty()) {
    throw Error(ErrorKind::unreadable_input, fmt::format("{}: lists no take", input_name(list)));
  }
  inputs.insert(inputs.end(), listed.begin(), listed.end());
  return inputs;
}

std::vector<Done> do_all(const std::vector<BatchItem>& items, const Batch& batch) {
  std::optional<ThreadLimit> limit;
  if (batch.plan.threads > 0) limit.emplace(static_cast<std::size_t>(batch.plan.threads));
  std::vector<Done> done(items.size());
  std::vector<double> sizes(items.size());
  std::transform(items.begin(), items.end(), sizes.begin(), size_of);
  ProgressBar bar(items.size(), std::accumulate(sizes.begin(), sizes.end(), 0.0));
  Sayer sayer(batch, bar);
  std::atomic<std::size_t> next{0};
  on_every_thread([&] {
    for (std::size_t i = next++; i < items.size(); i = next++) {
      done[i] = try_item(items[i], batch);
      sayer.say_of(done[i]);
      bar.step(sizes[i], done[i].is_new);
    }
  });
  bar.clear();
  sayer.finish();
  return done;
}

// Only the takes that most need review get a picture, so that an index of thousands stays small.
void add_pictures(const Batch& batch, const std::vector<BatchItem>& items,
                  std::vector<BatchPageRow>& rows) {
  constexpr std::size_t most_pictures = 200;
  std::vector<BatchRow> all;
  all.reserve(rows.size());
  for (const BatchPageRow& row : rows) all.push_back(row.row);
  std::set<std::string> shown;
  for (const BatchRow& row : worst_rows(all, most_pictures)) shown.insert(row.name);
  for (std::size_t i = 0; i < all.size() && shown.size() < most_pictures; ++i)
    shown.insert(all[i].name);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::error_code ignored;
    const fs::path picture = picture_path(batch, items[i]);
    if (shown.count(rows[i].row.name) > 0 && fs::is_regular_file(picture, ignored))
      rows[i].picture = read_file(picture);
  }
}

// Writes the index of the pages of this run's takes.
void write_index(const Batch& batch, const std::vector<BatchItem>& items,
                 const std::vector<Done>& done, const BatchSums& sums,
                 const PageSettings& settings) {
  std::vector<BatchPageRow> rows;
  for (std::size_t i = 0; i < items.size(); ++i) {
    std::error_code ignored;
    const bool has_page = !items[i].is_copied && done[i].code == 0 &&
                          fs::is_regular_file(page_path(batch, items[i]), ignored);
    rows.push_back({done[i].row, has_page ? page_name(batch, items[i]).generic_string() : ""});
  }
  add_pictures(batch, items, rows);
  write_file(batch.index, batch_page(rows, sums, settings), true);
}

// A resumed batch may overwrite the page of its first run.
bool is_our_page(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) &&
         read_file(path).find("<meta name=\"generator\" content=\"kinemend") < 1000;
}

// Checks the page that --report names. It must overwrite neither a take nor a file that no batch
// wrote.
void plan_index(const Arguments& arguments, const std::vector<std::string>& inputs, Batch& batch) {
  batch.index = arguments.text("report");
  if (batch.index.empty()) return;
  if (!is_page(batch.index))
    throw Error(
        ErrorKind::usage,
        "batch: --report needs a name that ends with .html; JSON is always written, as rows.jsonl "
        "and summary.json");
  check_page(batch.index, 1);
  files_read(batch.plan, arguments)
      .reads("IN", inputs)
      .reads("--list", arguments.text("list"))
      .writes("--report", batch.index)
      .check();
  check_free(batch.index, batch.plan.force || is_our_page(batch.index));
  batch.plan.page = page_settings(arguments);
  // The page of a take shows the command `clean`.
  batch.plan.page->command = "clean";
}

/// Changes no track, so that a batch can run the other steps alone.
class NoCleaner : public Cleaner {
 public:
  std::string_view name() const override { return "none"; }
  CleanTrace clean(const TakeView&, const TrackSink&,
                   const std::function<void(double)>&) const override {
    return {};
  }
};

// Applies --no-clean and --to.
void plan_steps(const Arguments& arguments, CleanPlan& plan) {
  if (const std::string to = arguments.text("to"); !to.empty()) plan.to = &known_format(to);
  plan.cleans = arguments.flag("clean");
  if (plan.cleans) return;
  if (arguments.given("method") || !arguments.group_texts.empty())
    throw Error(ErrorKind::usage,
                "batch: --no-clean cannot be combined with --method or its "
                "options");
  const bool holds_feet = plan.settings.feet && plan.settings.feet->mode != FeetMode::by_source;
  if (!plan.settings.fill && !holds_feet && !plan.settings.fix_swaps && plan.to == nullptr)
    throw Error(ErrorKind::usage,
                "batch: --no-clean leaves nothing to do; add --fill auto, --feet auto, --fix-swaps "
                "or --to FORMAT");
  plan.cleaner = std::make_unique<NoCleaner>();
  plan.settings.leftovers = Leftovers::beyond_cleaning;
}

// Names the results of --to after their format. Only results in AMC include skeletons.
void name_by_format(const Format& to, std::vector<BatchItem>& items) {
  std::erase_if(items, [](const BatchItem& item) { return item.is_copied; });
  ResultPaths results("batch");
  for (BatchItem& item : items) {
    item.name = fs::path(item.name).replace_extension(to.extensions.front()).generic_string();
    results.add(item.name, item.input);
  }
}

/// The words for the work on a take, before and after it.
struct WorkWords {
  std::string_view to_do, done;
};
WorkWords work_words(const CleanPlan& plan) {
  if (plan.cleans) return {"clean", "cleaned"};
  if (plan.settings.fill) return {"fill", "filled"};
  if (plan.to != nullptr) return {"convert", "converted"};
  return {"change", "changed"};
}

/// The text of `--dry-run` for one file: what a run would do with it.
std::string planned_text(const BatchItem& item, const Batch& batch, Done& done) {
  const std::string output = result_of(item, batch);
  const std::string names = fmt::format("{} -> {}", printable(item.input), printable(output));
  try {
    const BatchKey key{item.is_copied ? std::string() : input_hash(item), batch.options_hash,
                       std::string(version())};
    check_is_ours(item, output, key, batch);
    if (item.is_copied) return "copy     " + names;
    check_skeletons_are_ours(item, batch);
    const auto record = read_record(batch.folder, item.name);
    std::error_code ignored;
    const bool has_page =
        batch.index.empty() || fs::is_regular_file(page_path(batch, item), ignored);
    if (record && has_page && is_done(*record, key, output)) return "done     " + names;
    done.is_new = true;
    return fmt::format("{:<9}{}", work_words(batch.plan).to_do, names);
  } catch (const Error& error) {
    done.code = static_cast<int>(error.kind());
    return fmt::format("refuse   {} ({})", printable(item.input), error.what());
  }
}

/// Lists what a run would do and writes no file. Returns the exit code for refused takes.
int list_plan(const std::vector<BatchItem>& items, const Batch& batch) {
  std::size_t to_do = 0, kept = 0, refused = 0;
  int code = 0;
  std::string text;
  for (const BatchItem& item : items) {
    Done done;
    text += planned_text(item, batch, done) + "\n";
    code = std::max(code, done.code);
    refused += done.code != 0 ? 1 : 0;
    to_do += done.is_new ? 1 : 0;
    kept += done.code == 0 && !done.is_new && !item.is_copied ? 1 : 0;
  }
  if (batch.quiet) return code;
  write_out(text + fmt::format("{} to do, {} done already, {} refused; nothing written "
                               "(--dry-run)\n",
                               counted(to_do, "take"), grouped(kept), grouped(refused)));
  return code;
}

// No result may overwrite a take or another file that this run reads, not even with --force.
void check_outputs(const Arguments& arguments, const std::vector<BatchItem>& items,
                   const Batch& batch) {
  RunFiles files = files_read(batch.plan, arguments);
  files.reads("--list", arguments.text("list"));
  for (const BatchItem& item : items) {
    files.reads("IN", item.input);
    files.writes("--output-dir", (fs::path(batch.folder) / item.name).string());
  }
  files.check();
}

int run_batch(const Arguments& arguments) {
  Batch batch;
  batch.folder = arguments.text("output_dir");
  if (batch.folder.empty())
    throw Error(ErrorKind::usage, "batch: --output-dir is missing (see kinemend batch -h)");
  if (arguments.flag("dry_run") && arguments.flag("json"))
    throw Error(ErrorKind::usage, "batch: --dry-run prints a list, no JSON");
  if (arguments.flag("merge")) return merge_batch(arguments);
  const std::vector<std::string> inputs = inputs_of(arguments);
  batch.plan = make_cleaning(arguments);
  plan_steps(arguments, batch.plan);
  plan_index(arguments, inputs, batch);
  batch.quiet = arguments.flag("quiet");
  batch.verbose = arguments.flag("verbose");
  batch.options_hash = content_hash(options_text(arguments) + learned_text(batch.plan));
  if (const std::string shard = arguments.text("shard"); !shard.empty())
    batch.shard = parse_shard(shard);

  std::vector<BatchItem> all = find_items(inputs, batch.folder, arguments.text("files"));
  const int empty_code = refuse_empty(inputs, all, arguments);
  if (batch.plan.to != nullptr) name_by_format(*batch.plan.to, all);
  std::vector<BatchItem> mine;
  std::copy_if(all.begin(), all.end(), std::back_inserter(mine),
               [&](const BatchItem& item) { return in_shard(item.name, batch.shard); });
  check_outputs(arguments, all, batch);
  if (arguments.flag("dry_run")) return std::max(list_plan(mine, batch), empty_code);
  const std::vector<fs::path> missing = missing_folders(batch.folder);
  make_folder(batch.folder);
  remove_leftovers(batch.folder);
  const std::vector<Done> done = do_all(mine, batch);

  BatchCounts counts;
  counts.part = batch.shard.index;
  counts.parts = batch.shard.count;
  counts.work = work_words(batch.plan).done;
  std::vector<BatchRow> rows;
  for (const Done& one : done) {
    counts.add(one.row, one.is_new, one.code);
    rows.push_back(one.row);
  }
  // A batch that could not begin any take leaves no file and no folder.
  const bool is_refused =
      std::any_of(done.begin(), done.end(), [](const Done& one) { return !one.is_begun; }) &&
      std::none_of(done.begin(), done.end(),
                   [](const Done& one) { return one.is_begun && one.row.status != "copied"; });
  const BatchSums sums = sums_of(batch.folder, all, batch.options_hash);
  const std::string summary = to_json(sums, batch.options_hash);
  if (!is_refused) {
    write_rows(batch.folder, batch.shard, all, rows);
    write_summary(batch.folder, summary);
    if (!batch.index.empty()) write_index(batch, mine, done, sums, page_settings(arguments));
  } else {
    std::error_code ignored;
    for (const fs::path& folder : missing) fs::remove(folder, ignored);  // only if empty
  }
  if (arguments.flag("json")) {
    write_out(summary);
  } else if (!batch.quiet) {
    write_out(to_text(counts, sums, worst_rows(rows)));
  }
  return std::max(counts.exit_code, empty_code);
}

Flag clean_switch() {
  Flag flag =
      switch_flag("clean", "Work", "clean the takes",
                  "--no-clean leaves that out: gaps are filled (--fill), feet held (--feet), "
                  "labels swapped back (--fix-swaps) and takes converted (--to) only.");
  flag.spec.default_value = true;
  return flag;
}

std::vector<Flag> batch_flags() {
  Flag folder =
      file_flag("output_dir", "DIR", "Output",
                "folder for the results, with the tree of the inputs", "", Completion::folder);
  folder.letter = 'o';
  // All other commands have -o for --output.
  folder.older_names = {"output"};
  std::vector<Flag> flags = {
      std::move(folder),
      force_flag(),
      switch_flag("dry_run", "Output", "list what would be done, and write nothing"),
      choice_flag("to", "Output", "format of the results (default that of each take)",
                  written_formats(), "",
                  "As kinemend convert writes it: joints become markers in a format of markers."),
      clean_switch(),
      report_flag(
          "also write a page for a browser, FILE.html: the takes, worst first",
          "It links to a page for each take, in the folder FILE.takes beside it. Takes that "
          "an earlier run cleaned without a page are cleaned again."),
      json_flag("print the merged summary as JSON instead of text"),
      quiet_flag("Warnings about takes are printed with --verbose only."),
      verbose_flag("print every error and every warning",
                   "Otherwise the first ten errors are printed, and the number of the others."),
      list_flag(),
      text_flag("files", "PATTERN", "Input",
                "in folders, clean only files whose name matches PATTERN",
                "* stands for any text, ? for any character. Quote the pattern."),
      text_flag(
          "shard", "I/N", "Work", "clean part I of N",
          "Only the names of the takes decide to which part they belong, so that N jobs on "
          "any machines clean each take once. Run once more without --shard, or with --merge, "
          "to write the summary of all parts."),
      switch_flag("merge", "Work", "put rows of shards together: IN are files of rows",
                  "Writes the rows and the summary of one run to --output-dir, and cleans "
                  "nothing.")};
  append(flags, cleaning_flags());
  flags.push_back(jobs_flag());
  return flags;
}

}  // namespace

Command batch_command() {
  Command command;
  command.name = "batch";
  command.summary = "clean whole trees of takes; can be stopped and resumed at any moment";
  command.description =
      "Cleans every take in the given folders, files and lists, in parallel, and writes the "
      "results "
      "to the same tree below --output-dir. If a take cannot be read, the others are cleaned all "
      "the "
      "same; the exit code is the highest of all.\n\n"
      "For each result, a record below .kinemend in the output folder keeps the input, the "
      "settings "
      "and the version. A second run cleans only takes that are missing, have changed or have "
      "failed. A killed run leaves no partial file. A result of another input is not overwritten "
      "without --force.\n\n"
      "rows.jsonl in the output folder has one line per take (rows.I-of-N.jsonl for a shard), "
      "written as soon as the take is done. summary.json has the totals over all takes in the "
      "folder. The totals and the ten takes that most need review are printed. Skeleton files "
      "(ASF) "
      "are copied along.";
  command.positionals = {{"IN", "folder or take; with --merge a file of rows", 0, 1000000, {}}};
  command.flags = batch_flags();
  command.group_heading = "With --method %";
  command.groups = method_groups();
  command.groups_are_flags = true;
  command.examples = {
      {"kinemend batch raw -o clean", "clean every take below raw, to the same place below clean"},
      {"kinemend batch raw -o filled --no-clean --fill auto", "fill gaps, and nothing else"},
      {"kinemend batch raw -o trc --no-clean --to trc", "convert a tree of takes"},
      {"kinemend batch raw -o clean --shard 3/8", "the third of eight jobs on a cluster"},
      {"kinemend batch --merge clean/rows.*-of-8.jsonl -o clean", "rows and totals of all eight"},
      {"find raw -name '*.c3d' | kinemend batch --list - -o clean", "clean a list of takes"}};
  command.run = run_batch;
  return command;
}

}  // namespace kinemend::cli
