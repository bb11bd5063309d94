// The core as a module for JavaScript: each call runs one command on files in memory and keeps its
// output. Exit codes and reports are those of the program.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "answer.hpp"
#include "captured_streams.hpp"
#include "kinemend/io.hpp"
#include "run_words.hpp"

namespace kinemend::wasm {

Answer answer;

std::string plain_name(const char* name) {
  const std::string last = std::filesystem::path(name).filename().string();
  return last.empty() || last == "." || last == ".." ? "take" : last;
}

void put(const std::filesystem::path& path, const std::uint8_t* bytes, std::size_t size) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(size));
}

void make_folders() {
  for (const auto& folder : {input_folder, output_folder})
    std::filesystem::create_directories(folder);
  std::filesystem::current_path(input_folder);
}

void begin_answer() {
  answer = {};
  cli::platform::captured = {};
}

void end_answer() {
  answer.out += cli::platform::captured.out;
  answer.err += cli::platform::captured.err;
  cli::platform::captured = {};
}

void fail_answer(const char* words) {
  answer.code = usage_error;
  cli::platform::captured.err += std::string("kinemend: ") + words + "\n";
}

namespace {

using Json = nlohmann::json;

std::string dashed(std::string name) {
  for (char& c : name) c = c == '_' ? '-' : c;
  return name;
}

void add_words(const std::string& name, const Json& value, std::vector<std::string>& words) {
  if (value.is_array()) {
    for (const Json& one : value) add_words(name, one, words);
  } else if (value.is_boolean()) {
    words.push_back((value.get<bool>() ? "--" : "--no-") + dashed(name));
  } else {
    words.push_back("--" + dashed(name));
    words.push_back(value.is_string() ? value.get<std::string>() : value.dump());
  }
}

}  // namespace

std::vector<std::string> words_of(std::string_view options) {
  std::vector<std::string> words;
  if (options.empty()) return words;
  const Json json = Json::parse(options);
  if (!json.is_object()) throw Json::other_error::create(501, "options: an object", nullptr);
  for (const auto& [name, value] : json.items()) add_words(name, value, words);
  return words;
}

}  // namespace kinemend::wasm

namespace {

namespace fs = std::filesystem;
using namespace kinemend::wasm;

void run(const std::string& command, const std::string& name, const std::string& output,
         std::string_view options) {
  std::vector<std::string> words = {command, name};
  const bool writes = !output.empty();
  const fs::path path = output_folder / output;
  if (writes) {
    words.insert(words.end(), {"--output", path.string(), "--force"});
  }
  if (command != "convert") words.emplace_back("--json");
  const std::vector<std::string> more = words_of(options);
  words.insert(words.end(), more.begin(), more.end());
  fs::remove(path);
  answer.code = kinemend::cli::run_words(words);
  if (writes && fs::exists(path)) answer.bytes = kinemend::read_file(path);
  fs::remove(path);
}

}  // namespace

extern "C" {

/// Keeps a file beside the takes, such as the skeleton of an AMC file, until it is removed.
void kinemend_put_file(const char* name, const std::uint8_t* bytes, std::size_t size) {
  make_folders();
  put(input_folder / plain_name(name), bytes, size);
}

void kinemend_remove_file(const char* name) { fs::remove(input_folder / plain_name(name)); }

/// Returns a file beside the takes as bytes of the answer. Returns 0, or 2 if it is missing.
int kinemend_read_file(const char* name) {
  return answered([&] { answer.bytes = kinemend::read_file(input_folder / plain_name(name)); });
}

/// Runs a command ("clean", "fill", "check", "info", "convert") on a take. `output` is the name of
/// its output, whose extension selects the format; empty for no output. `options` is a JSON object
/// with the names of the command line. Returns the program's exit code.
int kinemend_run(const char* command, const char* name, const std::uint8_t* bytes, std::size_t size,
                 const char* output, const char* options) {
  return answered([&] {
    const std::string input = plain_name(name);
    put(input_folder / input, bytes, size);
    run(command, input, *output != '\0' ? plain_name(output) : "", options);
    fs::remove(input_folder / input);
  });
}

const char* kinemend_bytes() { return answer.bytes.data(); }
std::size_t kinemend_bytes_size() { return answer.bytes.size(); }
const char* kinemend_report() { return answer.out.data(); }
std::size_t kinemend_report_size() { return answer.out.size(); }
const char* kinemend_messages() { return answer.err.data(); }
std::size_t kinemend_messages_size() { return answer.err.size(); }

}  // extern "C"
