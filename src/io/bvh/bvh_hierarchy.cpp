// Parses the hierarchy and the head of the motion, and finds the rate of a frame time.
#include "io/bvh/bvh_hierarchy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/portable.hpp"
#include "io/motion/motion_columns.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

// One open block: a joint or an end site.
struct Block {
  std::int32_t joint = -1;  // the joint itself, or the parent of an end site
  bool end_site = false;
  std::size_t begin = 0;
  bool has_offset = false;
  bool has_channels = false;
};

class HierarchyParser {
 public:
  HierarchyParser(const SourceText& text, TextScanner& scanner, std::size_t max_depth)
      : text_(text), scanner_(scanner), max_depth_(max_depth) {}

  Skeleton parse() {
    while (scanner_.accept("ROOT")) {
      open_joint();
      while (!blocks_.empty()) parse_statement();
    }
    if (skeleton_.joint_count() == 0) fail_expected("ROOT");
    text_.note("offset_rest_angles", rest_angles_,
               "an OFFSET holds more than three numbers: the others are skipped");
    return std::move(skeleton_);
  }

  [[noreturn]] void fail_expected(std::string_view expected) {
    const std::string_view found = scanner_.peek();
    throw text_.error_at(scanner_.position(),
                         fmt::format("expected {}, found {}", expected, quote(found)));
  }

 private:
  void parse_statement() {
    Block& block = blocks_.back();
    if (scanner_.accept("OFFSET")) {
      parse_offset(block);
    } else if (scanner_.accept("CHANNELS")) {
      parse_channels(block);
    } else if (!block.end_site && scanner_.accept("JOINT")) {
      open_joint();
    } else if (!block.end_site && accept_end_site()) {
      open_end_site();
    } else if (scanner_.accept("}")) {
      close(block);
    } else {
      fail_expected(block.end_site ? "OFFSET or } of an end site"
                                   : "OFFSET, CHANNELS, JOINT, End Site or }");
    }
  }

  bool accept_end_site() {
    if (scanner_.accept("EndSite")) return true;
    if (!scanner_.accept("End")) return false;
    if (!scanner_.accept("Site")) fail_expected("Site after End");
    return true;
  }

  void open(Block block) {
    if (!scanner_.accept("{")) fail_expected("{");
    if (blocks_.size() >= max_depth_) {
      throw text_.error_at(block.begin,
                           fmt::format("joints are nested deeper than {}", max_depth_));
    }
    blocks_.push_back(block);
  }

  void open_joint() {
    const std::size_t begin = scanner_.position();
    if (skeleton_.joint_count() >= most_joints) {
      throw text_.error_at(begin, fmt::format("more than {} joints", most_joints));
    }
    const std::int32_t parent = blocks_.empty() ? -1 : blocks_.back().joint;
    const std::int32_t joint = skeleton_.add_joint(std::string(scanner_.name()), parent, {}, {});
    open({joint, false, begin});
  }

  void open_end_site() {
    const std::size_t begin = scanner_.position();
    if (skeleton_.end_sites.size() >= most_joints) {
      throw text_.error_at(begin, fmt::format("more than {} end sites", most_joints));
    }
    const std::int32_t joint = blocks_.back().joint;
    skeleton_.end_sites.push_back({joint, {}, std::string(scanner_.name())});
    open({joint, true, begin});
  }

  void close(const Block& block) {
    if (!block.has_offset) {
      text_.note("offset_missing", block.begin, "no OFFSET: 0 0 0 assumed");
    }
    blocks_.pop_back();
  }

  void parse_offset(Block& block) {
    if (std::exchange(block.has_offset, true))
      throw text_.error_at(scanner_.position(), "a second OFFSET");
    scanner_.peek();
    const CommaStyle commas = comma_style(scanner_.rest_of_line(), 3);
    std::array<double, 3> values{};
    for (double& value : values) value = parse_offset_value(commas);
    if (commas == CommaStyle::separator) skip_commas();
    skip_rest_angles();
    const Vec3 offset{values[0], values[1], values[2]};
    if (block.end_site) {
      skeleton_.end_sites.back().offset = offset;
    } else {
      skeleton_.offsets[static_cast<std::size_t>(block.joint)] = offset;
    }
  }

  // Some programs write the rest angles of a joint behind its offset; MOTION holds them too.
  void skip_rest_angles() {
    const std::size_t begin = scanner_.position();
    std::size_t skipped = 0;
    while (skipped < 3 && read_number(scanner_.peek()).kind == TokenKind::number) {
      scanner_.next();
      ++skipped;
    }
    if (skipped > 0) rest_angles_.add(begin);
  }

  void skip_commas() {
    while (scanner_.peek().substr(0, 1) == ",") scanner_.move_to(scanner_.position() + 1);
  }

  double parse_offset_value(CommaStyle commas) {
    if (commas == CommaStyle::separator) skip_commas();
    const std::string_view word = scanner_.peek();
    const NumberToken token = read_number(word, commas);
    if (token.kind != TokenKind::number) fail_expected("a number of OFFSET");
    scanner_.move_to(scanner_.position() + static_cast<std::size_t>(token.end - word.data()));
    return token.value;
  }

  void parse_channels(Block& block) {
    const std::string_view word = scanner_.peek();
    const std::size_t begin = scanner_.position();
    const NumberToken count = read_number(word);
    if (count.kind != TokenKind::number || !(count.value >= 0 && count.value <= 6) ||
        count.value != std::floor(count.value)) {
      fail_expected("a number of channels from 0 to 6");
    }
    scanner_.next();
    const auto expected = static_cast<std::size_t>(count.value);
    std::vector<Channel> channels;
    while (const auto channel = channel_named(scanner_.peek())) {
      if (channels.size() <= expected) channels.push_back(*channel);
      scanner_.next();
    }
    if (channels.size() < expected && is_unknown_channel(scanner_.peek())) {
      throw text_.error_at(scanner_.position(),
                           fmt::format("unknown channel {}", quote(scanner_.peek())));
    }
    if (channels.size() != expected) {
      throw text_.error_at(
          begin,
          fmt::format("expected {} channel names, found {}", expected,
                      channels.size() > expected ? "more" : fmt::to_string(channels.size())));
    }
    if (block.end_site) {
      if (expected > 0) throw text_.error_at(begin, "an end site has no channels");
      return;
    }
    if (std::exchange(block.has_channels, true)) throw text_.error_at(begin, "a second CHANNELS");
    check_channels(channels, begin);
    skeleton_.channels[static_cast<std::size_t>(block.joint)] = std::move(channels);
  }

  static bool is_unknown_channel(std::string_view word) {
    constexpr std::array<std::string_view, 7> statements{"OFFSET",  "CHANNELS", "JOINT", "End",
                                                         "EndSite", "{",        "}"};
    return !word.empty() &&
           std::none_of(statements.begin(), statements.end(), [&](std::string_view statement) {
             return equal_ignoring_case(word, statement);
           });
  }

  void check_channels(const std::vector<Channel>& channels, std::size_t begin) {
    std::array<bool, 3> seen{};
    std::optional<Axis> previous;
    std::size_t rotations = 0;
    for (const Channel channel : channels) {
      const Axis axis = axis_of(channel);
      if (!is_rotation(channel)) {
        if (std::exchange(seen[static_cast<std::size_t>(axis)], true)) {
          throw text_.error_at(begin, "a position channel occurs twice");
        }
        continue;
      }
      if (previous == axis) throw text_.error_at(begin, "a rotation channel follows itself");
      previous = axis;
      if (++rotations > 3) throw text_.error_at(begin, "more than 3 rotation channels");
    }
  }

  const SourceText& text_;
  TextScanner& scanner_;
  std::size_t max_depth_;
  Skeleton skeleton_;
  std::vector<Block> blocks_;
  CountedRepair<std::size_t> rest_angles_;
};

// Parses `Frames:` and `Frame Time:`, in either order, any case, with or without the colon.
class MotionHeaderParser {
 public:
  MotionHeaderParser(const SourceText& text, TextScanner& scanner, BvhHeader& header,
                     double unknown_rate_hz)
      : text_(text), scanner_(scanner), header_(header), unknown_rate_hz_(unknown_rate_hz) {}

  void parse() {
    header_.data_begin = scanner_.position();
    while (accept_key()) header_.data_begin = scanner_.position();
    if (!seen_frames_) {
      text_.note("frame_count_missing", header_.data_begin, "no Frames: line: frames are counted");
    }
    if (!seen_time_) {
      text_.note("frame_time_missing", header_.data_begin,
                 fmt::format("no Frame Time: line: {} Hz assumed", unknown_rate_hz_));
    }
  }

 private:
  bool accept_key() {
    const std::string_view word = scanner_.peek();
    std::string_view key = word.substr(0, word.find(':'));
    std::size_t end = scanner_.position() + key.size();
    if (equal_ignoring_case(key, "Frame") && key.size() == word.size()) {
      scanner_.next();
      const std::string_view second = scanner_.peek();
      key = second.substr(0, second.find(':'));
      if (!equal_ignoring_case(key, "Time")) fail("expected Time: after Frame");
      end = scanner_.position() + key.size();
      key = "FrameTime";
    }
    const bool frames = equal_ignoring_case(key, "Frames");
    if (!frames && !equal_ignoring_case(key, "FrameTime")) return false;
    scanner_.move_to(end);
    if (scanner_.peek().substr(0, 1) == ":") scanner_.move_to(scanner_.position() + 1);
    if (frames) {
      parse_frames();
    } else {
      parse_time();
    }
    return true;
  }

  ByteSpan take_number(NumberToken& number, std::string_view expected) {
    const std::string_view word = scanner_.peek();
    const ByteSpan span{scanner_.position(), word.size()};
    if (!word.empty()) {
      number = read_number(word, comma_style(word, 1));
    }
    if (number.kind == TokenKind::text) {
      fail(fmt::format("expected {}, found {}", expected, quote(word)));
    }
    scanner_.next();
    return span;
  }

  void parse_frames() {
    if (std::exchange(seen_frames_, true)) fail("a second Frames: line");
    NumberToken number;
    header_.frame_count = take_number(number, "the number of frames");
    // By definition.
    constexpr double most = 0x1p53;  // more than any file holds, and still exact
    if (number.kind == TokenKind::number && number.value >= 0 &&
        number.value == std::floor(number.value)) {
      header_.frames = static_cast<std::size_t>(std::min(number.value, most));
    } else {
      text_.note("frame_count_missing", header_.frame_count.begin,
                 "Frames: is not a whole number: frames are counted");
    }
  }

  void parse_time() {
    if (std::exchange(seen_time_, true)) fail("a second Frame Time: line");
    NumberToken number;
    header_.frame_time = take_number(number, "the frame time in seconds");
    header_.frame_time_is_none = number.kind == TokenKind::not_finite;
    if (number.kind == TokenKind::number && is_usable_frame_rate(1 / number.value)) {
      header_.frame_time_s = number.value;
    } else {
      text_.note("frame_time_unusable", header_.frame_time.begin,
                 fmt::format("Frame Time: is not the time of a rate of {} to {} Hz: {} Hz assumed",
                             least_frame_rate_hz, most_frame_rate_hz, unknown_rate_hz_));
    }
  }

  [[noreturn]] void fail(std::string_view message) {
    throw text_.error_at(scanner_.position(), message);
  }

  const SourceText& text_;
  TextScanner& scanner_;
  BvhHeader& header_;
  double unknown_rate_hz_;
  bool seen_frames_ = false;
  bool seen_time_ = false;
};

std::size_t first_text_byte(const SourceText& text) {
  const std::string_view bytes = text.bytes;
  if (bytes.substr(0, 2) == "\xFF\xFE" || bytes.substr(0, 2) == "\xFE\xFF") {
    throw text.error_at(std::size_t{0}, "the text is UTF-16; save it as UTF-8");
  }
  return byte_order_mark_size(bytes);
}

}  // namespace

BvhHeader read_bvh_header(const SourceText& text, std::size_t max_depth, double unknown_rate_hz) {
  TextScanner scanner(text.bytes, first_text_byte(text));
  if (scanner.peek().empty()) throw text.error_at(std::size_t{0}, "the file is empty");
  HierarchyParser parser(text, scanner, max_depth);
  if (!scanner.accept("HIERARCHY")) {
    if (!equal_ignoring_case(scanner.peek(), "ROOT")) parser.fail_expected("HIERARCHY");
    text.note("hierarchy_keyword_missing", scanner.position(), "no HIERARCHY before ROOT");
  }
  BvhHeader header;
  header.skeleton = parser.parse();
  header.hierarchy_end = scanner.position();
  header.data_begin = text.bytes.size();
  if (scanner.accept("MOTION")) {
    header.has_motion = true;
    MotionHeaderParser(text, scanner, header, unknown_rate_hz).parse();
  } else if (scanner.peek().empty()) {
    text.note("motion_missing", header.hierarchy_end, "no MOTION: the take has no frames");
  } else {
    parser.fail_expected("MOTION");
  }
  if (scanner.comments() > 0) {
    text.note("comment_skipped", scanner.first_comment(),
              "comments are not part of the format: skipped", scanner.comments());
  }
  return header;
}

double rate_from_frame_time(double frame_time_s, std::string_view text) {
  // Usual rates. Chosen by hand.
  constexpr std::array<double, 14> known{23.976, 24, 25,  29.97,  30,  50,     59.94,
                                         60,     90, 100, 119.88, 120, 239.76, 240};
  const std::string_view mantissa = text.substr(0, text.find_first_of("eE"));
  const std::size_t first = std::min(mantissa.find_first_of("123456789"), mantissa.size());
  const auto digits = std::count_if(mantissa.begin() + static_cast<std::ptrdiff_t>(first),
                                    mantissa.end(), [](char c) { return c >= '0' && c <= '9'; });
  const auto error_of = [&](double rate) { return std::fabs(frame_time_s * rate - 1); };
  const double nearest = *std::min_element(
      known.begin(), known.end(), [&](double a, double b) { return error_of(a) < error_of(b); });
  // 0.0333 differs from 1/30 by 1e-3 up to rounding.
  if (error_of(nearest) <= (digits >= 9 ? 1e-6 : 1.0001e-3)) return nearest;
  const double rate = 1 / frame_time_s;
  const double whole = std::round(rate);
  const std::size_t dot = text.find('.');
  if (whole >= 1 && error_of(whole) <= 1e-4 && dot != text.npos &&
      text.find_first_of("eE") == text.npos) {
    const double half_unit = 0.5 * portable::pow(10.0, -static_cast<double>(text.size() - dot - 1));
    if (std::fabs(frame_time_s - 1 / whole) <= half_unit * 1.0001) return whole;
  }
  return rate;
}

}  // namespace kinemend
