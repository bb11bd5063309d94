// Small takes that NumPy wrote, and archives whose checksums are corrected after damage.
#pragma once

#include <functional>
#include <string>

#include "io/npz/npz.hpp"
#include "io/npz/zip_archive.hpp"
#include "io/support.hpp"

namespace kinemend::test {

/// A file that tools/reference/npz_takes.py wrote with NumPy's own writer.
inline std::string npz_fixture(const std::string& name) {
  return read_file(std::filesystem::path(KINEMEND_TEST_FIXTURES) / "npz" / (name + ".npz"));
}

inline TakeResult read_npz_bytes(std::string bytes, const ReadOptions& options = {}) {
  return read_take(std::move(bytes), "take.npz", options);
}

/// The archive after `change` has edited each content, stored without compression.
inline std::string npz_with(
    const std::string& bytes,
    const std::function<void(std::string& name, std::string& content)>& change) {
  const ZipArchive archive = read_zip(bytes, "take.npz");
  std::vector<ZipContent> contents;
  for (const ZipMember& member : archive.members) {
    contents.push_back({member.name, zip_content(bytes, archive, member, 1 << 20), false});
    change(contents.back().name, contents.back().bytes);
  }
  return make_zip(contents);
}

/// The unpacked bytes of an array's member, or empty if there is no such array.
inline std::string npz_content(const std::string& bytes, const std::string& array) {
  const ZipArchive archive = read_zip(bytes, "take.npz");
  const ZipMember* const member = archive.find(array + ".npy");
  return member == nullptr ? "" : zip_content(bytes, archive, *member, 1 << 20);
}

}  // namespace kinemend::test
