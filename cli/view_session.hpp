// Answers the page of `view`: runs other commands on one take, with the code that the command line
// uses.
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

/// The files that a session reads and writes. A take is saved in the folder of `cleaned` or
/// `filled` only, under a name that the page may choose; no other file is touched, whatever is
/// asked.
struct ViewFiles {
  std::string input;
  std::string other;                 ///< compared with it, and nothing else; empty: none
  bool of_joints = true;             ///< what the input holds
  std::string cleaned, filled;       ///< where "save as" goes, of clean and of fill
  std::string contacts, plan, gaps;  ///< side files
  bool with_gaps = false;            ///< what `gaps` lists is missing from the start
  std::vector<std::string> reading;  ///< flags of the input, as they were given: "--asf=..."
  std::string source = "unknown";    ///< of `clean`, where the page sets none
  bool force = false;                ///< replace files that another run has made
};

/// Those of a take, with the default names beside it. `from`: the format that was asked for, or
/// empty.
ViewFiles view_files_beside(const std::string& input, const std::string& from = "");

using ViewReply = HttpReply;
/// Told what a run is doing and which share (0..1) of that is done, from the run's thread.
using ViewProgress = std::function<void(std::string_view stage, double done)>;

class ViewSession {
 public:
  explicit ViewSession(ViewFiles files, ViewProgress told = {})
      : files_(std::move(files)), told_(std::move(told)) {}

  /// What the page is made from before there is a result (web/src/served.ts): JSON.
  std::string session() const;

  /// Answers one request. `action` is the end of its address:
  /// - "": the page, still without a take;
  /// - "run": report and motion of a run;
  /// - "curves": what each method makes of one gap;
  /// - "save", "contacts", "gaps": writes the take, reads a side file;
  /// - "progress": what the run is doing;
  /// - "leave": the tab was closed.
  /// Never throws: an error is a reply with the status 4xx or 5xx and {"error": words}. A run that
  /// a newer one of its tab has replaced ends with 409. May be called from several threads.
  ViewReply answer(std::string_view method, std::string_view action, const std::string& body);
  /// Stops the run that is under way.
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
  /// With the plan and the gaps of the page instead of those in files.
  FillRun fill_run(const ViewAsked& asked) const;
  /// The command line of the same run: "clean", "walk.bvh", ...
  std::vector<std::string> words_of(const ViewAsked& asked) const;
  /// Records how far the run is. Throws where a newer run has replaced it.
  void tell(const Turn& turn, std::string_view stage, double done);
  /// Where the take is saved: beside the default, which is an option of the command.
  std::string output_of(const ViewAsked& asked) const;
  /// Files that are read, and side files, which no take may replace.
  std::vector<std::string> inputs() const;
  /// Whether an existing file is replaced: by `--force`, once the person has confirmed it, or since
  /// this session has written it.
  bool may_replace(const std::string& path, const ViewAsked& asked) const;
  void write_side(const std::string& path, std::string_view bytes, const ViewAsked& asked,
                  Json& written);

  ViewFiles files_;
  ViewProgress told_;
  ViewTurns turns_;
  std::mutex work_;                // one run at a time
  std::set<std::string> written_;  // by this session, which may replace them
  std::mutex telling_;
  std::string stage_;  // of the run, and how far it is
  double done_ = 0;
};

}  // namespace kinemend::cli
