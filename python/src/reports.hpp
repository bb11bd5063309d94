// Reports as Python holds them: their JSON is made when it is asked for.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <utility>

#include "held.hpp"
#include "kinemend/report.hpp"

namespace kinemend::python {

using ReportPtr = std::shared_ptr<const Report>;

/// `take`: that the report is about, as it is named. Call with the GIL or without.
template <class Result>
ReportPtr report_of(const HeldTake& held, const Take& take, Result result) {
  Report report{take_facts(take), std::move(result)};
  report.take.input = held.take.source.name;
  report.take.diagnostics = held.diagnostics;
  return std::make_shared<const Report>(std::move(report));
}

}  // namespace kinemend::python
