#pragma once

#include <cstddef>
#include <optional>

#include "kinemend/experimental/live.hpp"
#include "live_output.hpp"
#include "live_sockets.hpp"

namespace kinemend::cli {

/// Where frames come from.
enum class LiveSource : std::uint8_t { standard, tcp_listen, tcp_connect, udp };

struct LivePlan {
  LiveSource source = LiveSource::standard;
  Address from;
  double stall_s = 1;  ///< a silence longer than this is told, once; 0: never
  bool holds = false;  ///< in a silence the frame before comes out again and again
  bool once = false;   ///< the end of the first connection is the end
  bool quiet = false;
  LiveSession* session = nullptr;
  LiveOutput* output = nullptr;
  LiveClock::time_point* came = nullptr;  ///< set to when bytes came, before they are fed
};

/// Receives, cleans and sends until the input ends or the program is told to end (SIGINT, SIGTERM);
/// then gives what is left. Errors: `ClosedPipe`, `ErrorKind::unreadable_input` for an input that
/// cannot be opened, `cannot_write`.
void run_live(const LivePlan& plan);

}  // namespace kinemend::cli
