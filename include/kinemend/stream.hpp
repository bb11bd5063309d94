#pragma once

#include <cstddef>
#include <memory>

#include "kinemend/cleaner.hpp"

namespace kinemend {

/// Cleans frame by frame: frame t goes in, frame t - latency_frames() comes out. The result equals
/// that of cleaning the whole take (for markers, with the same body height). Missing markers stay
/// missing.
class Stream {
 public:
  virtual ~Stream() = default;

  /// Constant from the first frame on. For markers, a method with a window also waits for the 0.25
  /// s after which a gap counts as long, and for 0.05 s after the gap, which a bridge needs.
  virtual std::size_t latency_frames() const = 0;
  /// Takes a frame; returns true if `out` holds the next cleaned frame. Once the stream is warm, it
  /// allocates no memory, unless something is missing within a window. Errors: `ErrorKind::usage`
  /// if the frame size differs. Sample values never cause an error.
  virtual bool push(const Frame& in, Frame& out) = 0;
  /// After the last frame: gives the remaining frames one by one, then returns false.
  virtual bool flush(Frame& out) = 0;
  /// Back to the state before the first frame.
  virtual void reset() = 0;
};

/// A stream of this cleaner for takes with the skeleton and rate of `like`, whose frames are
/// ignored. The cleaner must outlive the stream. Errors: `ErrorKind::usage` if the method needs the
/// whole take.
std::unique_ptr<Stream> make_stream(const Cleaner& cleaner, const Clip& like);
/// The same for markers with the names, kinds and rate of `like`. `body_height` is the height of
/// the person in file units, for example that of an earlier take (`body_height(take)`).
std::unique_ptr<Stream> make_stream(const Cleaner& cleaner, const MarkerClip& like,
                                    double body_height);

}  // namespace kinemend
