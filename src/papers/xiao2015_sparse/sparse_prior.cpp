// Stores the prior in a model file and reads it. Divides a body into torso, arms and legs by the
// names of its joints or markers, or as a file says.
#include "papers/xiao2015_sparse/sparse_prior.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "base/cells.hpp"
#include "body/body_names.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"
#include "motion/names.hpp"

namespace kinemend {

namespace {

using TensorShape = std::vector<std::size_t>;

[[noreturn]] void fail(const std::string& tensor) {
  throw Error(ErrorKind::unreadable_input,
              fmt::format("the model's {} does not fit its body", tensor));
}

std::string tensor_name(std::size_t poselet, const char* what) {
  return fmt::format("poselet{}.{}", poselet, what);
}

Tensor integers(const std::vector<std::int32_t>& values) {
  return {TensorType::i32, {values.size()}, {values.begin(), values.end()}};
}

// Whole numbers of at least `least` and below `end`.
std::vector<std::int32_t> integers_of(const Model& model, const std::string& name, double least,
                                      std::size_t end) {
  std::vector<std::int32_t> result;
  for (const double value : model.tensor(name, 1).values) {
    if (value < least || value >= static_cast<double>(end) || value != std::floor(value))
      fail(name);
    result.push_back(static_cast<std::int32_t>(value));
  }
  return result;
}

SparsePoints points_of_model(const Model& model) {
  const std::size_t tracks = model.layout.track_count();
  SparsePoints points;
  points.kind = model.layout.kind;
  points.parents = integers_of(model, "point_parents", -1, tracks);
  const std::size_t count = points.parents.size();
  for (std::size_t p = 0; p < count; ++p) {
    const bool is_root = points.kind == BodyKind::markers || p == 0;
    const auto before = static_cast<std::int32_t>(std::min(p, tracks));
    if (is_root ? points.parents[p] != -1 : points.parents[p] < 0 || points.parents[p] >= before)
      fail("point_parents");
  }
  if (count < tracks || count == 0 || (points.kind == BodyKind::markers && count != tracks))
    fail("point_parents");
  const std::vector<double>& offsets = model.tensor("offsets", TensorShape{count, 3}).values;
  for (std::size_t p = 0; p < count; ++p)
    points.offsets.push_back({offsets[3 * p], offsets[3 * p + 1], offsets[3 * p + 2]});
  return points;
}

SparsePoselet poselet_of_model(const Model& model, std::size_t number, std::size_t points,
                               std::size_t window) {
  SparsePoselet poselet;
  poselet.name = tensor_name(number, "points");
  poselet.points = integers_of(model, tensor_name(number, "points"), 0, points);
  const std::size_t channels = poselet.channels();
  const std::vector<double>& mean =
      model.tensor(tensor_name(number, "mean"), TensorShape{channels}).values;
  poselet.mean.assign(mean.begin(), mean.end());
  const std::string name = tensor_name(number, "atoms");
  const Tensor& atoms = model.tensor(name, 3);
  if (channels == 0 || atoms.shape[0] == 0 || atoms.shape[1] != window ||
      atoms.shape[2] != channels)
    fail(name);
  poselet.dictionary.rows = window * channels;
  poselet.dictionary.atoms = atoms.shape[0];
  poselet.dictionary.values.assign(atoms.values.begin(), atoms.values.end());
  return poselet;
}

}  // namespace

void store_sparse_prior(const SparsePrior& prior, Model& model) {
  model.rate_hz = prior.rate_hz;
  model.numbers["window_frames"] = static_cast<double>(prior.window_frames);
  model.numbers["poselets"] = static_cast<double>(prior.poselets.size());
  model.tensors["point_parents"] = integers(prior.points.parents);
  Tensor offsets{TensorType::f32, {prior.points.count(), 3}, {}};
  for (const Vec3 offset : prior.points.offsets)
    offsets.values.insert(offsets.values.end(), {offset.x, offset.y, offset.z});
  model.tensors["offsets"] = offsets;
  const LocalPoints& local = prior.local;
  model.tensors["local_points"] =
      integers({local.root, local.left_hip, local.right_hip, local.neck});
  for (std::size_t i = 0; i < prior.poselets.size(); ++i) {
    const SparsePoselet& poselet = prior.poselets[i];
    model.tensors[tensor_name(i, "points")] = integers(poselet.points);
    model.tensors[tensor_name(i, "mean")] = {
        TensorType::f32, {poselet.channels()}, {poselet.mean.begin(), poselet.mean.end()}};
    const sparse::Dictionary& atoms = poselet.dictionary;
    model.tensors[tensor_name(i, "atoms")] = {
        TensorType::f16,
        {atoms.atoms, prior.window_frames, poselet.channels()},
        {atoms.values.begin(), atoms.values.end()}};
  }
}

SparsePrior sparse_prior_of(const Model& model) {
  SparsePrior prior;
  prior.rate_hz = model.rate_hz;
  prior.points = points_of_model(model);
  const double window = model.number("window_frames"), poselets = model.number("poselets");
  if (!(window >= 1) || window > 1e4 || !(poselets >= 1) || poselets > 100) fail("window_frames");
  prior.window_frames = static_cast<std::size_t>(window);
  const std::vector<std::int32_t> local =
      integers_of(model, "local_points", -1, prior.points.count());
  if (local.size() != 4) fail("local_points");
  prior.local = {local[0], local[1], local[2], local[3]};
  for (std::size_t i = 0; i < static_cast<std::size_t>(poselets); ++i)
    prior.poselets.push_back(poselet_of_model(model, i, prior.points.count(), prior.window_frames));
  return prior;
}

namespace {

using representation::Bone;
using representation::BoneName;
using representation::Side;

enum Part : std::uint8_t { torso, left_arm, right_arm, left_leg, right_leg, unknown };
constexpr std::array<std::string_view, 5> part_names{"torso", "left arm", "right arm", "left leg",
                                                     "right leg"};

// A point's part, and whether the torso shares it.
struct Place {
  Part part = unknown;
  bool is_shared = false;
};

Place limb(Side side, bool is_leg, bool is_shared) {
  if (side == Side::none) return {};
  const bool left = side == Side::left;
  return {is_leg ? (left ? left_leg : right_leg) : (left ? left_arm : right_arm), is_shared};
}

Place place_of(const BoneName& bone) {
  switch (bone.bone) {
    case Bone::pelvis:
    case Bone::spine:
    case Bone::neck:
    case Bone::head:
      return {torso, false};
    case Bone::clavicle:
    case Bone::upper_arm:
      return limb(bone.side, false, true);
    case Bone::forearm:
    case Bone::hand:
    case Bone::palm:
      return limb(bone.side, false, false);
    case Bone::hip:
    case Bone::thigh:
      return limb(bone.side, true, true);
    case Bone::shin:
    case Bone::foot:
    case Bone::toe:
      return limb(bone.side, true, false);
    case Bone::other:
      break;
  }
  return {};
}

// The usual names of markers, without the letter of their side.
struct MarkerWord {
  std::string_view start;
  bool is_leg, is_shared;
};
constexpr std::array marker_words = std::to_array<MarkerWord>({
    {"sho", false, true},  {"upa", false, false}, {"elb", false, false}, {"fra", false, false},
    {"frm", false, false}, {"wr", false, false},  {"fin", false, false}, {"han", false, false},
    {"thm", false, false}, {"asi", true, true},   {"psi", true, true},   {"fwt", true, true},
    {"bwt", true, true},   {"thi", true, false},  {"kne", true, false},  {"tib", true, false},
    {"shn", true, false},  {"ank", true, false},  {"hee", true, false},  {"hel", true, false},
    {"toe", true, false},  {"mt", true, false},
});

Place place_of_marker(const std::string& name) {
  const std::string word = representation::plain_name(name);
  for (const std::string_view middle :
       {"c7", "t10", "clav", "strn", "lfhd", "rfhd", "lbhd", "rbhd", "rbac"}) {
    if (word.starts_with(middle)) return {torso, false};
  }
  if (word.size() < 3 || (word[0] != 'l' && word[0] != 'r')) return {};
  for (const MarkerWord& known : marker_words) {
    if (std::string_view(word).substr(1).starts_with(known.start))
      return limb(word[0] == 'l' ? Side::left : Side::right, known.is_leg, known.is_shared);
  }
  return {};
}

// Guesses the part from the mean position of a standing body, in body heights: y up, x to the left.
Place place_at(Vec3 mean) {
  // Height of the hips, and lateral distance at which arms begin. Chosen by hand, not swept.
  constexpr double hips = 0.5, shoulders = 0.16;
  const Side side = mean.x > 0 ? Side::left : Side::right;
  if (std::abs(mean.x) > shoulders && mean.y > 0.5 * hips) return limb(side, false, false);
  if (mean.y < hips) return limb(side, true, false);
  return {torso, false};
}

std::vector<Place> places_of(const BodyLayout& layout, const SparsePoints& points) {
  const std::vector<BoneName> bones = representation::bone_names(layout.names);
  std::vector<Place> places;
  for (std::size_t p = 0; p < points.count(); ++p) {
    Place place;
    if (p < bones.size()) {
      place = place_of(bones[p]);
      if (points.kind == BodyKind::markers) {
        if (place.part == unknown) place = place_of_marker(layout.names[p]);
        if (place.part == unknown) place = place_at(points.offsets[p]);
      }
    }
    // A point of unknown name belongs to the part of its parent.
    if (place.part == unknown && points.parents[p] >= 0)
      place.part = places[static_cast<std::size_t>(points.parents[p])].part;
    if (place.part == unknown) place.part = torso;
    places.push_back(place);
  }
  return places;
}

std::int32_t track_of_name(const BodyLayout& layout,
                           std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    for (std::size_t i = 0; i < layout.names.size(); ++i) {
      if (representation::plain_name(layout.names[i]) == name) return static_cast<std::int32_t>(i);
    }
  }
  return -1;
}

}  // namespace

std::vector<SparsePoselet> find_poselets(const BodyLayout& layout, const SparsePoints& points,
                                         bool whole) {
  std::vector<SparsePoselet> poselets(part_names.size());
  const std::vector<Place> places = places_of(layout, points);
  for (std::size_t i = 0; i < poselets.size(); ++i) poselets[i].name = part_names[i];
  for (std::size_t p = 0; p < places.size(); ++p) {
    const auto number = static_cast<std::int32_t>(p);
    if (whole) {
      poselets[torso].points.push_back(number);
      continue;
    }
    poselets[places[p].part].points.push_back(number);
    if (places[p].is_shared) poselets[torso].points.push_back(number);
    // A limb also has the joint of the torso that carries it.
    const std::int32_t parent = points.parents[p];
    if (parent <= 0 || places[p].part == torso ||
        places[static_cast<std::size_t>(parent)].part != torso)
      continue;
    std::vector<std::int32_t>& limb_points = poselets[places[p].part].points;
    if (std::find(limb_points.begin(), limb_points.end(), parent) == limb_points.end())
      limb_points.push_back(parent);
  }
  if (whole) poselets[torso].name = "body";
  std::erase_if(poselets, [](const SparsePoselet& poselet) { return poselet.points.empty(); });
  for (SparsePoselet& poselet : poselets) std::sort(poselet.points.begin(), poselet.points.end());
  return poselets;
}

LocalPoints find_local_points(const BodyLayout& layout) {
  const std::vector<BoneName> bones = representation::bone_names(layout.names);
  const auto found = [&](Bone bone, Side side, std::initializer_list<std::string_view> names) {
    const std::int32_t track = representation::find_bone(bones, bone, side);
    return track >= 0 ? track : track_of_name(layout, names);
  };
  LocalPoints points;
  points.left_hip = found(Bone::thigh, Side::left, {"lasi", "lfwt"});
  points.right_hip = found(Bone::thigh, Side::right, {"rasi", "rfwt"});
  points.neck = found(Bone::neck, Side::none, {"c7", "clav", "t10"});
  if (points.neck < 0) points.neck = representation::find_bone(bones, Bone::head, Side::none);
  points.root = 0;
  if (layout.kind == BodyKind::joints) return points;
  const std::int32_t pelvis = representation::find_bone(bones, Bone::pelvis, Side::none);
  points.root = pelvis >= 0 ? pelvis : std::max(points.left_hip, std::int32_t{0});
  return points;
}

namespace {

// Chosen by hand.
constexpr std::size_t most_poselets = 100;  // the limit of a model file

// A line of the file, with its place for errors.
struct Line {
  std::string_view file, text;
  std::size_t number;

  [[noreturn]] void refuse(const std::string& message) const {
    throw Error(ErrorKind::usage, fmt::format("{}:{}: {}", file, number, message));
  }
};

// Marks the points that a name matches: its tracks, and the free ends on them.
void mark_points(const Line& line, std::string_view name, const BodyLayout& layout,
                 const SparsePoints& points, std::vector<std::uint8_t>& marks) {
  if (name.empty()) line.refuse("a name is missing between two commas");
  const std::vector<std::uint8_t> meant = names_meant(layout.names, std::string(name));
  if (std::find(meant.begin(), meant.end(), 1) == meant.end()) {
    line.refuse(fmt::format("no {} is named \"{}\"",
                            points.kind == BodyKind::joints ? "joint" : "marker",
                            printable_name(name)));
  }
  for (std::size_t p = 0; p < points.count(); ++p) {
    const std::size_t track = p < meant.size() ? p : static_cast<std::size_t>(points.parents[p]);
    if (meant[track] != 0) marks[p] = 1;
  }
}

SparsePoselet poselet_of_line(const Line& line, const BodyLayout& layout,
                              const SparsePoints& points) {
  const std::size_t colon = line.text.find(':');
  if (colon == line.text.npos)
    line.refuse(fmt::format("expected \"poselet: name, name, ...\", found \"{}\"",
                            printable_name(line.text)));
  SparsePoselet poselet;
  poselet.name = trimmed(line.text.substr(0, colon));
  if (poselet.name.empty()) line.refuse("expected the poselet's name before the colon");
  std::string_view rest = trimmed(line.text.substr(colon + 1));
  if (rest.empty())
    line.refuse(fmt::format("poselet \"{}\" is empty", printable_name(poselet.name)));
  std::vector<std::uint8_t> marks(points.count(), 0);
  for (bool more = true; more;) {
    const std::size_t comma = rest.find(',');
    mark_points(line, trimmed(rest.substr(0, comma)), layout, points, marks);
    more = comma != rest.npos;
    if (more) rest.remove_prefix(comma + 1);
  }
  for (std::size_t p = 0; p < marks.size(); ++p) {
    if (marks[p] != 0) poselet.points.push_back(static_cast<std::int32_t>(p));
  }
  return poselet;
}

// The tracks that are in no poselet.
std::vector<std::string> left_over(const std::vector<SparsePoselet>& poselets,
                                   const BodyLayout& layout) {
  std::vector<std::uint8_t> used(layout.track_count(), 0);
  for (const SparsePoselet& poselet : poselets) {
    for (const std::int32_t point : poselet.points) {
      if (static_cast<std::size_t>(point) < used.size()) used[static_cast<std::size_t>(point)] = 1;
    }
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] == 0) names.push_back(layout.names[i]);
  }
  return names;
}

}  // namespace

std::vector<SparsePoselet> parse_poselets(std::string_view text, std::string_view name,
                                          const BodyLayout& layout, const SparsePoints& points) {
  text = without_byte_order_mark(text);
  std::vector<SparsePoselet> poselets;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view own = text.substr(0, end);
    const Line line{name, trimmed(own.substr(0, own.find('#'))), number};
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.text.empty()) continue;
    SparsePoselet poselet = poselet_of_line(line, layout, points);
    for (const SparsePoselet& other : poselets) {
      if (other.name == poselet.name)
        line.refuse(
            fmt::format("poselet \"{}\" is already in a line above", printable_name(other.name)));
    }
    if (poselets.size() == most_poselets)
      line.refuse(fmt::format("more than {} poselets", most_poselets));
    poselets.push_back(std::move(poselet));
  }
  if (poselets.empty())
    throw Error(ErrorKind::usage, fmt::format("{}: there are no poselets in it", name));
  if (const std::vector<std::string> names = left_over(poselets, layout); !names.empty()) {
    throw Error(ErrorKind::usage,
                fmt::format("{}: in no poselet: {}", name, fmt::join(names, ", ")));
  }
  return poselets;
}

}  // namespace kinemend
