// Fills, checks, compares and damages takes, and finds contacts of feet.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "conversions.hpp"
#include "held.hpp"
#include "kinemend/check.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/io.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/metrics.hpp"
#include "reports.hpp"

namespace kinemend::python {

namespace {

using namespace py::literals;

std::optional<Axis> axis_named(const std::optional<std::string>& name) {
  if (!name) return std::nullopt;
  if (*name == "x") return Axis::x;
  if (*name == "y") return Axis::y;
  if (*name == "z") return Axis::z;
  throw Error(ErrorKind::usage, "up: expected x, y or z, found " + *name);
}

// The model of the requested method.
FillModels fill_models(const std::string& method, const std::string& model,
                       const std::string& map) {
  FillModels models;
  if (method == "learned") models.learned = make_learned_fill({model, map});
  if (method == "recurrent") models.recurrent = make_recurrent_fill({model, map});
  return models;
}

py::tuple fill(const HeldTakePtr& held, const std::string& method, const py::iterable& names,
               const py::str& donor, double longest_gap_s, bool fill_all, double max_error,
               double max_error_deg, bool unlabelled,
               const std::optional<std::pair<std::size_t, std::size_t>>& range,
               const std::string& model, const std::string& map) {
  FillSettings settings;
  settings.method = method;
  settings.names = all_bytes_of(names);
  settings.donor = bytes_of(donor);
  settings.longest_gap_s = longest_gap_s;
  settings.fill_all = fill_all;
  settings.max_error = max_error;
  settings.max_error_deg = max_error_deg;
  settings.unlabelled = unlabelled;
  settings.range = range;
  HeldTakePtr result;
  ReportPtr report;
  {
    const py::gil_scoped_release release;
    held->check();
    settings.models = fill_models(method, model, map);
    Take take = held->take;
    FillOutcome outcome{fill_gaps(take, settings)};
    if (range) {
      const std::size_t left = find_gaps(take).size() + find_position_gaps(take).size();
      const std::size_t told = outcome.report.refused() + outcome.report.unlabelled;
      outcome.not_within_range = left - std::min(left, told);
    }
    report = report_of(*held, take, std::move(outcome));
    result = hold(std::move(take), held->diagnostics);
  }
  return py::make_tuple(result, report);
}

// Sets the member `name`; returns false if no member has that name.
template <class Settings>
bool set_number(Settings& settings, std::string_view name, const py::handle& value,
                std::initializer_list<std::pair<std::string_view, double Settings::*>> members) {
  for (const auto& [known, member] : members) {
    if (known != name) continue;
    settings.*member = value.cast<double>();
    return true;
  }
  return false;
}

bool set_limit(JointLimits& limits, std::string_view name, const py::handle& value) {
  return set_number(limits, name, value,
                    {{"speed_deg_s", &JointLimits::speed_deg_s},
                     {"acceleration_deg_s2", &JointLimits::acceleration_deg_s2}});
}

bool set_robot_number(RobotSettings& robot, std::string_view name, const py::handle& value) {
  return set_limit(robot.limits, name, value) ||
         set_number(robot, name, value,
                    {{"step_s", &RobotSettings::step_s},
                     {"penetration_cm", &RobotSettings::penetration_cm},
                     {"floating_cm", &RobotSettings::floating_cm},
                     {"jump_deg", &RobotSettings::jump_deg},
                     {"jump_cm", &RobotSettings::jump_cm},
                     {"floor_cm", &RobotSettings::floor_cm}});
}

// Joints of a pattern inherit the limits that it does not state, as in a file of limits.
RobotSettings robot_settings_of(const py::dict& numbers, const py::dict& joints) {
  RobotSettings robot;
  for (const auto& [key, value] : numbers) {
    if (const std::string name = bytes_of(key); !set_robot_number(robot, name, value))
      throw Error(ErrorKind::usage, "robot: unknown setting " + name);
  }
  for (const auto& [pattern, limits] : joints) {
    NamedJointLimits named{bytes_of(pattern), robot.limits};
    for (const auto& [key, value] : limits.cast<py::dict>()) {
      if (const std::string name = bytes_of(key); !set_limit(named.limits, name, value))
        throw Error(ErrorKind::usage, "robot: " + named.pattern + ": unknown limit " + name);
    }
    robot.joints.push_back(std::move(named));
  }
  return robot;
}

ReportPtr check(const HeldTakePtr& held, const std::optional<std::string>& up,
                std::optional<double> metres_per_unit, const py::dict& feet_names,
                const std::optional<py::dict>& robot, const py::dict& joint_limits,
                const std::string& source) {
  CheckSettings settings;
  settings.source = parse_source(source);
  if (robot) settings.robot = robot_settings_of(*robot, joint_limits);
  settings.up = axis_named(up);
  settings.metres_per_unit = metres_per_unit;
  settings.names = known_names_of(feet_names);
  const py::gil_scoped_release release;
  settings.plates = force_plates(held->take);
  return report_of(*held, held->take, check_take(held->take, settings));
}

ReportPtr contacts(const HeldTakePtr& held, const py::dict& feet_names) {
  if (!held->take.has_joints())
    throw Error(ErrorKind::usage, "ground contacts are found in takes of joints");
  FeetSettings settings;
  settings.names = known_names_of(feet_names);
  const py::gil_scoped_release release;
  held->check();
  Take copy = held->take;
  return report_of(*held, held->take, clean_feet(copy, settings));
}

MarkerFit fit_named(const std::string& name) {
  for (const MarkerFit fit : {MarkerFit::none, MarkerFit::rigid, MarkerFit::gain_offset}) {
    if (to_string(fit) == name) return fit;
  }
  throw Error(ErrorKind::usage, "fit: expected none, rigid or gain-offset, found " + name);
}

struct CompareSettings {
  ComparisonSettings joints;
  MarkerComparisonSettings markers;
};

CompareOutcome compared(const Take& reference, const Take& other, CompareSettings& settings) {
  CompareOutcome outcome;
  outcome.reference = reference.source.name;
  if (reference.has_joints() != other.has_joints())
    throw Error(ErrorKind::usage, "one take holds joints and the other markers");
  if (reference.has_joints()) {
    settings.joints.first_frame = leading_calibration_frames(reference);
    outcome.comparison = compare_clips(reference, other, settings.joints);
    return outcome;
  }
  outcome.fit = settings.markers.fit;
  outcome.markers = compare_markers(reference, other, settings.markers);
  return outcome;
}

ReportPtr compare(const HeldTakePtr& reference, const HeldTakePtr& other, double psnr_peak,
                  std::optional<double> metres_per_unit, const std::string& up,
                  const std::string& fit, const HeldTakePtr& fit_to, std::int64_t lag_frames,
                  double least_motion) {
  CompareSettings settings;
  settings.joints.psnr_peak = psnr_peak;
  settings.joints.metres_per_unit = metres_per_unit;
  settings.joints.foot_slide.up = axis_named(up).value();
  settings.markers.fit = fit_named(fit);
  settings.markers.fit_to = fit_to ? &fit_to->take : nullptr;
  settings.markers.lag_frames = lag_frames;
  settings.markers.least_motion = least_motion;
  const py::gil_scoped_release release;
  reference->check();
  other->check();
  CompareOutcome outcome = compared(reference->take, other->take, settings);
  // The reference says how joints and markers are spelled; lengths are in its unit.
  TakeFacts facts = take_facts(other->take), shown = take_facts(reference->take);
  facts.input = other->take.source.name;
  facts.diagnostics = other->diagnostics;
  facts.tracks = outcome.markers ? outcome.markers->names : shown.tracks;
  if (!shown.unit.empty()) facts.unit = shown.unit;
  return std::make_shared<const Report>(Report{std::move(facts), std::move(outcome)});
}

py::dict dict_of_damage(const DamageReport& report) {
  return py::dict("damage"_a = report.kind, "samples"_a = report.samples,
                  "samples_damaged"_a = report.samples_damaged, "rms_deg"_a = report.rms_deg,
                  "max_deg"_a = report.max_deg, "rms_position"_a = report.rms_position,
                  "notes"_a = texts_of(report.notes));
}

py::tuple corrupt(const HeldTakePtr& held,
                  const std::vector<std::pair<std::string, py::dict>>& wanted, std::uint64_t seed) {
  std::vector<std::pair<std::string, OptionValues>> requests;
  for (const auto& [name, options] : wanted) requests.emplace_back(name, option_values_of(options));
  std::vector<DamageReport> done;
  HeldTakePtr result;
  {
    const py::gil_scoped_release release;
    held->check();
    Take take = held->take;
    Random random(seed);
    for (const auto& [name, options] : requests)
      done.push_back(apply_damage(take, name, options, random));
    result = hold(std::move(take), held->diagnostics);
  }
  py::list reports;
  for (const DamageReport& report : done) reports.append(dict_of_damage(report));
  return py::make_tuple(result, reports);
}

}  // namespace

void bind_measures(py::module_& module) {
  module.def("fill", fill, "take"_a, py::kw_only(), "method"_a, "names"_a, "donor"_a,
             "longest_gap_s"_a, "fill_all"_a, "max_error"_a, "max_error_deg"_a, "unlabelled"_a,
             "range"_a, "model"_a, "map"_a);
  module.def("check", check, "take"_a, py::kw_only(), "up"_a, "metres_per_unit"_a, "feet_names"_a,
             "robot"_a, "joint_limits"_a, "source"_a);
  module.def("contacts", contacts, "take"_a, py::kw_only(), "feet_names"_a);
  module.def("compare", compare, "reference"_a, "other"_a, py::kw_only(), "psnr_peak"_a,
             "metres_per_unit"_a, "up"_a, "fit"_a, "fit_to"_a, "lag_frames"_a, "least_motion"_a);
  module.def("corrupt", corrupt, "take"_a, "damages"_a, "seed"_a);
}

}  // namespace kinemend::python
