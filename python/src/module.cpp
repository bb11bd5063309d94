// The module kinemend._core: the C++ library for the Python layer.
#include <pybind11/pybind11.h>

#include <exception>
#include <string>

#include "held.hpp"
#include "kinemend/extend/system.hpp"

namespace kinemend::python {

namespace {

const char* kind_name(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::quality_limit:
      return "quality_limit";
    case ErrorKind::usage:
      return "usage";
    case ErrorKind::cannot_write:
      return "cannot_write";
    case ErrorKind::unreadable_input:
      break;
  }
  return "unreadable_input";
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const Error& error) {
    const py::object make = py::module_::import("kinemend._errors").attr("error_of");
    const py::object raised = make(error.what(), kind_name(error.kind()));
    PyErr_SetObject(py::type::of(raised).ptr(), raised.ptr());
  }
}

}  // namespace

}  // namespace kinemend::python

PYBIND11_MODULE(_core, module) {
  using namespace kinemend::python;
  module.doc() = "The library as the package calls it; use `import kinemend`.";
  py::register_exception_translator(translate);
  module.attr("version") = std::string(kinemend::version());
  bind_takes(module);
  bind_files(module);
  bind_tables(module);
  bind_cleaning(module);
  bind_measures(module);
  bind_training(module);
  bind_live(module);
}
