// The interface of cleaning methods: what a method takes and gives, for whole takes and frame by
// frame, and the table of all methods.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/options.hpp"
#include "kinemend/take_view.hpp"

namespace kinemend {

/// What was done to one sample of a track.
enum class Action : std::uint8_t { kept, denoised, despiked, filled, foot_adjusted, refused };

std::string_view to_string(Action action);

/// Where a cleaner gave what another method makes of the take instead of what it makes itself.
struct FallBack {
  std::string method = "auto";       ///< the other
  std::string reason;                ///< "the model does not know them"
  std::vector<std::int32_t> tracks;  ///< joints or markers; -1: the root position
  std::vector<double> shares;        ///< how much of each is the other method's (0..1), over frames
};

/// Noise whose samples depend on each other.
struct ColouredNoise {
  double strength = 0;     ///< deviation of each axis: degrees of rotations, else file units
  double correlation = 0;  ///< from one frame to the next; 0: it is white, or not known
};

/// What a cleaner made of a track: F samples of its space.
struct CleanedTrack {
  std::vector<Quat> rotations;
  std::vector<Vec3> positions;
  /// F where the cleaner tells samples apart (spikes, fills); else empty. A marker that was not
  /// seen has a position where it says `filled`, and what stands there else means nothing.
  std::vector<Action> actions;
  ColouredNoise noise{};  ///< that it took out, where it is coloured
};

/// Takes what a cleaner made of a track. Called at most once a track, from any thread; it may write
/// into the clip at once, whose samples of this track are not looked at again.
using TrackSink = std::function<void(std::size_t track, CleanedTrack cleaned)>;

/// What the noise of a take's rotations, or of its positions, is like.
struct NoiseCharacter {
  Space space = Space::rotation;
  /// Per axis, the median of the tracks that have some: degrees of rotations, else file units.
  double strength = 0;
  double correlation = 0;  ///< from one measurement to the next; 0: white
  /// Frames for which there is one measurement: 4 where 30 Hz were brought to 120, 2.5 where 24 Hz
  /// were shown at 60.
  double frames_per_sample = 1;
  bool is_interpolated = false;  ///< the frames between are on a line; else the sample is held
  /// Not measured: a model expects it of takes like this one. With `correlation` 0 it is slow, and
  /// its strength alone is known.
  bool is_expected = false;

  /// The frequency below which a share of the noise's power lies (0..1), hertz, at the frame rate
  /// of the take.
  double frequency_of_share(double share, double frame_rate_hz) const;
};

/// What a cleaner says of its work beside the cleaned tracks.
struct CleanTrace {
  /// One a track: estimated noise per axis before cleaning, degrees or file units; else empty.
  std::vector<double> noise;
  /// One a track, of methods that say how sure they are: how far its samples are expected to be
  /// from the truth when they are cleaned, per axis, degrees or file units; else empty.
  std::vector<double> left;
  /// At most one for rotations and one for positions, of methods that look; none of a space without
  /// noise.
  std::vector<NoiseCharacter> characters;
  std::vector<FallBack> fall_backs;
  std::vector<std::string> notes;  ///< what it left alone and why, or what it could not use
  std::vector<std::string> warnings;
};

/// What a method says of live use at a frame rate before a stream begins.
struct LiveSupport {
  std::string why_not{};  ///< why it does not run live, and what would; empty: it runs
  std::string warning{};  ///< what it cannot do at this rate; empty: nothing

  bool runs() const noexcept { return why_not.empty(); }
};

/// One frame of live motion.
struct Frame {
  std::vector<Quat> rotations;  ///< J
  /// Root position, then those of the translated joints; or M markers.
  std::vector<Vec3> positions;
  /// J or M, 1 where the joint's rotation or the marker was measured; empty means all.
  std::vector<std::uint8_t> observed;
};

/// Frame `frame` of a take, as it stands.
Frame frame_of(const TakeView& take, std::size_t frame);

/// The state of a cleaner on one stream: frame t goes in, frame t - `lookahead()` comes out.
class LiveFilter {
 public:
  virtual ~LiveFilter() = default;
  /// Frames that the filter takes before it gives the first one. Constant.
  virtual std::size_t lookahead() const = 0;
  /// Takes a frame with the joints or markers that the filter was made for; true if `out` holds the
  /// next cleaned frame. A marker that is missing comes out as it came. Once warm, it takes nothing
  /// from the heap, unless something is missing within a window.
  virtual bool push(const Frame& in, Frame& out) = 0;
  /// After the last frame: gives the remaining frames one by one, then returns false.
  virtual bool flush(Frame& out) = 0;
};

/// A cleaning method with its options. Immutable after construction and safe to share between
/// threads.
class Cleaner {
 public:
  virtual ~Cleaner() = default;

  /// The name of the method, for reports: "bilateral".
  virtual std::string_view name() const = 0;
  /// Every option of the method with the value that this cleaner was made with. A model that was
  /// handed over is not among them.
  virtual OptionValues options() const { return {}; }

  /// Cleans the selected tracks and hands them over; tracks that it leaves alone may be left out.
  /// Every frame is motion: calibration frames are already off. Any number of frames is accepted,
  /// one and two included. What stands in a gap never matters. The result does not depend on the
  /// number of threads. `progress`, where there is one, is told how far the work is (0..1), by one
  /// thread at a time. Errors: `ErrorKind::usage` of a method that does not work on this kind of
  /// take.
  virtual CleanTrace clean(const TakeView& take, const TrackSink& sink,
                           const std::function<void(double)>& progress) const = 0;

  /// Whether `live` would make a filter at this rate. The default: the method needs the whole take.
  virtual LiveSupport live_support(double frame_rate_hz) const;
  /// A filter for one stream of takes like this one, whose frames do not matter. It gives what
  /// `clean` gives. The cleaner and the clip that `like` refers to outlive it. Errors:
  /// `ErrorKind::usage` where the method does not run live at this rate, or on this kind of take.
  virtual std::unique_ptr<LiveFilter> live(const TakeView& like) const;
};

/// What `clean_in_place` did: the trace, and of each track the actions (empty: nothing in
/// particular) and the noise.
struct InPlaceTrace : CleanTrace {
  std::vector<std::vector<Action>> actions;
  std::vector<ColouredNoise> coloured;
};
/// The cleaner alone, without the pipeline of `clean_take`: writes what it makes of the clip back
/// into it. Markers that it filled become observed.
InPlaceTrace clean_in_place(const Cleaner& cleaner, Take& take, const Selection& selection = {},
                            const std::function<void(double)>& progress = {});

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
