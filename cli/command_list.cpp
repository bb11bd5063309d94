// The commands of the program, in the order of its help.
#include "commands.hpp"

namespace kinemend::cli {

const std::vector<Command>& commands() {
  static const std::vector<Command> table = [] {
    std::vector<Command> list = {clean_command(),    batch_command(),      fill_command(),
                                 stream_command(),   info_command(),       check_command(),
                                 contacts_command(), compare_command(),    plot_command(),
                                 view_command(),     methods_command(),    train_command(),
                                 models_command(),   convert_command(),    corrupt_command(),
                                 synth_command(),    completion_command(), man_command()};
    list.push_back(help_command(list));
    return list;
  }();
  return table;
}

}  // namespace kinemend::cli
