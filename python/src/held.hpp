// Objects that Python holds: takes and cleaners, and the parts of the module.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <memory>

#include "kinemend/error.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/take.hpp"

namespace kinemend::python {

namespace py = pybind11;

/// A take with arrays that Python may view, so no array changes its length.
struct HeldTake {
  Take take;
  Diagnostics diagnostics;  ///< diagnostics of its reader
  /// Set if Python may have written into an array; then the values must be checked again.
  mutable bool is_touched = false;

  void touch() const { std::atomic_ref(is_touched).store(true, std::memory_order_relaxed); }
  /// Errors: those of `Take::validate`.
  void check() const {
    if (std::atomic_ref(is_touched).load(std::memory_order_relaxed)) take.validate();
  }
};
using HeldTakePtr = std::shared_ptr<HeldTake>;

/// Gives every take masks, so that Python reads and writes them in place.
HeldTakePtr hold(Take take, Diagnostics diagnostics = {});

struct HeldCleaner {
  std::unique_ptr<Cleaner> cleaner;
};
using HeldCleanerPtr = std::shared_ptr<HeldCleaner>;

void bind_takes(py::module_& module);
void bind_files(py::module_& module);
void bind_tables(py::module_& module);
void bind_cleaning(py::module_& module);
void bind_measures(py::module_& module);
void bind_training(py::module_& module);
void bind_live(py::module_& module);

}  // namespace kinemend::python
