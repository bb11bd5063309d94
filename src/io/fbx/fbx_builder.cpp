// Encodes records, packs long arrays, and ends the file as readers expect.
#include "io/fbx/fbx_builder.hpp"

#include "base/portable.hpp"
#include "io/fbx/fbx_tree.hpp"
#include "io/fbx/fbx_values.hpp"

namespace kinemend {

namespace {

constexpr std::size_t built_header_bytes = 25;
constexpr std::uint32_t built_version = 7500;
// Shorter arrays are not packed, as in the files of Autodesk's programs.
constexpr std::size_t least_packed_bytes = 128;
// Follows the records and must match the FileId and CreationTime of `write_head` in fbx_new_file.
constexpr std::string_view footer_id{
    "\xFA\xBC\xAB\x09\xD0\xC8\xD4\x66\xB1\x76\xFB\x83\x1C\xF7\x26\x7E", 16};
constexpr std::string_view last_bytes{
    "\xF8\x5A\x8C\x6A\xDE\xF5\xD9\x7E\xEC\xE9\x0C\xE3\x75\x8F\x29\x0B", 16};

template <class Number>
std::string words_of(std::span<const Number> values) {
  std::string content(values.size() * sizeof(Number), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    char* const place = content.data() + i * sizeof(Number);
    if constexpr (sizeof(Number) == 8) {
      put_fbx_word(place, static_cast<std::uint64_t>(values[i]), false);
    } else {
      put_fbx_word(place, bits_as<std::uint32_t>(values[i]), false);
    }
  }
  return content;
}

}  // namespace

FbxBuilder::FbxBuilder() : bytes_("Kaydara FBX Binary  \0\x1A\0", 23) { append(built_version); }

template <class Word>
void FbxBuilder::append(Word word) {
  bytes_.resize(bytes_.size() + sizeof(Word));
  put_fbx_word(bytes_.data() + bytes_.size() - sizeof(Word), word, false);
}

void FbxBuilder::end_properties() {
  if (open_.empty() || open_.back().has_children) return;
  Level& level = open_.back();
  put_fbx_word(bytes_.data() + level.begin + 8, level.properties, false);
  put_fbx_word(bytes_.data() + level.begin + 16,
               std::uint64_t{bytes_.size() - level.properties_begin}, false);
}

FbxBuilder& FbxBuilder::open(std::string_view name) {
  end_properties();
  if (!open_.empty()) open_.back().has_children = true;
  Level level;
  level.begin = bytes_.size();
  bytes_.append(built_header_bytes - 1, '\0');
  bytes_ += static_cast<char>(name.size());
  bytes_ += name;
  level.properties_begin = bytes_.size();
  open_.push_back(level);
  return *this;
}

void FbxBuilder::close() {
  end_properties();
  const Level level = open_.back();
  // A record without properties ends like a record with children.
  if (level.has_children || level.properties == 0) bytes_.append(built_header_bytes, '\0');
  put_fbx_word(bytes_.data() + level.begin, std::uint64_t{bytes_.size()}, false);
  open_.pop_back();
}

void FbxBuilder::put(char type, std::string_view bytes) {
  bytes_ += type;
  bytes_ += bytes;
  ++open_.back().properties;
}

FbxBuilder& FbxBuilder::integer(std::int32_t value) {
  put('I', {});
  append(static_cast<std::uint32_t>(value));
  return *this;
}

FbxBuilder& FbxBuilder::id(std::int64_t value) {
  put('L', {});
  append(static_cast<std::uint64_t>(value));
  return *this;
}

FbxBuilder& FbxBuilder::number(double value) {
  put('D', {});
  append(bits_as<std::uint64_t>(value));
  return *this;
}

FbxBuilder& FbxBuilder::string(std::string_view value) {
  put('S', {});
  append(static_cast<std::uint32_t>(value.size()));
  bytes_ += value;
  return *this;
}

FbxBuilder& FbxBuilder::raw(std::string_view value) {
  put('R', {});
  append(static_cast<std::uint32_t>(value.size()));
  bytes_ += value;
  return *this;
}

void FbxBuilder::put_array(char type, std::size_t count, const std::string& content) {
  put(type, {});
  append(static_cast<std::uint32_t>(count));
  const bool is_packed = content.size() >= least_packed_bytes;
  const std::string data = is_packed ? fbx_zlib(content) : content;
  append(std::uint32_t{is_packed ? 1u : 0u});
  append(static_cast<std::uint32_t>(data.size()));
  bytes_ += data;
}

FbxBuilder& FbxBuilder::array(std::span<const std::int64_t> values) {
  put_array('l', values.size(), words_of(values));
  return *this;
}

FbxBuilder& FbxBuilder::array(std::span<const std::int32_t> values) {
  put_array('i', values.size(), words_of(values));
  return *this;
}

FbxBuilder& FbxBuilder::array(std::span<const float> values) {
  put_array('f', values.size(), words_of(values));
  return *this;
}

void FbxBuilder::add(std::string_view name, std::int32_t value) {
  open(name).integer(value).close();
}

void FbxBuilder::add(std::string_view name, std::string_view value) {
  open(name).string(value).close();
}

FbxBuilder& FbxBuilder::property(std::string_view name, std::string_view type,
                                 std::string_view label, std::string_view flags) {
  return open("P").string(name).string(type).string(label).string(flags);
}

void FbxBuilder::set_integer(std::string_view name, std::string_view type, std::int32_t value) {
  property(name, type, type == "int" ? "Integer" : "", "").integer(value).close();
}

void FbxBuilder::set_number(std::string_view name, std::string_view type, std::string_view label,
                            std::string_view flags, double value) {
  property(name, type, label, flags).number(value).close();
}

void FbxBuilder::set_time(std::string_view name, std::int64_t ticks) {
  property(name, "KTime", "Time", "").id(ticks).close();
}

void FbxBuilder::set_vector(std::string_view name, std::string_view type, std::string_view label,
                            std::string_view flags, Vec3 value) {
  property(name, type, label, flags).number(value.x).number(value.y).number(value.z).close();
}

std::string FbxBuilder::finish() && {
  bytes_.append(built_header_bytes, '\0');
  bytes_ += footer_id;
  // One to sixteen zeros align the following bytes.
  bytes_.append(16 - bytes_.size() % 16, '\0');
  bytes_.append(4, '\0');
  append(built_version);
  bytes_.append(120, '\0');
  bytes_ += last_bytes;
  return std::move(bytes_);
}

}  // namespace kinemend
