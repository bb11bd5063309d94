#include "batch_record.hpp"

#include <signal.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <filesystem>

#include "kinemend/error.hpp"
#include "kinemend/io.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view records_folder = ".kinemend";

// The process that made `.kinemend-PID-N.tmp`; 0 for any other name.
int maker_of(const std::string& name) {
  constexpr std::string_view start = ".kinemend-", end = ".tmp";
  if (name.size() <= start.size() + end.size() || name.compare(0, start.size(), start) != 0 ||
      name.compare(name.size() - end.size(), end.size(), end) != 0) {
    return 0;
  }
  int process = 0;
  std::from_chars(name.data() + start.size(), name.data() + name.size(), process);
  return process;
}

bool is_running(int process) { return ::kill(process, 0) == 0 || errno == EPERM; }

}  // namespace

std::string record_path(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / records_folder / (name + ".json")).string();
}

std::optional<BatchRecord> read_record(const std::string& folder, const std::string& name) {
  const std::string path = record_path(folder, name);
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return std::nullopt;
  try {
    const Json json = Json::parse(read_file(path));
    BatchRecord record;
    record.key = {json.at("input_hash").get<std::string>(),
                  json.at("options_hash").get<std::string>(),
                  json.at("kinemend").get<std::string>()};
    record.output = json.at("output_hash").get<std::string>();
    record.row = json.at("row");
    return record;
  } catch (const Json::exception&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

void write_record(const std::string& folder, const std::string& name, const BatchRecord& record) {
  const fs::path path = record_path(folder, name);
  fs::create_directories(path.parent_path());
  write_file(path,
             json_text({{"kinemend", record.key.version},
                        {"input_hash", record.key.input},
                        {"options_hash", record.key.options},
                        {"output_hash", record.output},
                        {"row", record.row}}),
             true);
}

void remove_leftovers(const std::string& folder) {
  constexpr auto old = std::chrono::hours(1);
  std::error_code error;
  for (fs::recursive_directory_iterator entries(folder, error), end; !error && entries != end;
       entries.increment(error)) {
    const int process = maker_of(entries->path().filename().string());
    if (process == 0 || is_running(process)) continue;
    std::error_code ignored;
    const auto age = fs::file_time_type::clock::now() - entries->last_write_time(ignored);
    if (!ignored && age > old) fs::remove(entries->path(), ignored);
  }
}

}  // namespace kinemend::cli
