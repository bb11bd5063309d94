// Walks over the records of a binary FBX file, with 32-bit or 64-bit headers in either byte order.
#include <fmt/format.h>

#include <limits>

#include "io/fbx/fbx_tree.hpp"
#include "io/fbx/fbx_words.hpp"

namespace kinemend {

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

}  // namespace kinemend
