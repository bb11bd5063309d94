// Takes: views of their arrays, and takes made from arrays.
#include "kinemend/take.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "conversions.hpp"
#include "held.hpp"
#include "kinemend/extend/motion.hpp"

namespace kinemend::python {

namespace {

using namespace py::literals;

py::ssize_t count(std::size_t size) { return static_cast<py::ssize_t>(size); }

// The take for a view through which Python may write.
const Take& take_of(const py::object& self) {
  const auto& held = self.cast<const HeldTake&>();
  held.touch();
  return held.take;
}

// The views.

py::array rotations(const py::object& self) {
  const Take& take = take_of(self);
  const std::size_t frames = take.has_joints() ? take.frame_count() : 0;
  return view_of(self, {count(frames), count(take.joint_count()), 4}, numbers_of(take.rotations));
}
py::array positions(const py::object& self) {
  const Take& take = take_of(self);
  return view_of(self, {count(take.frame_count()), count(take.point_count()), 3},
                 numbers_of(take.positions));
}
py::array mask_of(const py::object& self, const std::vector<std::uint8_t>& marks,
                  std::size_t columns) {
  const std::size_t frames = columns == 0 ? 0 : marks.size() / columns;
  return view_of(self, {count(frames), count(columns)},
                 reinterpret_cast<const bool*>(marks.data()));
}
py::array observed(const py::object& self) {
  const Take& take = take_of(self);
  return mask_of(self, take.observed, take.owner_count());
}
py::array observed_positions(const py::object& self) {
  const Take& take = take_of(self);
  const auto& marks = take.has_joints() ? take.observed_positions : take.observed;
  return mask_of(self, marks, take.point_count());
}
py::object residuals(const py::object& self) {
  const Take& take = take_of(self);
  if (take.residuals.empty()) return py::none();
  return view_of(self, {count(take.frame_count()), count(take.point_count())},
                 take.residuals.data());
}
py::array parents(const py::object& self) {
  const Skeleton& skeleton = take_of(self).skeleton;
  return view_of(self, {count(skeleton.parents.size())}, skeleton.parents.data(), false);
}
py::array offsets(const py::object& self) {
  const Skeleton& skeleton = take_of(self).skeleton;
  return view_of(self, {count(skeleton.offsets.size()), 3}, numbers_of(skeleton.offsets));
}
py::array rest_rotations(const py::object& self) {
  const Skeleton& skeleton = take_of(self).skeleton;
  return view_of(self, {count(skeleton.rest_rotations.size()), 4},
                 numbers_of(skeleton.rest_rotations));
}
py::array translated_joints(const py::object& self) {
  const Take& take = take_of(self);
  return view_of(self, {count(take.translated_joints.size())}, take.translated_joints.data(),
                 false);
}
py::array is_position(const py::object& self) {
  const Take& take = take_of(self);
  py::array_t<bool> marks(count(take.marker_count()));
  for (std::size_t i = 0; i < take.marker_count(); ++i)
    marks.mutable_at(count(i)) = take.holds_positions(i);
  return marks;
}

// Start addresses of the arrays, for tests that no array is a copy.
py::dict addresses(const HeldTake& held) {
  const auto address = [](const void* data) { return reinterpret_cast<std::uintptr_t>(data); };
  return py::dict("rotations"_a = address(held.take.rotations.data()),
                  "positions"_a = address(held.take.positions.data()),
                  "observed"_a = address(held.take.observed.data()),
                  "offsets"_a = address(held.take.skeleton.offsets.data()));
}

py::list end_sites(const HeldTake& held) {
  py::list list;
  for (const EndSite& site : held.take.skeleton.end_sites) {
    list.append(py::make_tuple(site.parent,
                               py::make_tuple(site.offset.x, site.offset.y, site.offset.z),
                               text_of(site.name)));
  }
  return list;
}

py::list rotation_orders(const HeldTake& held) {
  py::list orders;
  for (std::size_t joint = 0; joint < held.take.joint_count(); ++joint)
    orders.append(to_string(held.take.skeleton.rotation_order(joint)));
  return orders;
}

py::list events(const HeldTake& held) {
  py::list list;
  for (const MarkerEvent& event : held.take.events)
    list.append(py::make_tuple(text_of(event.label), text_of(event.context), event.time_s));
  return list;
}

py::dict facts(const HeldTake& held) {
  py::dict dict;
  for (const SourceFact& fact : held.take.source.facts)
    dict[text_of(fact.name)] = text_of(fact.text);
  return dict;
}

py::list diagnostics(const HeldTake& held) {
  py::list list;
  for (const Diagnostic& entry : held.diagnostics.entries())
    list.append(py::make_tuple(entry.name, text_of(entry.message), entry.first_line, entry.count));
  return list;
}

// Takes from arrays.

Skeleton skeleton_of(const std::vector<std::string>& names,
                     const std::vector<std::int32_t>& parents, const Numbers& offsets,
                     const std::vector<std::int32_t>& translated, std::string_view order) {
  const auto joints = count(names.size());
  if (parents.size() != names.size())
    throw py::value_error(
        fmt::format("parents: expected {} of them, found {}", names.size(), parents.size()));
  check_shape(offsets, {joints, 3}, "offsets");
  const std::vector<Vec3> all = vectors_of(offsets);
  const RotationOrder rotations = parse_rotation_order(order);
  Skeleton skeleton;
  for (std::size_t joint = 0; joint < names.size(); ++joint) {
    const bool moves = joint == 0 || std::find(translated.begin(), translated.end(),
                                               static_cast<int>(joint)) != translated.end();
    skeleton.add_joint(names[joint], parents[joint], all[joint], make_channels(moves, rotations));
  }
  return skeleton;
}

using Site = std::tuple<std::int32_t, std::array<double, 3>, std::string>;

HeldTakePtr take_of_joints(const py::iterable& names, const std::vector<std::int32_t>& parents,
                           const Numbers& offsets, const Numbers& rotations,
                           const std::optional<Numbers>& positions, double fps,
                           const std::vector<std::int32_t>& translated_joints,
                           const std::optional<Marks>& observed,
                           const std::optional<Marks>& observed_positions,
                           const std::optional<Numbers>& rest_rotations, double metres_per_unit,
                           const std::string& rotation_order, const std::vector<Site>& end_sites) {
  Take take;
  take.skeleton =
      skeleton_of(all_bytes_of(names), parents, offsets, translated_joints, rotation_order);
  take.translated_joints = translated_joints;
  take.frame_rate_hz = fps;
  take.metres_per_unit = metres_per_unit;
  const auto joints = count(take.joint_count()), points = count(take.point_count());
  check_shape(rotations, {-1, joints, 4}, "rotations");
  const py::ssize_t frames = rotations.shape(0);
  take.rotations = quats_of(rotations);
  if (rest_rotations) {
    check_shape(*rest_rotations, {joints, 4}, "rest_rotations");
    take.skeleton.rest_rotations = quats_of(*rest_rotations);
  }
  if (positions) {
    check_shape(*positions, {frames, points, 3}, "positions");
    take.positions = vectors_of(*positions);
  } else {
    if (!translated_joints.empty())
      throw py::value_error("positions: needed where joints are translated");
    take.positions.assign(static_cast<std::size_t>(frames), take.skeleton.offsets.front());
  }
  if (observed) {
    check_shape(*observed, {frames, joints}, "observed");
    take.observed = marks_of(*observed);
  }
  if (observed_positions) {
    check_shape(*observed_positions, {frames, points}, "observed_positions");
    take.observed_positions = marks_of(*observed_positions);
  }
  for (const auto& [parent, offset, name] : end_sites)
    take.skeleton.end_sites.push_back({parent, {offset[0], offset[1], offset[2]}, name});
  take.validate();
  return hold(std::move(take));
}

HeldTakePtr take_of_markers(const py::iterable& names, const Numbers& positions, double fps,
                            const std::optional<Marks>& observed, const std::string& unit) {
  Take take = make_marker_take(all_bytes_of(names), 0, fps);
  take.unit = unit;
  const auto markers = count(take.marker_count());
  check_shape(positions, {-1, markers, 3}, "positions");
  take.positions = vectors_of(positions);
  take.observed.assign(take.positions.size(), 1);
  if (observed) {
    check_shape(*observed, {positions.shape(0), markers}, "observed");
    take.observed = marks_of(*observed);
  }
  for (std::size_t i = 0; i < take.positions.size(); ++i) {
    Vec3& position = take.positions[i];
    const bool is_finite =
        std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z);
    if (!is_finite) take.observed[i] = 0;
    if (take.observed[i] == 0) position = {};
  }
  take.validate();
  return hold(std::move(take));
}

// Values computed from a take.

HeldTakePtr frames_of(const HeldTake& held, const py::slice& range) {
  std::size_t start = 0, stop = 0, step = 0, length = 0;
  if (!range.compute(held.take.frame_count(), &start, &stop, &step, &length))
    throw py::error_already_set();
  if (step != 1) throw py::value_error("a take is cut into frames that follow one another: step 1");
  return hold(slice(held.take, start, start + length));
}

py::tuple forward(const HeldTake& held) {
  const Take& take = held.take;
  const auto frames = count(take.frame_count()), joints = count(take.joint_count());
  Numbers rotations(std::vector<py::ssize_t>{frames, joints, 4});
  Numbers positions(std::vector<py::ssize_t>{frames, joints, 3});
  auto* turn = reinterpret_cast<Quat*>(rotations.mutable_data());
  auto* place = reinterpret_cast<Vec3*>(positions.mutable_data());
  {
    const py::gil_scoped_release release;
    for (std::size_t frame = 0; take.has_joints() && frame < take.frame_count(); ++frame) {
      const Pose pose = forward_kinematics(take, frame);
      turn = std::copy(pose.rotations.begin(), pose.rotations.end(), turn);
      place = std::copy(pose.positions.begin(), pose.positions.end(), place);
    }
  }
  return py::make_tuple(rotations, positions);
}

py::str words_of(const HeldTake& held) {
  const Take& take = held.take;
  const char* const owners = take.has_joints() ? "joints" : "markers";
  const std::string name = take.source.name.empty() ? "" : " " + take.source.name;
  const std::string unit = take.unit.empty() ? "" : " in " + take.unit;
  return text_of(fmt::format("<kinemend.Take{}: {} frames of {} {}{} at {:g} Hz>", name,
                             take.frame_count(), take.owner_count(), owners, unit,
                             take.frame_rate_hz));
}

void bind_making(py::class_<HeldTake, HeldTakePtr>& type) {
  type.def_static("of_joints", take_of_joints, "names"_a, "parents"_a, "offsets"_a, "rotations"_a,
                  "positions"_a = py::none(), py::kw_only(), "fps"_a,
                  "translated_joints"_a = std::vector<std::int32_t>(), "observed"_a = py::none(),
                  "observed_positions"_a = py::none(), "rest_rotations"_a = py::none(),
                  "metres_per_unit"_a = 0.0, "rotation_order"_a = "ZXY",
                  "end_sites"_a = std::vector<Site>(),
                  R"(A take of joints from arrays, which are copied.

Parameters
----------
names : list of str
    J joints, every parent before its children; joint 0 is the root.
parents : list of int
    J indices; -1 for a root.
offsets : array of shape (J, 3)
    From the parent joint, in its frame, in the unit of the take.
rotations : array of shape (F, J, 4)
    Unit quaternions w, x, y, z, relative to the rest rotation.
positions : array of shape (F, 1 + T, 3), optional
    Of joint 0, then of the translated joints. Default: joint 0 stays at its offset.
fps : float
    Frames per second.
translated_joints : list of int, optional
    Joints other than 0 that also move in their parents, ascending.
observed, observed_positions : arrays of bool of shapes (F, J) and (F, 1 + T), optional
    True where a sample was measured. Default: all were.
rest_rotations : array of shape (J, 4), optional
    Of each joint in its parent where its rotation is identity. Default: identity.
metres_per_unit : float, default 0
    Of lengths; 0 where it is not known.
rotation_order : str, default "ZXY"
    Of the Euler angles when the take is written to a format that has them.
end_sites : list of (int, (float, float, float), str), optional
    Joint, offset and name of each end of a chain.

Raises
------
ValueError
    An array has another shape.
Error
    The take breaks a rule: a rotation is no unit quaternion, a rate is not positive.)");
  type.def_static("of_markers", take_of_markers, "names"_a, "positions"_a, py::kw_only(), "fps"_a,
                  "observed"_a = py::none(), "unit"_a = "",
                  R"(A take of markers from arrays, which are copied.

Parameters
----------
names : list of str
    P markers.
positions : array of shape (F, P, 3)
    NaN where a marker is missing.
fps : float
    Frames per second.
observed : array of bool of shape (F, P), optional
    True where a marker was measured. Default: where its position is finite.
unit : str, optional
    Of lengths: "mm", "m".)");
}

void bind_views(py::class_<HeldTake, HeldTakePtr>& type) {
  type.def_property_readonly("rotations", rotations,
                             "Array (F, J, 4), a view: unit quaternions w, x, y, z relative to the "
                             "rest rotation. (0, 0, 4) for markers.");
  type.def_property_readonly("positions", positions,
                             "Array (F, P, 3), a view. Joints: of joint 0, then of the translated "
                             "joints in their parents. Markers: zero where missing.");
  type.def_property_readonly("observed", observed,
                             "Array of bool (F, J) or (F, P), a view: True where a rotation or a "
                             "marker was measured.");
  type.def_property_readonly("observed_positions", observed_positions,
                             "The same of `positions`, (F, P).");
  type.def_property_readonly("residuals", residuals,
                             "Array of float32 (F, P), a view; None where the format has none.");
  type.def_property_readonly("parents", parents, "Array of int32 (J,), read-only; -1 for a root.");
  type.def_property_readonly("offsets", offsets, "Array (J, 3), a view: from the parent joint.");
  type.def_property_readonly("rest_rotations", rest_rotations,
                             "Array (J, 4), a view: of each joint in its parent where its rotation "
                             "is identity.");
  type.def_property_readonly("translated_joints", translated_joints,
                             "Array of int32 (P - 1,), read-only: joints other than 0 with a "
                             "position.");
  type.def_property_readonly("is_position", is_position,
                             "Array of bool (P,), a copy: False for the angles and forces among "
                             "the points of a C3D file.");
  type.def("_addresses", addresses);
}

void bind_facts(py::class_<HeldTake, HeldTakePtr>& type) {
  type.def_property_readonly(
      "names", [](const HeldTake& held) { return texts_of(held.take.owner_names()); },
      "Names of the joints or markers.");
  type.def_property(
      "fps", [](const HeldTake& held) { return held.take.frame_rate_hz; },
      [](HeldTake& held, double fps) {
        held.take.frame_rate_hz = fps;
        held.touch();
      },
      "Frames per second.");
  type.def_property_readonly(
      "kind", [](const HeldTake& held) { return held.take.has_joints() ? "joints" : "markers"; },
      "\"joints\" or \"markers\".");
  type.def_property(
      "unit", [](const HeldTake& held) { return text_of(held.take.unit); },
      [](HeldTake& held, const std::string& unit) { held.take.unit = unit; },
      "Of lengths of markers; empty where the file does not say.");
  type.def_property(
      "metres_per_unit", [](const HeldTake& held) { return held.take.metres_per_unit; },
      [](HeldTake& held, double metres) { held.take.metres_per_unit = metres; },
      "Of lengths of joints; 0 where the file does not say.");
  type.def_property_readonly(
      "first_frame", [](const HeldTake& held) { return first_frame_number(held.take); },
      "The number that the file gives its first frame. Reports count frames like this.");
  type.def_property(
      "name", [](const HeldTake& held) { return text_of(held.take.source.name); },
      [](HeldTake& held, const py::str& name) { held.take.source.name = bytes_of(name); },
      "The path, for messages and reports.");
  type.def_property_readonly(
      "format", [](const HeldTake& held) { return held.take.source.format; },
      "\"bvh\"; empty for a take made of arrays.");
  type.def_property_readonly(
      "animation", [](const HeldTake& held) { return text_of(held.take.source.animation); },
      "Which take of a file that holds several.");
  type.def_property_readonly(
      "animations", [](const HeldTake& held) { return texts_of(held.take.source.animations); },
      "The takes of such a file.");
  type.def_property_readonly("end_sites", end_sites, "Joint, offset and name of each.");
  type.def_property_readonly("rotation_orders", rotation_orders,
                             "Of the Euler angles of each joint: \"ZXY\".");
  type.def_property_readonly("events", events, "Label, context and time in seconds of each.");
  type.def_property_readonly("facts", facts, "What the file holds beside the motion, in words.");
  type.def_property_readonly("_diagnostics", diagnostics);
}

}  // namespace

HeldTakePtr hold(Take take, Diagnostics diagnostics) {
  const std::size_t frames = take.frame_count();
  if (take.observed.empty()) take.observed.assign(frames * take.owner_count(), 1);
  if (take.has_joints() && take.observed_positions.empty())
    take.observed_positions.assign(frames * take.point_count(), 1);
  return std::make_shared<HeldTake>(HeldTake{std::move(take), std::move(diagnostics), false});
}

void bind_takes(py::module_& module) {
  py::class_<HeldTake, HeldTakePtr> type(
      module, "Take",
      "A motion of F frames: of J joints of a skeleton, or of P markers.\n\n"
      "Arrays are views on the memory of the take: what is written into them is written into the "
      "take, and their shapes are fixed.");
  bind_making(type);
  bind_views(type);
  bind_facts(type);
  const auto copy = [](const HeldTake& held) { return std::make_shared<HeldTake>(held); };
  type.def("copy", copy, "The same take with memory of its own.");
  type.def("__copy__", copy);
  type.def(
      "__deepcopy__", [copy](const HeldTake& held, const py::dict&) { return copy(held); },
      "memo"_a);
  type.def("__len__", [](const HeldTake& held) { return held.take.frame_count(); });
  type.def("__getitem__", frames_of, "frames"_a,
           "Frames [first:last] as a new take, without the file that it came from.");
  type.def("__repr__", words_of);
  type.def(
      "validate", [](const HeldTake& held) { held.take.validate(); },
      "Raises `Error` with the first frame and joint or marker that break a rule.");
  type.def("forward_kinematics", forward,
           "Global rotations (F, J, 4) and positions (F, J, 3) of the joints.");
}

}  // namespace kinemend::python
