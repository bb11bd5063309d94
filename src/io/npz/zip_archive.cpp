// Reads the directory of a zip archive and unpacks its members; writes new archives, and existing
// ones with new contents for some members.
#include "io/npz/zip_archive.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <new>
#include <set>

#include "base/text.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

class ZipDirectory {
 public:
  ZipDirectory(std::string_view bytes, std::string_view name) : bytes_(bytes) {
    archive_.name = name;
  }

  ZipArchive read() {
    find_directory();
    for (std::size_t i = 0; i < entries_; ++i) read_entry();
    if (place_ != archive_.directory_end)
      throw error_at(place_, "expected the end of the archive's directory");
    for (ZipMember& member : archive_.members) read_header(member);
    find_ends();
    return std::move(archive_);
  }

 private:
  Error error_at(std::size_t place, std::string_view message) const {
    return Error::at_byte(archive_.name, place, message);
  }

  std::size_t word(std::size_t place) const { return zip_number(bytes_, place, 4); }
  std::size_t half(std::size_t place) const { return zip_number(bytes_, place, 2); }

  bool begins(std::string_view mark, std::size_t place) const {
    return bytes_.substr(std::min(place, bytes_.size()), mark.size()) == mark;
  }

  // The end record of the archive is the last one whose comment reaches the end of the file.
  void find_directory() {
    constexpr std::size_t most_comment = 65535;
    if (bytes_.size() < zip_end_bytes) throw error_at(0, "the file ends before its directory");
    const std::size_t last = bytes_.size() - zip_end_bytes;
    const std::size_t first = last - std::min(last, most_comment);
    for (std::size_t place = last + 1; place-- > first;) {
      if (!begins(zip_end_mark, place) || place + zip_end_bytes + half(place + 20) != bytes_.size())
        continue;
      entries_ = half(place + 10);
      archive_.directory = word(place + 16);
      check_directory(place);
      return;
    }
    throw error_at(bytes_.size(), "the archive has no directory: the file is cut off");
  }

  void check_directory(std::size_t end) {
    place_ = archive_.directory;
    const bool is_one_disk = half(end + 4) == 0 && half(end + 6) == 0 && half(end + 8) == entries_;
    if (!is_one_disk || entries_ == 0xFFFF || place_ == zip_no_number)
      throw error_at(end, "archives of 4 GiB or more, or in several parts, are not read");
    if (place_ > end || word(end + 12) != end - place_)
      throw error_at(end, "the directory of the archive is not where the file says");
    archive_.directory_end = end;
  }

  void read_entry() {
    const std::size_t at = place_;
    if (!begins(zip_entry_mark, at) || bytes_.size() - at < zip_entry_bytes)
      throw error_at(at, "expected an entry of the archive's directory");
    const std::size_t name_bytes = half(at + 28);
    ZipMember member;
    member.entry = at;
    member.entry_bytes = zip_entry_bytes + name_bytes + half(at + 30) + half(at + 32);
    if (bytes_.size() - at < member.entry_bytes)
      throw error_at(at, "an entry of the archive's directory is cut off");
    member.name = bytes_.substr(at + zip_entry_bytes, name_bytes);
    member.flags = static_cast<std::uint16_t>(half(at + 8));
    member.packing = static_cast<std::uint16_t>(half(at + 10));
    member.checksum = static_cast<std::uint32_t>(word(at + 16));
    member.packed_bytes = word(at + 20);
    member.raw_bytes = word(at + 24);
    member.begin = word(at + 42);
    for (const std::size_t number : {member.packed_bytes, member.raw_bytes, member.begin}) {
      if (number == zip_no_number) throw error_at(at, "members of 4 GiB or more are not read");
    }
    if (!names_.insert(member.name).second)
      throw error_at(at, fmt::format("two members are called {}", quote(member.name)));
    place_ += member.entry_bytes;
    archive_.members.push_back(std::move(member));
  }

  void read_header(ZipMember& member) const {
    const std::size_t at = member.begin;
    if (at >= archive_.directory || archive_.directory - at < zip_header_bytes ||
        !begins(zip_header_mark, at)) {
      throw error_at(member.entry,
                     fmt::format("{} is not where the directory says", quote(member.name)));
    }
    member.data = at + zip_header_bytes + half(at + 26) + half(at + 28);
  }

  // Rejects members that share bytes: a small file could then unpack to a huge size.
  void find_ends() {
    std::vector<ZipMember*> in_order;
    for (ZipMember& member : archive_.members) in_order.push_back(&member);
    std::sort(in_order.begin(), in_order.end(),
              [](const ZipMember* a, const ZipMember* b) { return a->begin < b->begin; });
    for (std::size_t i = 0; i < in_order.size(); ++i) {
      ZipMember& member = *in_order[i];
      member.end = i + 1 < in_order.size() ? in_order[i + 1]->begin : archive_.directory;
      if (member.data > member.end || member.packed_bytes > member.end - member.data)
        throw error_at(member.begin, fmt::format("{} overlaps what follows", quote(member.name)));
    }
  }

  std::string_view bytes_;
  ZipArchive archive_;
  std::size_t entries_ = 0;
  std::size_t place_ = 0;
  std::set<std::string> names_;
};

// Returns the CRC-32 of a member's unpacked bytes.
std::uint32_t zip_checksum(std::string_view raw) {
  return static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(raw.data()), static_cast<uInt>(raw.size())));
}

// Unpacks raw deflate data of known size; returns false if the bytes are damaged.
bool inflate_zip(std::string_view packed, std::string& raw) {
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  // Even a member without bytes has an end mark to read, which needs an output pointer.
  char none = 0;
  stream.next_out = reinterpret_cast<Bytef*>(raw.empty() ? &none : raw.data());
  stream.avail_out = static_cast<uInt>(raw.size());
  const int result = inflate(&stream, Z_FINISH);
  const bool is_whole = result == Z_STREAM_END && stream.total_out == raw.size();
  inflateEnd(&stream);
  return is_whole;
}

}  // namespace

const ZipMember* ZipArchive::find(std::string_view member) const {
  const auto found = std::find_if(members.begin(), members.end(),
                                  [&](const ZipMember& each) { return each.name == member; });
  return found == members.end() ? nullptr : &*found;
}

ZipArchive read_zip(std::string_view bytes, std::string_view name) {
  return ZipDirectory(bytes, name).read();
}

std::string zip_content(std::string_view bytes, const ZipArchive& archive, const ZipMember& member,
                        std::size_t most_bytes) {
  const auto refuse = [&](std::string_view what) {
    return Error::at_byte(archive.name, member.begin,
                          fmt::format("{}: {}", quote(member.name), what));
  };
  constexpr std::uint16_t encrypted = 1;
  if ((member.flags & encrypted) != 0) throw refuse("is encrypted");
  if (member.packing != zip_stored && member.packing != zip_deflated)
    throw refuse(fmt::format("unknown packing {}", member.packing));
  if (member.raw_bytes > most_bytes)
    throw refuse(fmt::format("{} bytes are too much memory for a file of {} bytes",
                             member.raw_bytes, bytes.size()));
  const std::string_view packed = bytes.substr(member.data, member.packed_bytes);
  std::string raw;
  if (member.packing == zip_stored) {
    if (member.packed_bytes != member.raw_bytes) throw refuse("two sizes are stated");
    raw = packed;
  } else {
    raw.resize(member.raw_bytes);
    if (!inflate_zip(packed, raw)) throw refuse("the packed bytes are damaged");
  }
  if (zip_checksum(raw) != member.checksum) throw refuse("the checksum does not match");
  return raw;
}

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
