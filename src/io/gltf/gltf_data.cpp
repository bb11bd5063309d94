// Loads buffers and reads accessors, with every bound checked first.
#include "io/gltf/gltf_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <type_traits>

#include "io/gltf/gltf_container.hpp"
#include "io/gltf/gltf_json.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

std::string gltf_file_beside(const GltfFile& file, const GltfModel& model, std::size_t buffer) {
  namespace fs = std::filesystem;
  const GltfBuffer& b = model.buffers[buffer];
  if (b.path.empty()) {
    throw gltf_error(file, "buffers", buffer,
                     "its address is no path within the folder of the file: refused");
  }
  const fs::path path = fs::path(file.name).parent_path() / b.path;
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) {
    throw gltf_error(file, "buffers", buffer,
                     fmt::format("its file {} is not there", path.string()));
  }
  return read_file(path);
}

// Returns the text of a JSON string; empty if it is damaged, because no parser has checked inline
// data.
std::optional<std::string> unescaped(std::string_view quoted) {
  if (quoted.find('\\') == quoted.npos) return std::string(quoted.substr(1, quoted.size() - 2));
  const GltfJson parsed = GltfJson::parse(quoted, nullptr, false);
  if (!parsed.is_string()) return std::nullopt;
  return parsed.get<std::string>();
}

std::string gltf_data_in_text(const GltfFile& file, std::size_t buffer) {
  const std::string_view text = file.json_text();
  const auto element = json_element(text, "buffers", buffer);
  const auto uri = element ? json_member(text, *element, "uri") : std::nullopt;
  if (uri && uri->size >= 2) {
    // Some writers escape every slash.
    const auto plain = unescaped(text.substr(uri->begin, uri->size));
    auto data = plain ? bytes_of_data_uri(*plain) : std::nullopt;
    if (data) return std::move(*data);
  }
  throw gltf_error(file, "buffers", buffer, "its data are not base64");
}

// Returns the bytes from the first to the end of the last of `count` elements.
std::optional<std::size_t> extent_of(std::size_t count, std::size_t size, std::size_t stride) {
  if (count == 0) return 0;
  constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
  if (stride > 0 && count - 1 > (most - size) / stride) return std::nullopt;
  return (count - 1) * stride + size;
}

// Calls `visit` with a zero of the component's type, and returns its result; a component of an
// unknown type counts as a float.
template <class Visit>
auto with_component(int component, const Visit& visit) {
  switch (component) {
    case gltf_byte:
      return visit(std::int8_t{});
    case gltf_ubyte:
      return visit(std::uint8_t{});
    case gltf_short:
      return visit(std::int16_t{});
    case gltf_ushort:
      return visit(std::uint16_t{});
    case gltf_uint:
      return visit(std::uint32_t{});
    default:
      return visit(float{});
  }
}

// Used bytes of a buffer: elements of `size` bytes every `stride` bytes.
struct GltfRange {
  std::size_t buffer = 0, begin = 0, end = 0, stride = 0, size = 0;
};

bool overlap(const GltfRange& a, const GltfRange& b) {
  if (a.buffer != b.buffer || a.begin >= b.end || b.begin >= a.end) return false;
  const bool same_steps = a.stride == b.stride && a.stride > a.size && a.size + b.size <= a.stride;
  if (!same_steps) return true;
  // Interleaved ranges do not overlap if their elements are side by side in each step.
  const std::size_t s = a.stride, ahead = (b.begin % s + s - a.begin % s) % s;
  return ahead < a.size || s - ahead < b.size;
}

std::optional<GltfRange> range_in_view(const GltfModel& model, std::size_t view, std::size_t offset,
                                       std::size_t count, std::size_t size, std::size_t stride) {
  if (view >= model.views.size() || count == 0) return std::nullopt;
  const GltfView& v = model.views[view];
  const std::size_t begin = v.offset + offset;
  const auto extent = extent_of(count, size, stride);
  if (!extent || begin < offset || *extent > std::numeric_limits<std::size_t>::max() - begin)
    return GltfRange{v.buffer, 0, std::numeric_limits<std::size_t>::max(), 0, 0};
  return GltfRange{v.buffer, begin, begin + *extent, stride, size};
}

// Returns the ranges of the values, then of the data of a sparse accessor.
std::vector<GltfRange> ranges_of(const GltfModel& model, const GltfAccessor& accessor) {
  std::vector<GltfRange> ranges;
  const auto add = [&](const std::optional<GltfRange>& range) {
    if (range) ranges.push_back(*range);
  };
  const std::size_t size = size_of_component(accessor.component) * accessor.width;
  if (accessor.view && *accessor.view < model.views.size()) {
    const std::size_t stride = model.views[*accessor.view].stride;
    add(range_in_view(model, *accessor.view, accessor.offset, accessor.count, size,
                      stride > 0 ? stride : size));
  }
  if (!accessor.sparse) return ranges;
  const GltfSparse& sparse = *accessor.sparse;
  const std::size_t index_size = size_of_component(sparse.index_component);
  add(range_in_view(model, sparse.value_view, sparse.value_offset, sparse.count, size, size));
  add(range_in_view(model, sparse.index_view, sparse.index_offset, sparse.count, index_size,
                    index_size));
  return ranges;
}

}  // namespace

std::string load_gltf_buffer(const GltfFile& file, const GltfModel& model, std::size_t buffer) {
  switch (model.buffers[buffer].place) {
    case GltfBuffer::Place::binary_chunk:
      return file.bytes.substr(file.binary->begin, file.binary->size);
    case GltfBuffer::Place::in_text:
      return gltf_data_in_text(file, buffer);
    case GltfBuffer::Place::beside:
      return gltf_file_beside(file, model, buffer);
    default:
      throw gltf_error(file, "buffers", buffer, "nothing says where its bytes are");
  }
}

void GltfBuffers::load(const GltfFile& file, const GltfModel& model, std::size_t buffer) {
  loaded_.resize(model.buffers.size());
  Loaded& loaded = loaded_[buffer];
  if (loaded.is_there) return;
  loaded.in_file = model.buffers[buffer].place == GltfBuffer::Place::binary_chunk;
  if (!loaded.in_file)
    loaded.bytes = std::make_shared<const std::string>(load_gltf_buffer(file, model, buffer));
  const std::size_t found = loaded.in_file ? file.binary->size : loaded.bytes->size();
  if (found < model.buffers[buffer].size) {
    throw gltf_error(
        file, "buffers", buffer,
        fmt::format("{} bytes are stated, but there are {}", model.buffers[buffer].size, found));
  }
  loaded.is_there = true;
}

bool GltfBuffers::is_loaded(std::size_t buffer) const {
  return buffer < loaded_.size() && loaded_[buffer].is_there;
}

std::string_view GltfBuffers::bytes(const GltfFile& file, std::size_t buffer) const {
  const Loaded& loaded = loaded_[buffer];
  if (!loaded.in_file) return *loaded.bytes;
  return std::string_view(file.bytes).substr(file.binary->begin, file.binary->size);
}

std::size_t GltfBuffers::size_beside() const {
  std::size_t size = 0;
  for (const Loaded& loaded : loaded_) size += loaded.bytes ? loaded.bytes->size() : 0;
  return size;
}

GltfNumbers::GltfNumbers(const GltfFile& file, const GltfModel& model, GltfBuffers& buffers,
                         std::size_t accessor_index, std::size_t width)
    : file_(file), model_(model), buffers_(buffers), index_(accessor_index), width_(width) {
  const GltfAccessor& a = accessor();
  if (a.width != width_) {
    throw error(width_ == 1 ? "expected single numbers"
                            : fmt::format("expected vectors of {} numbers", width_));
  }
  if (size_of_component(a.component) == 0)
    throw error(fmt::format("component type {} does not exist", a.component));
  if (a.component != gltf_float && (!a.normalized || a.component == gltf_uint))
    throw error("expected floats or normalized integers of 8 or 16 bits");
  if (a.view) check_view(*a.view, a.offset, a.count, element_size(), stride());
  if (a.sparse) check_sparse();
  // Without a view no bytes confirm the count. Chosen by hand.
  constexpr std::size_t most_zeros = std::size_t{1} << 16;
  if (!a.view && a.count > most_zeros) throw error(fmt::format("{} zeros are too many", a.count));
}

Error GltfNumbers::error(std::string_view message) const {
  return gltf_error(file_, "accessors", index_, message);
}

std::size_t GltfNumbers::element_size() const {
  return size_of_component(accessor().component) * width_;
}

std::size_t GltfNumbers::stride() const {
  const std::size_t view = *accessor().view;
  const std::size_t stated = view < model_.views.size() ? model_.views[view].stride : 0;
  return stated > 0 ? stated : element_size();
}

void GltfNumbers::check_view(std::size_t view, std::size_t offset, std::size_t count,
                             std::size_t size, std::size_t stride) const {
  if (view >= model_.views.size()) throw error("its buffer view is not there");
  const GltfView& v = model_.views[view];
  if (!v.coded.empty())
    throw gltf_error(file_, "bufferViews", view, fmt::format("compressed by {}: refused", v.coded));
  if (v.buffer >= model_.buffers.size())
    throw gltf_error(file_, "bufferViews", view, "its buffer is not there");
  const std::size_t whole = model_.buffers[v.buffer].size;
  if (v.offset > whole || v.size > whole - v.offset)
    throw gltf_error(file_, "bufferViews", view, "it reaches beyond its buffer");
  if (stride < size) throw gltf_error(file_, "bufferViews", view, "its stride is too short");
  const auto extent = extent_of(count, size, stride);
  if (offset > v.size || !extent || *extent > v.size - offset)
    throw error("it reaches beyond its buffer view");
  buffers_.load(file_, model_, v.buffer);
}

void GltfNumbers::check_sparse() const {
  const GltfSparse& sparse = *accessor().sparse;
  const std::size_t index_size = size_of_component(sparse.index_component);
  const int type = sparse.index_component;
  if (type != gltf_ubyte && type != gltf_ushort && type != gltf_uint)
    throw error("its sparse indices are no whole numbers");
  if (sparse.count > accessor().count) throw error("more sparse values than elements");
  check_view(sparse.index_view, sparse.index_offset, sparse.count, index_size, index_size);
  check_view(sparse.value_view, sparse.value_offset, sparse.count, element_size(), element_size());
  for (std::size_t i = 0; i < sparse.count; ++i) {
    if (sparse_index(i) >= accessor().count) throw error("a sparse index is out of range");
  }
}

std::size_t GltfNumbers::sparse_index(std::size_t i) const {
  const GltfSparse& sparse = *accessor().sparse;
  const GltfView& view = model_.views[sparse.index_view];
  const std::size_t size = size_of_component(sparse.index_component);
  const std::size_t at = view.offset + sparse.index_offset + i * size;
  const char* const bytes = buffers_.bytes(file_, view.buffer).data() + at;
  return static_cast<std::size_t>(read_component(bytes, sparse.index_component, false));
}

template <class Visit>
void GltfNumbers::for_each_stored(const Visit& visit) const {
  const GltfAccessor& a = accessor();
  const auto place_in = [&](std::size_t view, std::size_t offset) {
    return GltfPlace{model_.views[view].buffer, model_.views[view].offset + offset};
  };
  for (std::size_t i = 0, step = a.view ? stride() : 0; a.view && i < a.count; ++i)
    visit(i, place_in(*a.view, a.offset + i * step));
  for (std::size_t i = 0; a.sparse && i < a.sparse->count; ++i) {
    visit(sparse_index(i),
          place_in(a.sparse->value_view, a.sparse->value_offset + i * element_size()));
  }
}

std::vector<double> GltfNumbers::values() const {
  const GltfAccessor& a = accessor();
  const std::size_t component = size_of_component(a.component);
  std::vector<double> values(a.count * width_);
  for_each_stored([&](std::size_t element, GltfPlace place) {
    const char* const bytes = buffers_.bytes(file_, place.buffer).data() + place.at;
    for (std::size_t c = 0; c < width_; ++c) {
      values[element * width_ + c] =
          read_component(bytes + c * component, a.component, a.normalized);
    }
  });
  return values;
}

std::vector<std::optional<GltfPlace>> GltfNumbers::places() const {
  std::vector<std::optional<GltfPlace>> places(count());
  for_each_stored([&](std::size_t element, GltfPlace place) { places[element] = place; });
  return places;
}

std::size_t size_of_component(int component) {
  const bool exists =
      component >= gltf_byte && component <= gltf_float && component != gltf_uint - 1;
  return exists ? with_component(component, [](auto zero) { return sizeof zero; }) : 0;
}

double read_component(const char* bytes, int component, bool normalized) {
  static_assert(std::endian::native == std::endian::little, "glTF holds little-endian numbers");
  return with_component(component, [&]<class T>(T value) -> double {
    std::memcpy(&value, bytes, sizeof value);
    if constexpr (std::is_floating_point_v<T>) {
      return value;
    } else {
      const double whole = value;
      return normalized ? std::max(whole / std::numeric_limits<T>::max(), -1.0) : whole;
    }
  });
}

bool store_component(double value, int component, bool normalized, char* bytes) {
  return with_component(component, [&]<class T>(T stored) {
    using Limits = std::numeric_limits<T>;
    if constexpr (std::is_floating_point_v<T>) {
      stored = static_cast<T>(value);
      if (component != gltf_float || !std::isfinite(stored)) return false;
    } else {
      const double least = normalized && Limits::is_signed ? -static_cast<double>(Limits::max())
                                                           : static_cast<double>(Limits::min());
      const double steps = std::round(normalized ? value * Limits::max() : value);
      if (component == gltf_uint ||
          !(steps >= least && steps <= static_cast<double>(Limits::max())))
        return false;
      stored = static_cast<T>(steps);
    }
    std::memcpy(bytes, &stored, sizeof stored);
    return true;
  });
}

bool is_stored_alone(const GltfModel& model, std::size_t accessor) {
  const std::vector<GltfRange> own = ranges_of(model, model.accessors[accessor]);
  const auto meets = [&](const GltfRange& other) {
    return std::any_of(own.begin(), own.end(),
                       [&](const GltfRange& range) { return overlap(range, other); });
  };
  for (std::size_t a = 0; a < model.accessors.size(); ++a) {
    if (a == accessor) continue;
    const auto ranges = ranges_of(model, model.accessors[a]);
    if (std::any_of(ranges.begin(), ranges.end(), meets)) return false;
  }
  for (const std::size_t view : model.image_views) {
    if (view >= model.views.size()) continue;
    const GltfView& v = model.views[view];
    if (meets({v.buffer, v.offset, v.offset + v.size, 0, v.size})) return false;
  }
  return true;
}

}  // namespace kinemend
