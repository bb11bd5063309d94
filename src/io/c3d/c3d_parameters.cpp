// Reads the entries of the parameter section, looks parameters up by name, replaces and removes
// them, and lays out their section byte by byte.
#include "io/c3d/c3d_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "io/text/text.hpp"

namespace kinemend {

namespace {

constexpr std::size_t unsigned_words = 65536;

std::size_t value_count(const C3dParameter& parameter) {
  return std::accumulate(parameter.dimensions.begin(), parameter.dimensions.end(), std::size_t{1},
                         std::multiplies<>());
}

std::size_t value_bytes(C3dType type) {
  return type == C3dType::text ? 1 : static_cast<std::size_t>(type);
}

// An entry is: length of the name (negative when locked), number of the group (negative for the
// group itself), the name, the distance from this field to the next entry, then for a parameter its
// type, its dimensions and its values, and last a description with its length.
class EntryReader {
 public:
  EntryReader(const C3dSource& source, std::size_t begin, std::size_t end)
      : source_(source), position_(begin), end_(end) {}

  C3dParameters read() {
    while (read_entry()) {
    }
    return std::move(result_);
  }

 private:
  bool has(std::size_t count) const { return end_ - position_ >= count; }
  int signed_byte(std::size_t offset) const {
    const int value = source_.byte(offset);
    return value < 128 ? value : value - 256;
  }

  // Reads an entry; returns false at the end of the list.
  bool read_entry() {
    entry_ = position_;
    if (!has(2)) return false;
    const int name_length = signed_byte(position_);
    const int group = signed_byte(position_ + 1);
    if (name_length == 0 || group == 0) return false;
    position_ += 2;
    const std::size_t length = static_cast<std::size_t>(std::abs(name_length));
    if (!has(length + 2)) return damaged("its name");
    const std::string name(source_.bytes.substr(position_, length));
    position_ += length;
    const std::size_t next = position_ + source_.word(position_);
    const bool last = next == position_;
    position_ += 2;
    const bool read = group < 0 ? read_group(-group, name, name_length < 0)
                                : read_parameter(group, name, name_length < 0);
    return read && !last && move_to(next);
  }

  bool read_group(std::int32_t number, const std::string& name, bool locked) {
    result_.groups.push_back({number, name, read_description(), locked});
    return true;
  }

  bool read_parameter(std::int32_t group, const std::string& name, bool locked) {
    C3dParameter parameter;
    parameter.group = group;
    parameter.name = name;
    parameter.locked = locked;
    if (!has(2)) return damaged("its type");
    parameter.type = static_cast<C3dType>(source_.byte(position_));
    const std::size_t dimensions = source_.byte(position_ + 1);
    position_ += 2;
    if (!is_known(parameter.type)) return damaged("its type");
    if (!has(dimensions)) return damaged("its dimensions");
    for (std::size_t i = 0; i < dimensions; ++i)
      parameter.dimensions.push_back(source_.byte(position_ + i));
    position_ += dimensions;
    // Seven dimensions of 255 fit into 64 bits; more are not valid in C3D.
    const std::size_t count = dimensions > 7 ? end_ : value_count(parameter);
    if (count > (end_ - position_) / value_bytes(parameter.type)) return damaged("its values");
    read_values(parameter, count);
    position_ += count * value_bytes(parameter.type);
    parameter.description = read_description();
    result_.entries.push_back(std::move(parameter));
    return true;
  }

  static bool is_known(C3dType type) {
    return type == C3dType::text || type == C3dType::byte || type == C3dType::integer ||
           type == C3dType::real;
  }

  void read_values(C3dParameter& parameter, std::size_t count) const {
    parameter.data_begin = position_;
    if (parameter.type == C3dType::text) {
      parameter.text = source_.bytes.substr(position_, count);
      return;
    }
    parameter.numbers.reserve(count);
    for (std::size_t i = 0; i < count; ++i) parameter.numbers.push_back(value(parameter.type, i));
  }

  double value(C3dType type, std::size_t index) const {
    if (type == C3dType::byte) return source_.byte(position_ + index);
    if (type == C3dType::integer)
      return static_cast<std::int16_t>(source_.word(position_ + 2 * index));
    return source_.real(position_ + 4 * index);
  }

  // Some writers leave the description out, so that the next entry is in its place.
  std::string read_description() {
    if (!has(1)) return {};
    const std::size_t length = source_.byte(position_);
    if (!has(1 + length)) return {};
    std::string text(source_.bytes.substr(position_ + 1, length));
    described_end_ = position_ + 1 + length;
    return text;
  }

  // Entries may have space between them, but they must not overlap.
  bool move_to(std::size_t next) {
    if (next >= position_ && next < end_) {
      position_ = next;
      return true;
    }
    source_.note("damaged_parameter_pointer", entry_,
                 "the pointer to the next parameter is wrong: it is read right after this one");
    position_ = std::min(std::max(position_, described_end_), end_);
    return true;
  }

  bool damaged(std::string_view what) {
    source_.note(
        "damaged_parameters", entry_,
        fmt::format("a parameter is damaged in {}: it and all parameters after it are ignored",
                    what));
    return false;
  }

  const C3dSource& source_;
  std::size_t position_;
  std::size_t end_;
  std::size_t entry_ = 0;
  std::size_t described_end_ = 0;
  C3dParameters result_;
};

std::string without_blanks(std::string_view text) {
  text = text.substr(0, text.find('\0'));
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return std::string(text);
}

}  // namespace

std::vector<std::string> texts_of(const C3dParameter& parameter) {
  const std::size_t length = parameter.dimensions.empty() ? 1 : parameter.dimensions[0];
  std::vector<std::string> texts;
  if (length == 0) {
    // The other dimensions give the number of empty texts.
    std::size_t count = parameter.dimensions.size() > 1 ? 1 : 0;
    for (std::size_t i = 1; i < parameter.dimensions.size(); ++i)
      count = std::min<std::size_t>(count * parameter.dimensions[i], 255);
    texts.resize(count);
    return texts;
  }
  for (std::size_t i = 0; i + length <= parameter.text.size(); i += length)
    texts.push_back(without_blanks(std::string_view(parameter.text).substr(i, length)));
  return texts;
}

bool C3dParameters::has_group(std::string_view name) const {
  return std::any_of(groups.begin(), groups.end(),
                     [&](const C3dGroup& group) { return equal_ignoring_case(group.name, name); });
}

bool C3dParameters::holds(std::string_view group, const C3dParameter& parameter) const {
  return std::any_of(groups.begin(), groups.end(), [&](const C3dGroup& known) {
    return known.number == parameter.group && equal_ignoring_case(known.name, group);
  });
}

const C3dParameter* C3dParameters::find(std::string_view group, std::string_view name) const {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const C3dParameter& p) {
    return equal_ignoring_case(p.name, name) && holds(group, p);
  });
  return found == entries.end() ? nullptr : &*found;
}

std::optional<double> C3dParameters::number(std::string_view group, std::string_view name) const {
  const C3dParameter* const parameter = find(group, name);
  if (parameter == nullptr || parameter->numbers.empty()) return std::nullopt;
  return parameter->numbers[0];
}

std::optional<std::size_t> C3dParameters::count(std::string_view group,
                                                std::string_view name) const {
  const auto value = number(group, name);
  if (!value || !(std::fabs(*value) < unsigned_words)) return std::nullopt;
  const auto whole = static_cast<std::int32_t>(*value);
  return static_cast<std::size_t>(whole) % unsigned_words;
}

namespace {

// Calls `action` with NAME, NAME2, NAME3, ... as long as they exist.
template <class Action>
void for_each_part(const C3dParameters& parameters, std::string_view group, std::string_view name,
                   Action&& action) {
  const C3dParameter* part = parameters.find(group, name);
  for (int number = 2; part != nullptr; ++number) {
    action(*part);
    part = parameters.find(group, fmt::format("{}{}", name, number));
  }
}

}  // namespace

std::vector<double> C3dParameters::numbers(std::string_view group, std::string_view name) const {
  std::vector<double> all;
  for_each_part(*this, group, name, [&](const C3dParameter& part) {
    all.insert(all.end(), part.numbers.begin(), part.numbers.end());
  });
  return all;
}

std::vector<std::string> C3dParameters::texts(std::string_view group, std::string_view name) const {
  std::vector<std::string> all;
  for_each_part(*this, group, name, [&](const C3dParameter& part) {
    if (part.type != C3dType::text) return;
    for (std::string& text : texts_of(part)) all.push_back(std::move(text));
  });
  return all;
}

std::string C3dParameters::text(std::string_view group, std::string_view name) const {
  const C3dParameter* const parameter = find(group, name);
  if (parameter == nullptr || parameter->type != C3dType::text) return {};
  std::vector<std::string> all = texts_of(*parameter);
  return all.empty() ? std::string() : std::move(all[0]);
}

C3dParameters read_c3d_parameters(const C3dSource& source, std::size_t begin, std::size_t end) {
  return EntryReader(source, begin, end).read();
}

namespace {

using Words = C3dWords<C3dProcessor::intel>;

// An entry's length is 16 bits, which some readers treat as signed.
constexpr std::size_t most_entry_bytes = 32000;
constexpr std::size_t most_in_a_byte = 255;

std::int32_t group_number(C3dParameters& parameters, std::string_view name) {
  for (const C3dGroup& group : parameters.groups) {
    if (equal_ignoring_case(group.name, name)) return group.number;
  }
  const auto is_used = [&](std::int32_t number) {
    const auto same_group = [&](const C3dGroup& group) { return group.number == number; };
    const auto in_group = [&](const C3dParameter& p) { return p.group == number; };
    return std::any_of(parameters.groups.begin(), parameters.groups.end(), same_group) ||
           std::any_of(parameters.entries.begin(), parameters.entries.end(), in_group);
  };
  std::int32_t number = 1;
  while (is_used(number)) ++number;
  if (number > 127) throw Error(ErrorKind::usage, "C3D files can hold 127 groups");
  parameters.groups.push_back({number, std::string(name), "", false});
  return number;
}

class SectionWriter {
 public:
  std::string write(const C3dParameters& parameters) {
    out_.assign(4, '\0');
    for (const C3dGroup& group : parameters.groups) write_group(group);
    for (const C3dParameter& parameter : parameters.entries) write_parameter(parameter);
    // Two zero bytes end the list.
    const std::size_t blocks = (out_.size() + 2 + c3d_block_bytes - 1) / c3d_block_bytes;
    out_.resize(blocks * c3d_block_bytes);
    out_[0] = 1;
    out_[1] = 0x50;
    out_[2] = static_cast<char>(std::min(blocks, most_in_a_byte));
    out_[3] = static_cast<char>(C3dProcessor::intel);
    return std::move(out_);
  }

 private:
  void put_byte(std::size_t value) { out_ += static_cast<char>(value); }
  void put_word(std::uint16_t value) {
    out_.append(2, '\0');
    Words::put_word(out_.data() + out_.size() - 2, value);
  }

  void begin_entry(std::string_view name, bool locked, std::int32_t number) {
    const auto length = static_cast<std::int32_t>(std::min<std::size_t>(name.size(), 127));
    out_ += static_cast<char>(locked ? -length : length);
    out_ += static_cast<char>(number);
    out_.append(name.substr(0, 127));
    length_at_ = out_.size();
    put_word(0);
  }

  void end_entry(std::string_view description) {
    put_byte(std::min(description.size(), most_in_a_byte));
    out_.append(description.substr(0, most_in_a_byte));
    if (out_.size() - length_at_ > 0xFFFF)
      throw Error(ErrorKind::usage, "a parameter is too long for a C3D file");
    Words::put_word(out_.data() + length_at_, static_cast<std::uint16_t>(out_.size() - length_at_));
  }

  void write_group(const C3dGroup& group) {
    begin_entry(group.name, group.locked, -group.number);
    end_entry(group.description);
  }

  void write_parameter(const C3dParameter& parameter) {
    begin_entry(parameter.name, parameter.locked, parameter.group);
    out_ += static_cast<char>(parameter.type);
    put_byte(parameter.dimensions.size());
    for (const std::uint8_t dimension : parameter.dimensions) put_byte(dimension);
    out_ += parameter.text;
    for (const double value : parameter.numbers) write_number(parameter.type, value);
    end_entry(parameter.description);
  }

  void write_number(C3dType type, double value) {
    if (type == C3dType::byte) return put_byte(static_cast<std::uint8_t>(value));
    if (type == C3dType::integer)
      return put_word(static_cast<std::uint16_t>(static_cast<std::int32_t>(value)));
    out_.append(4, '\0');
    Words::put_real(out_.data() + out_.size() - 4, static_cast<float>(value));
  }

  std::string out_;
  std::size_t length_at_ = 0;
};

C3dParameter new_parameter(std::string name, C3dType type, std::vector<std::uint8_t> dimensions,
                           std::vector<double> numbers, std::string text = {}) {
  C3dParameter parameter;
  parameter.name = std::move(name);
  parameter.type = type;
  parameter.dimensions = std::move(dimensions);
  parameter.numbers = std::move(numbers);
  parameter.text = std::move(text);
  return parameter;
}

}  // namespace

C3dParameter c3d_integers(std::string name, std::vector<double> values) {
  const auto count = static_cast<std::uint8_t>(values.size());
  return new_parameter(std::move(name), C3dType::integer, {count}, std::move(values));
}

C3dParameter c3d_integer(std::string name, double value) {
  return new_parameter(std::move(name), C3dType::integer, {}, {value});
}

C3dParameter c3d_real(std::string name, double value) {
  return new_parameter(std::move(name), C3dType::real, {}, {value});
}

C3dParameter c3d_reals(std::string name, std::vector<double> values, std::size_t columns) {
  const auto width = static_cast<std::uint8_t>(columns);
  const auto rows = static_cast<std::uint8_t>(values.size() / columns);
  return new_parameter(std::move(name), C3dType::real, {width, rows}, std::move(values));
}

C3dParameter c3d_text(std::string name, std::string_view text) {
  text = text.substr(0, most_in_a_byte);
  return new_parameter(std::move(name), C3dType::text, {static_cast<std::uint8_t>(text.size())}, {},
                       std::string(text));
}

void set_parameter(C3dParameters& parameters, std::string_view group, C3dParameter parameter) {
  parameter.group = group_number(parameters, group);
  const C3dParameter* const old = parameters.find(group, parameter.name);
  if (old == nullptr) {
    parameters.entries.push_back(std::move(parameter));
    return;
  }
  parameter.description = old->description;
  parameter.locked = old->locked;
  parameters.entries[static_cast<std::size_t>(old - parameters.entries.data())] =
      std::move(parameter);
}

void set_texts(C3dParameters& parameters, std::string_view group, const std::string& name,
               const std::vector<std::string>& texts) {
  remove_parameter(parameters, group, name);
  std::size_t length = 1;
  for (const std::string& text : texts) length = std::max(length, text.size());
  if (length > most_in_a_byte) {
    throw Error(ErrorKind::usage,
                fmt::format("a text of {} bytes; C3D files can hold 255", length));
  }
  const std::size_t rows = std::min(most_in_a_byte, most_entry_bytes / length);
  for (std::size_t first = 0, part = 1; first == 0 || first < texts.size(); first += rows, ++part) {
    const std::size_t count = std::min(rows, texts.size() - first);
    std::string text;
    for (std::size_t i = first; i < first + count; ++i) {
      text += texts[i];
      text.append(length - texts[i].size(), ' ');
    }
    set_parameter(
        parameters, group,
        new_parameter(part == 1 ? name : fmt::format("{}{}", name, part), C3dType::text,
                      {static_cast<std::uint8_t>(length), static_cast<std::uint8_t>(count)}, {},
                      std::move(text)));
  }
}

void remove_parameter(C3dParameters& parameters, std::string_view group, std::string_view name) {
  std::string part(name);
  bool removed = true;
  for (int number = 2; removed; ++number) {
    removed = false;
    while (const C3dParameter* const found = parameters.find(group, part)) {
      parameters.entries.erase(parameters.entries.begin() + (found - parameters.entries.data()));
      removed = true;
    }
    part = fmt::format("{}{}", name, number);
  }
}

void remove_group(C3dParameters& parameters, std::string_view name) {
  std::erase_if(parameters.entries,
                [&](const C3dParameter& entry) { return parameters.holds(name, entry); });
  std::erase_if(parameters.groups,
                [&](const C3dGroup& group) { return equal_ignoring_case(group.name, name); });
}

std::string c3d_parameter_section(const C3dParameters& parameters) {
  return SectionWriter().write(parameters);
}

}  // namespace kinemend
