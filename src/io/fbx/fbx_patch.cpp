// Moves the bytes after a patch, and updates the fields that count bytes.
#include "io/fbx/fbx_patch.hpp"

#include <algorithm>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "io/fbx/fbx_words.hpp"

namespace kinemend {

namespace {

constexpr std::size_t footer_alignment = 16, zeros_after_padding = 4;
constexpr std::size_t footer_head = 16;

class FbxPatcher {
 public:
  FbxPatcher(const FbxTree& tree, std::vector<FbxPatch> patches)
      : tree_(tree), patches_(std::move(patches)) {
    std::sort(patches_.begin(), patches_.end(), [](const FbxPatch& a, const FbxPatch& b) {
      return std::tie(a.begin, a.end) < std::tie(b.begin, b.end);
    });
    std::ptrdiff_t shift = 0;
    for (const FbxPatch& patch : patches_) {
      shift += static_cast<std::ptrdiff_t>(patch.bytes.size()) -
               static_cast<std::ptrdiff_t>(patch.end - patch.begin);
      shifts_.push_back(shift);
      if (patch.more_properties != 0) grown_.emplace(patch.begin, patch.more_properties);
    }
  }

  std::string write() {
    std::string out;
    out.reserve(moved(tree_.bytes.size()) + footer_alignment);
    std::size_t from = 0;
    for (const FbxPatch& patch : patches_) {
      out.append(tree_.bytes, from, patch.begin - from);
      out += patch.bytes;
      from = patch.end;
    }
    out.append(tree_.bytes, from);
    const bool moves = !grown_.empty() ||
                       std::any_of(shifts_.begin(), shifts_.end(), [](auto s) { return s != 0; });
    if (!tree_.is_text && moves) {
      for (const FbxRecord& record : tree_.records) mend_header(record, out);
      pad_footer(out);
    }
    return out;
  }

 private:
  // Returns the new offset of a byte that is not within a patch.
  std::size_t moved(std::size_t place) const {
    const auto after =
        std::upper_bound(patches_.begin(), patches_.end(), place,
                         [](std::size_t at, const FbxPatch& patch) { return at < patch.end; });
    if (after == patches_.begin()) return place;
    const auto index = static_cast<std::size_t>(after - patches_.begin()) - 1;
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(place) + shifts_[index]);
  }

  template <class Word>
  void put(std::string& out, std::size_t place, std::size_t value) const {
    put_fbx_word(out.data() + place, static_cast<Word>(value), tree_.is_big_endian);
  }

  void mend_header(const FbxRecord& record, std::string& out) const {
    const std::size_t place = moved(record.begin);
    const std::size_t end = moved(record.end);
    const std::size_t list = moved(record.properties_end) - moved(record.properties_begin);
    const auto grown = grown_.find(record.properties_begin);
    const std::size_t count =
        record.property_count + static_cast<std::size_t>(grown == grown_.end() ? 0 : grown->second);
    if (tree_.has_wide_headers()) {
      put<std::uint64_t>(out, place, end);
      put<std::uint64_t>(out, place + 8, count);
      put<std::uint64_t>(out, place + 16, list);
    } else {
      put<std::uint32_t>(out, place, end);
      put<std::uint32_t>(out, place + 4, count);
      put<std::uint32_t>(out, place + 8, list);
    }
  }

  // Zeros between the head of the footer and the version align the version.
  void pad_footer(std::string& out) const {
    const std::size_t zeros_begin = tree_.records_end + footer_head;
    const std::size_t version_place = place_of_version(zeros_begin);
    if (version_place == 0) return;
    const std::size_t phase = version_place % footer_alignment;
    const std::size_t begin = moved(tree_.records_end) + footer_head;
    // Autodesk pads with 1 to 16 bytes and adds four; Blender adds four and pads with 1 to 16.
    const std::size_t least = begin + 1 + (phase == 0 ? zeros_after_padding : 0);
    const std::size_t aligned =
        (least + footer_alignment - 1) / footer_alignment * footer_alignment;
    out.replace(begin, version_place - zeros_begin, aligned + phase - begin, '\0');
  }

  // Returns the offset of the version in the source file; 0 if its footer has another form.
  std::size_t place_of_version(std::size_t zeros_begin) const {
    constexpr std::size_t most_zeros = footer_alignment + zeros_after_padding;
    const std::string& bytes = tree_.bytes;
    for (std::size_t i = 0; i <= most_zeros && zeros_begin + i + 4 <= bytes.size(); ++i) {
      const std::size_t place = zeros_begin + i;
      const std::size_t phase = place % footer_alignment;
      const auto word = fbx_word<std::uint32_t>(bytes.data() + place, tree_.is_big_endian);
      if (word == tree_.version && (phase == 0 || phase == zeros_after_padding)) return place;
      if (bytes[place] != 0) return 0;
    }
    return 0;
  }

  const FbxTree& tree_;
  std::vector<FbxPatch> patches_;
  std::vector<std::ptrdiff_t> shifts_;
  std::unordered_map<std::size_t, std::int64_t> grown_;  // by the offset of a list of properties
};

}  // namespace

std::string write_patched_fbx(const FbxTree& tree, std::vector<FbxPatch> patches) {
  if (patches.empty()) return tree.bytes;
  return FbxPatcher(tree, std::move(patches)).write();
}

}  // namespace kinemend
