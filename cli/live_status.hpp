// The status page of a live stream, served on 127.0.0.1 by its own thread.
#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "http_server.hpp"
#include "json.hpp"
#include "kinemend/extend/sessions.hpp"
#include "live_output.hpp"

namespace kinemend::cli {

/// Serves the page at `/` and its data at `/status.json`, to browsers of this machine only.
class LiveStatus {
 public:
  /// `port` 0 takes any free port. Errors: `ErrorKind::cannot_write` if it cannot be used.
  explicit LiveStatus(int port);
  ~LiveStatus();
  LiveStatus(const LiveStatus&) = delete;
  LiveStatus& operator=(const LiveStatus&) = delete;

  std::string address() const;
  /// Starts serving. `report` makes the data; another thread calls it while holding the lock.
  void start(std::function<Json()> report);
  /// Ends the service; `report` is not called again.
  void stop();
  /// Hold this lock while changing data that the report reads.
  std::unique_lock<std::mutex> lock() { return std::unique_lock(mutex_); }

 private:
  HttpReply answer(const HttpHead& head);

  HttpServer server_;
  std::mutex mutex_;
  std::function<Json()> report_;
  std::thread thread_;
};

/// Locks the page; returns an empty lock if `status` is null.
std::unique_lock<std::mutex> locked(LiveStatus* status);

/// The constant delay of a live method.
struct LiveDelay {
  std::size_t frames = 0;
  double ms = 0;
};

Json json_of(const std::vector<TrackChange>& changes);
/// The data of the page, `live-status/1`.
Json status_report(std::string_view method, LiveDelay delay, const LatencyHistogram& latency,
                   Json senders);
/// The report of a stream of text.
Json stream_report(std::string_view method, const LiveSession& session, const LiveOutput& output);

}  // namespace kinemend::cli
