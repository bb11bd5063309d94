// Turns a struct that describes a kind of damage into an entry of the table of damages.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "kinemend/lab/corrupt.hpp"

namespace kinemend::corrupt {

using Notes = std::vector<std::string>;

/// Runs `damage` on the clip and reports the changes.
DamageReport measured(std::string kind, Take& clip, const std::function<void(Notes&)>& damage);

DamageReport measured(std::string kind, VectorMotion& motion,
                      const std::function<void(Notes&)>& damage);

/// A kind of damage is a struct with `name`, `summary`, `paper`, `Options`, `table()` and
/// `damage(clip, random, options, notes)`. It gets its own generator, to be forked for each joint.
/// `damage` also accepts a `VectorMotion`, unless it needs a skeleton: then it accepts only a
/// `Take`.
template <class Kind, class Motion>
DamageReport apply_kind(Motion& motion, Random& random, const OptionValues& values) {
  const auto options = Kind::table().parse(values);
  const Random own(random.next());
  return measured(Kind::name, motion,
                  [&](Notes& notes) { Kind::damage(motion, own, options, notes); });
}

template <class Kind>
Damage entry() {
  Damage damage{
      Kind::name, Kind::summary, Kind::paper, Kind::table().specs(), &apply_kind<Kind, Take>,
      nullptr};
  if constexpr (requires(VectorMotion & motion, const Random& random,
                         const typename Kind::Options& options,
                         Notes& notes) { Kind::damage(motion, random, options, notes); }) {
    damage.apply_to_vectors = &apply_kind<Kind, VectorMotion>;
  }
  return damage;
}

/// These functions add the sections of the table, one for each source file.
void add_rotation_noise(std::vector<Damage>& table);
void add_biases(std::vector<Damage>& table);
void add_outliers(std::vector<Damage>& table);
void add_position_noise(std::vector<Damage>& table);
void add_gaps(std::vector<Damage>& table);
void add_lower_rates(std::vector<Damage>& table);
void add_systems(std::vector<Damage>& table);

}  // namespace kinemend::corrupt
