// The cleaning methods by name, and the two that the program uses by itself: `learned`, its
// default, and `auto`.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/cleaner.hpp"
#include "kinemend/fill.hpp"

namespace kinemend {

struct Model;

/// An entry of the table of methods.
struct Method {
  std::string name;     ///< "bilateral"
  std::string summary;  ///< one line
  std::string paper;    ///< the paper that it follows
  std::vector<OptionSpec> options;
  std::unique_ptr<Cleaner> (*make)(const OptionValues& values);
  bool learned = false;  ///< needs a trained model and works on bodies that the model knows
};

/// All methods, `auto` first.
std::span<const Method> methods();
/// Returns the method of that name. Errors: `ErrorKind::usage`, with the names of all methods.
const Method& find_method(std::string_view name);
/// Makes the cleaner of a method. Errors: `ErrorKind::usage` for an unknown method or option or a
/// value out of range.
std::unique_ptr<Cleaner> make_cleaner(std::string_view method, const OptionValues& values = {});

/// Measures the noise of each joint or marker, repairs spikes, smooths by the measured noise, and
/// leaves clean takes unchanged. In a keyframed take (`TakeView::source`) only gaps change. The
/// default method of the program is `learned`.
struct AutoOptions {
  double sensitivity = 1;  ///< factor on the estimated noise: above 1 smooths more, below 1 less
  bool despike = true;
};
std::unique_ptr<Cleaner> make_auto(const AutoOptions& options = {});

/// A network trained on clean motion with the damage that systems and pipelines cause, and on takes
/// recorded by two systems at once. For each channel and moment it mixes smoothers of all widths,
/// and it adds a correction based on the whole body. It works on any skeleton and on markers, and
/// is more accurate if it recognises the joints. Takes shorter than half a second, or slower than
/// 20 Hz, are cleaned by `auto`. The source of the take (`TakeView::source`) decides how slow noise
/// that the take does not show is treated: for video, depth cameras and suits, all error that the
/// network expects is removed. For other sources, the change within half a second is limited to
/// twice the level of the quieter quarter of the take, or to the measured noise, so that clean
/// motion is kept. Errors: `ErrorKind::usage` for a model of another method.
struct LearnedOptions {
  std::string model{};  ///< a file made by `kinemend-train learned`; empty: the shipped model
  std::string map{};    ///< file that maps names in the take to names in the model
  /// Cleans frame by frame with a delay of 0.117 s (at most 14 frames up to 390 Hz), without spike
  /// rules and without measuring the noise first. A take is then cleaned like a stream of its
  /// frames.
  bool live = false;
};
std::unique_ptr<Cleaner> make_learned(const LearnedOptions& options = {},
                                      std::shared_ptr<const Model> model = nullptr);

/// Fills gaps of joints with the network of `make_learned`, for `FillModels::learned`. It fills
/// rotations of any skeleton. Takes shorter than half a second, or slower than 20 Hz, are left out.
LearnedFill make_learned_fill(const LearnedOptions& options = {},
                              std::shared_ptr<const Model> model = nullptr);

}  // namespace kinemend
