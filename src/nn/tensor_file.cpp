// Reads and writes safetensors files, and rejects values that a type cannot hold.
#include "kinemend/experimental/tensor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "base/bits.hpp"
#include "base/quote.hpp"
#include "kinemend/error.hpp"
#include "nn/half.hpp"
#include "nn/tensor_header.hpp"

namespace kinemend {

namespace {

using OrderedJson = nlohmann::ordered_json;

// Bytes, by definition of safetensors.
constexpr std::size_t alignment = 8;

// The bytes of a stored number, lowest first whatever the machine.
template <class Word>
Word load(const char* bytes) {
  Word word = 0;
  for (std::size_t i = 0; i < sizeof word; ++i) {
    word = static_cast<Word>(
        word |
        static_cast<Word>(static_cast<Word>(static_cast<unsigned char>(bytes[i])) << (8 * i)));
  }
  return word;
}
template <class Word>
void store(Word word, std::string& bytes) {
  for (std::size_t i = 0; i < sizeof word; ++i)
    bytes += static_cast<char>(static_cast<unsigned char>(word >> (8 * i)));
}

// The rules of each type: decoding a word, encoding a value, and whether a value fits.
struct Half {
  using Word = std::uint16_t;
  static double decode(Word word) { return from_half(word); }
  static Word encode(double value) { return to_half(value); }
  static bool fits(double value) { return std::isfinite(from_half(to_half(value))); }
};
template <class Number>
struct Real {
  using Word = std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t>;
  static double decode(Word word) { return static_cast<double>(bits_as<Number>(word)); }
  static Word encode(double value) { return bits_as<Word>(static_cast<Number>(value)); }
  static bool fits(double value) { return std::abs(value) <= std::numeric_limits<Number>::max(); }
};
template <class Number>
struct Whole {
  using Word = std::make_unsigned_t<Number>;
  static double decode(Word word) { return static_cast<double>(static_cast<Number>(word)); }
  static Word encode(double value) {
    return static_cast<Word>(static_cast<Number>(std::nearbyint(value)));
  }
  static bool fits(double value) {
    const double rounded = std::nearbyint(value);
    return rounded >= static_cast<double>(std::numeric_limits<Number>::min()) &&
           rounded <= static_cast<double>(std::numeric_limits<Number>::max());
  }
};

// Calls `action` with the rules of the type.
template <class Action>
void with_type(TensorType type, Action&& action) {
  switch (type) {
    case TensorType::f64:
      return action(Real<double>{});
    case TensorType::f32:
      return action(Real<float>{});
    case TensorType::f16:
      return action(Half{});
    case TensorType::i32:
      return action(Whole<std::int32_t>{});
    case TensorType::i8:
      return action(Whole<std::int8_t>{});
    case TensorType::u8:
      return action(Whole<std::uint8_t>{});
  }
}

Tensor read_tensor(const TensorEntry& entry, std::string_view bytes, std::size_t data_begin,
                   std::string_view name) {
  Tensor tensor{entry.type, entry.shape, std::vector<double>(entry.count)};
  with_type(entry.type, [&]<class Rules>(Rules) {
    constexpr std::size_t step = sizeof(typename Rules::Word);
    const std::size_t begin = data_begin + entry.begin;
    for (std::size_t i = 0; i < entry.count; ++i) {
      const std::size_t at = begin + i * step;
      tensor.values[i] = Rules::decode(load<typename Rules::Word>(bytes.data() + at));
      if (std::isfinite(tensor.values[i])) continue;
      throw Error::at_byte(name, at,
                           fmt::format("tensor {}: expected a finite number, found {}",
                                       quote(entry.name), tensor.values[i]));
    }
  });
  return tensor;
}

[[noreturn]] void refuse(std::string_view name, std::string_view message) {
  throw Error(ErrorKind::usage, fmt::format("tensor {}: {}", quote(name), message));
}

void check_shape(std::string_view name, const Tensor& tensor) {
  // Divides instead of multiplying, as the product may overflow.
  std::size_t rest = tensor.size();
  bool is_empty = false, divides = tensor.shape.size() <= most_dimensions;
  for (const std::size_t length : tensor.shape) {
    is_empty = is_empty || length == 0;
    divides = divides && (length == 0 || rest % length == 0);
    if (length != 0) rest /= length;
  }
  const bool fits = divides && (is_empty ? tensor.size() == 0 : rest == 1);
  if (!fits) refuse(name, fmt::format("{} values have not shape {}", tensor.size(), tensor.shape));
}

void append_values(std::string_view name, const Tensor& tensor, std::string& bytes) {
  with_type(tensor.stored, [&]<class Rules>(Rules) {
    for (const double value : tensor.values) {
      if (!std::isfinite(value) || !Rules::fits(value))
        refuse(name, fmt::format("{} is no number of {}", value, safetensors_name(tensor.stored)));
      store(Rules::encode(value), bytes);
    }
  });
}

std::string header_text(const TensorFile& file) {
  OrderedJson header = OrderedJson::object();
  if (!file.metadata.empty()) header[std::string(metadata_key)] = file.metadata;
  std::size_t offset = 0;
  for (const auto& [name, tensor] : file.tensors) {
    const std::size_t end = offset + tensor.size() * bytes_per_value(tensor.stored);
    OrderedJson entry;
    entry["dtype"] = safetensors_name(tensor.stored);
    entry["shape"] = tensor.shape;
    entry["data_offsets"] = {offset, end};
    header[name] = std::move(entry);
    offset = end;
  }
  std::string text;
  try {
    text = header.dump();
  } catch (const OrderedJson::type_error&) {
    throw Error(ErrorKind::usage, "names and metadata of tensors are to be UTF-8");
  }
  text.resize((text.size() + alignment - 1) / alignment * alignment, ' ');
  return text;
}

}  // namespace

TensorFile parse_tensors(std::string_view bytes, std::string_view name) {
  TensorHeader header = parse_tensor_header(bytes, name);
  TensorFile file;
  for (const TensorEntry& entry : header.entries)
    file.tensors.emplace(entry.name, read_tensor(entry, bytes, header.data_begin, name));
  file.metadata = std::move(header.metadata);
  return file;
}

std::string write_tensors(const TensorFile& file) {
  for (const auto& [name, tensor] : file.tensors) {
    if (name == metadata_key) refuse(name, "the name stands for metadata");
    check_shape(name, tensor);
  }
  const std::string header = header_text(file);
  std::string bytes;
  store(static_cast<std::uint64_t>(header.size()), bytes);
  bytes += header;
  for (const auto& [name, tensor] : file.tensors) append_values(name, tensor, bytes);
  return bytes;
}

}  // namespace kinemend
