#pragma once

#include <chrono>
#include <string>
#include <vector>

// What the programs that train have in common.
namespace kinemend::train {

/// Lines of a file that are not empty. Errors: `ErrorKind::unreadable_input`.
std::vector<std::string> lines_of(const std::string& path);
/// Written beside and renamed, so that a killed run leaves the old file or the new one. Errors:
/// `ErrorKind::cannot_write`.
void write_file(const std::string& path, const std::string& bytes);

class Clock {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// `kinemend-train paper ...`: the networks of Mall et al. 2017. Returns the exit code.
int paper_program(int count, char** values);

}  // namespace kinemend::train
