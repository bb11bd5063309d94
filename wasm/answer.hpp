// What the last call of the module wrote, and the files in memory that calls work on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend::wasm {

inline constexpr int usage_error = 2;  // as of the program

struct Answer {
  int code = 0;
  std::string bytes, out, err;
};
extern Answer answer;

/// The folder of takes and of what lies beside them; relative names are in it.
inline const std::filesystem::path input_folder = "/in";
inline const std::filesystem::path output_folder = "/out";

void make_folders();
/// The last part of a name, so that it cannot leave its folder.
std::string plain_name(const char* name);
/// {"method": "butterworth", "cutoff_hz": 6, "despike": false} as words of the command line.
std::vector<std::string> words_of(std::string_view options);
void put(const std::filesystem::path& path, const std::uint8_t* bytes, std::size_t size);

/// Runs `work` after clearing `answer`, and keeps what it printed. An exception becomes a message
/// and the code of a usage error. Returns the code.
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
