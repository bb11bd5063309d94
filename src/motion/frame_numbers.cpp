#include "kinemend/frame_numbers.hpp"

#include <charconv>

#include "motion/frame_numbers.hpp"

namespace kinemend {

std::int64_t first_frame_number(const Clip& clip) {
  std::int64_t number = 1;
  for (const SourceFact& fact : clip.source.facts) {
    if (fact.name == first_frame_fact)
      std::from_chars(fact.text.data(), fact.text.data() + fact.text.size(), number);
  }
  return number;
}

std::int64_t first_frame_number(const MarkerClip& clip) { return clip.first_frame; }

}  // namespace kinemend
