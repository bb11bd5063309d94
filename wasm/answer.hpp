// The output of the module's last call, and the files in memory that calls use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend::wasm {

inline constexpr int usage_error = 2;  // as in the program

struct Answer {
  int code = 0;
  std::string bytes, out, err;
};
extern Answer answer;

/// The folder of takes and the files beside them; relative names refer to it.
inline const std::filesystem::path input_folder = "/in";
inline const std::filesystem::path output_folder = "/out";

void make_folders();
/// The last part of a name, so that it cannot leave its folder.
std::string plain_name(const char* name);
/// Converts {"method": "butterworth", "cutoff_hz": 6, "despike": false} to words of the command
/// line.
std::vector<std::string> words_of(std::string_view options);
void put(const std::filesystem::path& path, const std::uint8_t* bytes, std::size_t size);

/// Clears `answer`, runs `work`, and keeps its output. An exception becomes a message and the exit
/// code of a usage error. Returns the exit code.
template <class Work>
int answered(const Work& work);
void begin_answer();
void end_answer();
void fail_answer(const char* words);

template <class Work>
int answered(const Work& work) {
  begin_answer();
  try {
    make_folders();
    work();
  } catch (const std::exception& error) {
    fail_answer(error.what());
  }
  end_answer();
  return answer.code;
}

}  // namespace kinemend::wasm
