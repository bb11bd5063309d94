// Finds the limits that the figures of a report exceed.
#include <fmt/format.h>

#include <algorithm>

#include "report/figures.hpp"
#include "report/texts.hpp"

namespace kinemend {

namespace {

const FigureLimit* limit_of(std::string_view figure, std::span<const FigureLimit> limits) {
  const auto found = std::find_if(limits.begin(), limits.end(),
                                  [&](const FigureLimit& limit) { return limit.figure == figure; });
  return found == limits.end() ? nullptr : &*found;
}

// Returns a limit's option on the command line: "--max-gap-s".
std::string option_of(const FigureRule& rule) {
  std::string name(rule.limit);
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

std::vector<std::string> passed(const TakeFacts& take, const CheckReport& report,
                                std::span<const FigureLimit> limits) {
  std::vector<std::string> lines;
  for (const CheckFigure& figure : check_figure_table()) {
    const FigureLimit* const limit = limit_of(figure.rule.name, limits);
    const std::optional<double> value = figure.get(report.figures);
    if (limit == nullptr || !value || *value <= limit->value) continue;
    const std::string unit = unit_of(figure, report);
    std::string line = fmt::format(
        "{}: {}: {} is above the limit {}", take.input == "-" ? "standard input" : take.input,
        figure.rule.label, with_unit(*value, unit), with_unit(limit->value, unit));
    const auto worst =
        std::find_if(report.findings.begin(), report.findings.end(), [&](const Finding& finding) {
          return std::find(figure.kinds.begin(), figure.kinds.end(), finding.kind) !=
                 figure.kinds.end();
        });
    if (worst != report.findings.end()) line += "; " + finding_sentence(*worst, take, report);
    lines.push_back(std::move(line));
  }
  return lines;
}

// Returns why a figure of a comparison is unknown.
std::string_view unknown_for(const FigureRule& rule, const CompareOutcome& outcome) {
  if (outcome.markers) return "the take is too short, or its rate too low";
  return rule.name.starts_with("foot_slide") ? "no foot has ground contact"
                                             : "the unit of length is unknown";
}

std::vector<std::string> passed(const TakeFacts& /*take*/, const CompareOutcome& outcome,
                                std::span<const FigureLimit> limits) {
  std::vector<std::string> lines;
  std::size_t known = 0;
  for_each_figure(outcome, [&](const FigureRule& rule, const std::optional<double>& value) {
    const FigureLimit* const limit = limit_of(rule.name, limits);
    if (limit == nullptr) return;
    ++known;
    if (!value) {
      lines.push_back(fmt::format("{} is unknown because {}: {} cannot be checked", rule.name,
                                  unknown_for(rule, outcome), option_of(rule)));
    } else if (rule.more_is_better ? !(*value >= limit->value) : !(*value <= limit->value)) {
      lines.push_back(fmt::format("{} {:.4g} is {} the limit {:.4g}", rule.name, *value,
                                  rule.more_is_better ? "below" : "above", limit->value));
    }
  });
  if (known == limits.size()) return lines;
  const std::size_t of_joints = comparison_figure_table().size();
  const std::span<const FigureRule> all = comparison_figures();
  for (const FigureRule& rule : outcome.markers ? all.first(of_joints) : all.subspan(of_joints)) {
    if (limit_of(rule.name, limits) != nullptr)
      lines.push_back(fmt::format("{} is a figure of {}: {} cannot be checked", rule.name,
                                  outcome.markers ? "joints" : "markers", option_of(rule)));
  }
  return lines;
}

template <class Result>
std::vector<std::string> passed(const TakeFacts& /*take*/, const Result& /*result*/,
                                std::span<const FigureLimit> /*limits*/) {
  return {};
}

}  // namespace

std::vector<std::string> passed_limits(const Report& report, std::span<const FigureLimit> limits) {
  return std::visit([&](const auto& result) { return passed(report.take, result, limits); },
                    report.result);
}

}  // namespace kinemend
