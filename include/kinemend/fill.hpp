// Fills gaps from the take itself and, if one is given, with a trained model.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

/// The result of a trained model that fills the gaps of a take of joints.
struct LearnedFilling {
  std::vector<Quat> rotations;  ///< F x J, local; entries for observed samples are ignored
  /// J: why the model does not fill the gaps of a joint; empty: it does.
  std::vector<std::string> left_out;
  /// `rotations` also holds the model's estimates of observed samples. The fillings do not meet the
  /// ends of their gaps yet; they are moved to meet them.
  bool is_guess = false;
};
/// Runs such a model. The take has no calibration pose. Called from several threads at once.
using LearnedFill = std::function<LearnedFilling(const Take& clip)>;

/// The models of the learned methods, by the method's name; empty: the model is not available.
struct FillModels {
  LearnedFill recurrent = {};  ///< made by `make_recurrent_fill` (kinemend/methods.hpp)
  LearnedFill learned = {};    ///< made by `make_learned_fill`
};

struct FillSettings {
  std::string method = "auto";     ///< an entry of `fill_methods()`
  std::vector<std::string> names;  ///< joints or markers, or shell patterns; empty: all
  std::string donor;               ///< for `pattern`: the marker whose movement is copied
  double longest_gap_s = 0;        ///< longer gaps are refused; 0: the method's rules decide
  bool fill_all = false;           ///< fill gaps that the rules refuse with the best guess
  /// Gaps whose expected error is above this, or not known, are refused: `max_error` for positions
  /// in file units, `max_error_deg` for rotations; 0: no limit. Cannot be combined with `fill_all`.
  double max_error = 0, max_error_deg = 0;
  /// Fills markers whose name is a number given by the capture system (`*52`, `U_12`), and uses
  /// them as evidence for other markers. Such a name changes from one marker to another within a
  /// take.
  bool unlabelled = false;
  /// First and last frame, counted from 0: gaps that are not completely inside stay and are not
  /// listed.
  std::optional<std::pair<std::size_t, std::size_t>> range;
  FillModels models = {};  ///< a learned method needs its model
};

/// The result for one gap.
struct GapOutcome {
  Gap gap;
  std::string method;  ///< the method that filled it, or that was tried last
  bool filled = false;
  std::string reason;  ///< why it was refused; empty where filled
  /// The method's estimate in file units (degrees for rotations); 0: unknown.
  double expected_error = 0;
  bool is_position = false;  ///< a gap of a joint's position, not of its rotation
};

struct FillReport {
  std::vector<GapOutcome> gaps;  ///< by track, then frame
  std::vector<std::string> warnings;
  std::size_t unlabelled = 0;  ///< gaps of unlabelled markers, which were left alone

  std::size_t filled() const;
  std::size_t refused() const;
};

/// A fill method, for help texts.
struct FillMethod {
  std::string_view name;     ///< "rigid-body"
  std::string_view summary;  ///< one line
  std::string_view paper;
  std::string_view rules;  ///< which gaps it accepts, in words
  bool markers = false;
  bool joints = false;
  bool learned = false;  ///< needs a model; `auto` fills the tracks that the model does not know
};

/// All fill methods, `auto` first.
std::span<const FillMethod> fill_methods();

/// Fills the missing samples in place: a filled sample is observed, and its residual is 0. A filled
/// span meets its ends in value and velocity (in value only by `slerp`, `pchip` and `recurrent`).
/// Gaps that the method's rules refuse stay missing and are listed. Gaps that a model cannot fill
/// are filled by `auto` under its own rules, with a warning. Errors: `ErrorKind::usage` for an
/// unknown method, name or donor, and for a learned method without its model. A joint with one or
/// two rotation channels gets rotations that these channels can express.
FillReport fill_gaps(Take& clip, const FillSettings& settings = {});

}  // namespace kinemend
