// Reference values and channels for tests of filters.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "kinemend/extend/random.hpp"
#include "kinemend/extend/signal.hpp"

namespace kinemend::test {

/// The records of tests/fixtures/signal/filters.csv (made by tools/reference/signal_filters.py).
inline const std::map<std::string, std::vector<double>>& reference() {
  static const auto records = [] {
    std::map<std::string, std::vector<double>> result;
    std::ifstream file(std::string(KINEMEND_TEST_FIXTURES) + "/signal/filters.csv");
    if (!file) throw std::runtime_error("the fixture filters.csv is missing");
    for (std::string line; std::getline(file, line);) {
      std::istringstream cells(line);
      std::string name;
      std::getline(cells, name, ',');
      for (std::string cell; std::getline(cells, cell, ',');)
        result[name].push_back(std::stod(cell));
    }
    return result;
  }();
  return records;
}

inline PoseMatrix column(const std::vector<double>& values) {
  PoseMatrix matrix(values.size(), 1);
  matrix.values = values;
  return matrix;
}

inline std::vector<double> channel(const PoseMatrix& matrix, std::size_t c) {
  std::vector<double> values(matrix.frames);
  for (std::size_t t = 0; t < matrix.frames; ++t) values[t] = matrix(t, c);
  return values;
}

/// Sines of several periods with white noise of standard deviation `noise`.
inline PoseMatrix noisy_sines(std::size_t frames, std::size_t channels, std::uint64_t seed,
                              double noise = 0.1) {
  PoseMatrix matrix(frames, channels);
  Random random(seed);
  for (std::size_t t = 0; t < frames; ++t) {
    for (std::size_t c = 0; c < channels; ++c) {
      matrix(t, c) =
          std::sin(0.05 * static_cast<double>(t) * (1 + 0.3 * static_cast<double>(c % 7)) +
                   static_cast<double>(c)) +
          noise * random.normal();
    }
  }
  return matrix;
}

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) throw std::runtime_error("compared vectors differ in size");
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    // The negated comparison catches NaN too.
    if (!(std::abs(a[i] - b[i]) <= largest)) largest = std::abs(a[i] - b[i]);
  }
  return largest;
}

inline PoseMatrix filtered(PoseMatrix matrix, const std::function<void(PoseMatrix&)>& filter) {
  filter(matrix);
  return matrix;
}

inline void filter_causally(PoseMatrix& matrix, const std::vector<Biquad>& sections) {
  CausalState state(sections);
  for (std::size_t t = 0; t < matrix.frames; ++t) state.step(matrix.row(t));
}

inline double rms(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace kinemend::test
