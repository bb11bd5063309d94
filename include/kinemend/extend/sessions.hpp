// Cleans streams of text and of VMC datagrams, without sockets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/cleaner.hpp"

namespace kinemend {

// Cleans live motion as text: bytes of BVH, or of lines of markers, come in as they arrive, and
// cleaned frames go out as text. docs/live.md describes both.

/// How cleaned frames are written.
enum class LiveFormat {
  /// The form of the input: the sender's hierarchy, then a line per frame with the channel values;
  /// or the names of the markers, then their positions.
  bvh,
  jsonl,  ///< a line of JSON that describes the stream, then a line per frame
};

struct LiveOptions {
  LiveFormat format = LiveFormat::bvh;
  double strength = 1;  ///< 0..1: geodesic blend from the input to the cleaned frame
  /// Joints: holds a foot that is low and slow in its place, without more delay. Only legs move,
  /// and only horizontally. A skeleton whose legs are not recognised is not changed.
  bool feet = false;
  double frame_rate_hz = 0;  ///< 0.1 to 100,000; 0: the rate of the header, or 30 if it has none
  /// A motion line begins with the number of its frame, which increases by one. The numbers show
  /// lost, late and duplicate frames.
  bool numbered = false;
  /// Largest number of numbered frames that wait for a missing frame that they may have overtaken.
  /// When more arrive the frame is lost. 0: frames never wait.
  std::size_t reorder_frames = 0;
  /// The input comes in datagrams, which anyone can send: a malformed line is only counted, and not
  /// interpolated.
  bool datagrams = false;
  std::size_t skipped_words = 0;  ///< words to skip at the start of a motion line
  /// Lines as Axis Neuron sends them: the number and the name of an avatar, then the values of its
  /// 59 joints, with or without displacement, and no header. `skeleton`, if it is given, names the
  /// joints; otherwise the skeleton is a person of 1.75 m, in centimetres at 60 Hz.
  bool neuron = false;
  /// BVH text with hierarchy and rate, used until a header arrives. Empty: frames before the first
  /// header are malformed.
  std::string skeleton;
  /// The system that records the frames; with `neuron`, `unknown` means a suit.
  Source source = Source::unknown;
  double body_height = 1750;  ///< height of the person, in the units of a stream of markers (> 0)
  double longest_gap_s = 1;   ///< longest run of lost frames that is interpolated (>= 0)
  std::size_t most_line_bytes = 1U << 20;    ///< a longer line is malformed
  std::size_t most_header_bytes = 1U << 22;  ///< a longer header is rejected
};

/// Counts of a stream. Once it has ended, `frames_out = frames_in + made_up + held`.
struct LiveCounts {
  std::size_t frames_in = 0;
  std::size_t frames_out = 0;
  std::size_t lost = 0;       ///< frames missing by their numbers, or with a malformed line
  std::size_t made_up = 0;    ///< lost frames that were interpolated
  std::size_t held = 0;       ///< frames repeated by `LiveSession::hold`
  std::size_t late = 0;       ///< frames that arrived after a later one and were ignored
  std::size_t doubled = 0;    ///< frames with the number of an earlier frame, which were ignored
  std::size_t malformed = 0;  ///< lines that do not hold a frame
  /// Values (nan, inf) that were replaced by the values of the frame before.
  std::size_t not_finite = 0;
  std::size_t restarts = 0;  ///< jumps of the numbers too large to be a loss
  std::size_t bad_headers = 0;
  std::size_t sessions = 0;   ///< skeletons, each with a header in the output
  std::size_t reordered = 0;  ///< frames that arrived after a later one and were put in order
};

/// How much a joint's rotation or a marker changed, which is nearly its noise.
struct TrackChange {
  std::string name;
  /// Root mean square over about the last 600 frames: degrees, or units of the markers.
  double rms = 0;
};

/// A piece of the output: text that ends with a newline.
struct LivePiece {
  bool is_header = false;
  std::string_view text;  ///< valid during the call only
};
using LiveSink = std::function<void(const LivePiece&)>;

/// One live stream: takes bytes in pieces of any size, and gives cleaned frames with a constant
/// delay. Input never causes an error: malformed lines are counted. Once the stream is warm, a
/// frame allocates no memory.
class LiveSession {
 public:
  /// The cleaner must outlive the session. Errors: `ErrorKind::usage` for options out of range and
  /// for a method that needs the whole take, `unreadable_input` for a `skeleton` that is not BVH.
  LiveSession(const Cleaner& cleaner, const LiveOptions& options, LiveSink sink);
  ~LiveSession();
  LiveSession(const LiveSession&) = delete;
  LiveSession& operator=(const LiveSession&) = delete;

  /// Takes bytes as they arrive.
  void feed(std::string_view bytes);
  /// Ends the current line, as the end of a datagram does; a partial header is kept.
  void end_line();
  /// The sender has disconnected: discards a partial line or header. A sender that returns
  /// continues with a frame or a header. A header with another skeleton or rate ends the current
  /// output and begins a new one.
  void drop_line();
  /// Repeats the last frame, so that the output keeps its rate while no frame arrives. Does nothing
  /// before the first frame.
  void hold();
  /// Gives the frames that wait for a missing frame (`reorder_frames`), for example because no more
  /// input arrives. `hold`, `drop_line` and `finish` do so too.
  void settle();
  /// Ends the stream: takes a partial line, and gives all remaining frames.
  void finish();

  const LiveCounts& counts() const noexcept;
  bool has_skeleton() const noexcept;
  std::size_t joint_count() const noexcept;     ///< 0 for markers, and before a header
  double frame_rate_hz() const noexcept;        ///< 0 before a header
  std::size_t latency_frames() const noexcept;  ///< 0 before a header
  /// Returns the change of each joint or marker, in order; empty before the first cleaned frame.
  std::vector<TrackChange> changes() const;
  /// Returns the messages since the last call: a new skeleton with its delay, unreadable headers,
  /// the first malformed line.
  std::vector<std::string> take_notes();

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

/// A method that runs live, and the options that it needs to do so (`causal` for `butterworth`).
struct LiveMethod {
  std::string name;
  OptionValues options;
};
/// Returns all live methods, in the order of the table of methods.
std::vector<LiveMethod> live_methods();

// Cleans live motion in the VMC protocol: OSC datagrams come in, and the same datagrams go out with
// cleaned bones after a constant delay. docs/live.md describes it.

struct VmcOptions {
  double frame_rate_hz = 60;  ///< of the sender (0.1 to 100,000)
  /// Bones to clean, as messages name them; case is ignored. Empty: all bones of Unity's humanoid,
  /// and the root ("root"). A name that is not a bone of the humanoid is an additional bone.
  std::vector<std::string> bones;
  double strength = 1;              ///< 0..1: geodesic blend from the input to the cleaned pose
  bool feet = false;                ///< as `LiveOptions::feet`
  Source source = Source::unknown;  ///< the system that records the frames
  /// Largest size of the datagrams that wait for their bones; above it all of them are sent at
  /// once.
  std::size_t most_waiting_bytes = std::size_t{4} << 20;
};

/// Counts of a sender.
struct VmcCounts {
  std::size_t datagrams_in = 0;
  std::size_t datagrams_out = 0;  ///< equals `datagrams_in` after the end of the session
  std::size_t frames = 0;         ///< frames formed by the sender's bones
  std::size_t poses = 0;          ///< poses of bones and the root in the input
  std::size_t cleaned = 0;        ///< poses that were changed by cleaning
  std::size_t missing = 0;        ///< bones missing from a frame although earlier frames had them
  std::size_t made_up = 0;        ///< frames that did not arrive and were interpolated
  std::size_t not_finite = 0;     ///< poses that are not a rotation or contain nan or inf
  std::size_t not_osc = 0;        ///< datagrams that are not OSC, which are passed on unchanged
  /// Poses of bones that the session does not know, which are passed on unchanged.
  std::size_t other_bones = 0;
  std::size_t settled = 0;  ///< times all waiting datagrams were sent early in a pause
};

/// The session of one VMC sender. It takes datagrams and gives them in the same order; size,
/// bundles, time tags and all values except those of cleaned bones are kept. A datagram waits until
/// its bones are cleaned, and later datagrams wait for it. Any bytes are accepted. Memory is
/// bounded.
class VmcSession {
 public:
  using Sink = std::function<void(std::string_view datagram)>;

  /// The cleaner must outlive the session. Errors: `ErrorKind::usage` for options out of range and
  /// for a method that does not run live at this rate.
  VmcSession(const Cleaner& cleaner, const VmcOptions& options, Sink sink);
  ~VmcSession();
  VmcSession(const VmcSession&) = delete;
  VmcSession& operator=(const VmcSession&) = delete;

  /// Takes a datagram that arrived at `now_s`, in seconds of a monotonic clock.
  void receive(std::string_view datagram, double now_s);
  /// Handles timeouts: completes a frame of which no more datagrams arrive, and sends all waiting
  /// datagrams during a silence. Call it at `due_s` or more often.
  void attend(double now_s);
  /// Returns when to call `attend`; infinite: only after another datagram.
  double due_s() const noexcept;
  /// Gives all waiting datagrams, for the end of the stream. More datagrams may follow.
  void settle();

  const VmcCounts& counts() const noexcept;
  std::size_t latency_frames() const noexcept;  ///< constant
  double measured_hz() const noexcept;          ///< rate over the last seconds; 0: not measured yet
  std::size_t waiting_bytes() const noexcept;
  /// Returns the change of each cleaned bone.
  std::vector<TrackChange> changes() const;
  /// Returns the messages since the last call: bones that have no place in the skeleton, an
  /// unexpected rate.
  std::vector<std::string> take_notes();

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace kinemend
