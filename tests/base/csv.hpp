// Reads fixtures of comma-separated values.
#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace kinemend::test {

// Rows of a comma-separated fixture; lines that start with # are comments.
inline std::vector<std::vector<std::string>> read_csv(const std::string& name) {
  const std::string path = std::string(KINEMEND_TEST_FIXTURES) + "/" + name;
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

}  // namespace kinemend::test
