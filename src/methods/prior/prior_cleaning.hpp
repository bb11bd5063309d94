// The core that methods with a learned model share: it encodes a take as channels of a body, has
// the method filter them, and decodes them into the take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "kinemend/extend/body.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/model.hpp"

namespace kinemend {

/// Channels of a part, which is a track of a body or its place: the axes of a vector. By
/// definition.
inline constexpr std::size_t channels_of_part = 3;

/// Parts whose result comes from `auto` instead of the filter.
struct PartFallBack {
  std::string reason;
  std::vector<double> shares;  ///< D / 3: how much of each part, over frames (0..1)
};

/// A take as the input of such a method.
struct PriorWork {
  const BodyMatch* match = nullptr;  ///< of the take's joints or markers with the model's parts
  /// Degrees. Samples that are missing, and those of parts that the take lacks, are not observed.
  BodyChannels channels;
  std::vector<double> noise;          ///< D, degrees per channel, as `auto` measures it; 0: none
  std::vector<std::uint8_t> suspect;  ///< F x D, 1 where `auto` takes the sample for a spike
  /// D / 3: how much of the filter's result each part takes, by its noise, from 0 (`auto` finds the
  /// part clean) to 1.
  std::vector<double> needs;
  /// The result is not held near that of `auto` (`settle_needs`, `release_if_crowded`).
  bool is_whole = false;
  std::string why_no_need = "auto finds little or no noise in them";
  bool is_white = true;  ///< as far as `auto` can tell: white noise, and no repeated frames
  /// D / 3: 1 for parts that are not observed because they are left to `auto`. Empty: none.
  std::vector<std::uint8_t> left_out;
  /// F x D: the result of `auto`, for motion that the model cannot explain; gaps are bridged.
  PoseMatrix fallback;
  /// Set by the filter, F x D: 1 for a measurement of almost no weight. Empty: none.
  std::vector<std::uint8_t> rejected;
  std::vector<PartFallBack> fall_backs;  ///< parts left to `auto`, by the filter or before it
  std::vector<std::string> warnings;     ///< of the filter
};

/// Cleans `work.channels.poses` in place.
using PriorFilter = std::function<void(PriorWork& work)>;

/// Decides how much of a filter's result a part takes.
enum class PriorHold {
  noise,        ///< by the noise of the part
  white_noise,  ///< the same, or nothing if the noise is coloured: the filter assumes white noise
  nothing,      ///< all of it in all parts: options set the strength of the filter
};

/// Runs the filter on the parts that layout and take share. `auto` cleans all others, parts that it
/// finds clean, and joints that turn farther from the model's mean than their channels can express
/// (`tangent_limit_rad`) or flip by more than 60 degrees in a frame. Fills gaps of the shared parts
/// if `fill` is set. The filter does not run if no part is left to it. Errors: `ErrorKind::usage`
/// as of `match_body`.
CleanTrace clean_with_prior(const TakeView& take, const TrackSink& sink, const BodyLayout& layout,
                            const NameMap& names, bool fill, PriorHold hold,
                            const PriorFilter& filter);

/// A cleaner that does its own work on some takes only, and leaves others to `auto`.
class ParticularCleaner : public Cleaner {
 public:
  /// Why it leaves every joint or marker of this take to `auto`; empty: it cleans some. Errors:
  /// `ErrorKind::usage` of a take that `clean` refuses.
  virtual std::string why_not(const Take& take) const = 0;
};

/// A method that is built on such a filter.
struct PriorMethod {
  std::string name;
  OptionValues options;  ///< all that the method has
  std::string map;       ///< the path of a mapping file, or empty
  bool fill = false;
  PriorHold hold = PriorHold::noise;
  PriorFilter filter;
  std::string why_not_live{};  ///< replaces the usual reason (it needs the whole take); or empty
  /// Why the filter leaves all to `auto` at this frame rate; an empty text if it does not. Null: it
  /// never does.
  std::function<std::string(double frame_rate_hz)> why_not_at{};
};
/// A cleaner that applies `clean_with_prior` to every take of joints or markers. Errors: as of
/// `name_map_at`.
std::unique_ptr<Cleaner> make_prior_cleaner(std::shared_ptr<const Model> model, PriorMethod method);

/// The names of a mapping file; none for an empty path. Errors: `ErrorKind::unreadable_input`.
NameMap name_map_at(const std::string& path);

}  // namespace kinemend
