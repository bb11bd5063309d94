// Fixtures and analog samples for the tests of C3D.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

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
  Take clip;
  Diagnostics diagnostics;
};

inline C3dResult read_c3d_bytes(std::string bytes, const ReadOptions& options = {}) {
  TakeResult result = read_take(std::move(bytes), "take.c3d", options);
  return {std::move(result.take), std::move(result.diagnostics)};
}

inline Take read_good_c3d(const std::string& name) { return read_c3d_bytes(good_c3d(name)).clip; }

inline const C3dDocument& document_of(const Take& clip) {
  return dynamic_cast<const C3dDocument&>(*clip.source.document);
}

/// The analog samples of a file.
struct C3dAnalog {
  std::vector<std::string> names;  ///< C channels
  std::vector<std::string> units;  ///< C
  double rate_hz = 0;
  std::vector<double> values;  ///< N x C, instant by instant; N is a multiple of the frame count
};

inline std::vector<std::string> analog_texts(const C3dDocument& document, const char* name) {
  std::vector<std::string> texts = document.parameters.texts("ANALOG", name);
  texts.resize(document.layout.analog_count);
  for (std::string& text : texts) text = as_utf8(text);
  return texts;
}

/// The result has no channels if the file has none.
inline C3dAnalog analog_of(const Take& clip) {
  const C3dDocument& document = document_of(clip);
  const C3dLayout& layout = document.layout;
  C3dAnalog analog;
  const std::size_t channels = layout.analog_count, instants = layout.analog_instants();
  if (channels == 0 || instants == 0) return analog;
  analog.names = analog_texts(document, "LABELS");
  analog.units = analog_texts(document, "UNITS");
  analog.rate_hz = layout.rate_hz * static_cast<double>(instants);
  const C3dAnalogDecoder decoder(document);
  std::vector<double> frame;
  for (std::size_t f = 0; f < layout.frame_count; ++f) {
    decoder.stored(f, frame);
    for (std::size_t i = 0; i < instants * channels; ++i)
      analog.values.push_back(decoder.value(frame[i], i % channels));
  }
  return analog;
}

inline std::string fact_of(const Take& clip, const std::string& name) {
  for (const SourceFact& fact : clip.source.facts) {
    if (fact.name == name) return fact.text;
  }
  return "";
}

inline void expect_same_samples(const Take& a, const Take& b, double tolerance = 0) {
  ASSERT_EQ(a.names, b.names);
  ASSERT_EQ(a.observed, b.observed);
  ASSERT_EQ(a.positions.size(), b.positions.size());
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    if (a.observed[i] == 0) continue;
    ASSERT_LE(norm(a.positions[i] - b.positions[i]), tolerance) << "sample " << i;
  }
}

}  // namespace kinemend::test
