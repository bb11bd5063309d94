// Finds the tracks that change places in a mirror and converts values to a form.
#include "lab/samples/motion_forms.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace kinemend {

namespace {

std::string mirrored_name(const std::string& name) {
  const auto swapped = [&](std::string_view from, std::string_view to) {
    return std::string(to) + name.substr(from.size());
  };
  const auto begins = [&](std::string_view text) { return name.rfind(text, 0) == 0; };
  if (begins("Left")) return swapped("Left", "Right");
  if (begins("Right")) return swapped("Right", "Left");
  if (begins("L")) return swapped("L", "R");
  if (begins("R")) return swapped("R", "L");
  return name;
}

std::vector<float> backwards(const std::vector<float>& values, std::size_t width) {
  std::vector<float> result;
  result.reserve(values.size());
  for (std::size_t row = values.size() / width; row > 0; --row) {
    const auto from = values.begin() + static_cast<std::ptrdiff_t>((row - 1) * width);
    result.insert(result.end(), from, from + static_cast<std::ptrdiff_t>(width));
  }
  return result;
}

std::vector<float> mirrored(const std::vector<float>& values, const BodyMirror& mirror) {
  const std::size_t tracks = mirror.partners.size();
  std::vector<float> result(values.size());
  for (std::size_t i = 0; i < values.size() / 3; ++i) {
    const std::size_t n = i % tracks;
    const float* v = &values[3 * (i - n + mirror.partners[n])];
    // The mirror flips x: it negates x of a position, and y and z of a rotation axis.
    const float sign = n < mirror.turns ? 1.0F : -1.0F;
    float* w = &result[3 * i];
    w[0] = sign * v[0], w[1] = -sign * v[1], w[2] = -sign * v[2];
  }
  return result;
}

}  // namespace

BodyMirror mirror_of(const BodyLayout& layout) {
  BodyMirror mirror;
  mirror.turns = layout.track_count();
  const std::vector<std::string>& names = layout.names;
  for (std::size_t n = 0; n < layout.channel_count() / 3; ++n) {
    mirror.partners.push_back(n);
    if (n >= mirror.turns) continue;
    const auto found = std::find(names.begin(), names.end(), mirrored_name(names[n]));
    if (found != names.end()) mirror.partners[n] = static_cast<std::size_t>(found - names.begin());
  }
  const std::vector<std::size_t> partners = mirror.partners;
  for (std::size_t n = 0; n < partners.size(); ++n) {
    if (partners[partners[n]] != n) mirror.partners[n] = n;
  }
  return mirror;
}

std::vector<float> in_form(const std::vector<float>& values, MotionForm form,
                           const BodyMirror& mirror) {
  std::vector<float> result = form.is_mirrored ? mirrored(values, mirror) : values;
  return form.is_reversed ? backwards(result, 3 * mirror.partners.size()) : result;
}

}  // namespace kinemend
