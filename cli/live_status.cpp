// Answers requests for the status page, and turns counts of a stream into JSON.
#include "live_status.hpp"

#include <fmt/format.h>

#include "live_status_page.hpp"

namespace kinemend::cli {

LiveStatus::LiveStatus(int port) : server_(port) {}

LiveStatus::~LiveStatus() { stop(); }

std::string LiveStatus::address() const {
  return fmt::format("http://127.0.0.1:{}/", server_.port());
}

void LiveStatus::start(std::function<Json()> report) {
  report_ = std::move(report);
  thread_ = std::thread([this] {
    const std::string host = fmt::format("127.0.0.1:{}", server_.port());
    const std::string local = fmt::format("localhost:{}", server_.port());
    server_.serve(
        [&](const HttpHead& head) {
          // A page elsewhere may use a host name that resolves to this machine.
          if (head.host != host && head.host != local) return http::forbidden;
          if (!head.site.empty() && head.site != "same-origin" && head.site != "none")
            return http::forbidden;
          return head.method == "GET" ? 0 : http::not_allowed;
        },
        [this](const HttpHead& head, const std::string&) { return answer(head); });
  });
}

void LiveStatus::stop() {
  if (!thread_.joinable()) return;
  server_.stop();
  thread_.join();
}

HttpReply LiveStatus::answer(const HttpHead& head) {
  if (head.path == "/") return {200, "text/html; charset=utf-8", std::string(live_status_page)};
  if (head.path != "/status.json") return {http::not_found, "text/plain", "not found\n"};
  const auto held = lock();
  return {200, "application/json", json_text(report_())};
}

std::unique_lock<std::mutex> locked(LiveStatus* status) {
  return status != nullptr ? status->lock() : std::unique_lock<std::mutex>();
}

Json json_of(const std::vector<TrackChange>& changes) {
  Json all = Json::array();
  for (const TrackChange& change : changes)
    all.push_back({{"name", change.name}, {"change", change.rms}});
  return all;
}

namespace {

// Milliseconds: median, 99th percentile, maximum and bars.
Json latency_json(const LatencyHistogram& latency) {
  if (latency.empty()) return nullptr;
  Json bars = Json::array();
  for (const LatencyHistogram::Bar& bar : latency.bars())
    bars.push_back({{"below_ms", 1000 * bar.below_s}, {"count", bar.count}});
  return {{"median_ms", 1000 * latency.quantile_s(0.5)},
          {"p99_ms", 1000 * latency.quantile_s(0.99)},
          {"most_ms", 1000 * latency.most_s()},
          {"bars", std::move(bars)}};
}

}  // namespace

Json status_report(std::string_view method, LiveDelay delay, const LatencyHistogram& latency,
                   Json senders) {
  return {{"kinemend", "live-status/1"},      {"method", method},
          {"delay_frames", delay.frames},     {"delay_ms", delay.ms},
          {"latency", latency_json(latency)}, {"senders", std::move(senders)}};
}

Json stream_report(std::string_view method, const LiveSession& session, const LiveOutput& output) {
  const LiveCounts& c = session.counts();
  const double rate_hz = session.frame_rate_hz();
  const Json counts = {
      {"in", c.frames_in},          {"out", c.frames_out},      {"lost", c.lost},
      {"interpolated", c.made_up},  {"held", c.held},           {"late", c.late},
      {"duplicate", c.doubled},     {"reordered", c.reordered}, {"malformed", c.malformed},
      {"not_finite", c.not_finite}, {"restarts", c.restarts},   {"dropped", output.dropped()}};
  const double delay_ms =
      rate_hz > 0 ? 1000 * static_cast<double>(session.latency_frames()) / rate_hz : 0;
  const bool joints = session.joint_count() > 0;
  const Json sender = {{"from", "stream"},
                       {"frame_rate_hz", rate_hz},
                       {"unit", joints ? "degrees" : "units"},
                       {"counts", counts},
                       {"tracks", json_of(session.changes())}};
  return status_report(method, {session.latency_frames(), delay_ms}, output.latency(),
                       Json::array({sender}));
}

}  // namespace kinemend::cli
