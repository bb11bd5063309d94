// A gap plan: one row per gap that says how to treat it. One run of `fill` writes it, the user
// edits it, and another run applies it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/fill.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

enum class GapVerdict : std::uint8_t {
  fill,   ///< fill with the row's method if its rules allow it
  force,  ///< fill with the best guess even if the rules refuse, as `FillSettings::fill_all`
  refuse  ///< leave the gap open
};
/// "fill", "force", "refuse".
std::string_view to_string(GapVerdict verdict);

/// The result of one method for a gap.
struct GapPreview {
  std::string method;
  bool filled = false;  ///< the rules of the method allow it to fill the gap
  std::string reason;   ///< why it refuses
  /// Root mean square distance to the filling of the row's own method, file units or degrees; empty
  /// if either method does not fill the gap.
  std::optional<double> distance;
};

/// A gap, and how it is to be treated.
struct PlannedGap {
  Gap gap;                   ///< a gap of a joint or marker, as `GapOutcome::gap`
  bool is_position = false;  ///< a gap of a joint's position, not of its rotation
  GapVerdict verdict = GapVerdict::fill;
  std::string method = "auto";  ///< an entry of `fill_methods()`
  std::string donor;            ///< for `pattern`: a marker
  /// A longer gap is refused; 0: the method's rules decide.
  double longest_gap_s = 0;

  // Results of the run that wrote the row. When the row is applied, only `reason` is read, as the
  // reason for a gap that stays.
  std::string filled_by;              ///< the method that filled it, or that was tried last
  std::vector<std::string> evidence;  ///< markers that were used to fill it
  double expected_error = 0;          ///< as `GapOutcome::expected_error`
  std::string reason;                 ///< why it was refused
  std::vector<GapPreview> previews;
};

struct PlannedFill {
  FillReport report;
  std::vector<PlannedGap> plan;  ///< a row for each gap of the report, in the same order
};

/// Called repeatedly while gaps are filled, at least before each gap, from several threads at once.
/// An exception that it throws ends the run and leaves the take unchanged.
using FillCheck = std::function<void()>;

/// Fills the take as `fill_gaps` does, and returns the result with a plan. The plan, applied to the
/// original take, gives bit-identical samples.
PlannedFill fill_with_plan(Take& clip, const FillSettings& settings, const FillCheck& check = {});
/// Fills the gaps of the plan as its rows say, all in one run, and leaves other gaps alone. Errors:
/// `ErrorKind::usage` for a row that does not name a gap of the take, a gap named by two rows, an
/// unknown method or donor, and a learned method without its model.
PlannedFill fill_with_plan(Take& clip, std::span<const PlannedGap> plan,
                           const FillCheck& check = {}, const FillModels& models = {});

/// Fills `previews` of each row with the result of every method for this kind of take, by its
/// rules, if that method filled all gaps of the plan. `pattern` is included if the row names a
/// donor, and a learned method if its model is given. `clip` is the take before it is filled.
/// Errors: as for `fill_with_plan`.
void preview_methods(const Take& clip, std::vector<PlannedGap>& plan, const FillCheck& check = {},
                     const FillModels& models = {});

/// The result of one method for a gap, frame by frame.
struct GapCurve {
  GapPreview preview;
  double expected_error = 0;  ///< as `GapOutcome::expected_error`
  /// A value per axis for each frame of the window; empty if the sample stays missing. For a method
  /// whose rules refuse the gap, the forced filling, if any.
  std::vector<std::optional<Vec3>> values;
};

/// The results of every method for one gap, with the samples around it.
struct GapCurves {
  /// First frame of the window: the gap and up to half a second on either side.
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;  ///< inclusive
  /// Names of the axes, for a joint's angles in the file's order: "Z", "X", "Y". Positions are in
  /// file units, angles in degrees, without jumps of whole turns.
  std::vector<std::string> axes;
  std::vector<GapCurve> curves;  ///< one per method, in the order of `fill_methods()`
};

/// Tries every method for this kind of take on the gap of one row, by its rules, and fills all
/// other gaps as the plan says. Each curve is the result of the plan with that method in the row.
/// `clip` is the take before it is filled. Errors: as for `fill_with_plan`; `ErrorKind::usage` for
/// a row that does not exist.
GapCurves preview_curves(const Take& clip, std::span<const PlannedGap> plan, std::size_t row,
                         const FillCheck& check = {}, const FillModels& models = {});

/// Returns the plan as a file, with the frame numbers of the take's file: a table with a heading,
/// or JSON of the schema `kinemend.gap-plan/1`. docs/methods/gap-plan.md describes both.
std::string plan_csv(const Take& clip, std::span<const PlannedGap> plan);
std::string plan_json(const Take& clip, std::span<const PlannedGap> plan);
/// Reads either form. It also finds the errors of `fill_with_plan`, with the row. Errors:
/// `unreadable_input`, `name:line: ...` for a table, `name: gap N: ...` for JSON.
std::vector<PlannedGap> parse_plan(std::string_view text, std::string_view name, const Take& clip);

}  // namespace kinemend
