// Writes zip archives: new ones, and existing ones with new contents for some members.
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <new>

#include "io/npz/zip_archive.hpp"
#include "io/npz/zip_records.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

void append_zip_number(std::string& bytes, std::size_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
}

void put_zip_number(std::string& bytes, std::size_t place, std::size_t value) {
  std::string number;
  append_zip_number(number, value, 4);
  bytes.replace(place, 4, number);
}

std::string deflated_for_zip(std::string_view raw) {
  constexpr int usual_level = 6, usual_memory = 8;
  z_stream stream{};
  if (deflateInit2(&stream, usual_level, Z_DEFLATED, -MAX_WBITS, usual_memory,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string packed(deflateBound(&stream, static_cast<uLong>(raw.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(raw.data()));
  stream.avail_in = static_cast<uInt>(raw.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

class ZipWriter {
 public:
  void add(const ZipContent& content) {
    check_size(content.bytes.size());
    const std::string packed = content.is_deflated ? deflated_for_zip(content.bytes) : "";
    const std::string& data = content.is_deflated ? packed : content.bytes;
    const std::string facts = facts_of(content, data.size());
    const std::size_t begin = out_.size();
    out_ += zip_header_mark;
    out_ += facts;
    append_zip_number(out_, 0, 2);  // no extra field
    out_ += content.name;
    out_ += data;
    constexpr std::size_t made_by = 20, rest = 12;  // version 2.0; comment, disk and attributes: 0
    std::string entry(zip_entry_mark);
    append_zip_number(entry, made_by, 2);
    entry += facts;
    append_zip_number(entry, 0, 2);
    entry.append(rest - 2, '\0');
    append_zip_number(entry, begin, 4);
    entry += content.name;
    entries_.push_back(std::move(entry));
  }

  // Copies a member from another archive unchanged.
  void copy(std::string_view bytes, const ZipMember& member) {
    std::string entry(bytes.substr(member.entry, member.entry_bytes));
    constexpr std::size_t place_of_begin = 42;
    put_zip_number(entry, place_of_begin, out_.size());
    entries_.push_back(std::move(entry));
    append(bytes.substr(member.begin, member.end - member.begin));
  }

  void append(std::string_view bytes) { out_ += bytes; }

  std::string finish(std::string_view comment) && {
    const std::size_t directory = out_.size();
    for (const std::string& entry : entries_) out_ += entry;
    const std::size_t size = out_.size() - directory;
    check_size(out_.size());
    out_ += zip_end_mark;
    append_zip_number(out_, 0, 4);
    for (int i = 0; i < 2; ++i) append_zip_number(out_, entries_.size(), 2);
    append_zip_number(out_, size, 4);
    append_zip_number(out_, directory, 4);
    append_zip_number(out_, comment.size(), 2);
    out_ += comment;
    return std::move(out_);
  }

 private:
  static void check_size(std::size_t bytes) {
    if (bytes >= zip_no_number)
      throw Error(ErrorKind::usage, "npz files of 4 GiB or more are not written");
  }

  // Returns the fields that the header and the entry of a member share, up to the size of the name.
  static std::string facts_of(const ZipContent& content, std::size_t packed_bytes) {
    constexpr std::size_t version = 20, first_day = 0x21;  // 2.0; 1 January 1980
    std::string facts;
    append_zip_number(facts, version, 2);
    append_zip_number(facts, 0, 2);
    append_zip_number(facts, content.is_deflated ? zip_deflated : zip_stored, 2);
    append_zip_number(facts, 0, 2);
    append_zip_number(facts, first_day, 2);
    append_zip_number(facts, zip_checksum(content.bytes), 4);
    append_zip_number(facts, packed_bytes, 4);
    append_zip_number(facts, content.bytes.size(), 4);
    append_zip_number(facts, content.name.size(), 2);
    return facts;
  }

  std::string out_;
  std::vector<std::string> entries_;
};

}  // namespace

std::uint32_t zip_checksum(std::string_view raw) {
  return static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(raw.data()), static_cast<uInt>(raw.size())));
}

std::string make_zip(const std::vector<ZipContent>& contents) {
  ZipWriter writer;
  for (const ZipContent& content : contents) writer.add(content);
  return std::move(writer).finish("");
}

std::string rewrite_zip(std::string_view bytes, const ZipArchive& archive,
                        const std::map<std::string, std::string>& contents) {
  std::vector<const ZipMember*> in_order;
  for (const ZipMember& member : archive.members) in_order.push_back(&member);
  std::sort(in_order.begin(), in_order.end(),
            [](const ZipMember* a, const ZipMember* b) { return a->begin < b->begin; });
  ZipWriter writer;
  writer.append(bytes.substr(0, in_order.empty() ? archive.directory : in_order.front()->begin));
  bool is_deflated = false;
  for (const ZipMember* const member : in_order) {
    const auto found = contents.find(member->name);
    is_deflated = member->packing == zip_deflated;
    if (found == contents.end()) {
      writer.copy(bytes, *member);
    } else {
      writer.add({member->name, found->second, is_deflated});
    }
  }
  for (const auto& [name, content] : contents) {
    if (archive.find(name) == nullptr) writer.add({name, content, is_deflated});
  }
  return std::move(writer).finish(bytes.substr(archive.directory_end + zip_end_bytes));
}

}  // namespace kinemend
