// Cleans live motion in the VMC protocol: datagrams of OSC come in, and the same datagrams go out
// with cleaned bones, a constant delay later. docs/live.md describes it.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/experimental/live.hpp"

namespace kinemend {

struct VmcOptions {
  double frame_rate_hz = 60;  ///< of the sender (0.1 to 100,000)
  /// Bones to clean, as messages name them; upper and lower case are alike. Empty: all bones of
  /// Unity's humanoid, and the root ("root"). A name that the humanoid lacks is a bone of its own.
  std::vector<std::string> bones;
  double strength = 1;  ///< 0..1: geodesic blend from the pose as it came to the cleaned one
  bool feet = false;    ///< as `LiveOptions::feet`
  Source source = Source::unknown;  ///< what records the frames
  /// Datagrams that wait for their bones; when they are more, all of them leave at once.
  std::size_t most_waiting_bytes = std::size_t{4} << 20;
};

/// Counts of a sender.
struct VmcCounts {
  std::size_t datagrams_in = 0;
  std::size_t datagrams_out = 0;  ///< once the session has ended: all that came in
  std::size_t frames = 0;         ///< that the sender's bones made up
  std::size_t poses = 0;          ///< of bones and the root, in the messages that came in
  std::size_t cleaned = 0;        ///< of these: left with other values than they came with
  std::size_t missing = 0;        ///< bones that a frame lacked, though others had them before
  std::size_t made_up = 0;        ///< frames that did not arrive and were interpolated
  std::size_t not_finite = 0;     ///< poses that are no rotation, or have values nan and inf
  std::size_t not_osc = 0;        ///< datagrams that are not OSC; they pass unchanged
  std::size_t other_bones = 0;    ///< poses of bones that are in no table; they pass unchanged
  std::size_t settled = 0;        ///< times all waiting datagrams were sent early in a pause
};

/// One sender of VMC. Takes its datagrams and gives them in the same order, each with its size,
/// bundles, time tags and all values but those of cleaned bones. A datagram waits until its bones
/// are cleaned, and those after it wait for it. Any bytes are accepted. The memory is bounded.
class VmcSession {
 public:
  using Sink = std::function<void(std::string_view datagram)>;

  /// The cleaner must outlive the session. Errors: `ErrorKind::usage` for options out of range and
  /// for a method that does not run live at this rate.
  VmcSession(const Cleaner& cleaner, const VmcOptions& options, Sink sink);
  ~VmcSession();
  VmcSession(const VmcSession&) = delete;
  VmcSession& operator=(const VmcSession&) = delete;

  /// A datagram that arrived at `now_s`: seconds of a clock that never goes back.
  void receive(std::string_view datagram, double now_s);
  /// What time alone decides: a frame of which nothing more arrives is complete, and during a
  /// silence all that waits leaves. To be called when `due_s` has come, or more often.
  void attend(double now_s);
  /// When to call `attend`; infinite: only after another datagram.
  double due_s() const noexcept;
  /// Gives all that waits, for the end of the stream. More may follow.
  void settle();

  const VmcCounts& counts() const noexcept;
  std::size_t latency_frames() const noexcept;  ///< constant
  double measured_hz() const noexcept;          ///< of the last seconds; 0: not measured yet
  std::size_t waiting_bytes() const noexcept;
  /// Of each bone that was cleaned.
  std::vector<TrackChange> changes() const;
  /// Messages since the last call: bones without a place, a rate that is not the one expected.
  std::vector<std::string> take_notes();

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace kinemend
