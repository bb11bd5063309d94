#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/cleaner.hpp"

// Live motion as text: bytes of BVH, or of lines of markers, as they arrive in, cleaned frames as
// text out. docs/live.md describes both.
namespace kinemend {

/// How cleaned frames are written.
enum class LiveFormat {
  bvh,    ///< as it came in: the sender's hierarchy, then a line a frame with the channel values;
          ///< or the names of the markers, then their positions
  jsonl,  ///< a line of JSON that describes the stream, then one a frame
};

struct LiveOptions {
  LiveFormat format = LiveFormat::bvh;
  double strength = 1;       ///< 0..1: geodesic blend from the frame as it came to the cleaned one
  double frame_rate_hz = 0;  ///< 0.1 to 100,000; 0: that of the header, or 30 where it has none
  /// A motion line begins with the frame's number, which counts up by one: lost, late and doubled
  /// frames are told by it.
  bool numbered = false;
  std::size_t skipped_words = 0;  ///< at the start of a motion line, before the number
  /// BVH whose hierarchy and rate hold until a header comes; empty: frames wait for a header.
  std::string skeleton;
  double body_height = 1750;  ///< of the person, in the units of a stream of markers (> 0)
  double longest_gap_s = 1;   ///< lost frames in a row that are made up (>= 0)
  std::size_t most_line_bytes = 1U << 20;    ///< a longer line is malformed
  std::size_t most_header_bytes = 1U << 22;  ///< a longer header is none
};

/// What came in and went out. Every frame that came out was in, made up or held:
/// `frames_out = frames_in + made_up + held` once the stream has ended.
struct LiveCounts {
  std::size_t frames_in = 0;
  std::size_t frames_out = 0;
  std::size_t lost = 0;        ///< by their numbers, or malformed in a place of their own
  std::size_t made_up = 0;     ///< of those lost, between the frames on either side
  std::size_t held = 0;        ///< `LiveSession::hold`
  std::size_t late = 0;        ///< came after a later one, and were left out
  std::size_t doubled = 0;     ///< the number of the frame before once more, and left out
  std::size_t malformed = 0;   ///< lines that are no frame
  std::size_t not_finite = 0;  ///< values (nan, inf) that the frame before stood in for
  std::size_t restarts = 0;    ///< leaps of the numbers that are no loss
  std::size_t bad_headers = 0;
  std::size_t sessions = 0;  ///< skeletons, each with a header in the output
};

/// A piece of the output: text that ends with a newline.
struct LivePiece {
  bool is_header = false;
  std::string_view text;  ///< valid during the call only
};
using LiveSink = std::function<void(const LivePiece&)>;

/// One live stream: bytes in, in pieces of any size, and cleaned frames out with a constant delay.
/// Nothing in the bytes is an error: what is no frame is counted. Once it is warm, a frame takes
/// nothing from the heap.
class LiveSession {
 public:
  /// The cleaner outlives the session. Errors: `ErrorKind::usage` for options out of range and for
  /// a method that needs the whole take, `unreadable_input` for a `skeleton` that is no BVH.
  LiveSession(const Cleaner& cleaner, const LiveOptions& options, LiveSink sink);
  ~LiveSession();
  LiveSession(const LiveSession&) = delete;
  LiveSession& operator=(const LiveSession&) = delete;

  /// Bytes as they arrive.
  void feed(std::string_view bytes);
  /// What stands of a line is a line: a datagram ends there. A header goes on.
  void end_line();
  /// The sender has gone: what stands of a line or a header is forgotten. When one comes back, it
  /// goes on with a frame or with a header; one with another skeleton or rate ends the output of
  /// the old one and begins a new one.
  void drop_line();
  /// The frame before once more, for an output that keeps its clock while nothing comes; nothing
  /// before the first frame.
  void hold();
  /// The end of the stream: takes what stands of a line, and gives all frames that are left.
  void finish();

  const LiveCounts& counts() const noexcept;
  bool has_skeleton() const noexcept;
  std::size_t joint_count() const noexcept;     ///< 0 of markers, and before a header
  double frame_rate_hz() const noexcept;        ///< 0 before a header
  std::size_t latency_frames() const noexcept;  ///< 0 before a header
  /// Lines for people since the last call: a new skeleton with its delay, headers that are none,
  /// the first malformed line.
  std::vector<std::string> take_notes();

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

/// A method that runs live, and the options without which it does not (`causal` of `butterworth`).
struct LiveMethod {
  std::string name;
  OptionValues options;
};
/// All of them, in the order of the table of methods.
std::vector<LiveMethod> live_methods();

}  // namespace kinemend
