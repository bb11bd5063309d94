// Cleaners, and cleaning whole takes.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "conversions.hpp"
#include "held.hpp"
#include "kinemend/check.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/experimental/threads.hpp"
#include "reports.hpp"
#include "running.hpp"

namespace kinemend::python {

namespace {

using namespace py::literals;

HeldCleanerPtr make_held_cleaner(const std::string& method, const py::dict& options) {
  auto held = std::make_shared<HeldCleaner>();
  const OptionValues values = option_values_of(options);
  const py::gil_scoped_release release;
  held->cleaner = make_cleaner(method, values);
  return held;
}

KnownNames names_of(const py::dict& names) {
  KnownNames known;
  for (const auto& [key, value] : names) known[bytes_of(key)] = bytes_of(value);
  return known;
}

// Leg, part, and first and last frame, counted from 0.
using Contact = std::tuple<std::string, std::string, std::size_t, std::size_t>;

FeetSettings feet_settings(const Take& take, const std::string& mode, const py::dict& names,
                           const std::optional<std::vector<Contact>>& contacts) {
  FeetSettings feet;
  feet.mode = mode == "force" ? FeetMode::force : FeetMode::automatic;
  feet.names = names_of(names);
  if (!contacts) return feet;
  // The parser of side files checks the contacts.
  std::string text;
  const auto first = first_frame_number(take);
  for (const auto& [side, part, begin, end] : *contacts) {
    text += side + " " + part + " " + std::to_string(static_cast<std::int64_t>(begin) + first) +
            " " + std::to_string(static_cast<std::int64_t>(end) + first) + "\n";
  }
  try {
    feet.contacts = parse_contacts(text, "contacts", take, feet.names);
  } catch (const Error& error) {
    throw Error(ErrorKind::usage, error.what());
  }
  return feet;
}

std::optional<KnownNoise> noise_of(const py::object& noise) {
  if (noise.is_none()) return std::nullopt;
  const auto [correlation, strengths] = noise.cast<std::pair<double, py::dict>>();
  KnownNoise known;
  known.correlation = correlation;
  for (const auto& [key, value] : strengths) known.strengths[bytes_of(key)] = value.cast<double>();
  return known;
}

// The fill step itself would check the method only if there is a gap.
void check_fill_method(const std::string& name) {
  std::vector<std::string> names;
  for (const FillMethod& method : fill_methods()) {
    if (method.name == name) return;
    names.emplace_back(method.name);
  }
  throw Error(ErrorKind::usage, "fill: there is no method " + name + suggestion(name, names));
}

std::optional<FillSettings> fill_settings(const py::object& method, bool fill_all,
                                          bool unlabelled) {
  if (method.is_none() && !fill_all) return std::nullopt;
  FillSettings fill;
  if (!method.is_none()) fill.method = method.cast<std::string>();
  check_fill_method(fill.method);
  fill.fill_all = fill_all;
  fill.unlabelled = unlabelled;
  return fill;
}

// The work of cleaning, without Python objects.
struct CleanWork {
  HeldTakePtr held;
  HeldCleanerPtr cleaner;
  CleanSettings settings;
  bool fix_swaps = false;
  std::size_t threads = 0;
};

std::pair<HeldTakePtr, ReportPtr> cleaned(CleanWork& work, const Tell& tell) {
  work.held->check();
  std::optional<ThreadLimit> limit;
  if (work.threads > 0) limit.emplace(work.threads);
  work.settings.progress = tell;
  CleanOutcome outcome;
  outcome.options = work.cleaner->cleaner->options();
  Take take = work.held->take;
  if (work.fix_swaps && !take.has_joints()) {
    outcome.swaps = find_swaps(take);
    undo_swaps(take, outcome.swaps);
  }
  CleanResult result;
  run_isolated(
      [&] { result = clean_take(std::move(take), *work.cleaner->cleaner, work.settings); });
  outcome.report = std::move(result.report);
  ReportPtr report = report_of(*work.held, result.take, std::move(outcome));
  return {hold(std::move(result.take), work.held->diagnostics), std::move(report)};
}

py::tuple clean(const HeldTakePtr& held, const HeldCleanerPtr& cleaner, double strength,
                double max_change_deg, double max_change, const py::iterable& joints,
                const py::iterable& exclude, bool root_position,
                const std::optional<std::pair<std::size_t, std::size_t>>& range,
                const py::object& noise, const std::string& source, double peak_loss_limit,
                const py::object& fill, bool fill_all, bool unlabelled,
                const std::optional<std::string>& feet, const py::dict& feet_names,
                const std::optional<std::vector<Contact>>& contacts, bool fix_swaps,
                std::size_t threads, const py::object& progress) {
  CleanWork work{held, cleaner, {}, fix_swaps, threads};
  CleanSettings& settings = work.settings;
  settings.strength = strength;
  settings.max_change_deg = max_change_deg;
  settings.max_change = max_change;
  settings.joints = all_bytes_of(joints);
  settings.exclude = all_bytes_of(exclude);
  settings.root_position = root_position;
  settings.range = range;
  settings.noise = noise_of(noise);
  settings.source = parse_source(source);
  settings.peak_loss_limit = peak_loss_limit;
  settings.fill = fill_settings(fill, fill_all, unlabelled);
  if (feet || contacts)
    settings.feet = feet_settings(held->take, feet.value_or("auto"), feet_names, contacts);
  std::pair<HeldTakePtr, ReportPtr> result;
  run_watched(progress, [&](const Tell& tell) { result = cleaned(work, tell); });
  return py::make_tuple(result.first, result.second);
}

void bind_cleaner(py::module_& module) {
  py::class_<HeldCleaner, HeldCleanerPtr> type(
      module, "CoreCleaner", "A method with its options, safe to share between threads.");
  type.def(py::init(&make_held_cleaner), "method"_a, "options"_a);
  type.def_property_readonly(
      "name", [](const HeldCleaner& held) { return std::string(held.cleaner->name()); });
  type.def_property_readonly(
      "options", [](const HeldCleaner& held) { return dict_of(held.cleaner->options()); });
  type.def(
      "why_not_live",
      [](const HeldCleaner& held, double fps) {
        return text_of(held.cleaner->live_support(fps).why_not);
      },
      "fps"_a);
}

void bind_report(py::module_& module) {
  py::class_<Report, std::shared_ptr<Report>> type(module, "CoreReport",
                                                   "What a command made of a take.");
  type.def(
      "to_json", [](const Report& report, bool with_spans) { return to_json(report, with_spans); },
      "with_spans"_a = true);
  type.def("to_text", [](const Report& report) {
    TextOptions options;
    options.all = true;
    return text_of(to_text(report, options));
  });
}

}  // namespace

void bind_cleaning(py::module_& module) {
  bind_cleaner(module);
  bind_report(module);
  module.def("clean", clean, "take"_a, "cleaner"_a, py::kw_only(), "strength"_a, "max_change_deg"_a,
             "max_change"_a, "joints"_a, "exclude"_a, "root_position"_a, "range"_a, "noise"_a,
             "source"_a, "peak_loss_limit"_a, "fill"_a, "fill_all"_a, "unlabelled"_a, "feet"_a,
             "feet_names"_a, "contacts"_a, "fix_swaps"_a, "threads"_a, "progress"_a);
}

}  // namespace kinemend::python
