#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "kinemend/corrupt.hpp"

namespace kinemend::corrupt {

using Notes = std::vector<std::string>;

/// Runs `damage` on the clip and reports what it changed.
DamageReport measured(std::string kind, Clip& clip, const std::function<void(Notes&)>& damage);

/// A kind of damage is a struct with `name`, `summary`, `paper`, `Options`, `table()` and
/// `damage(clip, random, options, notes)`. The generator it is given is its own: the same for every
/// joint, to be forked.
template <class Kind>
DamageReport apply_kind(Clip& clip, Random& random, const OptionValues& values) {
  const auto options = Kind::table().parse(values);
  const Random own(random.next());
  return measured(Kind::name, clip, [&](Notes& notes) { Kind::damage(clip, own, options, notes); });
}

template <class Kind>
Damage entry() {
  return {Kind::name, Kind::summary, Kind::paper, Kind::table().specs(), &apply_kind<Kind>};
}

/// The parts of the table, one a source file.
void add_rotation_noise(std::vector<Damage>& table);
void add_biases(std::vector<Damage>& table);
void add_outliers(std::vector<Damage>& table);
void add_position_noise(std::vector<Damage>& table);
void add_gaps(std::vector<Damage>& table);

}  // namespace kinemend::corrupt
