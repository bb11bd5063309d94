// Adds accessors, samplers and channels to the end of a glTF file's arrays.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/gltf/gltf_rewrite.hpp"

namespace kinemend {

/// Collects additions; `finish` turns them into changes. Floats are appended to the buffer that
/// holds the animation.
class GltfAdditions {
 public:
  GltfAdditions(const GltfDocument& document, GltfChanges& changes);

  /// Appends elements of `width` floats and returns the number of their accessor. Times get their
  /// range, which glTF requires. Errors: `usage` for a value that overflows a float.
  std::size_t add_floats(const std::vector<double>& values, std::size_t width, bool are_times);
  /// Appends a sampler and returns its number.
  std::size_t add_sampler(std::size_t input, std::size_t output, bool in_steps);
  void set_sampler(std::size_t channel, std::size_t sampler);
  /// Appends a channel. A node with a matrix gets translation, rotation and scale instead, as
  /// animated nodes must.
  void add_channel(std::size_t node, GltfPath path, std::size_t sampler);
  void finish();

 private:
  struct Additions {
    std::size_t before = 0;
    std::vector<std::string> items;

    std::size_t add(std::string item) {
      items.push_back(std::move(item));
      return before + items.size() - 1;
    }
  };
  void append(std::optional<ByteSpan> array, const Additions& additions);
  void split_matrix(std::size_t node);
  std::string& buffer();

  const GltfDocument& document_;
  GltfChanges& changes_;
  std::size_t home_ = 0;  // the buffer that is extended
  Additions views_, accessors_, samplers_, channels_;
  std::vector<std::pair<std::size_t, std::size_t>> set_samplers_;
  std::set<std::size_t> split_;
};

/// Returns a number as JSON that reads back as the same float.
std::string json_of_float(float value);

}  // namespace kinemend
