#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

// Which of the things that pages ask for is the last: all others are given up.
namespace kinemend::cli {

/// What is asked for: the take cleaned or filled, or the curves of one gap beside it.
enum class ViewTurn { run, curves };

class ViewTurns {
 private:
  using Count = std::atomic<std::uint64_t>;

 public:
  /// One thing that a tab has asked for.
  class Turn {
   public:
    /// Whether the same tab has asked for another since, was closed, or the program ends.
    bool is_overtaken() const { return *latest_ != own_ || *ended_; }
    /// Errors: an `Error` that says `overtaken`.
    void check() const;

   private:
    friend class ViewTurns;
    std::shared_ptr<Count> latest_;
    std::shared_ptr<std::atomic<bool>> ended_;
    std::uint64_t own_ = 0;
  };

  /// `tab` is what the page calls itself. A run overtakes what the tab has asked for before, curves
  /// overtake curves; another tab's are left alone.
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

inline constexpr const char* overtaken = "another run was asked for";

}  // namespace kinemend::cli
