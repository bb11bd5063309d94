// Cleans motion frame by frame, with a fixed delay.
#pragma once

#include <cstddef>
#include <memory>

#include "kinemend/extend/cleaner.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Cleans frame by frame: frame t goes in, frame t - latency_frames() comes out. The result equals
/// the result of cleaning the whole take (for markers, with the same body height). Missing markers
/// stay missing. A stream owns a `LiveFilter` and an empty take for it, and checks the input.
class Stream {
 public:
  /// For `make_stream`, which passes a take without frames.
  Stream(const Cleaner& cleaner, Take like, const Selection& selection);
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  /// Constant from the first frame on. For markers, a method with a window also waits for 0.25 s,
  /// after which a gap is long, and for another 0.05 s, which a bridge needs after the gap.
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
  TakeView view_;  // view of `like_`
  std::unique_ptr<LiveFilter> filter_;
};

/// Makes a stream of this cleaner for takes with the skeleton, or the names and kinds of markers,
/// and the rate of `like`, whose frames are ignored. The cleaner must outlive the stream.
/// `body_height`, for markers: the height of the person in file units, for example from an earlier
/// take (`body_height(take)`). `source`: the system that records the frames; `unknown`: the source
/// of `like`. Errors: as for `Cleaner::live`.
std::unique_ptr<Stream> make_stream(const Cleaner& cleaner, const Take& like,
                                    double body_height = 0, Source source = Source::unknown);

}  // namespace kinemend
