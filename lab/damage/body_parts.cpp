// Looks for words of arms and legs, and for left and right, in the spellings of many programs.
#include "lab/damage/body_parts.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "kinemend/extend/text.hpp"
#include "kinemend/take.hpp"

namespace kinemend::corrupt {

namespace {

template <std::size_t N>
bool has_part(std::string_view name, const std::array<std::string_view, N>& parts) {
  return std::any_of(parts.begin(), parts.end(), [&](std::string_view part) {
    return name.find(part) != std::string_view::npos;
  });
}

enum class Side : std::uint8_t { none, left, right };

Side side_of(std::string_view bare) {
  const std::string name = lower_case(bare);
  if (name.find("left") != std::string::npos) return Side::left;
  if (name.find("right") != std::string::npos) return Side::right;
  // The side may be a capital at either end: LWRA, RToe; elbowL, hip_r.
  if (bare.size() < 2) return Side::none;
  const auto is_upper = [](char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; };
  const char first = bare[0], last = bare[bare.size() - 1];
  const bool capital_next = is_upper(bare[1]) || bare[1] == '_';
  if ((first == 'L' || first == 'l') && capital_next) return Side::left;
  if ((first == 'R' || first == 'r') && capital_next) return Side::right;
  const char before = bare[bare.size() - 2];
  if (last == 'L' || (last == 'l' && before == '_')) return Side::left;
  if (last == 'R' || (last == 'r' && before == '_')) return Side::right;
  return Side::none;
}

}  // namespace

NamedPart named_part(std::string_view name) {
  // Legs are tested first, because `Foot_Index` is not a finger.
  static constexpr std::array<std::string_view, 14> legs{"leg",  "knee", "kne", "ankle", "ank",
                                                         "foot", "heel", "hee", "toe",   "thigh",
                                                         "thi",  "tib",  "hip", "shank"};
  static constexpr std::array<std::string_view, 16> arms{
      "arm", "elbow", "elb", "wrist", "wra",   "wrb",   "hand",   "fin",
      "upa", "frm",   "fra", "thumb", "index", "pinky", "middle", "ring"};
  const std::string text = lower_case(without_subject(name));
  if (text == "hips") return NamedPart::other;
  if (has_part(text, legs)) return NamedPart::leg;
  return has_part(text, arms) ? NamedPart::arm : NamedPart::other;
}

std::vector<std::size_t> named_limbs(const std::vector<std::string>& names) {
  std::vector<std::size_t> keys, limbs;
  for (const std::string& name : names) {
    const NamedPart part = named_part(name);
    const Side side = part == NamedPart::other ? Side::none : side_of(without_subject(name));
    const std::size_t key = 3 * static_cast<std::size_t>(part) + static_cast<std::size_t>(side);
    const auto found = std::find(keys.begin(), keys.end(), key);
    limbs.push_back(static_cast<std::size_t>(found - keys.begin()));
    if (found == keys.end()) keys.push_back(key);
  }
  return limbs;
}

std::vector<std::size_t> wrists_and_ankles(const std::vector<std::string>& names) {
  static constexpr std::array<std::string_view, 4> ends{"hand", "wrist", "foot", "ankle"};
  static constexpr std::array<std::string_view, 8> beyond{"thumb", "index",  "middle", "ring",
                                                          "pinky", "little", "finger", "toe"};
  std::vector<std::size_t> found;
  for (std::size_t j = 0; j < names.size(); ++j) {
    const std::string name = lower_case(names[j]);
    if (has_part(name, ends) && !has_part(name, beyond)) found.push_back(j);
  }
  return found;
}

}  // namespace kinemend::corrupt
