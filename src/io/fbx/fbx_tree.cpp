// Detects the form of an FBX file, and walks over its records: a binary file has 32-bit or 64-bit
// headers in either byte order.
#include "io/fbx/fbx_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "base/text.hpp"
#include "io/fbx/fbx_values.hpp"
#include "io/text/text.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

constexpr std::string_view binary_magic{"Kaydara FBX Binary  \0", 21};

// Returns the version of a text whose first line does not state it.
std::uint32_t stated_version(const FbxTree& tree) {
  const std::uint32_t header = tree.child(no_fbx_record, "FBXHeaderExtension");
  if (header == no_fbx_record) return 0;
  const std::int64_t version = fbx_child_integer(tree, header, "FBXVersion", 0);
  return version > 0 && version < 100000 ? static_cast<std::uint32_t>(version) : 0;
}

}  // namespace

bool is_binary_fbx(std::string_view bytes) { return bytes.substr(0, 21) == binary_magic; }

std::uint32_t FbxTree::child(std::uint32_t parent, std::string_view child_name) const {
  std::uint32_t record = first_child_of(parent);
  while (record != no_fbx_record && name_of(records[record]) != child_name)
    record = records[record].next_sibling;
  return record;
}

Error FbxTree::error_at(std::size_t place, std::string_view message) const {
  return is_text ? Error::at_line(name, line_at(bytes, place), message)
                 : Error::at_byte(name, place, message);
}

FbxTree read_fbx_tree(std::string bytes, std::string_view name, std::size_t max_depth) {
  FbxTree tree;
  tree.name = std::string(name);
  tree.bytes = std::move(bytes);
  tree.is_text = !is_binary_fbx(tree.bytes);
  if (tree.is_text) {
    read_text_fbx_records(tree, max_depth);
    if (tree.version == 0) tree.version = stated_version(tree);
  } else {
    read_binary_fbx_records(tree, max_depth);
  }
  return tree;
}

void FbxRecordBuilder::open(const FbxRecord& record) {
  const auto index = static_cast<std::uint32_t>(tree_.records.size());
  std::uint32_t& last = open_.empty() ? last_root_ : open_.back().last_child;
  if (last != no_fbx_record) {
    tree_.records[last].next_sibling = index;
  } else if (open_.empty()) {
    tree_.first_root = index;
  } else {
    tree_.records[open_.back().record].first_child = index;
  }
  last = index;
  tree_.records.push_back(record);
  if (!open_.empty()) tree_.records.back().parent = open_.back().record;
  open_.push_back({index});
}

namespace {

constexpr std::size_t version_place = 23, first_record_place = 27;
constexpr std::size_t array_head_bytes = 12;

// Returns the bytes of one number by its type code, for properties and arrays; 0 for another code.
std::size_t fbx_number_bytes(char type) {
  switch (type) {
    case 'B':
    case 'C':
    case 'b':
    case 'c':
    case 'Z':
      return 1;
    case 'Y':
      return 2;
    case 'I':
    case 'F':
    case 'i':
    case 'f':
      return 4;
    case 'D':
    case 'L':
    case 'd':
    case 'l':
      return 8;
    default:
      return 0;
  }
}

class BinaryFbxReader {
 public:
  BinaryFbxReader(FbxTree& tree, std::size_t max_depth)
      : tree_(tree), builder_(tree), max_depth_(max_depth) {}

  void read() {
    read_head();
    place_ = first_record_place;
    while (true) {
      close_full_records();
      const bool is_end = !read_record();
      if (!is_end) continue;
      if (builder_.depth() == 0) break;
      end_children();
    }
    tree_.records_end = place_;
  }

 private:
  struct Header {
    std::uint64_t end = 0;
    std::uint64_t property_count = 0;
    std::uint64_t property_bytes = 0;
    std::uint8_t name_bytes = 0;
  };

  void read_head() {
    if (tree_.bytes.size() < first_record_place)
      throw tree_.error_at(tree_.bytes.size(), "the file ends in its head");
    tree_.is_big_endian = tree_.bytes[version_place - 1] == 1;
    tree_.version =
        fbx_word<std::uint32_t>(tree_.bytes.data() + version_place, tree_.is_big_endian);
  }

  std::size_t header_bytes() const { return tree_.has_wide_headers() ? 25 : 13; }

  // Returns the end of the open record.
  std::size_t limit() { return builder_.depth() == 0 ? tree_.bytes.size() : builder_.top().end; }

  Header header_at(std::size_t place) const {
    const char* const bytes = tree_.bytes.data() + place;
    const bool big = tree_.is_big_endian;
    if (tree_.has_wide_headers()) {
      return {fbx_word<std::uint64_t>(bytes, big), fbx_word<std::uint64_t>(bytes + 8, big),
              fbx_word<std::uint64_t>(bytes + 16, big), static_cast<std::uint8_t>(bytes[24])};
    }
    return {fbx_word<std::uint32_t>(bytes, big), fbx_word<std::uint32_t>(bytes + 4, big),
            fbx_word<std::uint32_t>(bytes + 8, big), static_cast<std::uint8_t>(bytes[12])};
  }

  void close_full_records() {
    while (builder_.depth() > 0 && place_ >= builder_.top().end) builder_.close();
  }

  // A record of zeros ends the children of the open record.
  void end_children() {
    if (place_ != builder_.top().end) {
      throw tree_.error_at(place_, "the records within a record end before the record does");
    }
  }

  // Reads a record; returns false for the record of zeros that ends a list.
  bool read_record() {
    if (limit() - place_ < header_bytes())
      throw tree_.error_at(place_, "the file ends in the head of a record");
    const Header header = header_at(place_);
    const std::size_t begin = place_;
    place_ += header_bytes();
    if (header.end == 0) return false;
    const std::size_t after_name = place_ + header.name_bytes;
    if (header.end > limit() || header.end < after_name ||
        header.property_bytes > header.end - after_name) {
      throw tree_.error_at(begin, fmt::format("a record claims to end at byte {}, outside of what "
                                              "holds it",
                                              header.end));
    }
    if (builder_.depth() >= max_depth_)
      throw tree_.error_at(begin, fmt::format("records are nested deeper than {}", max_depth_));
    open_record(begin, after_name, header);
    return true;
  }

  void open_record(std::size_t begin, std::size_t after_name, const Header& header) {
    FbxRecord record;
    record.begin = begin;
    record.end = header.end;
    record.properties_begin = after_name;
    record.properties_end = after_name + header.property_bytes;
    record.name_begin = static_cast<std::uint32_t>(header_bytes());
    record.name_size = header.name_bytes;
    record.first_property = static_cast<std::uint32_t>(tree_.properties.size());
    place_ = after_name;
    read_properties(record, header.property_count);
    builder_.open(record);
    place_ = record.properties_end;
  }

  void read_properties(FbxRecord& record, std::uint64_t count) {
    // Each property takes at least two bytes.
    if (count > (record.properties_end - place_) / 2 ||
        tree_.properties.size() + count > std::numeric_limits<std::uint32_t>::max()) {
      throw tree_.error_at(record.begin, fmt::format("a record claims {} properties", count));
    }
    record.property_count = static_cast<std::uint32_t>(count);
    for (std::uint64_t i = 0; i < count; ++i) read_property(record.properties_end);
    if (place_ != record.properties_end) {
      throw tree_.error_at(place_, "the properties of a record end before they should");
    }
  }

  void read_property(std::size_t end) {
    if (place_ >= end) throw tree_.error_at(place_, "a property lies outside of its record");
    const char type = tree_.bytes[place_++];
    const std::size_t room = end - place_;
    const std::size_t size = property_bytes(type, room);
    if (size > room) throw tree_.error_at(place_, "a property lies outside of its record");
    tree_.properties.push_back({place_, static_cast<std::uint32_t>(size), type});
    place_ += size;
  }

  // Returns the size of a property, including the head of a string or array.
  std::size_t property_bytes(char type, std::size_t room) const {
    const char* const bytes = tree_.bytes.data() + place_;
    const bool big = tree_.is_big_endian;
    if (type == 'S' || type == 'R')
      return room < 4 ? 4 : std::size_t{4} + fbx_word<std::uint32_t>(bytes, big);
    const std::size_t number = fbx_number_bytes(type);
    if (number == 0) {
      throw tree_.error_at(place_ - 1, fmt::format("unknown type of property: code {}",
                                                   static_cast<unsigned char>(type)));
    }
    if (type < 'a') return number;
    if (room < array_head_bytes) return array_head_bytes;
    const std::size_t count = fbx_word<std::uint32_t>(bytes, big);
    const std::uint32_t encoding = fbx_word<std::uint32_t>(bytes + 4, big);
    const std::size_t packed = fbx_word<std::uint32_t>(bytes + 8, big);
    return array_head_bytes + (encoding == 0 ? count * number : packed);
  }

  FbxTree& tree_;
  FbxRecordBuilder builder_;
  std::size_t max_depth_;
  std::size_t place_ = 0;
};

}  // namespace

void read_binary_fbx_records(FbxTree& tree, std::size_t max_depth) {
  BinaryFbxReader(tree, max_depth).read();
}

namespace {

bool is_fbx_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\0'; }

bool ends_fbx_word(char c) {
  return is_fbx_blank(c) || c == ',' || c == '{' || c == '}' || c == ':' || c == ';' || c == '"';
}

class TextFbxReader {
 public:
  TextFbxReader(FbxTree& tree, std::size_t max_depth)
      : tree_(tree), bytes_(tree.bytes), builder_(tree), max_depth_(max_depth) {}

  void read() {
    place_ = byte_order_mark_size(bytes_);
    read_version();
    while (skip_blanks()) {
      if (bytes_[place_] == '}') {
        end_block();
      } else {
        read_record();
      }
    }
    if (builder_.depth() > 0) {
      throw tree_.error_at(bytes_.size(), "the file ends within braces that are open");
    }
    if (tree_.records.empty()) throw tree_.error_at(0, "the file holds no records");
    tree_.records_end = bytes_.size();
  }

 private:
  // Reads the version from the first comment: `; FBX 7.4.0 project file`.
  void read_version() {
    const std::size_t found = bytes_.substr(0, 1024).find("FBX ");
    if (found == bytes_.npos) return;
    std::uint32_t parts[3] = {0, 0, 0};
    std::size_t part = 0;
    for (std::size_t i = found + 4; i < bytes_.size() && part < 3; ++i) {
      const char c = bytes_[i];
      if (c == '.') {
        ++part;
      } else if (c >= '0' && c <= '9' && parts[part] < 100) {
        parts[part] = 10 * parts[part] + static_cast<std::uint32_t>(c - '0');
      } else {
        break;
      }
    }
    tree_.version = 1000 * parts[0] + 100 * parts[1] + 10 * parts[2];
  }

  // Moves past blanks and comments; returns false at the end.
  bool skip_blanks() {
    while (place_ < bytes_.size()) {
      if (bytes_[place_] == ';') {
        place_ = std::min(bytes_.find('\n', place_), bytes_.size());
      } else if (is_fbx_blank(bytes_[place_])) {
        ++place_;
      } else {
        return true;
      }
    }
    return false;
  }

  std::size_t word_end(std::size_t from) const {
    while (from < bytes_.size() && !ends_fbx_word(bytes_[from])) ++from;
    return from;
  }

  Error unexpected(std::string_view wanted) const {
    return tree_.error_at(place_,
                          fmt::format("expected {}, found {}", wanted,
                                      quote(bytes_.substr(place_, word_end(place_ + 1) - place_))));
  }

  void end_block() {
    if (builder_.depth() == 0) throw tree_.error_at(place_, "a brace closes nothing");
    ++place_;
    builder_.top().end = place_;
    builder_.close();
  }

  void read_record() {
    const std::size_t end = word_end(place_);
    std::size_t colon = end;
    while (colon < bytes_.size() && (bytes_[colon] == ' ' || bytes_[colon] == '\t')) ++colon;
    if (end == place_ || colon >= bytes_.size() || bytes_[colon] != ':')
      throw unexpected("the name of a record");
    if (builder_.depth() >= max_depth_)
      throw tree_.error_at(place_, fmt::format("records are nested deeper than {}", max_depth_));
    FbxRecord record;
    record.begin = place_;
    record.name_size = static_cast<std::uint32_t>(end - place_);
    record.first_property = static_cast<std::uint32_t>(tree_.properties.size());
    const bool is_array = bytes_.substr(place_, end - place_) == "a" && holds_array();
    record.properties_begin = place_ = colon + 1;
    builder_.open(record);
    if (is_array) {
      read_numbers();
    } else {
      read_properties();
    }
  }

  // Whether the open record is an array, whose numbers follow `a:`.
  bool holds_array() {
    if (builder_.depth() == 0) return false;
    const FbxProperty* const count = tree_.property(builder_.top(), 0);
    return count != nullptr && count->type == '*';
  }

  void read_numbers() {
    const std::size_t end = std::min(bytes_.find('}', place_), bytes_.size());
    add('A', place_, end - place_);
    place_ = end;
    finish_properties(end);
    builder_.close();
  }

  void read_properties() {
    std::size_t last_end = place_;
    bool may_follow = true, after_comma = false;
    while (skip_blanks()) {
      const char c = bytes_[place_];
      if (c == ',') {
        ++place_;
        may_follow = after_comma = true;
      } else if (c == '{') {
        finish_properties(last_end);
        ++place_;
        return;
      } else if (c == '}' || !may_follow || (!after_comma && is_name(place_))) {
        break;
      } else {
        read_value();
        last_end = place_;
        may_follow = after_comma = false;
      }
    }
    finish_properties(last_end);
    builder_.top().end = last_end;
    builder_.close();
  }

  // Whether a word with a colon begins here, which is the next record.
  bool is_name(std::size_t place) const {
    const std::size_t end = word_end(place);
    return end > place && end < bytes_.size() && bytes_[end] == ':';
  }

  void read_value() {
    const char c = bytes_[place_];
    if (c == '"') {
      const std::size_t end = bytes_.find('"', place_ + 1);
      if (end == bytes_.npos) throw tree_.error_at(place_, "a string does not end");
      add('S', place_ + 1, end - place_ - 1);
      place_ = end + 1;
      return;
    }
    const std::size_t end = word_end(place_);
    if (end == place_) throw unexpected("a value");
    const bool is_number = (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
    if (c == '*') {
      add('*', place_ + 1, end - place_ - 1);
    } else {
      add(is_number ? 'N' : 'W', place_, end - place_);
    }
    place_ = end;
  }

  void add(char type, std::size_t begin, std::size_t size) {
    if (size > std::numeric_limits<std::uint32_t>::max() ||
        tree_.properties.size() >= std::numeric_limits<std::uint32_t>::max()) {
      throw tree_.error_at(begin, "a value is too long");
    }
    tree_.properties.push_back({begin, static_cast<std::uint32_t>(size), type});
    ++builder_.top().property_count;
  }

  void finish_properties(std::size_t end) {
    builder_.top().properties_end = end;
    builder_.top().end = end;
  }

  FbxTree& tree_;
  std::string_view bytes_;
  FbxRecordBuilder builder_;
  std::size_t max_depth_;
  std::size_t place_ = 0;
};

}  // namespace

void read_text_fbx_records(FbxTree& tree, std::size_t max_depth) {
  TextFbxReader(tree, max_depth).read();
}

}  // namespace kinemend
