// Counts the words of lines, and writes Perception Neuron's hierarchy.
#include "live/neuron_lines.hpp"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <utility>

#include "io/text/number.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

namespace {

constexpr std::size_t neuron_joints = 59;
constexpr std::size_t plain_values = 6 + 3 * (neuron_joints - 1);
constexpr std::size_t displaced_values = 6 * neuron_joints;
// Bounds the words of the number, the avatar's name, which may have spaces, and the six reference
// values.
constexpr std::size_t most_words_before = 16;

std::size_t words_of(std::string_view line) {
  std::size_t words = 0;
  bool in_word = false;
  for (const char c : line) {
    const bool space = is_space(c);
    words += !space && !in_word ? 1 : 0;
    in_word = !space;
  }
  return words;
}

std::string_view avatar_of(std::string_view line) {
  while (!line.empty() && is_space(line.front())) line.remove_prefix(1);
  std::size_t end = 0;
  while (end < line.size() && !is_space(line[end])) ++end;
  return line.substr(0, end);
}

// Writes nested joints.
class NeuronHierarchy {
 public:
  explicit NeuronHierarchy(bool displaced) : displaced_(displaced) {}

  void open(std::string_view name, Vec3 offset) {
    const bool is_root = depth_ == 0;
    line("{} {}", is_root ? "ROOT" : "JOINT", name);
    line("{{");
    ++depth_;
    line("OFFSET {:.2f} {:.2f} {:.2f}", offset.x, offset.y, offset.z);
    line("CHANNELS {}Yrotation Xrotation Zrotation",
         is_root || displaced_ ? "6 Xposition Yposition Zposition " : "3 ");
  }
  void close() {
    --depth_;
    line("}}");
  }
  void end_site(Vec3 offset) {
    line("End Site");
    line("{{");
    ++depth_;
    line("OFFSET {:.2f} {:.2f} {:.2f}", offset.x, offset.y, offset.z);
    close();
  }
  std::string text;

 private:
  template <class... Values>
  void line(fmt::format_string<Values...> format, Values&&... values) {
    text.append(2 * depth_, ' ');
    fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
    text += '\n';
  }

  bool displaced_;
  std::size_t depth_ = 0;
};

// Lengths belong to a person of 1.75 m, in centimetres; y is up, x is to the left.
void write_leg(NeuronHierarchy& out, const std::string& side, double sign) {
  out.open(side + "UpLeg", {sign * 9, -2, 0});
  out.open(side + "Leg", {0, -43, 0});
  out.open(side + "Foot", {0, -42, 0});
  out.end_site({0, -7, 15});
  for (int i = 0; i < 3; ++i) out.close();
}

void write_finger(NeuronHierarchy& out, const std::string& side, std::string_view finger,
                  double sign, double z) {
  const bool is_thumb = finger == "Thumb";
  if (!is_thumb) out.open(fmt::format("{}InHand{}", side, finger), {sign * 3.5, 0, z});
  for (int i = 1; i <= 3; ++i) {
    const double length = i > 1 ? 3 : is_thumb ? 3.5 : 5.5;
    out.open(fmt::format("{}Hand{}{}", side, finger, i),
             {sign * length, 0, is_thumb && i == 1 ? z : 0});
  }
  out.end_site({sign * 2.2, 0, 0});
  for (int i = is_thumb ? 1 : 0; i < 4; ++i) out.close();
}

void write_arm(NeuronHierarchy& out, const std::string& side, double sign) {
  out.open(side + "Shoulder", {sign * 3.5, 8, 0});
  out.open(side + "Arm", {sign * 14, 0, 0});
  out.open(side + "ForeArm", {sign * 28, 0, 0});
  out.open(side + "Hand", {sign * 26, 0, 0});
  write_finger(out, side, "Thumb", sign, 3);
  write_finger(out, side, "Index", sign, 2);
  write_finger(out, side, "Middle", sign, 0.5);
  write_finger(out, side, "Ring", sign, -0.5);
  write_finger(out, side, "Pinky", sign, -1.8);
  for (int i = 0; i < 4; ++i) out.close();
}

}  // namespace

std::optional<NeuronForm> neuron_form(std::string_view line) {
  const std::size_t words = words_of(line);
  for (const std::size_t values : {plain_values, displaced_values}) {
    if (words > values && words - values <= most_words_before)
      return NeuronForm{avatar_of(line), values == displaced_values, words - values};
  }
  return std::nullopt;
}

std::string neuron_skeleton(bool displaced) {
  NeuronHierarchy out(displaced);
  out.text = "HIERARCHY\n";
  out.open("Hips", {0, 95, 0});
  write_leg(out, "Right", -1);
  write_leg(out, "Left", 1);
  out.open("Spine", {0, 8, 0});
  for (const char* name : {"Spine1", "Spine2", "Spine3"}) out.open(name, {0, 11, 0});
  out.open("Neck", {0, 12, 0});
  out.open("Head", {0, 9, 0});
  out.end_site({0, 18, 0});
  for (int i = 0; i < 2; ++i) out.close();
  write_arm(out, "Right", -1);
  write_arm(out, "Left", 1);
  for (int i = 0; i < 5; ++i) out.close();
  return out.text + "MOTION\nFrames: 0\nFrame Time: 0.0166666667\n";
}

}  // namespace kinemend
