// Cleans motion frame by frame, with a fixed delay.
#pragma once

#include <cstddef>
#include <memory>

#include "kinemend/cleaner.hpp"
#include "kinemend/source.hpp"

namespace kinemend {

/// Cleans frame by frame: frame t goes in, frame t - latency_frames() comes out. The result equals
/// that of cleaning the whole take (for markers, with the same body height). Missing markers stay
/// missing. It is a `LiveFilter` with the take that it is for, and it checks what goes in.
class Stream {
 public:
  /// `make_stream` makes it, of a take without frames.
  Stream(const Cleaner& cleaner, Take like, const Selection& selection);
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  /// Constant from the first frame on. For markers, a method with a window also waits for the 0.25
  /// s after which a gap counts as long, and for 0.05 s after the gap, which a bridge needs.
  std::size_t latency_frames() const { return filter_->lookahead(); }
  /// Takes a frame; returns true if `out` holds the next cleaned frame. Once the stream is warm, it
  /// allocates no memory, unless something is missing within a window. Errors: `ErrorKind::usage`
  /// if the frame size differs. Sample values never cause an error.
  bool push(const Frame& in, Frame& out);
  /// After the last frame: gives the remaining frames one by one, then returns false.
  bool flush(Frame& out) { return filter_->flush(out); }
  /// Back to the state before the first frame.
  void reset() { filter_ = cleaner_.live(view_); }

 private:
  const Cleaner& cleaner_;
  Take like_;
  TakeView view_;  // of `like_`
  std::unique_ptr<LiveFilter> filter_;
};

/// A stream of this cleaner for takes with the skeleton, or the names and kinds of markers, and the
/// rate of `like`, whose frames are ignored. The cleaner must outlive the stream. `body_height`, of
/// markers: the height of the person in file units, for example that of an earlier take
/// (`body_height(take)`). `source`: what records the frames; `unknown`: what `like` says.
/// Errors: as of `Cleaner::live`.
std::unique_ptr<Stream> make_stream(const Cleaner& cleaner, const Take& like,
                                    double body_height = 0, Source source = Source::unknown);

}  // namespace kinemend
