// Runs long work in a thread of its own, while the caller's thread looks for Ctrl-C and tells
// Python of the progress.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string_view>

namespace kinemend::python {

namespace py = pybind11;

/// Told by the work how far it is; ends the work by an exception once it is to stop.
using Tell = std::function<void(std::string_view stage, double done)>;

/// Calls `work` without the GIL. `progress`, where it is not None, is called as
/// `progress(stage, done)` in the caller's thread. An exception of `progress`, or of a signal such
/// as Ctrl-C, ends the work at its next step and is raised here; errors of the work are, too.
void run_watched(const py::object& progress, const std::function<void(const Tell& tell)>& work);

}  // namespace kinemend::python
