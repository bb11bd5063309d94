// Fills gaps from the take itself and, where one is given, by a trained model.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinemend/gaps.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// How a trained model fills the gaps of a take of joints.
struct LearnedFilling {
  std::vector<Quat> rotations;  ///< F x J, local; entries for observed samples are ignored
  std::vector<std::string>
      left_out;  ///< J: why the model does not fill gaps of the joint; empty: it does
  /// What the model makes of observed samples stands among `rotations`, too: its fillings do not
  /// meet the ends of their gaps yet, and are moved to.
  bool is_guess = false;
};
/// Such a model. It gets a take without its calibration pose and is called from several threads at
/// once.
using LearnedFill = std::function<LearnedFilling(const Take& clip)>;

/// The models of the learned methods, by the method's name; an empty one is not there.
struct FillModels {
  LearnedFill recurrent = {};  ///< `make_recurrent_fill` (kinemend/methods.hpp) makes it
  LearnedFill learned = {};    ///< `make_learned_fill` makes it
};

struct FillSettings {
  std::string method = "auto";     ///< an entry of `fill_methods()`
  std::vector<std::string> names;  ///< joints or markers, or shell patterns; empty: all
  std::string donor;               ///< of `pattern`: the marker whose movement is copied
  double longest_gap_s = 0;        ///< longer gaps are refused; 0: what the method's rules say
  bool fill_all = false;           ///< also where the rules refuse: the best guess there is
  /// Gaps whose expected error is above this, or not known, are refused: of positions in file
  /// units, of rotations in degrees; 0: no limit. Not together with `fill_all`.
  double max_error = 0, max_error_deg = 0;
  /// Markers whose name is a number that the capture system gave (`*52`, `U_12`) are filled, and
  /// used as evidence for others. They change from one marker to another within a take.
  bool unlabelled = false;
  /// First and last frame, from 0: gaps that do not lie within stay, and are not listed.
  std::optional<std::pair<std::size_t, std::size_t>> range;
  FillModels models = {};  ///< a learned method needs its own
};

/// What became of one gap.
struct GapOutcome {
  Gap gap;
  std::string method;  ///< that filled it, or was tried last
  bool filled = false;
  std::string reason;  ///< why it was refused; empty where filled
  double expected_error =
      0;  ///< file units (degrees for rotations) as the method judged; 0: unknown
  bool is_position = false;  ///< of a joint's position, not of its rotation
};

struct FillReport {
  std::vector<GapOutcome> gaps;  ///< by track, then frame
  std::vector<std::string> warnings;
  std::size_t unlabelled = 0;  ///< gaps of unlabelled markers, which were left alone

  std::size_t filled() const;
  std::size_t refused() const;
};

/// A way to fill, for help texts.
struct FillMethod {
  std::string_view name;     ///< "rigid-body"
  std::string_view summary;  ///< one line
  std::string_view paper;
  std::string_view rules;  ///< which gaps it accepts, in words
  bool markers = false;
  bool joints = false;
  bool learned = false;  ///< needs a model, and leaves to `auto` what that does not know
};

/// `auto` first.
std::span<const FillMethod> fill_methods();

/// Fills the missing samples in place: a filled sample is observed, and its residual is 0. A filled
/// span meets its ends in value and velocity (in value only by `slerp`, `pchip` and `recurrent`).
/// Gaps that the method's rules refuse stay missing and are listed. Gaps that a model cannot fill
/// are filled by `auto` under its own rules, with a warning. Errors: `ErrorKind::usage` for an
/// unknown method, name or donor, and for a learned method without its model. A joint with one or
/// two rotation channels gets rotations that these can hold.
FillReport fill_gaps(Take& clip, const FillSettings& settings = {});

}  // namespace kinemend
