// Runs a live session between its source of frames and its output.
#pragma once

#include <cstddef>
#include <optional>

#include "kinemend/extend/sessions.hpp"
#include "live_output.hpp"
#include "live_sockets.hpp"
#include "live_status.hpp"

namespace kinemend::cli {

/// Where frames come from.
enum class LiveSource : std::uint8_t { standard, tcp_listen, tcp_connect, udp };

struct LivePlan {
  LiveSource source = LiveSource::standard;
  Address from;
  double stall_s = 1;  ///< a longer silence is reported, once; 0: never
  bool holds = false;  ///< repeat the last frame during a silence
  bool once = false;   ///< end with the first connection
  bool quiet = false;
  LiveStatus* status = nullptr;  ///< null: no status page
  LiveSession* session = nullptr;
  LiveOutput* output = nullptr;
  /// Set to the arrival time of bytes before they are fed; none when the stream ends.
  std::optional<LiveClock::time_point>* came = nullptr;
};

/// Receives, cleans and sends until the input ends or SIGINT or SIGTERM arrives, then sends the
/// remaining frames. Errors: `ClosedPipe`, `ErrorKind::unreadable_input` for an input that cannot
/// be opened, `cannot_write`.
void run_live(const LivePlan& plan);

}  // namespace kinemend::cli
