#include "io/npz/zip_archive.hpp"
#include "read_law.hpp"

namespace {

// The same archive with correct checksums, which the fuzzer would not find.
std::string with_checksums(const std::string& bytes) {
  using namespace kinemend;
  std::vector<ZipContent> contents;
  const ZipArchive archive = read_zip(bytes, "fuzz");
  for (ZipMember member : archive.members) {
    if (member.packing != zip_stored) return bytes;
    member.raw_bytes = member.packed_bytes;
    contents.push_back({member.name, bytes.substr(member.data, member.packed_bytes), false});
  }
  return make_zip(contents);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string bytes = text_of(data, size);
  try {
    bytes = with_checksums(bytes);
  } catch (const kinemend::Error&) {
    // The bytes are not an archive, so the reader refuses them.
  }
  return check_read_law(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), "npz");
}
