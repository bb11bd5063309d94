// kinemend batch: cleans whole trees of takes, and can be stopped and taken up again at any moment.

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <mutex>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "batch_list.hpp"
#include "batch_record.hpp"
#include "batch_summary.hpp"
#include "clean_flags.hpp"
#include "clean_plan.hpp"
#include "clean_take.hpp"
#include "commands.hpp"
#include "config.hpp"
#include "json.hpp"
#include "kinemend/experimental/batch_rows.hpp"
#include "kinemend/experimental/content_hash.hpp"
#include "kinemend/experimental/model.hpp"
#include "kinemend/experimental/version.hpp"
#include "kinemend/io.hpp"
#include "method_options.hpp"
#include "page_report.hpp"
#include "run_files.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

/// All that a batch was asked for.
struct Batch {
  CleanPlan plan;
  std::string folder;  ///< for the results
  std::string index;   ///< the page of --report; empty: none
  std::string options_hash;
  Shard shard;
  bool quiet = false;
  bool verbose = false;  ///< says every error and warning
};

/// Where the page of a take stands, from the folder of the index.
fs::path page_name(const Batch& batch, const BatchItem& item) {
  return fs::path(fs::path(batch.index).stem().string() + ".takes") / (item.name + ".html");
}
fs::path page_path(const Batch& batch, const BatchItem& item) {
  return fs::path(batch.index).parent_path() / page_name(batch, item);
}
/// Of a few of its poses, for the index.
fs::path picture_path(const Batch& batch, const BatchItem& item) {
  return page_path(batch, item).replace_extension(".svg");
}

/// What came of one file.
struct Done {
  BatchRow row;
  int code = 0;
  bool is_new = false;   ///< false where an earlier run had done it
  bool is_begun = true;  ///< false where it was refused before anything was done
  std::string error;
  std::vector<std::string> warnings;
};

/// Every setting that a result depends on, as one text. Where results go and how many threads make
/// them is left out.
std::string options_text(const Arguments& arguments) {
  std::string text = settings_text(*arguments.command, merged_settings(arguments), "");
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

/// What a method reads beside the take, as one text: its files, and a model that ships.
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
    if (model.method == plan.method) text += model_checksum(model.bytes) + "\n";
  }
  return text;
}

/// The bytes a take's result depends on: its own, and those of an ASF that it is read with.
std::string input_hash(const BatchItem& item) {
  std::string hash = content_hash(read_file(item.input));
  const Format* format = format_of_path(item.input);
  if (format == nullptr || format->name != "amc") return hash;
  std::vector<fs::path> skeletons;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(fs::path(item.input).parent_path(), error)) {
    const Format* known = format_of_path(entry.path());
    if (known != nullptr && known->name == "asf") skeletons.push_back(entry.path());
  }
  std::sort(skeletons.begin(), skeletons.end());
  for (const fs::path& skeleton : skeletons) hash += content_hash(read_file(skeleton));
  return content_hash(hash);
}

bool is_done(const BatchRecord& record, const BatchKey& key, const std::string& output) {
  std::error_code ignored;
  return record.key == key && !record.output.empty() && fs::is_regular_file(output, ignored) &&
         content_hash(read_file(output)) == record.output;
}

Done copy_skeleton(const BatchItem& item, const std::string& output, bool may_replace) {
  Done done;
  done.row = plain_row(item.name, "copied");
  const std::string bytes = read_file(item.input);
  std::error_code ignored;
  if (fs::is_regular_file(output, ignored) && read_file(output) == bytes) {
    return done;
  }
  write_output(output, bytes, may_replace);
  done.is_new = true;
  return done;
}

Done clean_item(const BatchItem& item, const std::string& output, const Batch& batch,
                const BatchKey& key) {
  const Outcome outcome = try_take({item.input, output, true, item.name}, batch.plan);
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
  write_record(batch.folder, item.name, {key, result, done.row});
  return done;
}

/// What an earlier run of the batch made, or had begun, may be replaced; what somebody else put
/// there may not. A record is older than its result, and so it is asked for second.
void check_is_ours(const BatchItem& item, const std::string& output, const Batch& batch) {
  std::error_code ignored;
  if (fs::exists(output, ignored) && !read_record(batch.folder, item.name))
    check_free(output, batch.plan.force);
}

Done do_item(const BatchItem& item, const Batch& batch) {
  const std::string output = (fs::path(batch.folder) / item.name).string();
  make_folder(fs::path(output).parent_path());
  if (item.is_copied) {
    const TakeLock lock(batch.folder, item.name);
    return copy_skeleton(item, output, true);
  }
  // What is refused leaves no trace.
  check_is_ours(item, output, batch);
  const BatchKey key{input_hash(item), batch.options_hash, std::string(version())};
  const TakeLock lock(batch.folder, item.name);
  const auto record = read_record(batch.folder, item.name);
  // A take that was done without a page has none yet.
  std::error_code ignored;
  const bool has_page = batch.index.empty() || fs::is_regular_file(page_path(batch, item), ignored);
  if (record && has_page && is_done(*record, key, output))
    return {record->row, 0, false, true, {}, {}};
  if (!record) {
    check_is_ours(item, output, batch);
    write_record(batch.folder, item.name, {key, "", plain_row(item.name, "begun")});
  }
  return clean_item(item, output, batch, key);
}

/// Whatever goes wrong with one file stops no other.
Done try_item(const BatchItem& item, const Batch& batch) {
  Done done;
  done.is_new = true;
  try {
    done = do_item(item, batch);
    if (done.is_new && !item.is_copied) append_row(batch.folder, batch.shard, done.row);
    return done;
  } catch (const Error& error) {
    done.code = static_cast<int>(error.kind());
    done.error = error.what();
  } catch (const std::bad_alloc&) {
    done.code = static_cast<int>(ErrorKind::unreadable_input);
    done.error = item.input + ": out of memory";
  } catch (const std::exception& error) {
    done.code = static_cast<int>(ErrorKind::unreadable_input);
    done.error = fmt::format("{}: internal error: {}", item.input, error.what());
  }
  done.is_begun = false;
  done.row = failed_row(item.name, item.input, done.error, done.code);
  return done;
}

/// How much work a take is, about.
double size_of(const BatchItem& item) {
  std::error_code error;
  const auto bytes = fs::file_size(item.input, error);
  return error ? 1.0 : 1.0 + static_cast<double>(bytes);
}

/// Errors as they come, the first ten: thousands of lines say no more.
class Sayer {
 public:
  Sayer(const Batch& batch, ProgressBar& bar) : batch_(batch), bar_(bar) {}

  void say_of(const Done& done) {
    const std::lock_guard lock(mutex_);
    const bool warns = batch_.verbose && !batch_.quiet && !done.warnings.empty();
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
    say_error(fmt::format("and {} more failed; the rows in {} say how", grouped(failed_ - most),
                          batch_.folder));
  }

 private:
  static constexpr std::size_t most = 10;
  const Batch& batch_;
  ProgressBar& bar_;
  std::mutex mutex_;
  std::size_t failed_ = 0;
};

/// Inputs that hold nothing to do are mistakes: 3, or an error where there is nothing else.
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
  const std::vector<std::string> listed = listed_inputs(read_file(list));
  if (listed.empty()) {
    throw Error(ErrorKind::unreadable_input, fmt::format("{}: lists no take", input_name(list)));
  }
  inputs.insert(inputs.end(), listed.begin(), listed.end());
  return inputs;
}

std::vector<Done> do_all(const std::vector<BatchItem>& items, const Batch& batch) {
  std::optional<tbb::global_control> limit;
  if (batch.plan.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism,
                  static_cast<std::size_t>(batch.plan.threads));
  }
  std::vector<Done> done(items.size());
  std::vector<double> sizes(items.size());
  std::transform(items.begin(), items.end(), sizes.begin(), size_of);
  ProgressBar bar(items.size(), std::accumulate(sizes.begin(), sizes.end(), 0.0));
  Sayer sayer(batch, bar);
  std::atomic<std::size_t> next{0};
  tbb::parallel_for(0, tbb::this_task_arena::max_concurrency(), [&](int) {
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

// Of the takes that most should be looked at, so that an index of thousands stays small.
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

// The index of the pages, of the takes that this run was about.
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

// A batch that is taken up again may replace the page of its first run.
bool is_our_page(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) &&
         read_file(path).find("<meta name=\"generator\" content=\"kinemend") < 1000;
}

// The page that --report names. What it would replace must be no take, and no file of somebody
// else.
void plan_index(const Arguments& arguments, const std::vector<std::string>& inputs, Batch& batch) {
  batch.index = arguments.text("report");
  if (batch.index.empty()) return;
  if (!is_page(batch.index))
    throw Error(
        ErrorKind::usage,
        "batch: --report FILE.html is a page; rows.jsonl and summary.json are written anyway");
  check_page(batch.index, 1);
  files_read(batch.plan, arguments)
      .reads("IN", inputs)
      .reads("--list", arguments.text("list"))
      .writes("--report", batch.index)
      .check();
  check_free(batch.index, batch.plan.force || is_our_page(batch.index));
  batch.plan.page = page_settings(arguments);
  // The pages of takes are those of `clean`.
  batch.plan.page->command = "clean";
}

int run_batch(const Arguments& arguments) {
  Batch batch;
  batch.folder = arguments.text("output_dir");
  if (batch.folder.empty())
    throw Error(ErrorKind::usage, "batch: --output-dir is missing (see kinemend batch -h)");
  const std::vector<std::string> inputs = inputs_of(arguments);
  batch.plan = make_cleaning(arguments);
  plan_index(arguments, inputs, batch);
  batch.quiet = arguments.flag("quiet");
  batch.verbose = arguments.flag("verbose");
  batch.options_hash = content_hash(options_text(arguments) + learned_text(batch.plan));
  if (const std::string shard = arguments.text("shard"); !shard.empty())
    batch.shard = parse_shard(shard);

  const std::vector<BatchItem> all = find_items(inputs, batch.folder, arguments.text("files"));
  const int empty_code = refuse_empty(inputs, all, arguments);
  std::vector<BatchItem> mine;
  std::copy_if(all.begin(), all.end(), std::back_inserter(mine),
               [&](const BatchItem& item) { return in_shard(item.name, batch.shard); });
  make_folder(batch.folder);
  remove_leftovers(batch.folder);
  const std::vector<Done> done = do_all(mine, batch);

  BatchCounts counts;
  counts.part = batch.shard.index;
  counts.parts = batch.shard.count;
  std::vector<BatchRow> rows;
  for (const Done& one : done) {
    counts.add(one.row, one.is_new, one.code);
    rows.push_back(one.row);
  }
  // A batch that could begin nothing leaves no word of itself.
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
  }
  if (arguments.flag("json")) {
    write_out(summary);
  } else if (!batch.quiet) {
    write_out(to_text(counts, sums, worst_rows(rows)));
  }
  return std::max(counts.exit_code, empty_code);
}

std::vector<Flag> batch_flags() {
  Flag folder = text_flag("output_dir", "DIR", "Output", "folder for the results: the same tree");
  folder.letter = 'o';
  folder.completion = Completion::folder;
  Flag list =
      text_flag("list", "FILE", "Input", "further takes and folders, one a line",
                "Blank lines and lines that start with # are left out; - is standard input.");
  list.completion = Completion::file;
  std::vector<Flag> flags = {
      std::move(folder),
      force_flag(),
      report_flag("also write a page for a browser, FILE.html: the takes, worst first",
                  "Beside it, below FILE.takes, stands a page for each take. Takes that were done "
                  "without a page are done again."),
      json_flag("print the merged summary as JSON instead of text"),
      switch_flag("quiet", "Output", "print errors only"),
      switch_flag("verbose", "Output", "print every error and every warning as it comes",
                  "Else the first ten errors, and of the rest how many there are."),
      std::move(list),
      text_flag("files", "PATTERN", "Input", "of a folder only files of such names",
                "In PATTERN * is any text and ? any character; quote it."),
      text_flag("shard", "I/N", "Work", "do part I of N",
                "The split depends on the names of the takes alone, so that N jobs on any machines "
                "do each take once. A last run without --shard finds nothing to do and sums up.")};
  append(flags, cleaning_flags());
  flags.push_back(jobs_flag());
  for (Flag& flag : flags) {
    if (flag.spec.name == "quiet") flag.letter = 'q';
    if (flag.spec.name == "verbose") flag.letter = 'v';
  }
  return flags;
}

}  // namespace

Command batch_command() {
  Command command;
  command.name = "batch";
  command.summary = "clean whole trees of takes; stop and go on at any moment";
  command.description =
      "Cleans every take in the folders and lists, in parallel, into the same tree below "
      "--output-dir. A take that cannot be read stops no other; the exit code is the highest of "
      "all.\n\n"
      "Of each result it is remembered, below .kinemend in the output folder, from which input, "
      "with "
      "which settings and by which version it was made. A second run does only what is missing, "
      "has "
      "changed or has failed. A run that is killed leaves whole files only.\n\n"
      "rows.jsonl there holds a line for each take (rows.I-of-N.jsonl for a shard), written as "
      "takes are done, summary.json the sums over all takes in the folder so far. Printed are the "
      "sums and the ten takes that most should be looked at. Skeleton files (ASF) are copied "
      "along.";
  command.positionals = {{"IN", "folder or take", 0, 1000000, {}}};
  command.flags = batch_flags();
  command.group_heading = "With --method %";
  command.groups = method_groups();
  command.groups_are_flags = true;
  command.examples = {
      {"kinemend batch raw -o clean", "every take below raw, to the same place below clean"},
      {"kinemend batch raw -o clean --shard 3/8", "one of eight jobs of a scheduler"},
      {"find raw -name '*.c3d' | kinemend batch --list - -o clean", "a list of takes"}};
  command.run = run_batch;
  return command;
}

}  // namespace kinemend::cli
