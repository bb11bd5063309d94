// Every experiment in one program, so that the library is linked once:
//   kinemend_papers NAME [--data FOLDER] [--output FOLDER] [--models FOLDER] [--quick]
//   kinemend_papers --list
#include <algorithm>

#include "experiment.hpp"

namespace kinemend::papers {
namespace {

void list() {
  std::vector<std::string> names;
  for (const Experiment& experiment : experiments()) names.push_back(experiment.name);
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) fmt::print("{}\n", name);
}

void run(const std::string& name, const std::vector<std::string>& words) {
  const auto found = std::find_if(experiments().begin(), experiments().end(),
                                  [&](const Experiment& each) { return each.name == name; });
  if (found == experiments().end())
    throw Error(ErrorKind::usage, name + ": no such experiment; kinemend_papers --list names them");
  found->run(parse_arguments(words));
}

}  // namespace
}  // namespace kinemend::papers

int main(int count, char** values) {
  using namespace kinemend;
  const std::vector<std::string> words(values + 1, values + count);
  try {
    if (words.empty())
      throw Error(ErrorKind::usage, "usage: kinemend_papers NAME [OPTIONS], or --list");
    if (words[0] == "--list")
      papers::list();
    else
      papers::run(words[0], {words.begin() + 1, words.end()});
    return 0;
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(error.kind());
  }
}
