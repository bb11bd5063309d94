#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "io/c3d/c3d_analog.hpp"
#include "io/c3d/c3d_document.hpp"
#include "kinemend/error.hpp"
#include "kinemend/io.hpp"

namespace kinemend::test {

inline std::filesystem::path c3d_folder() {
  return std::filesystem::path(KINEMEND_TEST_FIXTURES) / "c3d";
}

inline std::string good_c3d(const std::string& name) {
  return read_file(c3d_folder() / "good" / (name + ".c3d"));
}

struct C3dResult {
  MarkerClip clip;
  Diagnostics diagnostics;
};

inline C3dResult read_c3d_bytes(std::string bytes, const ReadOptions& options = {}) {
  TakeResult result = read_take(std::move(bytes), "take.c3d", options);
  return {std::get<MarkerClip>(std::move(result.take)), std::move(result.diagnostics)};
}

inline MarkerClip read_good_c3d(const std::string& name) {
  return read_c3d_bytes(good_c3d(name)).clip;
}

inline const C3dDocument& document_of(const MarkerClip& clip) {
  return dynamic_cast<const C3dDocument&>(*clip.source.document);
}

inline std::string fact_of(const MarkerClip& clip, const std::string& name) {
  for (const SourceFact& fact : clip.source.facts) {
    if (fact.name == name) return fact.text;
  }
  return "";
}

inline void expect_same_samples(const MarkerClip& a, const MarkerClip& b, double tolerance = 0) {
  ASSERT_EQ(a.names, b.names);
  ASSERT_EQ(a.observed, b.observed);
  ASSERT_EQ(a.positions.size(), b.positions.size());
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    if (a.observed[i] == 0) continue;
    ASSERT_LE(norm(a.positions[i] - b.positions[i]), tolerance) << "sample " << i;
  }
}

}  // namespace kinemend::test
