// A gap plan: one row a gap, with what is to be done about it. It is written by a run of `fill`,
// edited, and applied in another.
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
#include "kinemend/gaps.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

enum class GapVerdict : std::uint8_t {
  fill,   ///< by the row's method, where its rules let it
  force,  ///< also where they refuse: by the best guess there is, as `FillSettings::fill_all`
  refuse  ///< the gap stays, whatever fills it
};
/// "fill", "force", "refuse".
std::string_view to_string(GapVerdict verdict);

/// What one method would make of a gap.
struct GapPreview {
  std::string method;
  bool filled = false;  ///< its rules let it fill the gap
  std::string reason;   ///< why not
  /// Root mean square distance to what the row's own method fills, file units or degrees; none
  /// where one of the two does not fill the gap.
  std::optional<double> distance;
};

/// A gap, and what is asked for it.
struct PlannedGap {
  Gap gap;                   ///< of a joint or marker, as `GapOutcome::gap`
  bool is_position = false;  ///< of a joint's position, not of its rotation
  GapVerdict verdict = GapVerdict::fill;
  std::string method = "auto";  ///< an entry of `fill_methods()`
  std::string donor;            ///< of `pattern`: a marker
  double longest_gap_s =
      0;  ///< the gap is refused where it is longer; 0: as the method's rules say

  // What the run that wrote the row found. When the row is applied, a gap that stays does so with
  // this reason; nothing else of it is looked at.
  std::string filled_by;              ///< the method that filled it, or was tried last
  std::vector<std::string> evidence;  ///< markers that it was filled from
  double expected_error = 0;          ///< as `GapOutcome::expected_error`
  std::string reason;                 ///< why it was refused
  std::vector<GapPreview> previews;
};

struct PlannedFill {
  FillReport report;
  std::vector<PlannedGap> plan;  ///< a row for each gap of the report, in its order
};

/// Called now and then while gaps are filled, before each at least, from several threads at once.
/// What it throws ends the run, and the take is as it was.
using FillCheck = std::function<void()>;

/// Fills the take as `fill_gaps` does, and says it as a plan: applied to the take as it was, it
/// gives the same samples to the bit.
PlannedFill fill_with_plan(Take& clip, const FillSettings& settings, const FillCheck& check = {});
/// Fills the gaps that rows name as these say, all in one run, and leaves others alone. Errors:
/// `ErrorKind::usage` for a row that names no gap of the take, a gap that another row names, a
/// method or a donor that there is not, a learned method without its model.
PlannedFill fill_with_plan(Take& clip, std::span<const PlannedGap> plan,
                           const FillCheck& check = {}, const FillModels& models = {});

/// Fills `previews` of each row: what every method of this kind of take (`pattern` where the row
/// names a donor, a learned one where there is its model), by its rules, would make of the gap if
/// it had to fill all gaps of the plan. `clip` is the take before it is filled. Errors: as of
/// `fill_with_plan`.
void preview_methods(const Take& clip, std::vector<PlannedGap>& plan, const FillCheck& check = {},
                     const FillModels& models = {});

/// What one method would make of a gap, frame by frame.
struct GapCurve {
  GapPreview preview;
  double expected_error = 0;  ///< as `GapOutcome::expected_error`
  /// A value an axis for each frame of the window; none where the sample stays missing. Of a method
  /// whose rules refuse the gap, what it makes where it is forced to, if anything.
  std::vector<std::optional<Vec3>> values;
};

/// What every method would make of one gap, with the samples around it.
struct GapCurves {
  std::size_t first_frame = 0;  ///< of the window: the gap and up to half a second on either side
  std::size_t last_frame = 0;   ///< inclusive
  /// What the values are along or about, the file's own order of a joint's angles: "Z", "X", "Y".
  /// Positions are in file units, angles in degrees, without jumps of whole turns.
  std::vector<std::string> axes;
  std::vector<GapCurve> curves;  ///< a method each, in the order of `fill_methods()`
};

/// Tries every method of this kind of take on the gap of one row, by its rules, and fills all
/// others as the plan says: a curve is what the plan makes of the gap once the row has that method.
/// `clip` is the take before it is filled. Errors: as of `fill_with_plan`; `ErrorKind::usage` for a
/// row that there is not.
GapCurves preview_curves(const Take& clip, std::span<const PlannedGap> plan, std::size_t row,
                         const FillCheck& check = {}, const FillModels& models = {});

/// The plan as a file, frames as the file of the take counts them: a table with a heading, or JSON
/// of the schema `kinemend.gap-plan/1`. docs/methods/gap-plan.md describes both.
std::string plan_csv(const Take& clip, std::span<const PlannedGap> plan);
std::string plan_json(const Take& clip, std::span<const PlannedGap> plan);
/// Reads either. Of what `fill_with_plan` finds wrong the row is named too. Errors:
/// `unreadable_input`, `name:line: ...` for a table, `name: gap N: ...` for JSON.
std::vector<PlannedGap> parse_plan(std::string_view text, std::string_view name, const Take& clip);

}  // namespace kinemend
