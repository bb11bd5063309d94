// Builds, replaces and removes parameters, and lays out their section byte by byte.
#include "io/c3d/c3d_parameter_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/text/text.hpp"

namespace kinemend {

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

}  // namespace

C3dParameter c3d_integers(std::string name, std::vector<double> values) {
  C3dParameter parameter;
  parameter.name = std::move(name);
  parameter.dimensions = {static_cast<std::uint8_t>(values.size())};
  parameter.numbers = std::move(values);
  return parameter;
}

C3dParameter c3d_integer(std::string name, double value) {
  C3dParameter parameter = c3d_integers(std::move(name), {value});
  parameter.dimensions.clear();
  return parameter;
}

C3dParameter c3d_real(std::string name, double value) {
  C3dParameter parameter = c3d_integer(std::move(name), value);
  parameter.type = C3dType::real;
  return parameter;
}

C3dParameter c3d_reals(std::string name, std::vector<double> values, std::size_t columns) {
  C3dParameter parameter;
  parameter.name = std::move(name);
  parameter.type = C3dType::real;
  parameter.dimensions = {static_cast<std::uint8_t>(columns),
                          static_cast<std::uint8_t>(values.size() / columns)};
  parameter.numbers = std::move(values);
  return parameter;
}

C3dParameter c3d_text(std::string name, std::string_view text) {
  C3dParameter parameter;
  parameter.name = std::move(name);
  parameter.type = C3dType::text;
  parameter.text = text.substr(0, most_in_a_byte);
  parameter.dimensions = {static_cast<std::uint8_t>(parameter.text.size())};
  return parameter;
}

std::vector<C3dParameter> c3d_texts(const std::string& name,
                                    const std::vector<std::string>& texts) {
  std::size_t length = 1;
  for (const std::string& text : texts) length = std::max(length, text.size());
  if (length > most_in_a_byte) {
    throw Error(ErrorKind::usage,
                fmt::format("a text of {} bytes; C3D files can hold 255", length));
  }
  const std::size_t rows = std::min(most_in_a_byte, most_entry_bytes / length);
  std::vector<C3dParameter> parts;
  for (std::size_t first = 0; first == 0 || first < texts.size(); first += rows) {
    const std::size_t count = std::min(rows, texts.size() - first);
    C3dParameter part;
    part.name = parts.empty() ? name : fmt::format("{}{}", name, parts.size() + 1);
    part.type = C3dType::text;
    part.dimensions = {static_cast<std::uint8_t>(length), static_cast<std::uint8_t>(count)};
    for (std::size_t i = first; i < first + count; ++i) {
      part.text += texts[i];
      part.text.append(length - texts[i].size(), ' ');
    }
    parts.push_back(std::move(part));
  }
  return parts;
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
  for (C3dParameter& part : c3d_texts(name, texts))
    set_parameter(parameters, group, std::move(part));
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
  const auto is_it = [&](const C3dGroup& group) { return equal_ignoring_case(group.name, name); };
  const auto in_it = [&](const C3dParameter& parameter) {
    return std::any_of(
        parameters.groups.begin(), parameters.groups.end(),
        [&](const C3dGroup& group) { return group.number == parameter.group && is_it(group); });
  };
  std::erase_if(parameters.entries, in_it);
  std::erase_if(parameters.groups, is_it);
}

std::string c3d_parameter_section(const C3dParameters& parameters) {
  return SectionWriter().write(parameters);
}

}  // namespace kinemend
