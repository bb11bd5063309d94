#include "clean_leftovers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "kinemend/experimental/text.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

std::size_t count_of(const std::vector<Finding>& findings,
                     std::initializer_list<FindingKind> kinds) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [&](const Finding& finding) {
        return std::find(kinds.begin(), kinds.end(), finding.kind) != kinds.end();
      }));
}

}  // namespace

std::vector<Leftover> leftovers_of(const std::vector<Finding>& findings, const CleanPlan& plan,
                                   const std::string& input) {
  const std::string take = printable(input);
  const std::string listing = fmt::format("kinemend check {} lists them", take);
  std::vector<Leftover> leftovers;
  const auto add = [&](std::initializer_list<FindingKind> kinds, const char* noun,
                       const char* of_what, const std::string& mend) {
    if (const std::size_t count = count_of(findings, kinds); count > 0)
      leftovers.push_back({counted(count, noun) + of_what + " left", mend});
  };
  if (!plan.fix_swaps) add({FindingKind::swap}, "swap", " of markers", "--fix-swaps undoes them");
  if (!plan.settings.fill) add({FindingKind::gap}, "long gap", "", "--fill auto fills them");
  add({FindingKind::frozen, FindingKind::bridged}, "frozen or bridged span", "",
      fmt::format("kinemend check {0} --gaps-out gaps.csv; kinemend clean {0} --gaps gaps.csv "
                  "--fill auto",
                  take));
  add({FindingKind::repeated_frames, FindingKind::zero_frames}, "run",
      " of repeated or empty frames", listing);
  for (const Finding& finding : findings) {
    const std::string words = printable(finding.words);
    if (finding.kind == FindingKind::rate)
      leftovers.push_back({"the frame rate looks wrong", words});
    if (finding.kind == FindingKind::unit) leftovers.push_back({"the unit looks wrong", words});
  }
  return leftovers;
}

}  // namespace kinemend::cli
