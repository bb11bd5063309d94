// What the methods with a learned model share: a take becomes channels of a body, the method
// filters them, and they go back into the take.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/body.hpp"
#include "kinemend/experimental/model.hpp"

namespace kinemend {

/// Parts whose result is not the filter's but what `auto` makes of the take.
struct PartFallBack {
  std::string reason;
  std::vector<double> shares;  ///< D / 3: how much of each part, over frames (0..1)
};

/// A take as such a method sees it.
struct PriorWork {
  const BodyMatch* match = nullptr;  ///< of the take's joints or markers with the model's parts
  /// Degrees. Samples that are missing, and those of parts that the take lacks, are not observed.
  BodyChannels channels;
  std::vector<double> noise;          ///< D, degrees per channel, as `auto` measures it; 0: none
  std::vector<std::uint8_t> suspect;  ///< F x D, 1 where `auto` takes the sample for a spike
  /// D / 3: how much of the filter's result each part wants, by its noise: 0 where `auto` finds it
  /// clean, to 1.
  std::vector<double> needs;
  /// Nothing holds the filter back (`settle_needs`, `release_if_crowded`).
  bool is_whole = false;
  std::string why_no_need = "auto finds little or no noise in them";
  bool is_white = true;  ///< the noise, and every frame is a measurement, as far as `auto` can tell
  /// D / 3: 1 for parts that are not observed because they are left to `auto`. Empty: none.
  std::vector<std::uint8_t> left_out;
  /// F x D, what `auto` makes of the take, for what the model cannot explain; gaps are bridged.
  PoseMatrix fallback;
  /// Set by the filter, F x D: 1 where a measurement counted for next to nothing. Empty: none.
  std::vector<std::uint8_t> rejected;
  std::vector<PartFallBack> fall_backs;  ///< of the filter, and of what it is kept from
  std::vector<std::string> warnings;     ///< of the filter
};

/// Cleans `work.channels.poses` in place.
using PriorFilter = std::function<void(PriorWork& work)>;

/// What decides how much of a filter's result a part has.
enum class PriorHold {
  noise,        ///< the noise of the part
  white_noise,  ///< the same, and nothing where it is not white: the filter takes noise for white
  nothing,      ///< the filter is told what to do: all parts have all of it
};

/// Runs the filter on the parts that layout and take share, and `auto` on all others, on parts that
/// it finds clean and on joints that turn farther from the model's mean than their channels can say
/// (`tangent_limit_rad`) or flip by more than 60 degrees in a frame; fills gaps of the shared parts
/// where `fill` is set. The filter does not run where no part is left to it. Errors:
/// `ErrorKind::usage` as of `match_body`.
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

/// What makes a method of such a filter.
struct PriorMethod {
  std::string name;
  OptionValues options;  ///< all that the method has
  std::string map;       ///< the path of a mapping file, or empty
  bool fill = false;
  PriorHold hold = PriorHold::noise;
  PriorFilter filter;
  std::string why_not_live{};  ///< where there is more to say than that it needs the whole take
  /// Why the filter leaves all to `auto` at this frame rate; empty text: it does not. Null: at
  /// none.
  std::function<std::string(double frame_rate_hz)> why_not_at{};
};
/// A cleaner that does `clean_with_prior` to every take of joints or markers. Errors: as of
/// `name_map_at`.
std::unique_ptr<Cleaner> make_prior_cleaner(std::shared_ptr<const Model> model, PriorMethod method);

/// The names of a mapping file; none for an empty path. Errors: `ErrorKind::unreadable_input`.
NameMap name_map_at(const std::string& path);

}  // namespace kinemend
