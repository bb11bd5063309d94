#include "program.hpp"

#include <filesystem>
#include <fstream>

#include "kinemend/error.hpp"

namespace kinemend::train {

std::vector<std::string> lines_of(const std::string& path) {
  std::vector<std::string> lines;
  std::ifstream file(path);
  if (!file) throw Error(ErrorKind::unreadable_input, path + ": cannot be read");
  for (std::string line; std::getline(file, line);) {
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

void write_file(const std::string& path, const std::string& bytes) {
  const std::string part = path + ".part";
  {
    std::ofstream file(part, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) throw Error(ErrorKind::cannot_write, path + ": cannot be written");
  }
  std::filesystem::rename(part, path);
}

}  // namespace kinemend::train
