// Writes npz files: into the source archive if the take has one, else as new archives.

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "io/held_samples.hpp"
#include "io/motion/motion_write.hpp"
#include "io/npz/npz.hpp"
#include "io/reading_limits.hpp"

namespace kinemend {

namespace {

using NpzShape = std::vector<std::size_t>;

Quat whole_rotation(const Take& take, std::size_t frame, std::size_t joint) {
  const Quat rest = take.skeleton.rest_rotations[joint];
  const Quat rotation = take.rotation(frame, joint);
  return rest == Quat{} ? rotation : normalized(rest * rotation);
}

std::vector<double> numbers_of(const std::vector<Quat>& rotations) {
  std::vector<double> values;
  values.reserve(4 * rotations.size());
  for (const Quat& q : rotations) values.insert(values.end(), {q.w, q.x, q.y, q.z});
  return values;
}

std::vector<double> numbers_of(const std::vector<Vec3>& vectors) {
  std::vector<double> values;
  values.reserve(3 * vectors.size());
  for (const Vec3& v : vectors) values.insert(values.end(), {v.x, v.y, v.z});
  return values;
}

// Returns 1 or 0 for each of `count` samples; without a mask all samples are measured.
std::vector<std::uint8_t> mask_of(const std::vector<std::uint8_t>& seen, std::size_t count) {
  std::vector<std::uint8_t> mask(count, 1);
  for (std::size_t i = 0; i < seen.size(); ++i) mask[i] = seen[i] != 0 ? 1 : 0;
  return mask;
}

// Returns the mask of the rotations, or of the markers.
std::vector<std::uint8_t> observed_mask(const Take& take) {
  return mask_of(take.observed, take.frame_count() * take.owner_count());
}

std::vector<std::uint8_t> position_mask(const Take& take) {
  return mask_of(take.observed_positions, take.positions.size());
}

class NewNpz {
 public:
  explicit NewNpz(const Take& take) : take_(take) {}

  std::string write() {
    const double fps[] = {take_.frame_rate_hz};
    const std::string layout[] = {std::string(npz_layout)};
    add("format", npy_of(layout, true));
    add("fps", npy_of(fps, NpzShape{}));
    add("names", npy_of(take_.owner_names()));
    if (take_.has_joints()) {
      add_skeleton();
      add_rotations();
    } else {
      add_facts_of_markers();
    }
    add("positions",
        npy_of(numbers_of(take_.positions), NpzShape{take_.frame_count(), take_.point_count(), 3}));
    if (!take_.has_joints() || !take_.observed.empty())
      add("observed",
          npy_of(observed_mask(take_), NpzShape{take_.frame_count(), take_.owner_count()}));
    if (!take_.observed_positions.empty())
      add("observed_positions",
          npy_of(position_mask(take_), NpzShape{take_.frame_count(), take_.point_count()}));
    return make_zip(contents_);
  }

 private:
  void add(const std::string& name, std::string content) {
    contents_.push_back({name + ".npy", std::move(content), false});
  }

  void add_skeleton() {
    const Skeleton& skeleton = take_.skeleton;
    const std::size_t joints = skeleton.joint_count();
    add("parents", npy_of(skeleton.parents, NpzShape{joints}));
    add("offsets", npy_of(numbers_of(skeleton.offsets), NpzShape{joints, 3}));
    const auto& rest = skeleton.rest_rotations;
    if (std::any_of(rest.begin(), rest.end(), [](Quat q) { return !(q == Quat{}); }))
      add("rest_rotations", npy_of(numbers_of(rest), NpzShape{joints, 4}));
    if (!skeleton.end_sites.empty()) add_end_sites();
    const double metres[] = {take_.metres_per_unit};
    add("metres_per_unit", npy_of(metres, NpzShape{}));
    if (!take_.translated_joints.empty())
      add("translated_joints",
          npy_of(take_.translated_joints, NpzShape{take_.translated_joints.size()}));
  }

  void add_end_sites() {
    std::vector<std::int32_t> parents;
    std::vector<Vec3> offsets;
    std::vector<std::string> names;
    for (const EndSite& site : take_.skeleton.end_sites) {
      parents.push_back(site.parent);
      offsets.push_back(site.offset);
      names.push_back(site.name);
    }
    add("end_parents", npy_of(parents, NpzShape{parents.size()}));
    add("end_offsets", npy_of(numbers_of(offsets), NpzShape{offsets.size(), 3}));
    add("end_names", npy_of(names));
  }

  void add_rotations() {
    const std::size_t frames = take_.frame_count(), joints = take_.joint_count();
    std::vector<Quat> rotations;
    rotations.reserve(frames * joints);
    for (std::size_t f = 0; f < frames; ++f) {
      for (std::size_t j = 0; j < joints; ++j) rotations.push_back(whole_rotation(take_, f, j));
    }
    add("rotations", npy_of(numbers_of(rotations), NpzShape{frames, joints, 4}));
  }

  void add_facts_of_markers() {
    const std::string unit[] = {take_.unit};
    add("unit", npy_of(unit, true));
    if (take_.first_frame == 1) return;
    const double first[] = {static_cast<double>(take_.first_frame)};
    add("first_frame", npy_of(first, NpzShape{}));
  }

  const Take& take_;
  std::vector<ZipContent> contents_;
};

const NpzDocument* npz_document_of(const Take& take) {
  return dynamic_cast<const NpzDocument*>(take.source.document.get());
}

// Whether the take differs from the source only in samples.
bool fits_npz(const Take& take, const Take& original) {
  return take.frame_count() == original.frame_count() &&
         take.frame_rate_hz == original.frame_rate_hz &&
         (take.has_joints() || take.first_frame == original.first_frame) &&
         same_parts(take, original);
}

// The arrays whose elements differ from the source's.
class ChangedNpz {
 public:
  ChangedNpz(const Take& take, const Take& original, const NpzDocument& document)
      : take_(take), original_(original), document_(document) {}

  std::map<std::string, std::string> contents() {
    const bool is_mended = take_.has_joints() && change_rotations();
    const bool is_mended_in_place = change_positions();
    const bool is_mask_needed = take_.has_joints() ? is_mended : is_mended_in_place;
    change_mask("observed", observed_mask(take_), observed_mask(original_), take_.owner_count(),
                is_mask_needed);
    if (take_.has_joints())
      change_mask("observed_positions", position_mask(take_), position_mask(original_),
                  take_.point_count(), is_mended_in_place);
    return std::move(contents_);
  }

 private:
  NpyArray array(const std::string& name) {
    std::size_t unlimited = memory_limit(document_.bytes.size());
    return *npz_array(document_, name, unlimited);
  }

  // Replaces each sample i for which `is_same(i)` is false by `value(i)`. Returns whether a
  // replaced sample is missing (`is_seen(i)` is false) or was not finite.
  template <std::size_t size, class IsSeen, class IsSame, class Value>
  bool change(const std::string& name, std::size_t samples, IsSeen is_seen, IsSame is_same,
              Value value) {
    const NpyArray before = array(name);
    std::vector<double> values(size * samples);
    bool is_changed = false, is_mended = false;
    for (std::size_t i = 0; i < samples; ++i) {
      const std::span<double> sample(values.data() + size * i, size);
      npy_numbers(before, size * i, sample);
      const bool is_finite =
          std::none_of(sample.begin(), sample.end(), [](double v) { return std::isnan(v); });
      if (is_finite && is_same(i)) continue;
      is_changed = true;
      is_mended = is_mended || !is_finite || !is_seen(i);
      const std::array<double, size> now = value(i);
      std::copy(now.begin(), now.end(), sample.begin());
    }
    if (is_changed) contents_[name + ".npy"] = npy_of(values, before.shape);
    return is_mended;
  }

  bool change_rotations() {
    const std::size_t joints = take_.joint_count();
    return change<4>(
        "rotations", take_.rotations.size(),
        [&](std::size_t i) { return take_.is_observed(i / joints, i % joints); },
        [&](std::size_t i) {
          return take_.rotations[i] == original_.rotations[i] &&
                 take_.is_observed(i / joints, i % joints) ==
                     original_.is_observed(i / joints, i % joints);
        },
        [&](std::size_t i) {
          const Quat q = whole_rotation(take_, i / joints, i % joints);
          return std::array<double, 4>{q.w, q.x, q.y, q.z};
        });
  }

  bool change_positions() {
    const std::size_t points = take_.point_count();
    const auto is_seen = [&](const Take& take, std::size_t i) {
      return take.has_joints() ? take.is_position_observed(i / points, i % points)
                               : take.is_observed(i / points, i % points);
    };
    return change<3>(
        "positions", take_.positions.size(), [&](std::size_t i) { return is_seen(take_, i); },
        [&](std::size_t i) {
          return take_.positions[i] == original_.positions[i] &&
                 is_seen(take_, i) == is_seen(original_, i);
        },
        [&](std::size_t i) {
          const Vec3 v = take_.positions[i];
          return std::array<double, 3>{v.x, v.y, v.z};
        });
  }

  // A replaced sample that was not finite no longer shows that it is missing, so the mask must mark
  // it.
  void change_mask(const std::string& name, const std::vector<std::uint8_t>& now,
                   const std::vector<std::uint8_t>& before, std::size_t owners, bool is_needed) {
    if (now == before && !is_needed) return;
    contents_[name + ".npy"] = npy_of(now, NpzShape{take_.frame_count(), owners});
  }

  const Take& take_;
  const Take& original_;
  const NpzDocument& document_;
  std::map<std::string, std::string> contents_;
};

}  // namespace

std::string write_npz(const Take& take) {
  take.validate();
  if (const NpzDocument* const document = npz_document_of(take)) {
    const Take original = take_of_npz(*document).take;
    if (fits_npz(take, original)) {
      const auto contents = ChangedNpz(take, original, *document).contents();
      if (contents.empty()) return document->bytes;
      return rewrite_zip(document->bytes, document->archive, contents);
    }
  }
  return NewNpz(take).write();
}

std::vector<std::string> lost_beside_npz(const Take& take) {
  const NpzDocument* const document = npz_document_of(take);
  if (document == nullptr || fits_npz(take, take_of_npz(*document).take)) return {};
  std::vector<std::string> parts;
  for (const std::string& name : other_npz_arrays(*document)) parts.push_back("array " + name);
  return parts;
}

}  // namespace kinemend
