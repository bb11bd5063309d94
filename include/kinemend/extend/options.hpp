// The options of methods, each defined once for command lines, files and C++.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "kinemend/error.hpp"

namespace kinemend {

using OptionValue = std::variant<double, std::int64_t, bool, std::string>;
using OptionValues = std::map<std::string, OptionValue, std::less<>>;

/// One option of a method, defined once: parser, help, configuration files, shell completion and
/// manual page are derived from it.
struct OptionSpec {
  /// snake_case and including the unit: `cutoff_hz`. On a command line: `--cutoff-hz`.
  std::string name;
  std::string unit;  ///< "s", "Hz", "deg", ...; empty for a pure number
  OptionValue default_value;
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices;  ///< the allowed values of a text option; empty: any
  std::string help;                  ///< one line
};

/// Returns the value as text, in the form that `parse_option` reads.
std::string to_string(const OptionValue& value);
/// Converts text to the type of the option's default. Errors: `ErrorKind::usage`, naming the option
/// and the values that it accepts.
OptionValue parse_option(const OptionSpec& spec, std::string_view text);
/// Checks type, range and choice; an integer is accepted for a number. Returns the value in the
/// option's own type. Errors: `ErrorKind::usage`: `cutoff_hz: 900 is outside 0.1 to 120 Hz`.
OptionValue check_option(const OptionSpec& spec, const OptionValue& value);

/// Returns the candidate most similar to `name`, for messages; empty if no candidate is similar.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);
/// Returns the nearest name as part of a message: `; did you mean walk?`, or empty.
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

/// Binds option names to the members of a plain options struct, whose initialisers are the
/// defaults.
template <class Options>
class OptionTable {
 public:
  OptionTable& number(double Options::*member, std::string name, std::string unit, double minimum,
                      double maximum, std::string help) {
    return add(member, {std::move(name),
                        std::move(unit),
                        Options{}.*member,
                        minimum,
                        maximum,
                        {},
                        std::move(help)});
  }
  OptionTable& integer(std::int64_t Options::*member, std::string name, std::string unit,
                       double minimum, double maximum, std::string help) {
    return add(member, {std::move(name),
                        std::move(unit),
                        Options{}.*member,
                        minimum,
                        maximum,
                        {},
                        std::move(help)});
  }
  OptionTable& flag(bool Options::*member, std::string name, std::string help) {
    return add(member, {std::move(name), "", Options{}.*member, 0, 1, {}, std::move(help)});
  }
  OptionTable& choice(std::string Options::*member, std::string name,
                      std::vector<std::string> choices, std::string help) {
    return add(member,
               {std::move(name), "", Options{}.*member, 0, 0, std::move(choices), std::move(help)});
  }

  /// A path or other free text; empty by default.
  OptionTable& text(std::string Options::*member, std::string name, std::string help) {
    return add(member, {std::move(name), "", Options{}.*member, 0, 0, {}, std::move(help)});
  }

  const std::vector<OptionSpec>& specs() const noexcept { return specs_; }

  /// The struct with these values set. Errors: `ErrorKind::usage` for an unknown name, a wrong type
  /// or a value out of range.
  Options parse(const OptionValues& values) const {
    Options options;
    for (const auto& [name, value] : values) {
      const std::size_t index = index_of(name);
      setters_[index](options, check_option(specs_[index], value));
    }
    return options;
  }
  /// Every option with its value, the inverse of `parse`.
  OptionValues values(const Options& options) const {
    OptionValues result;
    for (std::size_t i = 0; i < specs_.size(); ++i) result[specs_[i].name] = getters_[i](options);
    return result;
  }
  /// Throws the same errors as `parse` for these values; used by constructors that take the struct.
  void validate(const Options& options) const { parse(values(options)); }

 private:
  template <class T>
  OptionTable& add(T Options::*member, OptionSpec spec) {
    specs_.push_back(std::move(spec));
    setters_.push_back([member](Options& o, const OptionValue& v) { o.*member = std::get<T>(v); });
    getters_.push_back([member](const Options& o) { return OptionValue(o.*member); });
    return *this;
  }
  std::size_t index_of(std::string_view name) const {
    for (std::size_t i = 0; i < specs_.size(); ++i) {
      if (specs_[i].name == name) return i;
    }
    throw Error(ErrorKind::usage, "unknown option " + std::string(name));
  }

  std::vector<OptionSpec> specs_;
  std::vector<std::function<void(Options&, const OptionValue&)>> setters_;
  std::vector<std::function<OptionValue(const Options&)>> getters_;
};

}  // namespace kinemend
