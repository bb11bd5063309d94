#pragma once

#include <cstddef>
#include <memory>

#include "kinemend/cleaner.hpp"

namespace kinemend {

/// Cleaning frame by frame: frame t goes in, frame t - latency_frames() comes out. The frames that
/// come out are those that the cleaner gives for the whole take (of markers at the same body
/// height). Markers that are missing stay missing.
class Stream {
 public:
  virtual ~Stream() = default;

  /// Constant from the first frame on. On markers a method with a window also waits for the 0.25 s
  /// after which a gap counts as long, and the 0.05 s behind it that a bridge rests on.
  virtual std::size_t latency_frames() const = 0;
  /// Takes a frame; true when `out` holds the next cleaned one. Once the stream is warm, and unless
  /// something is missing within a window, it takes nothing from the heap. Errors:
  /// `ErrorKind::usage` for a frame of another shape; no value is one.
  virtual bool push(const Frame& in, Frame& out) = 0;
  /// After the last frame: gives the remaining frames one by one, then false.
  virtual bool flush(Frame& out) = 0;
  /// Back to the state before the first frame.
  virtual void reset() = 0;
};

/// A stream of this cleaner for takes with the skeleton and rate of `like`, whose frames do not
/// matter. The cleaner outlives the stream. Errors: `ErrorKind::usage` when the method needs the
/// whole take.
std::unique_ptr<Stream> make_stream(const Cleaner& cleaner, const Clip& like);
/// The same for markers with the names, kinds and rate of `like`. `body_height` is that of the
/// person in file units, which cannot be known of frames to come: that of an earlier take, say
/// (`body_height(take)`).
std::unique_ptr<Stream> make_stream(const Cleaner& cleaner, const MarkerClip& like,
                                    double body_height);

}  // namespace kinemend
