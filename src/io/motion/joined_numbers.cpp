// Inserts blanks into a document, and adjusts its offsets.
#include "io/motion/joined_numbers.hpp"

#include <string>
#include <utility>

namespace kinemend {

void separate_numbers(MotionDocument& document, const std::vector<const char*>& places) {
  if (places.empty()) return;
  std::string separated;
  separated.reserve(document.bytes.size() + places.size());
  std::size_t copied = 0, added = 0;
  for (const char* const p : places) {
    const auto place = static_cast<std::size_t>(p - document.bytes.data());
    if (place >= document.data_end) break;
    separated.append(document.bytes, copied, place - copied);
    separated += ' ';
    copied = place;
    ++added;
  }
  separated.append(document.bytes, copied);
  document.bytes = std::move(separated);
  document.data_end += added;
}

}  // namespace kinemend
