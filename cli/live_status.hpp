// The status page of a live stream: served on 127.0.0.1 by a thread of its own.
#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "http_server.hpp"
#include "json.hpp"
#include "kinemend/experimental/live.hpp"
#include "live_output.hpp"

namespace kinemend::cli {

/// Serves the page at `/` and its data at `/status.json`, to browsers of this machine only.
class LiveStatus {
 public:
  /// `port` 0: any that is free. Errors: `ErrorKind::cannot_write` for a port that cannot be used.
  explicit LiveStatus(int port);
  ~LiveStatus();
  LiveStatus(const LiveStatus&) = delete;
  LiveStatus& operator=(const LiveStatus&) = delete;

  std::string address() const;
  /// Serves from now on. `report` makes the data; it is called by another thread, which holds the
  /// lock.
  void start(std::function<Json()> report);
  /// Ends the service; `report` is not called again.
  void stop();
  /// To be held while what the report reads is changed.
  std::unique_lock<std::mutex> lock() { return std::unique_lock(mutex_); }

 private:
  HttpReply answer(const HttpHead& head);

  HttpServer server_;
  std::mutex mutex_;
  std::function<Json()> report_;
  std::thread thread_;
};

/// The lock of a page; of none, no lock.
std::unique_lock<std::mutex> locked(LiveStatus* status);

/// Milliseconds: median, 99th percentile, maximum and bars.
Json json_of(const LatencyHistogram& latency);
Json json_of(const std::vector<TrackChange>& changes);
/// The report of a stream of text.
Json stream_report(std::string_view method, const LiveSession& session, const LiveOutput& output);

}  // namespace kinemend::cli
