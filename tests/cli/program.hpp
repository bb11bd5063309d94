// Runs the program in its own folder and returns its exit code, output and peak memory.
#pragma once

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace kinemend::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

inline std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void put(const fs::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary) << text;
}

struct Ran {
  int code = -1;  ///< exit code, or 128 + signal if a signal ended it
  std::string out;
  std::string err;
  long peak_kilobytes = 0;
};

/// Standard streams and environment of a run; an empty path keeps the usual stream.
struct Setting {
  std::string in;   ///< text for standard input
  fs::path out_to;  ///< file or device that standard output is opened on
  std::vector<std::pair<std::string, std::string>> environment;
  long most_file_bytes = 0;  ///< largest file that may be written; 0: no limit
};

class Program : public testing::Test {
 protected:
  Program() {
    std::string name = (fs::temp_directory_path() / "kinemend-cli-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    folder = name;
  }
  ~Program() override {
    std::error_code ignored;
    fs::permissions(folder, fs::perms::owner_all, ignored);
    fs::remove_all(folder, ignored);
    fs::remove_all(streams(), ignored);
  }

  /// `kinemend words...` in the test's folder.
  Ran run(const std::vector<std::string>& words, const Setting& setting = {}) {
    fs::create_directory(streams());
    const fs::path in = streams() / "in", out = streams() / "out", err = streams() / "err";
    put(in, setting.in);
    const pid_t child = fork();
    if (child == 0) {
      open_as(STDIN_FILENO, in, O_RDONLY);
      open_as(STDOUT_FILENO, setting.out_to.empty() ? out : setting.out_to,
              O_WRONLY | O_CREAT | O_TRUNC);
      open_as(STDERR_FILENO, err, O_WRONLY | O_CREAT | O_TRUNC);
      execute(words, setting);
    }
    Ran ran = wait_for(child);
    ran.out = setting.out_to.empty() ? contents(out) : "";
    ran.err = contents(err);
    return ran;
  }

  /// Copies the fixture at `path` to the test's folder and returns its file name.
  std::string fixture(const fs::path& path) {
    fs::copy_file(fs::path(KINEMEND_TEST_FIXTURES) / path, folder / path.filename());
    return path.filename().string();
  }
  std::string c3d_fixture(const std::string& name) { return fixture("c3d/good/" + name + ".c3d"); }

  /// Writes a short synthetic take to the test's folder.
  void synth(const std::string& name, const std::string& motion = "walk",
             const std::string& duration_s = "0.5") {
    const Ran ran =
        run({"synth", motion, "-o", name, "--duration-s", duration_s, "--frame-rate-hz", "60"});
    ASSERT_EQ(ran.code, 0) << ran.err;
  }
  /// Writes a short synthetic take with jitter and spikes.
  void noisy(const std::string& name, const std::string& duration_s = "2") {
    synth("truth.bvh", "walk", duration_s);
    const Ran ran = run({"corrupt", "truth.bvh", "-o", name, "--damage", "gaussian:std_deg=1.5",
                         "--damage", "outliers:share=0.004,std_deg=25", "--seed", "3"});
    ASSERT_EQ(ran.code, 0) << ran.err;
  }

  /// Names in the test's folder, sorted.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      names.push_back(fs::relative(entry.path(), folder).string());
    std::sort(names.begin(), names.end());
    return names;
  }

  static Ran wait_for(pid_t child) {
    Ran ran;
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    ran.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    ran.peak_kilobytes = usage.ru_maxrss;
    return ran;
  }

  [[noreturn]] void execute(const std::vector<std::string>& words, const Setting& setting) const {
    std::vector<char*> arguments = {const_cast<char*>("kinemend")};
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    for (const auto& [name, value] : setting.environment) setenv(name.c_str(), value.c_str(), 1);
    if (setting.most_file_bytes > 0) {
      const rlimit limit{static_cast<rlim_t>(setting.most_file_bytes),
                         static_cast<rlim_t>(setting.most_file_bytes)};
      setrlimit(RLIMIT_FSIZE, &limit);
      // With the signal ignored, exceeding the limit becomes a write error.
      signal(SIGXFSZ, SIG_IGN);
    }
    if (chdir(folder.c_str()) == 0) execv(KINEMEND_PROGRAM, arguments.data());
    _exit(127);
  }

  fs::path folder;

 private:
  fs::path streams() const { return folder.string() + "-streams"; }

  static void open_as(int stream, const fs::path& path, int flags) {
    const int opened = open(path.c_str(), flags, 0666);
    if (opened < 0 || dup2(opened, stream) < 0) _exit(126);
    close(opened);
  }
};

/// Matches one line that ends in a newline.
MATCHER(IsOneLine, "") {
  return std::count(arg.begin(), arg.end(), '\n') == 1 && arg.back() == '\n';
}

/// Replaces every `from` in the text by `to`.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

/// Ten frames of a hip, an arm and two fingers, in an unusual layout.
inline const char* hand_take() {
  return "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 90 0\n"
         "  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
         "  JOINT LeftArm\n  {\n    OFFSET 20 40 0\n    CHANNELS 3 Zrotation Xrotation Yrotation\n"
         "    JOINT LeftFinger1\n    {\n      OFFSET 30 0 0\n"
         "      CHANNELS 3 Zrotation Xrotation Yrotation\n"
         "      End Site\n      {\n        OFFSET 5 0 0\n      }\n    }\n"
         "    JOINT LeftFinger2\n    {\n      OFFSET 30 0 2\n"
         "      CHANNELS 3 Zrotation Xrotation Yrotation\n"
         "      End Site\n      {\n        OFFSET 5 0 0\n      }\n    }\n  }\n}\n"
         "MOTION\nFrames: 10\nFrame Time: 0.0333333\n"
         "0 90 0 0.1 -0.20 1.0 10.0 0 0 1e1 1.50 +2 3.000 4 -0.0\n"
         "0 90 1 1.1 0.30 0.1 12.0 1 0 1.1e1 1.51 +3 3.100 4 -0.0\n"
         "0 90 2 0.0 -0.10 1.1 14.5 0 1 1.2e1 1.52 +2 3.000 4 -0.0\n"
         "0 90 3 1.2 0.20 0.2 16.0 1 0 1.1e1 1.50 +3 3.100 4 -0.0\n"
         "0 90 4 0.1 -0.20 1.0 18.5 0 0 1e1 1.53 +2 3.000 4 -0.0\n"
         "0 90 5 1.0 0.30 0.1 20.0 1 1 1.1e1 1.50 +3 3.100 4 -0.0\n"
         "0 90 6 0.2 -0.10 1.2 22.5 0 0 1.2e1 1.50 +2 3.000 4 -0.0\n"
         "0 90 7 1.1 0.20 0.0 24.0 1 0 1.1e1 1.54 +3 3.100 4 -0.0\n"
         "0 90 8 0.1 -0.20 1.1 26.5 0 1 1e1 1.50 +2 3.000 4 -0.0\n"
         "0 90 9 1.2 0.30 0.1 28.0 1 0 1.1e1 1.50 +3 3.100 4 -0.0\n";
}

}  // namespace kinemend::test
