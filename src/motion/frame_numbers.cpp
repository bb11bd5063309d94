// Converts between frames counted from 0 and the numbers that a file gives them.
#include "kinemend/experimental/frame_numbers.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "motion/frame_numbers.hpp"

namespace kinemend {

namespace {

constexpr std::string_view first_frame_fact = "first frame";

}  // namespace

void note_first_frame(Take& clip, double number) {
  // Larger whole numbers are not exact; a round number below 2^53, by definition.
  constexpr double most = 9e15;
  if (number == 1 || number != std::floor(number) || !(std::fabs(number) < most)) return;
  clip.source.facts.push_back({std::string(first_frame_fact), fmt::format("{:.0f}", number)});
}

std::int64_t first_frame_number(const Take& take) {
  if (!take.has_joints()) return take.first_frame;
  std::int64_t number = 1;
  for (const SourceFact& fact : take.source.facts) {
    if (fact.name == first_frame_fact)
      std::from_chars(fact.text.data(), fact.text.data() + fact.text.size(), number);
  }
  return number;
}

std::int64_t frame_number(std::size_t frame, std::int64_t first) {
  return static_cast<std::int64_t>(frame) + first;
}

}  // namespace kinemend
