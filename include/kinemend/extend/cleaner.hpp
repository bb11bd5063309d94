// The interface of cleaning methods: the input and output of a method, for whole takes and frame by
// frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/options.hpp"
#include "kinemend/extend/take_view.hpp"

namespace kinemend {

/// The treatment of one sample of a track.
enum class Action : std::uint8_t { kept, denoised, despiked, filled, foot_adjusted, refused };

std::string_view to_string(Action action);

/// The tracks for which a cleaner returned another method's result instead of its own.
struct FallBack {
  std::string method = "auto";       ///< the other method
  std::string reason;                ///< "the model does not know them"
  std::vector<std::int32_t> tracks;  ///< joints or markers; -1: the root position
  /// Share of each track that is the other method's (0..1), over frames.
  std::vector<double> shares;
};

/// Noise whose samples depend on each other.
struct ColouredNoise {
  double strength = 0;     ///< deviation per axis: degrees for rotations, else file units
  double correlation = 0;  ///< from one frame to the next; 0: white or unknown
};

/// A track after cleaning: F samples of its space.
struct CleanedTrack {
  std::vector<Quat> rotations;
  std::vector<Vec3> positions;
  /// F if the cleaner distinguishes samples (spikes, fills); else empty. A missing marker has a
  /// valid position only where the action is `filled`.
  std::vector<Action> actions;
  ColouredNoise noise{};  ///< the noise that was removed, if it is coloured
};

/// Receives a cleaned track. Called at most once per track, from any thread. It may write into the
/// clip at once, because the cleaner does not read the samples of this track again.
using TrackSink = std::function<void(std::size_t track, CleanedTrack cleaned)>;

/// Describes the noise of a take's rotations, or of its positions.
struct NoiseCharacter {
  Space space = Space::rotation;
  /// Per axis, the median over the tracks with noise: degrees for rotations, else file units.
  double strength = 0;
  double correlation = 0;  ///< from one measurement to the next; 0: white
  /// Frames per measurement: 4 if 30 Hz were resampled to 120, 2.5 if 24 Hz were shown at 60.
  double frames_per_sample = 1;
  /// The frames between two measurements lie on a line; else the sample is held.
  bool is_interpolated = false;
  /// The noise was not measured: a model expects it in takes like this one. With `correlation` 0 it
  /// is slow, and only its strength is known.
  bool is_expected = false;

  /// Returns the frequency in hertz below which a share (0..1) of the noise's power lies, at the
  /// frame rate of the take.
  double frequency_of_share(double share, double frame_rate_hz) const;
};

/// The information that a cleaner returns beside the cleaned tracks.
struct CleanTrace {
  /// One value per track: estimated noise per axis before cleaning, degrees or file units; else
  /// empty.
  std::vector<double> noise;
  /// One value per track from methods that estimate their error: the expected distance of cleaned
  /// samples from the truth, per axis, degrees or file units; else empty.
  std::vector<double> left;
  /// At most one entry for rotations and one for positions, from methods that measure noise. A
  /// space without noise has no entry.
  std::vector<NoiseCharacter> characters;
  std::vector<FallBack> fall_backs;
  /// Tracks that were left alone and why, or data that could not be used.
  std::vector<std::string> notes;
  std::vector<std::string> warnings;
};

/// Whether a method supports live use at a frame rate.
struct LiveSupport {
  std::string why_not{};  ///< why it does not run live, and which method would; empty: it runs
  std::string warning{};  ///< limitations at this rate; empty: none

  bool runs() const noexcept { return why_not.empty(); }
};

/// One frame of live motion.
struct Frame {
  std::vector<Quat> rotations;  ///< J
  /// Root position, then those of the translated joints; or M markers.
  std::vector<Vec3> positions;
  /// J or M, 1 if the joint's rotation or the marker was measured; empty: all were.
  std::vector<std::uint8_t> observed;

  /// `owner`: the joint or marker.
  bool is_observed(std::size_t owner) const { return observed.empty() || observed[owner] != 0; }
};

/// Returns frame `frame` of a take, unchanged.
Frame frame_of(const TakeView& take, std::size_t frame);

/// The state of a cleaner on one stream: frame t goes in, frame t - `lookahead()` comes out.
class LiveFilter {
 public:
  virtual ~LiveFilter() = default;
  /// Number of frames that the filter takes before it gives the first one. Constant.
  virtual std::size_t lookahead() const = 0;
  /// Takes a frame with the joints or markers that the filter was made for; true if `out` holds the
  /// next cleaned frame. A missing marker is passed through unchanged. Once warm, it allocates no
  /// memory, unless a sample within a window is missing.
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
  /// passed to the constructor is not included.
  virtual OptionValues options() const { return {}; }

  /// Cleans the selected tracks and passes them to `sink`; unchanged tracks may be left out. Every
  /// frame is motion: calibration frames are already removed. Any number of frames is accepted, one
  /// and two included. Values inside a gap are ignored. The result does not depend on the number of
  /// threads. `progress`, if set, receives the share of the work that is done (0..1), from one
  /// thread at a time. Errors: `ErrorKind::usage` if the method does not work on this kind of take.
  virtual CleanTrace clean(const TakeView& take, const TrackSink& sink,
                           const std::function<void(double)>& progress) const = 0;

  /// Whether `live` makes a filter at this rate. By default the method needs the whole take.
  virtual LiveSupport live_support(double frame_rate_hz) const;
  /// Makes a filter for one stream of takes like `like`, whose frames are ignored. Its result
  /// equals that of `clean`. The cleaner and the clip that `like` refers to must outlive it.
  /// Errors: `ErrorKind::usage` if the method does not run live at this rate, or on this kind of
  /// take.
  virtual std::unique_ptr<LiveFilter> live(const TakeView& like) const;
};

/// The result of `clean_in_place`: the trace, and for each track its actions (empty: none recorded)
/// and noise.
struct InPlaceTrace : CleanTrace {
  std::vector<std::vector<Action>> actions;
  std::vector<ColouredNoise> coloured;
};
/// Runs the cleaner alone, without the pipeline of `clean_take`, and writes its result back into
/// the clip. Markers that it filled become observed.
InPlaceTrace clean_in_place(const Cleaner& cleaner, Take& take, const Selection& selection = {},
                            const std::function<void(double)>& progress = {});

}  // namespace kinemend
