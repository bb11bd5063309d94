// Keeps partial lines, gathers and parses headers, and writes the hierarchy of Perception Neuron.
#include "live/live_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "io/bvh/bvh.hpp"
#include "io/bvh/bvh_hierarchy.hpp"
#include "io/text/number.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/rotation.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

LineSplitter::Found LineSplitter::next(std::string_view& bytes, bool bars_end_lines,
                                       std::string_view& line) {
  if (is_given_) drop();
  const auto end = std::find_if(bytes.begin(), bytes.end(), [bars_end_lines](char c) {
    return is_line_end(c) || (bars_end_lines && c == '|');
  });
  const std::string_view piece = bytes.substr(0, static_cast<std::size_t>(end - bytes.begin()));
  if (end == bytes.end()) {
    bytes = {};
    add(piece);
    return Found::nothing;
  }
  bytes.remove_prefix(piece.size() + 1);
  if (part_.empty() && !is_too_long_ && piece.size() <= most_bytes_) {
    line = piece;
    return Found::line;
  }
  add(piece);
  return this->end(line);
}

LineSplitter::Found LineSplitter::end(std::string_view& line) {
  if (is_given_) drop();
  if (part_.empty() && !is_too_long_) return Found::nothing;
  is_given_ = true;
  line = part_;
  return is_too_long_ ? Found::too_long : Found::line;
}

void LineSplitter::drop() {
  part_.clear();
  is_too_long_ = is_given_ = false;
}

void LineSplitter::add(std::string_view piece) {
  if (is_too_long_) return;
  is_too_long_ = piece.size() > most_bytes_ - part_.size();
  if (is_too_long_) {
    part_.clear();
  } else {
    part_.append(piece);
  }
}

namespace {

// The rate if a header states none, and a limit of the stack. Chosen by hand.
constexpr double rate_when_unknown_hz = 30;
constexpr std::size_t most_depth = 512;

// Returns the first word of a line, which distinguishes `Frames:` and `Frame Time:` from frames.
std::string_view first_word(std::string_view line) {
  std::size_t begin = byte_order_mark_size(line);
  while (begin < line.size() && is_space(line[begin])) ++begin;
  std::size_t end = begin;
  while (end < line.size() && !is_space(line[end]) && line[end] != ':' && line[end] != '{') ++end;
  return line.substr(begin, end - begin);
}

}  // namespace

LiveHeader read_live_header(std::string_view text, std::string_view name, double frame_rate_hz) {
  const SourceText source{name, text};
  Diagnostics diagnostics;
  BvhHeader read = read_bvh_header(source, diagnostics, most_depth, rate_when_unknown_hz);
  LiveHeader header;
  const auto piece = [&](ByteSpan span) { return text.substr(span.begin, span.size); };
  if (frame_rate_hz > 0) {
    header.frame_rate_hz = frame_rate_hz;
  } else if (read.frame_time_s > 0) {
    header.frame_rate_hz = rate_from_frame_time(read.frame_time_s, piece(read.frame_time));
    header.frame_time = piece(read.frame_time);
  } else {
    header.frame_rate_hz = rate_when_unknown_hz;
  }
  std::size_t channels = 0;
  for (const auto& own : read.skeleton.channels) channels += own.size();
  if (channels == 0) throw source.error_at(std::size_t{0}, "no joint has a channel");
  header.hierarchy = text.substr(0, text.rfind('}', read.hierarchy_end) + 1);
  header.frames = read.frames.value_or(0);
  header.skeleton = std::move(read.skeleton);
  for (const Diagnostic& diagnostic : diagnostics.entries()) {
    const bool is_of_rate =
        diagnostic.name == "frame_time_missing" || diagnostic.name == "frame_time_unusable";
    if (diagnostic.name == "frame_count_missing" || diagnostic.name == "motion_missing" ||
        (is_of_rate && frame_rate_hz > 0)) {
      continue;
    }
    header.repairs.push_back(
        fmt::format("{}:{}: {}", name, diagnostic.first_line, diagnostic.message));
  }
  return header;
}

bool begins_header(std::string_view line, bool surely) {
  const std::string_view word = first_word(line);
  return equal_ignoring_case(word, "HIERARCHY") || (!surely && equal_ignoring_case(word, "ROOT"));
}

bool is_marker_header(std::string_view line) { return first_word(line) == "MARKERS"; }

LiveHeader read_marker_header(std::string_view line, double frame_rate_hz) {
  // The limit of tables (io/table/marker_table.hpp), by definition.
  constexpr std::size_t most_markers = 16384;
  const auto fail = [](std::string_view what) {
    throw Error(ErrorKind::unreadable_input, fmt::format("header of markers: {}", what));
  };
  TextScanner scanner(line, 0);
  scanner.next();
  const std::string_view rate = scanner.next();
  LiveHeader header;
  const NumberToken token =
      rate.empty() ? NumberToken{} : read_number(rate.data(), rate.data() + rate.size());
  if (token.kind != TokenKind::number || !is_usable_frame_rate(token.value))
    fail(fmt::format("expected the rate in hertz after MARKERS, found {}", quote(rate)));
  header.frame_rate_hz = frame_rate_hz > 0 ? frame_rate_hz : token.value;
  std::string_view names = line.substr(scanner.position());
  while (!names.empty()) {
    const std::size_t end = std::min(names.find(','), names.size());
    std::string_view name = names.substr(0, end);
    names.remove_prefix(std::min(end + 1, names.size()));
    while (!name.empty() && is_space(name.front())) name.remove_prefix(1);
    while (!name.empty() && is_space(name.back())) name.remove_suffix(1);
    if (name.empty()) fail("a marker has no name");
    header.markers.emplace_back(name);
  }
  if (header.markers.empty()) fail("there are no names");
  if (header.markers.size() > most_markers) fail("there are too many names");
  return header;
}

HeaderLines::Next HeaderLines::take(std::string_view line) {
  const std::string_view word = first_word(line);
  // No line of a header begins with a number: its end was lost, or it was not a header.
  constexpr std::string_view firsts_of_numbers = "0123456789+-.";
  if (!word.empty() && firsts_of_numbers.find(word.front()) != firsts_of_numbers.npos)
    return Next::over;
  if (in_motion_ && !word.empty()) {
    if (equal_ignoring_case(word, "Frames")) {
      has_frames_ = true;
    } else if (equal_ignoring_case(word, "Frame") || equal_ignoring_case(word, "FrameTime")) {
      has_time_ = true;
    } else {
      return Next::over;
    }
  } else if (equal_ignoring_case(word, "MOTION")) {
    in_motion_ = true;
  }
  if (line.size() >= most_bytes_ - text_.size()) return Next::too_long;
  text_.append(line);
  text_ += '\n';
  return has_frames_ && has_time_ ? Next::complete : Next::more;
}

void HeaderLines::clear() {
  text_.clear();
  in_motion_ = has_frames_ = has_time_ = false;
}

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
