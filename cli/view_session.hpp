// Answers the `view` page: runs other commands on one take with the code of the command line.
#pragma once

#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fill_take.hpp"
#include "http_server.hpp"
#include "json.hpp"
#include "view_asked.hpp"
#include "view_turns.hpp"

namespace kinemend::cli {

/// The files that a session reads and writes. A take is saved only in the folder of `cleaned` or
/// `filled`, under a name that the page may choose; no other file is written, whatever the request.
struct ViewFiles {
  std::string input;
  std::string other;                 ///< a take to compare with; empty: none
  bool of_joints = true;             ///< the input holds joints
  std::string cleaned, filled;       ///< where "save as" writes, for clean and for fill
  std::string contacts, plan, gaps;  ///< side files
  bool with_gaps = false;            ///< the gaps in `gaps` are missing from the start
  std::vector<std::string> reading;  ///< flags for reading the input, as given: "--asf=..."
  std::string source = "unknown";    ///< source for `clean` if the page sets none
  bool force = false;                ///< replaces files from other runs
};

/// The files of a take, with the default names beside it. `from` is the requested format, or empty.
ViewFiles view_files_beside(const std::string& input, const std::string& from = "");

using ViewReply = HttpReply;
/// Receives the current stage of a run and its progress (0..1), in the run's thread.
using ViewProgress = std::function<void(std::string_view stage, double done)>;

class ViewSession {
 public:
  explicit ViewSession(ViewFiles files, ViewProgress told = {})
      : files_(std::move(files)), told_(std::move(told)) {}

  /// JSON from which the page is built before there is a result (web/src/served.ts).
  std::string session() const;

  /// Answers one request. `action` is the end of its address:
  /// - "": the page, without a take yet;
  /// - "run": report and motion of a run;
  /// - "curves": the result of each method for one gap;
  /// - "save", "contacts", "gaps": writes the take, reads a side file;
  /// - "progress": the current stage of the run;
  /// - "leave": the tab was closed.
  /// Never throws: an error is a reply with the status 4xx or 5xx and {"error": words}. A run that
  /// a newer one of its tab has replaced ends with 409. May be called from several threads.
  ViewReply answer(std::string_view method, std::string_view action, const std::string& body);
  /// Stops the current run.
  void stop() { turns_.stop(); }

 private:
  using Turn = ViewTurns::Turn;

  ViewReply first_page() const;
  ViewReply act(std::string_view action, const ViewAsked& asked);
  ViewReply run(const ViewAsked& asked, const Turn& turn);
  ViewReply curves(const ViewAsked& asked, const Turn& turn);
  ViewReply save(const ViewAsked& asked);
  ViewReply contacts();
  ViewReply gaps();
  ViewReply progress();
  std::string clean_page(const ViewAsked& asked, const Turn& turn);
  std::string fill_page(const ViewAsked& asked, const Turn& turn);
  std::string comparison() const;
  /// Uses the plan and gaps of the page instead of those in files.
  FillRun fill_run(const ViewAsked& asked) const;
  /// The command line that does the same run: "clean", "walk.bvh", ...
  std::vector<std::string> words_of(const ViewAsked& asked) const;
  /// Records the progress of the run. Throws if a newer run has replaced it.
  void tell(const Turn& turn, std::string_view stage, double done);
  /// The path where the take is saved: beside the default, which is an option of the command.
  std::string output_of(const ViewAsked& asked) const;
  /// Files that are read, and side files; no take may replace them.
  std::vector<std::string> inputs() const;
  /// Returns whether an existing file may be replaced: with `--force`, after the user's
  /// confirmation, or if this session has written it.
  bool may_replace(const std::string& path, const ViewAsked& asked) const;
  void write_side(const std::string& path, std::string_view bytes, const ViewAsked& asked,
                  Json& written);

  ViewFiles files_;
  ViewProgress told_;
  ViewTurns turns_;
  std::mutex work_;                // allows one run at a time
  std::set<std::string> written_;  // files that this session has written and may replace
  std::mutex telling_;
  std::string stage_;  // stage and progress of the run
  double done_ = 0;
};

}  // namespace kinemend::cli
