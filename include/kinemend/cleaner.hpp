#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/clip.hpp"
#include "kinemend/marker_clip.hpp"
#include "kinemend/options.hpp"

namespace kinemend {

/// What was done to one sample (a joint or a marker in a frame).
enum class Action : std::uint8_t { kept, denoised, despiked, filled, foot_adjusted, refused };

std::string_view to_string(Action action);

/// Which parts of a clip a cleaner may change.
struct Selection {
  std::vector<std::uint8_t> joints;  ///< J, 1 where the rotation may change
  bool root_position = true;         ///< position of joint 0
  bool translations = true;          ///< positions of translated joints that are selected

  static Selection all(const Clip& clip) {
    return {std::vector<std::uint8_t>(clip.joint_count(), 1), true, true};
  }
};

/// Where a cleaner gave what another method makes of the take instead of what it makes itself.
struct FallBack {
  std::string method = "auto";       ///< the other
  std::string reason;                ///< "the model does not know them"
  std::vector<std::int32_t> tracks;  ///< joints or markers; -1: the root position
  std::vector<double> shares;        ///< how much of each is the other method's (0..1), over frames
};

/// What a cleaner says of its work beside the cleaned clip.
struct CleanTrace {
  std::vector<Action>
      actions;  ///< F x J where the cleaner tells samples apart (spikes, fills); else empty
  std::vector<Action> root_actions;  ///< F, the same for the root position; else empty
  /// F x translated joints, the same for their positions; else empty.
  std::vector<Action> translation_actions;
  std::vector<double>
      noise_deg;  ///< J: estimated noise per axis before cleaning, degrees; else empty
  std::optional<double> root_noise;  ///< the same for the root position, file units
  std::vector<FallBack> fall_backs;
  std::vector<std::string> warnings;
};

/// Which markers a cleaner may change.
struct MarkerSelection {
  std::vector<std::uint8_t> markers;  ///< M, 1 where positions may change
  /// Stature, file units: options in degrees, and what counts as quiet, are measured by it.
  double body_height = 1;

  /// All that are positions, and the height of these markers.
  static MarkerSelection all(const MarkerClip& clip);
};

/// What a cleaner says of its work on markers.
struct MarkerTrace {
  std::vector<Action> actions;  ///< F x M where the cleaner tells samples apart; else empty
  std::vector<double> noise;    ///< M: estimated noise per axis, file units; else empty
  std::vector<FallBack> fall_backs;
  std::vector<std::string> warnings;
};

/// Takes what a cleaner made of a joint: F rotations, and what it says it did to each of them
/// (empty: nothing in particular). May be called from any thread, at most once a joint.
using JointSink = std::function<void(std::size_t joint, std::vector<Quat> rotations,
                                     std::vector<Action> actions)>;

/// What a method can do live.
struct LiveSupport {
  enum class Kind : std::uint8_t {
    none,      ///< needs the whole take
    windowed,  ///< a frame's result depends on `half_window_frames` on either side and on nothing
               ///< else
    causal,    ///< depends on the past only, through a state: `make_frame_filter`
  };
  Kind kind = Kind::none;
  std::size_t half_window_frames = 0;  ///< of `windowed`
};

/// One frame of live motion.
struct LiveFrame {
  Vec3 root_position;
  std::vector<Quat> rotations;           ///< J
  std::vector<Vec3> joint_translations;  ///< one a translated joint
  std::vector<std::uint8_t> observed;    ///< J, 1 where a rotation was measured; empty means all
};

/// The state of a causal cleaner on one stream: each call takes frame t and returns it cleaned.
class FrameFilter {
 public:
  virtual ~FrameFilter() = default;
  virtual void filter(LiveFrame& frame) = 0;
};

/// One frame of live markers.
struct MarkerFrame {
  std::vector<Vec3> positions;         ///< M
  std::vector<std::uint8_t> observed;  ///< M, 1 where there is a position; empty means all
};

/// The same for markers. What is missing stays missing.
class MarkerFilter {
 public:
  virtual ~MarkerFilter() = default;
  virtual void filter(MarkerFrame& frame) = 0;
};

/// A cleaning method with its options. Immutable after construction and safe to share between
/// threads.
class Cleaner {
 public:
  virtual ~Cleaner() = default;

  /// Cleans the selected parts of `clip` in place. Every frame is motion: calibration frames are
  /// already off. Any number of frames is accepted, one and two included. The result does not
  /// depend on the number of threads.
  virtual CleanTrace clean(Clip& clip, const Selection& selection) const = 0;

  /// The same for a caller who wants no second copy of a long take: positions are cleaned in place,
  /// and the rotations of those joints that may have changed go to `sink`, which may write them
  /// into `clip`: they are not looked at again. `CleanTrace::actions` stays empty. `progress`,
  /// where there is one, is told how far the work is (0..1), by one thread at a time. The default
  /// cleans a copy, and tells nothing on the way.
  virtual CleanTrace clean_joints(Clip& clip, const Selection& selection, const JointSink& sink,
                                  const std::function<void(double)>& progress = {}) const;

  /// Cleans the selected markers in place. What stands in a gap never matters. Gaps up to 0.25 s
  /// are bridged while a track is filtered, and no filter reaches across longer ones; only methods
  /// with a learned model fill gaps: what they filled is observed. Errors: `ErrorKind::usage` of a
  /// method that does not work on markers, which is the default.
  virtual MarkerTrace clean_markers(MarkerClip& clip, const MarkerSelection& selection) const;

  /// What the method can do frame by frame at this rate; the default is nothing.
  virtual LiveSupport live_support(double frame_rate_hz) const;
  /// Live, of a windowed cleaner: frame `frame` of what `clean` makes of `window`, all parts
  /// selected. The default cleans a copy of the window; a cleaner that can do with less work
  /// overrides it.
  virtual LiveFrame clean_frame(const Clip& window, std::size_t frame) const;
  /// A new stream's state, of a causal cleaner; nullptr of any other. `clean` of a causal cleaner
  /// gives the same numbers.
  virtual std::unique_ptr<FrameFilter> make_frame_filter(const Skeleton& skeleton,
                                                         double frame_rate_hz) const;
  /// The same for the markers of a clip like this one (its names and its rate; frames do not
  /// matter); nullptr of a method that is not causal. `clean_markers` gives the same numbers.
  virtual std::unique_ptr<MarkerFilter> make_marker_filter(const MarkerClip& like,
                                                           double body_height) const;
};

/// An entry of the table of methods.
struct Method {
  std::string name;     ///< "bilateral"
  std::string summary;  ///< one line
  std::string paper;    ///< where it comes from
  std::vector<OptionSpec> options;
  std::unique_ptr<Cleaner> (*make)(const OptionValues& values);
  bool learned = false;  ///< works with a trained model, on bodies that the model knows
};

/// All methods, `auto` first.
std::span<const Method> methods();
/// Errors: `ErrorKind::usage`, with the names there are.
const Method& find_method(std::string_view name);
/// Errors: `ErrorKind::usage` for an unknown method or option or a value out of range.
std::unique_ptr<Cleaner> make_cleaner(std::string_view method, const OptionValues& values = {});

}  // namespace kinemend
