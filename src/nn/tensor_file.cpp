// Reads and writes safetensors files. The header is parsed as a stream of JSON events, and its
// tensors must cover the data without overlap; values that a type cannot hold are rejected.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/portable.hpp"
#include "base/text.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/tensor.hpp"
#include "nn/half.hpp"

namespace kinemend {

// The most dimensions of a tensor, chosen by hand.
inline constexpr std::string_view metadata_key = "__metadata__";
inline constexpr std::size_t most_dimensions = 32;

/// "F32"
std::string_view safetensors_name(TensorType type);
std::size_t bytes_per_value(TensorType type);

struct TensorEntry {
  std::string name;
  TensorType type = TensorType::f32;
  std::vector<std::size_t> shape;
  std::size_t count = 0;  ///< number of values
  std::size_t begin = 0;  ///< of its bytes, from the start of the data
  std::size_t end = 0;
};

struct TensorHeader {
  std::map<std::string, std::string, std::less<>> metadata;
  std::vector<TensorEntry> entries;  ///< in the order of their bytes, which fill the data
  std::size_t data_begin = 0;        ///< in the file
};

/// Reads the header and checks it against the length of the file. Errors: those of `parse_tensors`.
TensorHeader parse_tensor_header(std::string_view bytes, std::string_view name);

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

namespace {

using Json = nlohmann::json;

// By definition of safetensors.
constexpr std::size_t length_bytes = 8;

struct StoredType {
  TensorType type;
  std::string_view name;
  std::size_t bytes;
};
constexpr std::array<StoredType, 6> stored_types = {{{TensorType::f64, "F64", 8},
                                                     {TensorType::f32, "F32", 4},
                                                     {TensorType::f16, "F16", 2},
                                                     {TensorType::i32, "I32", 4},
                                                     {TensorType::i8, "I8", 1},
                                                     {TensorType::u8, "U8", 1}}};

const StoredType& stored_type(TensorType type) {
  return stored_types[static_cast<std::size_t>(type)];
}

// Iterates over the header for the JSON parser, and exposes the position reached.
class Cursor {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Cursor(const char* at, const char** seen) : at_(at), seen_(seen) {}
  reference operator*() const { return *at_; }
  Cursor& operator++() {
    *seen_ = ++at_;
    return *this;
  }
  Cursor operator++(int) {
    Cursor before = *this;
    ++*this;
    return before;
  }
  bool operator==(const Cursor& other) const { return at_ == other.at_; }

 private:
  const char* at_;
  const char** seen_;
};

// Receives the parser's events. Content that the format does not allow is rejected at once, so that
// neither depth nor size of the JSON matters.
class HeaderReader : public nlohmann::json_sax<Json> {
 public:
  HeaderReader(std::string_view file, std::string_view header, std::string_view name)
      : file_(file), header_(header), name_(name), seen_(header.data()) {
    const char* end = header.data() + header.size();
    Json::sax_parse(Cursor(header.data(), &seen_), Cursor(end, &seen_), this);
  }

  std::map<std::string, std::string, std::less<>> metadata;
  std::vector<TensorEntry> entries;

  bool start_object(std::size_t) override {
    if (place_ == Place::start) return go_to(Place::top);
    if (place_ == Place::metadata_value_of_top) return go_to(Place::metadata);
    if (place_ == Place::entry_of_top) return go_to(Place::entry);
    refuse("an object");
  }
  bool end_object() override {
    if (place_ == Place::entry) finish_entry();
    return go_to(place_ == Place::top ? Place::end : Place::top);
  }
  bool key(std::string& text) override {
    if (place_ == Place::top) return begin_member(text);
    if (place_ == Place::metadata) {
      if (metadata.contains(text)) refuse_duplicate(text);
      key_ = std::move(text);
      return go_to(Place::metadata_text);
    }
    return begin_field(text);
  }
  bool string(std::string& text) override {
    if (place_ == Place::metadata_text) {
      metadata.emplace(std::move(key_), std::move(text));
      return go_to(Place::metadata);
    }
    if (place_ != Place::dtype) refuse(quote_text(text));
    const auto* found = std::find_if(stored_types.begin(), stored_types.end(),
                                     [&](const StoredType& type) { return type.name == text; });
    if (found == stored_types.end()) refuse(quote_text(text));
    type_ = found->type;
    return go_to(Place::entry);
  }
  bool start_array(std::size_t) override {
    if (place_ == Place::shape) return go_to(Place::shape_values);
    if (place_ == Place::offsets) return go_to(Place::offset_values);
    refuse("an array");
  }
  bool end_array() override {
    if (place_ == Place::offset_values && offsets_->size() != 2)
      refuse(fmt::format("{} of them", offsets_->size()));
    return go_to(Place::entry);
  }
  bool number_unsigned(std::uint64_t value) override {
    const bool in_shape = place_ == Place::shape_values;
    auto& list = in_shape ? shape_ : offsets_;
    const std::size_t most = in_shape ? most_dimensions : 2;
    const bool fits = value <= std::numeric_limits<std::size_t>::max();
    if ((!in_shape && place_ != Place::offset_values) || !fits || list->size() == most)
      refuse(fmt::format("{}", value), 2);
    list->push_back(static_cast<std::size_t>(value));
    return true;
  }
  bool number_integer(std::int64_t value) override { refuse(fmt::format("{}", value), 2); }
  bool number_float(double, const std::string& text) override { refuse(quote(text), 2); }
  bool boolean(bool value) override { refuse(value ? "true" : "false"); }
  bool null() override { refuse("null"); }
  bool binary(Json::binary_t&) override { refuse("bytes"); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    const std::size_t at = offset(1);
    const std::string_view rest = header_.substr(std::min(at - length_bytes, header_.size()));
    const bool at_end = rest.find_first_not_of(" \t\r\n") == rest.npos;
    throw Error::at_byte(name_, at,
                         fmt::format("expected a header in JSON, found {}",
                                     at_end ? "the end of the header" : quote(rest)));
  }

 private:
  enum class Place : std::uint8_t {
    start,
    top,
    metadata_value_of_top,
    metadata,
    metadata_text,
    entry_of_top,
    entry,
    dtype,
    shape,
    shape_values,
    offsets,
    offset_values,
    end
  };

  bool go_to(Place place) {
    place_ = place;
    return true;
  }

  bool begin_member(std::string& text) {
    if (!members_.insert(text).second) refuse_duplicate(text);
    if (text == metadata_key) return go_to(Place::metadata_value_of_top);
    key_ = std::move(text);
    type_.reset();
    shape_.reset();
    offsets_.reset();
    return go_to(Place::entry_of_top);
  }

  bool begin_field(const std::string& text) {
    const bool is_known = text == "dtype" || text == "shape" || text == "data_offsets";
    if (!is_known) refuse(quote_text(text));
    if (text == "dtype") {
      if (type_) refuse_duplicate(text);
      return go_to(Place::dtype);
    }
    auto& list = text == "shape" ? shape_ : offsets_;
    if (list) refuse_duplicate(text);
    list.emplace();
    return go_to(text == "shape" ? Place::shape : Place::offsets);
  }

  void finish_entry() {
    const char* missing = !type_ ? "dtype" : !shape_ ? "shape" : !offsets_ ? "data_offsets" : "";
    if (*missing != 0)
      throw Error::at_byte(name_, offset(1),
                           fmt::format("tensor {}: {} is missing", quote_text(key_), missing));
    entries.push_back(
        {std::move(key_), *type_, std::move(*shape_), 0, (*offsets_)[0], (*offsets_)[1]});
  }

  std::string_view expected() const {
    switch (place_) {
      case Place::start:
      case Place::top:
      case Place::end:
        return "a JSON object of tensors";
      case Place::metadata_value_of_top:
      case Place::metadata:
      case Place::metadata_text:
        return "texts in __metadata__";
      case Place::entry_of_top:
      case Place::entry:
        return "an object of dtype, shape and data_offsets";
      case Place::dtype:
        return "a dtype of F64, F32, F16, I32, I8, U8";
      case Place::shape:
      case Place::shape_values:
        return "a shape of at most 32 whole numbers";
      case Place::offsets:
      case Place::offset_values:
        return "two whole numbers as data_offsets";
    }
    return "";
  }

  // In a message an empty text must not appear as the file's end.
  static std::string quote_text(std::string_view text) {
    return text.empty() ? "\"\"" : quote(text);
  }

  // The offset of a token that ends `back` bytes before the parser's position.
  std::size_t offset(std::ptrdiff_t back) const {
    const std::ptrdiff_t read = seen_ - file_.data();
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(read - back, length_bytes));
  }

  [[noreturn]] void refuse(std::string_view found, std::ptrdiff_t back = 1) const {
    const bool in_entry = place_ >= Place::entry_of_top && place_ != Place::end;
    const std::string subject = in_entry ? fmt::format("tensor {}: ", quote_text(key_)) : "";
    throw Error::at_byte(name_, offset(back),
                         fmt::format("{}expected {}, found {}", subject, expected(), found));
  }

  [[noreturn]] void refuse_duplicate(std::string_view text) const {
    throw Error::at_byte(name_, offset(1),
                         fmt::format("expected each name once, found {} again", quote_text(text)));
  }

  std::string_view file_, header_, name_;
  const char* seen_;
  Place place_ = Place::start;
  std::set<std::string, std::less<>> members_;
  std::string key_;
  std::optional<TensorType> type_;
  std::optional<std::vector<std::size_t>> shape_, offsets_;
};

std::uint64_t header_length(std::string_view bytes) {
  std::uint64_t length = 0;
  for (std::size_t i = length_bytes; i-- > 0;)
    length = length << 8 | static_cast<unsigned char>(bytes[i]);
  return length;
}

// The text of the header within the file.
std::string_view header_of(std::string_view bytes, std::string_view name) {
  if (bytes.size() < length_bytes) {
    throw Error::at_byte(
        name, 0,
        fmt::format("expected 8 bytes with the length of a header, found {}", bytes.size()));
  }
  const std::uint64_t length = header_length(bytes);
  const std::size_t room = bytes.size() - length_bytes;
  if (length > room) {
    throw Error::at_byte(name, 0,
                         fmt::format("expected a header of at most {} bytes, which the file has, "
                                     "found a length of {}",
                                     room, length));
  }
  const std::string_view header = bytes.substr(length_bytes, static_cast<std::size_t>(length));
  if (header.empty() || header.front() != '{') {
    throw Error::at_byte(name, length_bytes,
                         fmt::format("expected a header that begins with {{, found {}",
                                     quote(bytes.substr(length_bytes, 20))));
  }
  // The parser would take a zero byte for the end.
  if (const std::size_t zero = header.find('\0'); zero != header.npos)
    throw Error::at_byte(name, length_bytes + zero, "expected a header in JSON, found a zero byte");
  return header;
}

// None if the count overflows.
std::optional<std::size_t> value_count(const std::vector<std::size_t>& shape) {
  std::size_t count = 1;
  for (const std::size_t length : shape) {
    if (length != 0 && count > std::numeric_limits<std::size_t>::max() / length) return {};
    count *= length;
  }
  return count;
}

Error entry_error(const TensorEntry& entry, std::string_view name, std::string_view message) {
  return Error::at_byte(name, length_bytes,
                        fmt::format("tensor {}: {}", quote(entry.name), message));
}

void check_span(TensorEntry& entry, std::size_t data_size, std::string_view name) {
  if (entry.begin > entry.end || entry.end > data_size) {
    throw entry_error(entry, name,
                      fmt::format("expected data_offsets within the {} bytes of data, found {}",
                                  data_size, fmt::join({entry.begin, entry.end}, " to ")));
  }
  const auto count = value_count(entry.shape);
  const std::size_t span = entry.end - entry.begin, each = bytes_per_value(entry.type);
  if (!count || *count > data_size || *count * each != span) {
    throw entry_error(entry, name,
                      fmt::format("expected the bytes of {} of shape {}, found {}",
                                  safetensors_name(entry.type), entry.shape, span));
  }
  entry.count = *count;
}

// Sorts the entries and checks that they cover the data without overlap or gap.
void check_cover(std::vector<TensorEntry>& entries, std::size_t data_size, std::string_view name) {
  std::sort(entries.begin(), entries.end(), [](const TensorEntry& a, const TensorEntry& b) {
    return std::tie(a.begin, a.end, a.name) < std::tie(b.begin, b.end, b.name);
  });
  std::size_t covered = 0;
  for (const TensorEntry& entry : entries) {
    if (entry.begin != covered) {
      throw entry_error(entry, name,
                        fmt::format("expected its data at {}, where that of the one before ends, "
                                    "found {}",
                                    covered, entry.begin));
    }
    covered = entry.end;
  }
  if (covered != data_size) {
    throw Error::at_byte(
        name, length_bytes,
        fmt::format("expected tensors of {} bytes in all, found {}", data_size, covered));
  }
}

}  // namespace

std::string_view safetensors_name(TensorType type) { return stored_type(type).name; }
std::size_t bytes_per_value(TensorType type) { return stored_type(type).bytes; }

TensorHeader parse_tensor_header(std::string_view bytes, std::string_view name) {
  const std::string_view header = header_of(bytes, name);
  HeaderReader reader(bytes, header, name);
  TensorHeader result{std::move(reader.metadata), std::move(reader.entries),
                      length_bytes + header.size()};
  const std::size_t data_size = bytes.size() - result.data_begin;
  for (TensorEntry& entry : result.entries) check_span(entry, data_size, name);
  check_cover(result.entries, data_size, name);
  return result;
}

}  // namespace kinemend
