// kinemend-train: trains the networks. The library provides all knowledge of takes.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "contact_training.hpp"
#include "kinemend/error.hpp"
#include "motion_training.hpp"
#include "program.hpp"

namespace kinemend::train {

namespace {

constexpr const char* usage =
    "usage: kinemend-train paper OPTION...    networks of the method recurrent (Mall et al. 2017)\n"
    "       kinemend-train learned OPTION...  network of the method learned\n"
    "       kinemend-train contacts OPTION... network that finds standing feet\n"
    "`kinemend-train paper --help` lists the options of the first, and so for the others.\n";

int start(int count, char** values) {
  const std::string_view word = count > 1 ? values[1] : "";
  if (word == "paper") return paper_program(count - 1, values + 1);
  if (word == "learned") return motion_program(count - 1, values + 1);
  if (word == "contacts") return contact_program(count - 1, values + 1);
  const bool is_asked = word == "--help" || word == "-h";
  fmt::print(is_asked ? stdout : stderr, "{}", usage);
  return is_asked ? 0 : static_cast<int>(ErrorKind::usage);
}

}  // namespace

}  // namespace kinemend::train

int main(int count, char** values) {
  // Threads in OpenBLAS make small products slower; the variable is read when the library is
  // loaded.
  if (std::getenv("OPENBLAS_NUM_THREADS") == nullptr) {
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
    setenv("OMP_NUM_THREADS", "1", 0);
    execv("/proc/self/exe", values);
  }
  try {
    return kinemend::train::start(count, values);
  } catch (const kinemend::Error& error) {
    fmt::print(stderr, "kinemend-train: {}\n", error.what());
    return static_cast<int>(error.kind());
  }
}
