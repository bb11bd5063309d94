// Finds the gap that a row names, and reports what is wrong with a row.
#include "fill/plan_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/quote.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/frame_numbers.hpp"

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
