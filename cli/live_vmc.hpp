// Relays VMC between senders and a receiver: datagrams come in and leave with cleaned bones.
#pragma once

#include "kinemend/extend/sessions.hpp"
#include "live_sockets.hpp"
#include "live_status.hpp"

namespace kinemend::cli {

struct VmcPlan {
  Address from;  ///< where to listen
  Address to;    ///< the receiver
  const Cleaner* cleaner = nullptr;
  VmcOptions options;
  double stall_s = 1;  ///< a longer silence of all senders is reported, once; 0: never
  bool quiet = false;
  LiveStatus* status = nullptr;  ///< null: no status page
};

/// Relays until SIGINT or SIGTERM arrives, then sends the waiting frames and prints a summary.
/// Errors: `ErrorKind::unreadable_input` for a port that cannot be opened, `cannot_write` for a
/// receiver whose name is unknown, `usage` for a method that does not run live.
void run_vmc(const VmcPlan& plan);

}  // namespace kinemend::cli
