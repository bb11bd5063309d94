// Reads whole files, closes open files, and keeps large records in memory up to a limit, and beyond
// it in a temporary file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/platform/files.hpp"

namespace kinemend {

/// The whole content of a file, or of standard input for "-". Errors: `unreadable_input`.
std::string file_bytes(const std::filesystem::path& path);

/// Closes the file on destruction, but never a standard stream.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ > platform::standard_error) platform::close_file(number_);
  }
  int get() const { return number_; }
  // Returns false on failure: some file systems report failed writes only at closing.
  bool close() { return platform::close_file(std::exchange(number_, -1)); }

 private:
  int number_;
};

/// Records of bytes that are written once and can then be read in any order, any number of times.
/// They are kept in memory up to a limit, and beyond it in a file in the temporary folder. The file
/// has no name, so that it disappears however the program ends. Several threads may read at once.
class Spool {
 public:
  /// `most_memory`: bytes of records to keep in memory.
  explicit Spool(std::size_t most_memory) : room_(most_memory) {}

  /// Returns the index of the record: 0, 1, ... Errors: `ErrorKind::cannot_write`, naming the
  /// folder.
  std::size_t append(std::span<const std::byte> bytes);
  /// Fills `bytes` from byte `from` of the record on, which must be long enough. Errors:
  /// `ErrorKind::unreadable_input`.
  void read(std::size_t record, std::size_t from, std::span<std::byte> bytes) const;

  std::size_t count() const noexcept { return records_.size(); }
  /// Size of a record in bytes.
  std::size_t size(std::size_t record) const { return records_[record].size; }
  /// Number of bytes in the file.
  std::uint64_t bytes_in_file() const noexcept { return file_end_; }

 private:
  struct Record {
    std::vector<std::byte> memory;  // empty: in the file
    std::uint64_t place = 0;        // in the file
    std::size_t size = 0;
  };

  void write_to_file(std::span<const std::byte> bytes);

  std::vector<Record> records_;
  std::size_t room_;  // bytes left in memory
  std::unique_ptr<Descriptor> file_;
  std::uint64_t file_end_ = 0;
};

/// The same for trivially copyable values.
template <class Value>
std::size_t append_values(Spool& spool, std::span<const Value> values) {
  return spool.append(std::as_bytes(values));
}
/// Values [first, first + count) of a record.
template <class Value>
std::vector<Value> read_values(const Spool& spool, std::size_t record, std::size_t first,
                               std::size_t count) {
  std::vector<Value> values(count);
  spool.read(record, first * sizeof(Value), std::as_writable_bytes(std::span(values)));
  return values;
}
template <class Value>
std::vector<Value> read_values(const Spool& spool, std::size_t record) {
  return read_values<Value>(spool, record, 0, spool.size(record) / sizeof(Value));
}

}  // namespace kinemend
