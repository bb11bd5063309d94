// Fills the gaps of a take as settings or the rows of a plan request, and reports what is wrong
// with a row.
#include "fill/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "base/text.hpp"
#include "fill/driver.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/gap_plan.hpp"
#include "kinemend/extend/motion.hpp"
#include "motion/names.hpp"

namespace kinemend {

namespace {

using fill::FilledGap, fill::GapRequest;

std::size_t donor_for(const Take& clip, const FillSettings& settings) {
  if (clip.has_joints()) return fill::MarkerRequest::no_marker;
  if (settings.donor.empty() && settings.method == "pattern")
    throw Error(ErrorKind::usage, "fill: the method pattern needs a donor");
  return fill::donor_of(clip, settings.donor);
}

void leave_unlabelled(const Take& clip, std::vector<std::uint8_t>& chosen) {
  if (clip.has_joints()) return;
  for (std::size_t m = 0; m < chosen.size(); ++m) {
    if (is_unlabelled(clip.names[m])) chosen[m] = 0;
  }
}

void check_limits(const FillSettings& settings) {
  if (settings.max_error < 0 || settings.max_error_deg < 0)
    throw Error(ErrorKind::usage, "fill: a limit of the expected error is negative");
  if (settings.fill_all && settings.max_error + settings.max_error_deg > 0)
    throw Error(ErrorKind::usage,
                "fill: a limit of the expected error cannot be combined with filling all gaps");
}

// The outcome of each gap that is filled or refused, and the number of gaps of unlabelled markers
// that were skipped.
struct FilledBySettings {
  std::vector<FilledGap> gaps;
  std::size_t unlabelled = 0;
};

FilledBySettings fill_by_settings(Take& clip, const FillSettings& settings,
                                  const FillCheck& check) {
  clip.validate();
  check_limits(settings);
  GapRequest request;
  request.method = &fill::find_method(settings.method, clip.has_joints());
  fill::check_model(*request.method, settings.models);
  request.learned = fill::model_of(*request.method, settings.models);
  const std::vector<std::uint8_t> named =
      names_meant(clip.owner_names(), settings.names, clip.has_joints() ? "joint" : "marker");
  std::vector<std::uint8_t> chosen = named;
  if (!settings.unlabelled) leave_unlabelled(clip, chosen);
  request.donor = donor_for(clip, settings);
  request.longest_gap_s = settings.longest_gap_s;
  request.fill_all = settings.fill_all;
  request.max_error = settings.max_error;
  request.max_error_deg = settings.max_error_deg;
  request.unlabelled = settings.unlabelled;
  FilledBySettings filled;
  const auto request_of = [&](const Gap& gap, bool) -> const GapRequest* {
    if (named[gap.track] == 0 || !fill::lies_within(gap, settings)) return nullptr;
    if (chosen[gap.track] != 0) return &request;
    ++filled.unlabelled;
    return nullptr;
  };
  filled.gaps = fill::fill_asked(clip, request_of, check);
  return filled;
}

// Writes the outcome of a gap into its row.
void tell_found(const FilledGap& filled, const std::vector<std::string>& names, PlannedGap& row) {
  row.filled_by = filled.outcome.method;
  row.expected_error = filled.outcome.expected_error;
  row.reason = filled.outcome.reason;
  row.evidence.clear();
  for (const std::size_t marker : filled.markers_used) row.evidence.push_back(names[marker]);
}

}  // namespace

std::string_view to_string(GapVerdict verdict) {
  switch (verdict) {
    case GapVerdict::fill:
      return "fill";
    case GapVerdict::force:
      return "force";
    case GapVerdict::refuse:
      break;
  }
  return "refuse";
}

FillReport fill_gaps(Take& clip, const FillSettings& settings) {
  const FilledBySettings filled = fill_by_settings(clip, settings, {});
  FillReport report = fill::report_of(filled.gaps, clip.owner_names());
  report.unlabelled = filled.unlabelled;
  return report;
}

PlannedFill fill_with_plan(Take& clip, const FillSettings& settings, const FillCheck& check) {
  const auto [gaps, unlabelled] = fill_by_settings(clip, settings, check);
  PlannedFill made{fill::report_of(gaps, clip.owner_names()), {}};
  made.report.unlabelled = unlabelled;
  for (const FilledGap& filled : gaps) {
    PlannedGap row;
    row.gap = filled.outcome.gap;
    row.is_position = filled.outcome.is_position;
    row.verdict = !filled.outcome.filled ? GapVerdict::refuse
                  : settings.fill_all    ? GapVerdict::force
                                         : GapVerdict::fill;
    row.method = settings.method;
    row.donor = settings.donor;
    row.longest_gap_s = settings.longest_gap_s;
    tell_found(filled, clip.owner_names(), row);
    made.plan.push_back(std::move(row));
  }
  return made;
}

PlannedFill fill_with_plan(Take& clip, std::span<const PlannedGap> plan, const FillCheck& check,
                           const FillModels& models) {
  clip.validate();
  fill::PlanRows rows(clip, &models);
  std::map<fill::GapKey, const PlannedGap*> by_gap;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (const std::string problem = rows.add(plan[i]); !problem.empty())
      throw Error(ErrorKind::usage, fmt::format("fill: gap {} of the plan: {}", i + 1, problem));
    by_gap.emplace(fill::key_of(plan[i].gap, plan[i].is_position), &plan[i]);
  }
  const std::vector<FilledGap> gaps = fill::fill_asked(clip, rows.request_of(), check);
  PlannedFill made{fill::report_of(gaps, clip.owner_names()), {}};
  for (const FilledGap& filled : gaps) {
    PlannedGap row = *by_gap.at(fill::key_of(filled.outcome.gap, filled.outcome.is_position));
    tell_found(filled, clip.owner_names(), row);
    made.plan.push_back(std::move(row));
  }
  return made;
}

}  // namespace kinemend

namespace kinemend::fill {

namespace {

// Returns an error's message about a method or marker without the command at its beginning.
std::string told(const Error& error) {
  constexpr std::string_view command = "fill: ";
  const std::string text = error.what();
  return text.starts_with(command) ? text.substr(command.size()) : text;
}

}  // namespace

PlanRows::PlanRows(const Take& take, const FillModels* models)
    : take_(take),
      models_(models),
      names_(take.owner_names()),
      first_number_(first_frame_number(take)) {
  for (const OpenGap& open : open_gaps(take))
    requests_.emplace(key_of(open.gap, open.is_position), std::nullopt);
}

std::string PlanRows::add(const PlannedGap& row) {
  const auto found = requests_.find(key_of(row.gap, row.is_position));
  if (found == requests_.end()) return fmt::format("{} are no gap", frames_text(row.gap));
  if (found->second) {
    return fmt::format("the gap of {} in {} stands in another row already",
                       quote(names_[row.gap.track]), frames_text(row.gap));
  }
  GapRequest request;
  try {
    request.method = &find_method(row.method, take_.has_joints());
    if (!take_.has_joints()) request.donor = donor_of(take_, row.donor);
    if (models_ != nullptr && row.verdict != GapVerdict::refuse)
      check_model(*request.method, *models_);
  } catch (const Error& error) {
    return told(error);
  }
  if (row.method == "pattern" && row.donor.empty() && row.verdict != GapVerdict::refuse)
    return "the method pattern needs a donor";
  if (models_ != nullptr) request.learned = model_of(*request.method, *models_);
  request.longest_gap_s = row.longest_gap_s;
  request.fill_all = row.verdict == GapVerdict::force;
  if (row.verdict == GapVerdict::refuse) {
    request.refusal = Filling::refused(row.filled_by.empty() ? row.method : row.filled_by,
                                       row.reason.empty() ? "the plan refuses it" : row.reason);
    request.refusal->expected_error = row.expected_error;
  }
  found->second = std::move(request);
  return "";
}

std::optional<Gap> PlanRows::find(std::string_view name, bool is_position, std::size_t first_frame,
                                  std::size_t last_frame) const {
  std::optional<Gap> taken;
  for (std::size_t track = 0; track < names_.size(); ++track) {
    if (names_[track] != name) continue;
    const Gap gap{track, first_frame, last_frame};
    const auto found = requests_.find(key_of(gap, is_position));
    if (found == requests_.end()) continue;
    if (!found->second) return gap;
    if (!taken) taken = gap;
  }
  return taken;
}

bool PlanRows::knows(std::string_view name) const {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

std::string PlanRows::gaps_of(std::string_view name, bool is_position) const {
  // Chosen by hand.
  constexpr std::size_t most = 5;  // in one line
  std::string text;
  std::size_t count = 0;
  for (const auto& [key, request] : requests_) {
    const auto& [track, of_position, first, last] = key;
    if (names_[track] != name || of_position != is_position) continue;
    if (++count > most) return text + ", ...";
    text += fmt::format("{}{}-{}", text.empty() ? "" : ", ", frame_number(first, first_number_),
                        frame_number(last, first_number_));
  }
  return text;
}

RequestOf PlanRows::request_of() const {
  return [this](const Gap& gap, bool is_position) -> const GapRequest* {
    const auto found = requests_.find(key_of(gap, is_position));
    return found == requests_.end() || !found->second ? nullptr : &*found->second;
  };
}

std::string PlanRows::frames_text(const Gap& gap) const {
  return fmt::format("frames {} to {}", frame_number(gap.first_frame, first_number_),
                     frame_number(gap.last_frame, first_number_));
}

}  // namespace kinemend::fill
