#pragma once

#include <cstddef>
#include <memory>

#include "kinemend/cleaner.hpp"

namespace kinemend {

/// Cleaning frame by frame: frame t goes in, frame t - latency_frames() comes out. The frames that
/// come out are those that `Cleaner::clean` gives for the whole take.
class Stream {
 public:
  virtual ~Stream() = default;

  /// Constant from the first frame on.
  virtual std::size_t latency_frames() const = 0;
  /// Takes a frame; true when `out` holds the next cleaned one.
  virtual bool push(const LiveFrame& in, LiveFrame& out) = 0;
  /// After the last frame: gives the remaining frames one by one, then false.
  virtual bool flush(LiveFrame& out) = 0;
  /// Back to the state before the first frame.
  virtual void reset() = 0;
};

/// The same for markers: what comes out is what `Cleaner::clean_markers` gives for the whole take
/// at the same stature. What is missing stays missing.
class MarkerStream {
 public:
  virtual ~MarkerStream() = default;

  /// Constant from the first frame on. A method with a window also waits for the 0.25 s after which
  /// a gap counts as long, and the 0.05 s behind it that a bridge rests on.
  virtual std::size_t latency_frames() const = 0;
  /// Takes a frame; true when `out` holds the next cleaned one.
  virtual bool push(const MarkerFrame& in, MarkerFrame& out) = 0;
  /// After the last frame: gives the remaining frames one by one, then false.
  virtual bool flush(MarkerFrame& out) = 0;
  /// Back to the state before the first frame.
  virtual void reset() = 0;
};

/// A stream of this cleaner for a skeleton and rate. The cleaner outlives the stream.
/// Errors: `ErrorKind::usage` when the method needs the whole take.
std::unique_ptr<Stream> make_stream(const Cleaner& cleaner, const Clip& like);
/// The same for markers with the names, kinds and rate of `like`, whose frames do not matter.
/// `body_height` is the stature in file units, which cannot be known of frames to come: that of an
/// earlier take of the same person, say (`body_height(take)`). Errors: `ErrorKind::usage` when the
/// method needs the whole take.
std::unique_ptr<MarkerStream> make_marker_stream(const Cleaner& cleaner, const MarkerClip& like,
                                                 double body_height);

}  // namespace kinemend
