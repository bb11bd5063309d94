// Reads npz files as takes of joints or of markers.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "base/text.hpp"
#include "io/held_samples.hpp"
#include "io/npz/npz.hpp"
#include "io/npz/npz_document.hpp"
#include "io/npz/zip_archive.hpp"
#include "io/reading_limits.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/frames.hpp"

namespace kinemend {

namespace {

constexpr double npz_rate_when_unknown_hz = 120;
constexpr std::string_view npy_ending = ".npy";
constexpr std::array<std::string_view, 17> npz_names{"format",
                                                     "fps",
                                                     "names",
                                                     "parents",
                                                     "offsets",
                                                     "rest_rotations",
                                                     "rotations",
                                                     "positions",
                                                     "observed",
                                                     "unit",
                                                     "observed_positions",
                                                     "translated_joints",
                                                     "end_parents",
                                                     "end_offsets",
                                                     "end_names",
                                                     "first_frame",
                                                     "metres_per_unit"};

class NpzDecoder {
 public:
  explicit NpzDecoder(const NpzDocument& document)
      : document_(document), left_bytes_(memory_limit(document.bytes.size())) {}

  NpzTake decode() {
    check_layout();
    if (document_.archive.find("rotations.npy") != nullptr) {
      read_joints();
    } else if (document_.archive.find("positions.npy") != nullptr) {
      read_markers();
    } else {
      throw file_error(fmt::format("holds neither the array rotations nor positions; it has: {}",
                                   member_list()));
    }
    take().frame_rate_hz = rate();
    return std::move(result_);
  }

 private:
  Take& take() { return result_.take; }

  Error file_error(std::string_view message) const {
    return Error(ErrorKind::unreadable_input,
                 fmt::format("{}: {}", document_.archive.name, message));
  }
  static Error array_error(const NpyArray& array, std::string_view message) {
    return Error::at_byte(array.place.file, array.place.begin,
                          fmt::format("array {}: {}", quote(array.place.array), message));
  }

  std::string member_list() const {
    constexpr std::size_t most_named = 20;
    std::vector<std::string> names;
    for (const ZipMember& member : document_.archive.members) {
      if (names.size() == most_named) break;
      names.push_back(quote(member.name));
    }
    return names.empty() ? "no array" : fmt::format("{}", fmt::join(names, ", "));
  }

  // Counts the memory that the take needs, because a few bytes of the file may ask for a lot.
  void charge(std::size_t count, std::size_t bytes_each) {
    if (count > left_bytes_ / bytes_each)
      throw file_error(
          fmt::format("needs too much memory for a file of {} bytes", document_.bytes.size()));
    left_bytes_ -= count * bytes_each;
  }

  void note(std::string_view kind, std::string_view message, std::size_t count) {
    if (count > 0) result_.repairs.push_back({std::string(kind), std::string(message), count});
  }

  std::optional<NpyArray> optional_array(const std::string& name, bool of_numbers = true) {
    std::optional<NpyArray> array = npz_array(document_, name, left_bytes_);
    if (array && array->holds_numbers() != of_numbers)
      throw array_error(*array, of_numbers ? "expected numbers" : "expected texts");
    return array;
  }
  NpyArray array(const std::string& name, bool of_numbers = true) {
    if (std::optional<NpyArray> found = optional_array(name, of_numbers)) return *std::move(found);
    throw file_error(fmt::format("the array {} is missing; the file has: {}", name, member_list()));
  }

  static void check_shape(const NpyArray& array, std::initializer_list<std::size_t> shape) {
    if (std::equal(shape.begin(), shape.end(), array.shape.begin(), array.shape.end())) return;
    throw array_error(array, fmt::format("expected the shape ({}), found ({})",
                                         fmt::join(shape, ", "), fmt::join(array.shape, ", ")));
  }

  static double only_number(const NpyArray& array) {
    if (array.count() != 1) throw array_error(array, "expected one number");
    double value = 0;
    npy_numbers(array, 0, {&value, 1});
    return value;
  }
  double number_or(const std::string& name, double otherwise) {
    const std::optional<NpyArray> found = optional_array(name);
    return found ? only_number(*found) : otherwise;
  }
  std::string text_or_none(const std::string& name) {
    const std::optional<NpyArray> found = optional_array(name, false);
    if (!found) return "";
    if (found->count() != 1) throw array_error(*found, "expected one text");
    return npy_text(*found, 0);
  }

  void check_layout() {
    const std::string layout = text_or_none("format");
    if (!layout.empty() && layout != npz_layout)
      throw file_error(
          fmt::format("has the layout {}; this program reads {}", quote(layout), npz_layout));
  }

  double rate() {
    const double stated = number_or("fps", 0);
    if (is_usable_frame_rate(stated)) return stated;
    if (stated != 0) note("frame_rate_unusable", unusable_rate_text(stated), 1);
    if (document_.rate_when_unknown_hz > 0) return document_.rate_when_unknown_hz;
    note("frame_rate_assumed",
         fmt::format("no usable array fps: {} Hz assumed", npz_rate_when_unknown_hz), 1);
    return npz_rate_when_unknown_hz;
  }

  std::vector<std::string> names(const std::string& array_name, std::size_t count) {
    const NpyArray found = array(array_name, false);
    check_shape(found, {count});
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < count; ++i) texts.push_back(npy_text(found, i));
    return texts;
  }

  // Returns whole numbers, each at least `least` and below `end(i)`.
  template <class End>
  std::vector<std::int32_t> indices(const NpyArray& found, std::int32_t least, End end) {
    std::vector<std::int32_t> values;
    for (std::size_t i = 0; i < found.count(); ++i) {
      double value = 0;
      npy_numbers(found, i, {&value, 1});
      const bool is_lawful = value >= least && value < end(i) && value == std::floor(value);
      if (!is_lawful)
        throw array_error(found, fmt::format("element {} is {}, which no joint can be", i, value));
      values.push_back(static_cast<std::int32_t>(value));
    }
    return values;
  }

  std::vector<Vec3> fixed_vectors(const NpyArray& found) {
    std::vector<Vec3> vectors;
    for (std::size_t i = 0; i < found.shape[0]; ++i) {
      const Vec3 v = vector_at(found, i);
      if (is_missing(v)) throw array_error(found, fmt::format("row {} is not finite", i));
      vectors.push_back(v);
    }
    return vectors;
  }

  static Vec3 vector_at(const NpyArray& found, std::size_t index) {
    std::array<double, 3> xyz{};
    npy_numbers(found, 3 * index, xyz);
    return {xyz[0], xyz[1], xyz[2]};
  }
  static std::array<double, 4> four_at(const NpyArray& found, std::size_t index) {
    std::array<double, 4> wxyz{};
    npy_numbers(found, 4 * index, wxyz);
    return wxyz;
  }

  void read_joints() {
    const NpyArray parents = array("parents");
    if (parents.shape.size() != 1 || parents.shape[0] == 0)
      throw array_error(parents, "expected one number for each of at least one joint");
    read_skeleton(parents, parents.shape[0]);
    read_translated();
    read_positions();
    read_rotations();
  }

  void read_skeleton(const NpyArray& parents, std::size_t joints) {
    constexpr std::size_t bytes_a_joint = 256;  // names, channels and offsets
    charge(joints, bytes_a_joint);
    Skeleton& skeleton = take().skeleton;
    const auto above = indices(parents, -1, [](std::size_t j) { return static_cast<double>(j); });
    check_depth(parents, above);
    const std::vector<std::string> joint_names = names("names", joints);
    const NpyArray offset_array = array("offsets");
    check_shape(offset_array, {joints, 3});
    const std::vector<Vec3> offsets = fixed_vectors(offset_array);
    const RotationOrder order = parse_rotation_order("ZXY");
    for (std::size_t j = 0; j < joints; ++j)
      skeleton.add_joint(joint_names[j], above[j], offsets[j], make_channels(j == 0, order));
    read_rest();
    read_end_sites();
    const double metres = number_or("metres_per_unit", 0);
    take().metres_per_unit = metres > 0 ? metres : 0;
  }

  void check_depth(const NpyArray& parents, const std::vector<std::int32_t>& above) const {
    std::vector<std::size_t> depth(above.size(), 1);
    for (std::size_t j = 0; j < above.size(); ++j) {
      if (above[j] >= 0) depth[j] = depth[static_cast<std::size_t>(above[j])] + 1;
      if (depth[j] > document_.max_depth)
        throw array_error(parents,
                          fmt::format("joints are nested deeper than {}", document_.max_depth));
    }
  }

  void read_rest() {
    const std::optional<NpyArray> rest = optional_array("rest_rotations");
    if (!rest) return;
    Skeleton& skeleton = take().skeleton;
    check_shape(*rest, {skeleton.joint_count(), 4});
    for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
      const auto [w, x, y, z] = four_at(*rest, j);
      const Quat rotation = rotation_of_values(w, x, y, z);
      if (is_missing(rotation)) throw array_error(*rest, fmt::format("row {} is no rotation", j));
      skeleton.rest_rotations[j] = rotation;
    }
  }

  void read_end_sites() {
    const std::optional<NpyArray> parents = optional_array("end_parents");
    if (!parents) return;
    if (parents->shape.size() != 1) throw array_error(*parents, "expected one index");
    const std::size_t count = parents->shape[0];
    constexpr std::size_t bytes_a_site = 128;
    charge(count, bytes_a_site);
    const auto joints = static_cast<double>(take().joint_count());
    const auto above = indices(*parents, 0, [&](std::size_t) { return joints; });
    const NpyArray offset_array = array("end_offsets");
    check_shape(offset_array, {count, 3});
    const std::vector<Vec3> offsets = fixed_vectors(offset_array);
    std::vector<std::string> end_names(count);
    if (document_.archive.find("end_names.npy") != nullptr) end_names = names("end_names", count);
    for (std::size_t i = 0; i < count; ++i)
      take().skeleton.end_sites.push_back({above[i], offsets[i], std::move(end_names[i])});
  }

  void read_translated() {
    const std::optional<NpyArray> found = optional_array("translated_joints");
    if (!found) return;
    if (found->shape.size() != 1) throw array_error(*found, "expected one index");
    const auto joints = static_cast<double>(take().joint_count());
    take().translated_joints = indices(*found, 1, [&](std::size_t) { return joints; });
    const auto& translated = take().translated_joints;
    const auto is_not_ascending = [](std::int32_t a, std::int32_t b) { return a >= b; };
    if (std::adjacent_find(translated.begin(), translated.end(), is_not_ascending) !=
        translated.end())
      throw array_error(*found, "expected ascending numbers of joints");
    for (const std::int32_t joint : translated) {
      take().skeleton.channels[static_cast<std::size_t>(joint)] =
          make_channels(true, parse_rotation_order("ZXY"));
    }
  }

  void read_positions() {
    const NpyArray found = array("positions");
    const std::size_t points = take().point_count();
    if (found.shape.size() != 3) throw array_error(found, "expected the shape (frames, points, 3)");
    frames_ = found.shape[0];
    check_shape(found, {frames_, points, 3});
    charge(frames_ * points, sizeof(Vec3) + 1);
    auto& positions = take().positions;
    positions.resize(frames_ * points);
    std::vector<std::uint8_t> seen = mask("observed_positions", points);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      positions[i] = vector_at(found, i);
      if (!is_missing(positions[i])) continue;
      ++lost;
      if (seen.empty()) seen.assign(positions.size(), 1);
      seen[i] = 0;
    }
    note("value_not_finite", "a position is not finite: held from a neighbour", lost);
    const auto& offsets = take().skeleton.offsets;
    for (std::size_t k = 0; k < points && lost > 0; ++k) {
      const std::int32_t joint = k == 0 ? 0 : take().translated_joints[k - 1];
      hold_missing(positions, k, points, offsets[static_cast<std::size_t>(joint)]);
    }
    take().observed_positions = std::move(seen);
  }

  // Returns one byte for each frame and owner; empty if the array is missing or marks all as
  // measured.
  std::vector<std::uint8_t> mask(const std::string& name, std::size_t owners) {
    const std::optional<NpyArray> found = optional_array(name);
    if (!found) return {};
    check_shape(*found, {frames_, owners});
    charge(found->count(), 1);
    std::vector<std::uint8_t> seen(found->count());
    bool is_whole = true;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      double value = 0;
      npy_numbers(*found, i, {&value, 1});
      seen[i] = value != 0 ? 1 : 0;
      is_whole = is_whole && seen[i] != 0;
    }
    return is_whole ? std::vector<std::uint8_t>() : seen;
  }

  void read_rotations() {
    const NpyArray found = array("rotations");
    const std::size_t joints = take().joint_count();
    check_shape(found, {frames_, joints, 4});
    charge(frames_ * joints, sizeof(Quat) + 1);
    auto& rotations = take().rotations;
    rotations.resize(frames_ * joints);
    std::vector<std::uint8_t> seen = mask("observed", joints);
    std::size_t not_finite = 0, not_unit = 0, lost = 0;
    for (std::size_t i = 0; i < rotations.size(); ++i) {
      const auto [w, x, y, z] = four_at(found, i);
      rotations[i] = relative_to_rest(rotation_of_values(w, x, y, z), i % joints);
      not_finite += std::isnan(w + x + y + z) ? 1 : 0;
      if (is_missing(rotations[i])) {
        ++lost;
        if (seen.empty()) seen.assign(rotations.size(), 1);
        seen[i] = 0;
      } else if (std::fabs(norm(Quat{w, x, y, z}) - 1) > unit_length_tolerance) {
        ++not_unit;
      }
    }
    note("value_not_finite", "a rotation is not finite: held from a neighbour", not_finite);
    note("rotation_missing", "a rotation is missing: held from a neighbour", lost - not_finite);
    note("rotation_not_unit", "the length of a quaternion is not 1: it is scaled", not_unit);
    for (std::size_t j = 0; j < joints && lost > 0; ++j) hold_missing(rotations, j, joints, Quat{});
    take().observed = std::move(seen);
  }

  Quat relative_to_rest(Quat whole, std::size_t joint) {
    const Quat rest = take().skeleton.rest_rotations[joint];
    if (rest == Quat{} || is_missing(whole)) return whole;
    return normalized(conjugate(rest) * whole);
  }

  void read_markers() {
    const NpyArray found = array("positions");
    if (found.shape.size() != 3 || found.shape[1] == 0)
      throw array_error(found, "expected the shape (frames, markers, 3)");
    frames_ = found.shape[0];
    const std::size_t markers = found.shape[1];
    check_shape(found, {frames_, markers, 3});
    constexpr std::size_t bytes_a_marker = 128;
    charge(markers, bytes_a_marker);
    charge(frames_ * markers, sizeof(Vec3) + 1);
    take().names = names("names", markers);
    take().unit = text_or_none("unit");
    const double first = number_or("first_frame", 1);
    constexpr double most_first = 1e15;
    if (!(std::fabs(first) <= most_first) || first != std::floor(first))
      throw file_error("first_frame is no number of a frame");
    take().first_frame = static_cast<std::int64_t>(first);
    read_samples(found, markers);
  }

  void read_samples(const NpyArray& found, std::size_t markers) {
    Take& clip = take();
    clip.observed = mask("observed", markers);
    if (clip.observed.empty()) clip.observed.assign(frames_ * markers, 1);
    clip.is_position.assign(markers, 1);
    clip.positions.resize(frames_ * markers);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < clip.positions.size(); ++i) {
      const Vec3 position = vector_at(found, i);
      const bool is_lost = is_missing(position);
      lost += is_lost ? 1 : 0;
      if (is_lost) clip.observed[i] = 0;
      if (clip.observed[i] != 0) clip.positions[i] = position;
    }
    note("value_not_finite", "a position is not finite: it is missing", lost);
  }

  const NpzDocument& document_;
  std::size_t left_bytes_;
  std::size_t frames_ = 0;
  NpzTake result_;
};

}  // namespace

std::optional<NpyArray> npz_array(const NpzDocument& document, const std::string& name,
                                  std::size_t& left_bytes) {
  const ZipMember* const member = document.archive.find(name + std::string(npy_ending));
  if (member == nullptr) return std::nullopt;
  NpyPlace place{document.archive.name, name, member->begin};
  NpyArray array = read_npy(zip_content(document.bytes, document.archive, *member, left_bytes),
                            std::move(place));
  left_bytes -= member->raw_bytes;
  return array;
}

std::vector<std::string> other_npz_arrays(const NpzDocument& document) {
  std::vector<std::string> others;
  for (const ZipMember& member : document.archive.members) {
    std::string_view name = member.name;
    if (name.ends_with(npy_ending)) name.remove_suffix(npy_ending.size());
    if (std::find(npz_names.begin(), npz_names.end(), name) == npz_names.end())
      others.emplace_back(name);
  }
  return others;
}

NpzTake take_of_npz(const NpzDocument& document) { return NpzDecoder(document).decode(); }

// An archive of arrays may hold any data, so this looks for an array of the layout.
int sniff_npz(std::string_view head) {
  constexpr int of_the_layout = 100, of_arrays = 20;
  const auto name_at = [&](std::size_t place) {
    constexpr std::size_t size_of_name = 26;
    return head.size() < place + zip_header_bytes
               ? std::string_view()
               : head.substr(place + zip_header_bytes, zip_number(head, place + size_of_name, 2));
  };
  if (!head.starts_with(zip_header_mark) || !name_at(0).ends_with(npy_ending)) return 0;
  for (std::size_t place = 0; place != head.npos;
       place = head.find(zip_header_mark, place + zip_header_bytes)) {
    std::string_view name = name_at(place);
    if (!name.ends_with(npy_ending)) continue;
    name.remove_suffix(npy_ending.size());
    if (std::find(npz_names.begin(), npz_names.end(), name) != npz_names.end())
      return of_the_layout;
  }
  return of_arrays;
}

TakeResult read_npz(std::string bytes, std::string_view name, const ReadOptions& options) {
  auto document = std::make_shared<NpzDocument>();
  document->archive = read_zip(bytes, name);
  document->bytes = std::move(bytes);
  document->rate_when_unknown_hz = options.frame_rate_hz;
  document->max_depth = options.max_depth;
  NpzTake decoded = take_of_npz(*document);
  TakeResult result{std::move(decoded.take), {}};
  for (const NpzRepair& repair : decoded.repairs) {
    if (options.strict)
      throw Error(ErrorKind::quality_limit, fmt::format("{}: {}", name, repair.message));
    for (std::size_t i = 0; i < repair.count; ++i)
      result.diagnostics.add(repair.kind, repair.message);
  }
  SourceInfo& source = result.take.source;
  source.name = name;
  source.format = "npz";
  if (const auto others = other_npz_arrays(*document); !others.empty())
    source.facts.push_back({"other arrays", fmt::format("{}", fmt::join(others, ", "))});
  source.document = std::move(document);
  return result;
}

}  // namespace kinemend
