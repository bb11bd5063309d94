// The program: sets up its streams and runs the command line.

#include "platform/console.hpp"
#include "run_words.hpp"
#include "terminal.hpp"

// The locale is never set, so that numbers look the same everywhere.
int main(int argc, char** argv) {
  using namespace kinemend::cli;
  open_standard_streams();
  platform::keep_freed_memory();
  platform::ignore_closed_pipes();
  return run_words(platform::program_words(argc, argv));
}
