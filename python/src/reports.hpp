// Reports for Python, whose JSON is made on request.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <utility>

#include "held.hpp"
#include "kinemend/report.hpp"

namespace kinemend::python {

using ReportPtr = std::shared_ptr<const Report>;

/// `take` names the take that the report is about. Call with or without the GIL.
template <class Result>
ReportPtr report_of(const HeldTake& held, const Take& take, Result result) {
  Report report{take_facts(take), std::move(result)};
  report.take.input = held.take.source.name;
  report.take.diagnostics = held.diagnostics;
  return std::make_shared<const Report>(std::move(report));
}

}  // namespace kinemend::python
