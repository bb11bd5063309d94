// Matches the lines of the first frame with the bones of the skeleton, reads frames line by line,
// bones in any order, and finds a frame that is cut off.
#include "io/acclaim/amc_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <unordered_map>
#include <utility>

#include "io/acclaim/asf.hpp"
#include "io/bvh/bvh_hierarchy.hpp"
#include "io/text/number.hpp"
#include "io/text/text.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

struct BoneLine {
  std::string_view name;
  std::size_t values = 0;
};

bool is_number(std::string_view word) {
  const NumberToken token = read_number(word.data(), word.data() + word.size());
  return token.kind == TokenKind::number;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

// Returns the lines between the first frame's number and the second's.
std::vector<BoneLine> first_frame(const SourceText& text, std::size_t begin) {
  AsfScanner scanner(text.bytes, begin);
  scanner.next();
  std::vector<BoneLine> lines;
  for (;;) {
    const std::string_view name = scanner.peek();
    if (name.empty() || is_number(name)) return lines;
    if (lines.size() > most_joints) {
      throw text.error_at(scanner.position(), fmt::format("more than {} bones", most_joints));
    }
    scanner.next();
    lines.push_back({name, 0});
    for (std::string_view word; !(word = scanner.next_in_line()).empty();)
      lines.back().values += numbers_in_word(word);
  }
}

// Finds joints by name, in the spelling of the skeleton or in lower case.
class JointNames {
 public:
  explicit JointNames(const Skeleton& skeleton) {
    for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
      exact_.try_emplace(skeleton.names[j], j);
      lower_.try_emplace(lower_case(skeleton.names[j]), j);
    }
  }

  std::optional<std::size_t> find(std::string_view name) const {
    const auto exact = exact_.find(std::string(name));
    if (exact != exact_.end()) return exact->second;
    const auto any_case = lower_.find(lower_case(name));
    if (any_case != lower_.end()) return any_case->second;
    return std::nullopt;
  }

 private:
  std::unordered_map<std::string, std::size_t> exact_, lower_;
};

const std::vector<AsfDof>& three_turns() {
  static const std::vector<AsfDof> dofs{Channel::x_rotation, Channel::y_rotation,
                                        Channel::z_rotation};
  return dofs;
}

bool has_three_turns(const std::vector<AsfDof>& dofs) {
  return dofs.size() == 3 &&
         std::all_of(dofs.begin(), dofs.end(), [](AsfDof d) { return d && is_rotation(*d); });
}

void give_three_turns(AsfSkeleton& asf, std::size_t joint) {
  if (has_three_turns(asf.dofs[joint])) return;
  Skeleton& skeleton = asf.skeleton;
  const std::vector<Channel> channels = channels_of(three_turns());
  if (!skeleton.limits.empty() && !skeleton.limits[joint].empty()) {
    std::vector<ChannelLimit> limits(channels.size());
    for (std::size_t i = 0; i < skeleton.channels[joint].size(); ++i) {
      const auto found = std::find(channels.begin(), channels.end(), skeleton.channels[joint][i]);
      if (found == channels.end()) continue;
      limits[static_cast<std::size_t>(found - channels.begin())] = skeleton.limits[joint][i];
    }
    skeleton.limits[joint] = std::move(limits);
  }
  asf.dofs[joint] = three_turns();
  skeleton.channels[joint] = channels;
}

class LayoutMatcher {
 public:
  LayoutMatcher(const SourceText& text, Diagnostics& diagnostics, const AmcHeader& header,
                AsfSkeleton& asf, std::string_view asf_name)
      : text_(text),
        diagnostics_(diagnostics),
        header_(header),
        asf_(asf),
        asf_name_(asf_name),
        lines_(first_frame(text, header.data_begin)) {}

  AmcLayout match() {
    find_joints();
    if (header_.three_dofs || three_dofs_undeclared()) {
      for (const AmcBone& bone : layout_) {
        if (bone.joint != 0) give_three_turns(asf_, bone.joint);
      }
    }
    check_counts();
    check_none_missing();
    return std::move(layout_);
  }

 private:
  void find_joints() {
    const JointNames names(asf_.skeleton);
    std::vector<bool> seen(asf_.skeleton.joint_count());
    for (const BoneLine& line : lines_) {
      const auto joint = names.find(line.name);
      if (!joint) {
        throw text_.error_at(line.name.data(), fmt::format("the skeleton {} has no bone {}",
                                                           asf_name_, quote(line.name)));
      }
      if (seen[*joint]) {
        throw text_.error_at(line.name.data(),
                             fmt::format("the bone {} occurs twice in a frame", quote(line.name)));
      }
      seen[*joint] = true;
      layout_.push_back({std::string(line.name), *joint, {}});
    }
  }

  // Some programs write three angles per bone without declaring it.
  bool three_dofs_undeclared() {
    bool differs = false;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (layout_[i].joint == 0) continue;
      if (lines_[i].values != 3) return false;
      differs = differs || asf_.dofs[layout_[i].joint].size() != 3;
    }
    if (differs) {
      note_repair(text_, diagnostics_, "three_dofs_undeclared", header_.data_begin,
                  fmt::format("every bone has three values, other than the skeleton {} says: taken "
                              "as rx ry rz",
                              asf_name_));
    }
    return differs;
  }

  void check_counts() const {
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const std::size_t expected = asf_.dofs[layout_[i].joint].size();
      if (lines_[i].values == expected) continue;
      throw text_.error_at(
          lines_[i].name.data(),
          fmt::format("expected {} values of the bone {} as in the skeleton {}, found {}", expected,
                      quote(lines_[i].name), asf_name_, lines_[i].values));
    }
  }

  void check_none_missing() const {
    std::vector<bool> seen(asf_.skeleton.joint_count());
    for (const AmcBone& bone : layout_) seen[bone.joint] = true;
    for (std::size_t j = 0; j < seen.size(); ++j) {
      if (seen[j] || asf_.dofs[j].empty()) continue;
      throw text_.error_at(header_.data_begin,
                           fmt::format("the frame has no bone {}, which the skeleton {} has",
                                       quote(asf_.skeleton.names[j]), asf_name_));
    }
  }

  const SourceText& text_;
  Diagnostics& diagnostics_;
  const AmcHeader& header_;
  AsfSkeleton& asf_;
  std::string_view asf_name_;
  std::vector<BoneLine> lines_;
  AmcLayout layout_;
};

void number_columns(AmcLayout& layout, const AsfSkeleton& asf) {
  std::vector<std::size_t> first_column;
  std::size_t columns = 0;
  for (const auto& channels : asf.skeleton.channels) {
    first_column.push_back(columns);
    columns += channels.size();
  }
  for (AmcBone& bone : layout) {
    for (const auto& slot : channel_slots(asf.dofs[bone.joint])) {
      bone.columns.push_back(slot ? first_column[bone.joint] + *slot : AmcBone::no_column);
    }
  }
}

}  // namespace

AmcHeader read_amc_header(const SourceText& text, Diagnostics& diagnostics) {
  const std::string_view bytes = text.bytes;
  AmcHeader header;
  std::size_t position = byte_order_mark_size(bytes);
  while (position < bytes.size()) {
    const std::size_t end = std::min(bytes.find_first_of("\r\n", position), bytes.size());
    const std::string_view line = trim(bytes.substr(position, end - position));
    constexpr std::string_view skeleton_mark = "#!OML:ASF";
    const std::string_view keyword = line.substr(0, line.find_first_of(" \t"));
    if (equal_ignoring_case(keyword, skeleton_mark)) {
      header.skeleton_file = trim(line.substr(skeleton_mark.size()));
    } else if (equal_ignoring_case(keyword, ":DEGREES")) {
      header.radians = false;
    } else if (equal_ignoring_case(keyword, ":RADIANS")) {
      header.radians = true;
    } else if (equal_ignoring_case(keyword, ":FORCE-ALL-JOINTS-BE-3DOF")) {
      header.three_dofs = true;
    } else if (keyword.substr(0, 1) == ":") {
      if (!equal_ignoring_case(keyword, ":FULLY-SPECIFIED")) {
        note_repair(text, diagnostics, "unknown_keyword", position,
                    fmt::format("{} is not a keyword of the format", quote(keyword)));
      }
    } else if (!line.empty() && line[0] != '#') {
      header.data_begin = static_cast<std::size_t>(line.data() - bytes.data());
      if (is_number(keyword)) return header;
      throw text.error_at(header.data_begin,
                          fmt::format("expected the number of a frame, found {}", quote(keyword)));
    }
    position = end + 1;
  }
  header.data_begin = bytes.size();
  return header;
}

AmcLayout read_amc_layout(const SourceText& text, Diagnostics& diagnostics, const AmcHeader& header,
                          AsfSkeleton& asf, std::string_view asf_name) {
  AmcLayout layout = LayoutMatcher(text, diagnostics, header, asf, asf_name).match();
  number_columns(layout, asf);
  return layout;
}

AmcLayout make_amc_layout(const AsfSkeleton& asf) {
  AmcLayout layout;
  for (std::size_t j = 0; j < asf.skeleton.joint_count(); ++j) {
    if (!asf.dofs[j].empty()) layout.push_back({asf.skeleton.names[j], j, {}});
  }
  number_columns(layout, asf);
  return layout;
}

namespace {

// Commas and parentheses are treated as white space.
bool is_blank(char c) { return c == ' ' || c == '\t' || c == ',' || c == '(' || c == ')'; }

// Thrown within a frame that the end of the file cut off.
struct CutFrame {};

bool ends_word(char c) { return is_space(c) || is_blank(c) || c == '#'; }

}  // namespace

AmcRows::AmcRows(const SourceText& text, std::size_t begin, const AmcLayout& layout,
                 const std::vector<std::uint8_t>& is_angle, double degrees_per_value)
    : text_(text),
      position_(text.bytes.data() + begin),
      end_(text.bytes.data() + text.bytes.size()),
      plain_places_(text.bytes.data(), end_),
      last_end_(position_),
      layout_(layout),
      is_angle_(is_angle),
      degrees_per_value_(degrees_per_value),
      data_begin_(position_) {
  for (std::size_t i = 0; i < layout.size(); ++i) index_of_.emplace(layout[i].name, i);
}

const char* AmcRows::skip_blanks(const char* p) const {
  while (p != end_ && is_blank(*p)) ++p;
  return p;
}

// Moves to the next word, across line ends and comments.
const char* AmcRows::skip_lines(const char* p) const {
  for (;;) {
    while (p != end_ && (is_space(*p) || is_blank(*p))) ++p;
    if (p == end_ || *p != '#') return p;
    p = std::find_if(p, end_, is_line_end);
  }
}

std::string_view AmcRows::word_at(const char* p) const {
  return {p, static_cast<std::size_t>(std::find_if(p, end_, ends_word) - p)};
}

bool AmcRows::read_frame_number() {
  const char* const p = skip_lines(position_);
  position_ = p;
  if (p == end_) return false;
  const std::string_view word = word_at(p);
  const NumberToken token = read_number(p, p + word.size());
  if (token.kind != TokenKind::number || token.end != p + word.size()) {
    const bool again = index_of_.find(word) != index_of_.end();
    fail(p, word, may_start_number(word),
         again ? fmt::format("the bone {} occurs twice in a frame", quote(word))
               : fmt::format("expected the number of a frame, found {}", quote(word)));
  }
  if (has_frame_number_ && token.value != frame_number_ + 1 && number_jumps_++ == 0) {
    first_number_jump_ = p;
  }
  if (!has_frame_number_) first_frame_number_ = token.value;
  frame_number_ = token.value;
  has_frame_number_ = true;
  position_ = p + word.size();
  const char* const rest = skip_blanks(position_);
  if (rest != end_ && !is_line_end(*rest) && *rest != '#') {
    throw text_.error_at(
        rest, fmt::format("expected only the number of a frame, found {}", quote(word_at(rest))));
  }
  return true;
}

bool AmcRows::starts_bone(const char* p, const std::string& name) const {
  const auto room = static_cast<std::size_t>(end_ - p);
  return room > name.size() && std::memcmp(p, name.data(), name.size()) == 0 &&
         ends_word(p[name.size()]);
}

bool AmcRows::next(double* values, TokenSpan* tokens) {
  const char* const last_end = last_end_;
  const std::size_t gaps = gaps_, number_jumps = number_jumps_;
  const std::size_t joins = joins_.size();
  const char* const begin = skip_lines(position_);
  try {
    if (!read_frame(values, tokens)) return false;
    if (last_end_ != end_ || !last_value_may_be_cut()) return true;
  } catch (const CutFrame&) {
  }
  // The cut frame is ignored.
  cut_frame_ = begin;
  position_ = end_;
  last_end_ = last_end;
  gaps_ = gaps;
  number_jumps_ = number_jumps;
  joins_.resize(joins);
  return false;
}

bool AmcRows::last_value_may_be_cut() const {
  return last_number_may_be_cut({data_begin_, static_cast<std::size_t>(end_ - data_begin_)},
                                CommaStyle::none, ' ', LikeLines::same_first_word);
}

// Throws an error at `word`, unless it may be the start of a longer word that was cut.
void AmcRows::fail(const char* p, std::string_view word, bool may_be_cut,
                   const std::string& message) const {
  if (may_be_cut && p + word.size() == end_) throw CutFrame();
  throw text_.error_at(p, message);
}

bool AmcRows::read_frame(double* values, TokenSpan* tokens) {
  if (!read_frame_number()) return false;
  std::size_t i = 0;
  for (; i < layout_.size(); ++i) {
    const char* const p = skip_lines(position_);
    if (!starts_bone(p, layout_[i].name)) break;
    read_bone(layout_[i], p, values, tokens);
  }
  if (i < layout_.size()) read_bones_in_any_order(i, values, tokens);
  if (degrees_per_value_ == 1) return true;
  for (std::size_t c = 0; c < is_angle_.size(); ++c) {
    if (is_angle_[c] != 0) values[c] *= degrees_per_value_;
  }
  return true;
}

// Reads the rest of a frame whose first bones were in the order of the layout.
void AmcRows::read_bones_in_any_order(std::size_t first, double* values, TokenSpan* tokens) {
  std::vector<bool> seen(layout_.size());
  std::fill(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(first), true);
  for (std::size_t count = first; count < layout_.size(); ++count) {
    const char* const p = skip_lines(position_);
    const std::size_t bone = bone_at(p, seen);
    seen[bone] = true;
    read_bone(layout_[bone], p, values, tokens);
  }
}

std::size_t AmcRows::bone_at(const char* p, const std::vector<bool>& seen) const {
  const std::string_view word = word_at(p);
  const auto found = index_of_.find(word);
  if (found == index_of_.end()) {
    if (word.empty() || read_number(p, p + word.size()).kind == TokenKind::number) {
      fail_missing(seen, p);
    }
    fail(p, word, true, fmt::format("the bone {} is not in the first frame", quote(word)));
  }
  if (seen[found->second]) {
    throw text_.error_at(p, fmt::format("the bone {} occurs twice in a frame", quote(word)));
  }
  return found->second;
}

void AmcRows::fail_missing(const std::vector<bool>& seen, const char* p) const {
  // If the last line is complete, the frame is damaged, not cut.
  if (p == end_ && !is_line_end(end_[-1])) throw CutFrame();
  const auto missing = std::find(seen.begin(), seen.end(), false) - seen.begin();
  throw text_.error_at(p, fmt::format("frame {:.0f} ends without the bone {}", frame_number_,
                                      quote(layout_[static_cast<std::size_t>(missing)].name)));
}

void AmcRows::read_bone(const AmcBone& bone, const char* p, double* values, TokenSpan* tokens) {
  const char* const line = p;
  p += bone.name.size();
  for (const std::size_t column : bone.columns) {
    p = *p == ' ' ? p + 1 : p;
    if (p != end_ && is_blank(*p)) p = skip_blanks(p);
    if (p == end_ || is_line_end(*p) || *p == '#') fail_value(bone, line, p);
    const char* const begin = p;
    const double value = read_value(p);
    if (column == AmcBone::no_column) continue;
    values[column] = value;
    if (tokens != nullptr) tokens[column] = {begin, p};
  }
  last_end_ = p;
  p = skip_blanks(p);
  if (p != end_ && !is_line_end(*p) && *p != '#') fail_value(bone, line, p);
  position_ = p;
}

double AmcRows::read_value(const char*& p) {
  PlainNumber plain;
  if (plain_places_.holds(p) && read_plain_number(p, plain) && is_space(p[plain.length]))
      [[likely]] {
    p += plain.length;
    most_decimals_ = std::max(most_decimals_, plain.decimals);
    return plain.value;
  }
  const std::string_view word = word_at(p);
  const NumberToken token = word.empty() ? NumberToken{} : read_sample(p, p + word.size());
  if (token.kind == TokenKind::text && numbers_in_word(word) > 1) return read_joined(p, word);
  const bool is_value = token.kind == TokenKind::number || token.kind == TokenKind::not_finite;
  if (!is_value || token.end != p + word.size()) {
    fail(p, word, may_start_number(word), fmt::format("expected a number, found {}", quote(word)));
  }
  if (token.kind == TokenKind::not_finite && gaps_++ == 0) first_gap_ = p;
  most_decimals_ = std::max(most_decimals_, token.decimals);
  p += word.size();
  return token.kind == TokenKind::number ? token.value : std::numeric_limits<double>::quiet_NaN();
}

// Reads the first of several numbers without a blank between them.
double AmcRows::read_joined(const char*& p, std::string_view word) {
  const char* const end = word.data() + word.size();
  const char* const next = second_number(p, end);
  const double value = read_sample(p, next).value;
  p = next;
  if (next != end) joins_.push_back(next);
  return value;
}

void AmcRows::fail_value(const AmcBone& bone, const char* line, const char* p) const {
  if (p == end_) throw CutFrame();
  std::size_t found = 0;
  for (p = line + bone.name.size(); (p = skip_blanks(p)) != end_;) {
    const std::string_view word = word_at(p);
    if (word.empty()) break;
    p += word.size();
    ++found;
  }
  throw text_.error_at(line, fmt::format("expected {} values of the bone {}, found {}",
                                         bone.columns.size(), quote(bone.name), found));
}

}  // namespace kinemend
