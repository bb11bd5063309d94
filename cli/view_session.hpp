#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "json.hpp"

// What the page of `view` asks for: runs of other commands on one take, by the code that the
// command line runs.
namespace kinemend::cli {

/// The files that a session reads and writes; no others are touched, whatever is asked.
struct ViewFiles {
  std::string input;
  std::string other;            ///< compared with it, and nothing else; empty: none
  std::string cleaned, filled;  ///< where "save as" goes, of clean and of fill
  std::string gaps;  ///< side file of gaps that the take's format cannot hold; empty: none
  std::string contacts, plan;        ///< side files
  std::vector<std::string> reading;  ///< flags of the input, as they were given: "--asf=..."
  bool force = false;                ///< replace files that another run has made
};

struct ViewReply {
  int status = 200;
  std::string type = "application/json";
  std::string body;
};

class ViewSession {
 public:
  explicit ViewSession(ViewFiles files) : files_(std::move(files)) {}

  /// Of the page's address. `action`: "" for the page, "run", "save", "contacts". Never throws:
  /// what goes wrong is a reply with the status 4xx or 5xx and {"error": words}. A run that is
  /// overtaken by another is given up: 409. May be called from several threads.
  ViewReply answer(std::string_view method, std::string_view action, const std::string& body);
  /// Gives up what is running.
  void stop() { ++latest_; }

 private:
  ViewReply page(const Json& asked, std::uint64_t turn);
  ViewReply save(const Json& asked);
  ViewReply contacts();
  std::string clean_page(const Json& asked, std::uint64_t turn);
  std::string fill_page(const Json& asked);
  std::string comparison() const;
  std::string session_json() const;
  /// "kinemend clean walk.bvh ...": what the same run is on a command line.
  std::vector<std::string> words_of(const Json& asked) const;
  void write_side(const std::string& path, std::string_view bytes, Json& written);

  ViewFiles files_;
  std::mutex work_;                       // one run at a time
  std::atomic<std::uint64_t> latest_{0};  // turn of the last run that was asked for
  std::set<std::string> written_;         // by this session, which may replace them
};

}  // namespace kinemend::cli
