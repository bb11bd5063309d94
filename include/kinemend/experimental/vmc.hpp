// Cleans live motion in the VMC protocol: OSC datagrams come in, and the same datagrams go out with
// cleaned bones after a constant delay. docs/live.md describes it.
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
