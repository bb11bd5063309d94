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
#include "kinemend/clean.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/methods.hpp"
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

// Leg, part, and first and last frame, counted from 0.
using Contact = std::tuple<std::string, std::string, std::size_t, std::size_t>;

void set_contacts(FeetSettings& feet, const Take& take,
                  const std::optional<std::vector<Contact>>& contacts) {
  if (!contacts) return;
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
}

std::optional<KnownNoise> noise_of(const py::object& noise) {
  if (noise.is_none()) return std::nullopt;
  const auto [correlation, strengths] = noise.cast<std::pair<double, py::dict>>();
  KnownNoise known;
  known.correlation = correlation;
  for (const auto& [key, value] : strengths) known.strengths[bytes_of(key)] = value.cast<double>();
  return known;
}

// The work of cleaning, without Python objects.
struct CleanWork {
  HeldTakePtr held;
  HeldCleanerPtr cleaner;
  CleanSettings settings;
  std::size_t threads = 0;
};

std::pair<HeldTakePtr, ReportPtr> cleaned(CleanWork& work, const Tell& tell) {
  work.held->check();
  std::optional<ThreadLimit> limit;
  if (work.threads > 0) limit.emplace(work.threads);
  work.settings.progress = tell;
  CleanResult result = clean_take(work.held->take, *work.cleaner->cleaner, work.settings);
  ReportPtr report = report_of(*work.held, result.take, std::move(result.report));
  return {hold(std::move(result.take), work.held->diagnostics), std::move(report)};
}

// `values`: those of `clean_options`.
py::tuple clean(const HeldTakePtr& held, const HeldCleanerPtr& cleaner, const py::dict& values,
                double max_change, const py::iterable& joints, const py::iterable& exclude,
                const std::optional<std::pair<std::size_t, std::size_t>>& range,
                const py::object& noise, const py::dict& feet_names,
                const std::optional<std::vector<Contact>>& contacts, std::size_t threads,
                const py::object& progress) {
  CleanWork work{held, cleaner, clean_settings(option_values_of(values)), threads};
  CleanSettings& settings = work.settings;
  settings.leftovers = Leftovers::all;
  settings.max_change = max_change;
  settings.joints = all_bytes_of(joints);
  settings.exclude = all_bytes_of(exclude);
  settings.range = range;
  settings.noise = noise_of(noise);
  if (contacts && !settings.feet) settings.feet.emplace();
  if (settings.feet) {
    settings.feet->names = known_names_of(feet_names);
    set_contacts(*settings.feet, held->take, contacts);
  }
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
  module.def("clean", clean, "take"_a, "cleaner"_a, "settings"_a, py::kw_only(), "max_change"_a,
             "joints"_a, "exclude"_a, "range"_a, "noise"_a, "feet_names"_a, "contacts"_a,
             "threads"_a, "progress"_a);
}

}  // namespace kinemend::python
