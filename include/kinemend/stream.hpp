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

/// A stream of this cleaner for a skeleton and rate. The cleaner outlives the stream.
/// Errors: `ErrorKind::usage` when the method needs the whole take.
std::unique_ptr<Stream> make_stream(const Cleaner& cleaner, const Clip& like);

}  // namespace kinemend
