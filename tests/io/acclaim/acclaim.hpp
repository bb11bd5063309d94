// Fixtures and small skeletons for the tests of ASF and AMC.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "io/acclaim/amc.hpp"
#include "io/support.hpp"
#include "kinemend/io.hpp"

namespace kinemend::test {

inline std::filesystem::path acclaim_fixture(const std::string& name) {
  return std::filesystem::path(KINEMEND_TEST_FIXTURES) / name;
}

inline std::string figure_asf() { return read_file(acclaim_fixture("asf/good/figure.asf")); }
inline std::string figure_amc() { return read_file(acclaim_fixture("amc/good/figure.amc")); }

inline TakeResult read_pair(std::string amc, std::string asf, const ReadOptions& options = {}) {
  TakeResult result = read_amc(std::move(amc), "take.amc", std::move(asf), "take.asf", options);
  return {std::move(result.take), std::move(result.diagnostics)};
}
inline Take read_figure() { return read_pair(figure_amc(), figure_asf()).take; }

/// An ASF with the root and a chain of bones, each described by one of `bone_lines`.
inline std::string chain_asf(const std::vector<std::string>& bone_lines,
                             const std::string& units = "", const std::string& root = "") {
  std::string asf = ":units\n" + units + ":root\n" +
                    (root.empty() ? "order tx ty tz rx ry rz\n" : root) + ":bonedata\n";
  std::string hierarchy = ":hierarchy\nbegin\n", parent = "root";
  for (std::size_t i = 0; i < bone_lines.size(); ++i) {
    const std::string name(1, static_cast<char>('a' + i));
    asf += "begin\nname " + name + "\n" + bone_lines[i] + "\nend\n";
    hierarchy += parent + " " + name + "\n";
    parent = name;
  }
  return asf + hierarchy + "end\n";
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return at == text.npos ? text : text.replace(at, from.size(), to);
}

}  // namespace kinemend::test
