// The commands of the module.
#include "commands.hpp"

namespace kinemend::cli {

const std::vector<Command>& commands() {
  static const std::vector<Command> table = {
      clean_command(),   fill_command(),    check_command(), info_command(),  convert_command(),
      methods_command(), corrupt_command(), synth_command(), stream_command()};
  return table;
}

}  // namespace kinemend::cli
