// Runs long work in a separate thread, while the caller's thread checks for Ctrl-C and reports
// progress to Python.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string_view>

namespace kinemend::python {

namespace py = pybind11;

/// Called by the work to report progress; throws to end the work.
using Tell = std::function<void(std::string_view stage, double done)>;

/// Calls `work` without the GIL. `progress`, unless None, is called as `progress(stage, done)` in
/// the caller's thread. An exception of `progress`, or of a signal such as Ctrl-C, ends the work at
/// its next step and is raised here, as are errors of the work.
void run_watched(const py::object& progress, const std::function<void(const Tell& tell)>& work);

}  // namespace kinemend::python
