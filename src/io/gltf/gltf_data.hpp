// The bytes of buffers, and the numbers that accessors point to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/gltf/gltf_model.hpp"

namespace kinemend {

/// The contents of the buffers that motion needs.
class GltfBuffers {
 public:
  /// Loads a buffer if it is not loaded yet. Errors: `unreadable_input` for a buffer that is
  /// refused, cannot be read, or is shorter than stated.
  void load(const GltfFile& file, const GltfModel& model, std::size_t buffer);
  bool is_loaded(std::size_t buffer) const;
  /// Returns at least `GltfBuffer::size` bytes. The buffer must be loaded.
  std::string_view bytes(const GltfFile& file, std::size_t buffer) const;
  /// Returns the size of the buffers outside the file itself.
  std::size_t size_beside() const;

 private:
  struct Loaded {
    bool is_there = false, in_file = false;
    std::shared_ptr<const std::string> bytes;  // null if it is part of the file
  };
  std::vector<Loaded> loaded_;
};

/// Returns the content of one buffer. Errors: as `GltfBuffers::load`.
std::string load_gltf_buffer(const GltfFile& file, const GltfModel& model, std::size_t buffer);

/// Where an element of an accessor is stored.
struct GltfPlace {
  std::size_t buffer = 0, at = 0;
};

/// An accessor whose bytes are loaded and lie within their buffers.
class GltfNumbers {
 public:
  /// Errors: `unreadable_input`, naming the accessor, if it is out of bounds, coded by an
  /// extension, or of a type that is not `width` numbers.
  GltfNumbers(const GltfFile& file, const GltfModel& model, GltfBuffers& buffers,
              std::size_t accessor, std::size_t width);

  std::size_t count() const { return accessor().count; }
  /// Returns all elements, `width` values each; normalised integers as -1 to 1 or 0 to 1.
  std::vector<double> values() const;
  /// Returns the place of each element; empty for a zero that is not stored.
  std::vector<std::optional<GltfPlace>> places() const;
  const GltfAccessor& accessor() const { return model_.accessors[index_]; }

 private:
  Error error(std::string_view message) const;
  void check_view(std::size_t view, std::size_t offset, std::size_t count, std::size_t size,
                  std::size_t stride) const;
  void check_sparse() const;
  /// Calls `visit(element, place)` for each stored element; a sparse one follows the one that it
  /// replaces.
  template <class Visit>
  void for_each_stored(const Visit& visit) const;
  std::size_t stride() const;
  std::size_t element_size() const;
  std::size_t sparse_index(std::size_t i) const;

  const GltfFile& file_;
  const GltfModel& model_;
  GltfBuffers& buffers_;
  std::size_t index_, width_;
};

std::size_t size_of_component(int component);
/// Reads one component as a number.
double read_component(const char* bytes, int component, bool normalized);
/// Stores the nearest number that the component can hold, in the bytes of one component; returns
/// false for a value out of its range by more than half a step.
bool store_component(double value, int component, bool normalized, char* bytes);

/// Whether no other accessor, image or index of sparse values shares a byte with this one.
bool is_stored_alone(const GltfModel& model, std::size_t accessor);

}  // namespace kinemend
