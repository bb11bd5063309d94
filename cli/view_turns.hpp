// Keeps track of the latest run of each browser tab: a newer run stops the one before it.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace kinemend::cli {

/// A run cleans or fills the take; curves compare the methods for one gap of it.
enum class ViewTurn { run, curves };

class ViewTurns {
 private:
  using Count = std::atomic<std::uint64_t>;

 public:
  /// One run, or one request for curves, of a tab.
  class Turn {
   public:
    /// True once the same tab has sent a newer request or was closed, or the program ends.
    bool is_overtaken() const { return *latest_ != own_ || *ended_; }
    /// Errors: an `Error` with the text `overtaken`.
    void check() const;

   private:
    friend class ViewTurns;
    std::shared_ptr<Count> latest_;
    std::shared_ptr<std::atomic<bool>> ended_;
    std::uint64_t own_ = 0;
  };

  /// `tab` is the page's own name. A run replaces earlier runs and curves of the tab; curves
  /// replace curves. Other tabs are not affected.
  Turn begin(const std::string& tab, ViewTurn kind);
  /// The tab was closed.
  void leave(const std::string& tab);
  /// The program ends.
  void stop() { *ended_ = true; }

 private:
  struct Tab {
    std::shared_ptr<Count> run = std::make_shared<Count>(0);
    std::shared_ptr<Count> curves = std::make_shared<Count>(0);
  };

  std::mutex mutex_;
  std::map<std::string, Tab> tabs_;
  std::shared_ptr<std::atomic<bool>> ended_ = std::make_shared<std::atomic<bool>>(false);
};

inline constexpr const char* overtaken = "a newer run has replaced this one";

}  // namespace kinemend::cli
