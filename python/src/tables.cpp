// The tables of the library: methods, ways to fill, damages, trainings and formats.
#include <pybind11/pybind11.h>

#include <string>

#include "conversions.hpp"
#include "held.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/extend/sessions.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/io.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/train.hpp"
#include "kinemend/methods.hpp"

namespace kinemend::python {

namespace {

using namespace py::literals;

py::list options_of(const std::vector<OptionSpec>& specs) {
  py::list list;
  for (const OptionSpec& spec : specs) {
    list.append(py::dict("name"_a = spec.name, "unit"_a = spec.unit,
                         "default"_a = object_of(spec.default_value), "minimum"_a = spec.minimum,
                         "maximum"_a = spec.maximum, "choices"_a = texts_of(spec.choices),
                         "help"_a = text_of(spec.help)));
  }
  return list;
}

py::object live_options(const std::string& method) {
  for (const LiveMethod& live : live_methods()) {
    if (live.name == method) return dict_of(live.options);
  }
  return py::none();
}

bool ships_model(const std::string& method) {
  for (const ShippedModel& model : shipped_models()) {
    if (model.method == method) return true;
  }
  return false;
}

py::list method_table() {
  py::list list;
  for (const Method& method : methods()) {
    list.append(py::dict("name"_a = method.name, "summary"_a = text_of(method.summary),
                         "paper"_a = text_of(method.paper), "learned"_a = method.learned,
                         "ships_model"_a = ships_model(method.name),
                         "live"_a = live_options(method.name),
                         "options"_a = options_of(method.options)));
  }
  return list;
}

py::list fill_method_table() {
  py::list list;
  for (const FillMethod& method : fill_methods()) {
    list.append(py::dict("name"_a = std::string(method.name), "summary"_a = text_of(method.summary),
                         "paper"_a = text_of(method.paper), "rules"_a = text_of(method.rules),
                         "markers"_a = method.markers, "joints"_a = method.joints,
                         "learned"_a = method.learned));
  }
  return list;
}

py::list damage_table() {
  py::list list;
  for (const Damage& damage : damages()) {
    list.append(py::dict("name"_a = damage.name, "summary"_a = text_of(damage.summary),
                         "paper"_a = text_of(damage.paper),
                         "options"_a = options_of(damage.options)));
  }
  return list;
}

py::list training_table() {
  py::list list;
  for (const Training& method : trainings()) {
    list.append(py::dict("name"_a = method.name, "summary"_a = text_of(method.summary),
                         "options"_a = options_of(method.options)));
  }
  return list;
}

py::list format_table() {
  py::list list;
  for (const Format& format : formats()) {
    py::list extensions;
    for (const std::string_view extension : format.extensions)
      extensions.append(text_of(extension));
    list.append(py::dict("name"_a = std::string(format.name),
                         "description"_a = text_of(format.description), "extensions"_a = extensions,
                         "reads"_a = format.read != nullptr,
                         "writes_joints"_a = format.write != nullptr,
                         "writes_markers"_a = format.write_markers != nullptr));
  }
  return list;
}

py::list clean_option_table() { return options_of(clean_options()); }

}  // namespace

void bind_tables(py::module_& module) {
  module.def("clean_option_table", clean_option_table);
  module.def("method_table", method_table);
  module.def("fill_method_table", fill_method_table);
  module.def("damage_table", damage_table);
  module.def("training_table", training_table);
  module.def("format_table", format_table);
}

}  // namespace kinemend::python
