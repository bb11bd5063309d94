#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "kinemend/error.hpp"
#include "kinemend/experimental/text.hpp"

namespace kinemend::cli {

/// The reader of standard output is gone, which is no failure: `head` has seen enough.
struct ClosedPipe {};

/// Opens those of the descriptors 0 to 2 that are closed on the null device: else the next file
/// that is opened would be taken for a standard stream. The first thing of all in `main`.
void open_standard_streams();
/// Throws `Error` of kind `cannot_write` where standard output was closed from the start: a take
/// that is meant for it must not vanish.
void check_out_is_open();
/// Throws `ClosedPipe`, or `Error` of kind `cannot_write`.
void write_out(std::string_view text);
/// Never fails: there is nobody left to tell.
void write_err(std::string_view text);
/// `kinemend: text` on standard error, on one line whatever is in the text.
void say(std::string_view text);
void say_warning(std::string_view text);
void say_error(std::string_view text);

/// Colours for one of the standard streams: none unless it is a terminal and NO_COLOR is not set.
class Colours {
 public:
  static Colours of_out();
  static Colours of_err();
  explicit Colours(bool on) : on_(on) {}
  bool on() const { return on_; }
  std::string paint(Paint paint, std::string_view text) const;

 private:
  bool on_;
};

/// A bar on standard error, on a terminal only. Calls may come from any thread.
class ProgressBar {
 public:
  /// `work`: how much there is to do, in any unit; 0: a take is as much as another.
  explicit ProgressBar(std::size_t total, double work = 0);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// One more is done, which was so much of the work; nothing of it where `is_new` is false.
  void step(double work = 1, bool is_new = true);
  /// Takes the bar off the line so that other text can be printed; `step` draws it again.
  void clear();

 private:
  void draw();

  std::mutex mutex_;
  std::size_t total_;
  std::size_t done_ = 0;
  double work_, work_done_ = 0;  ///< `work_` shrinks by what was done already
  std::chrono::steady_clock::time_point start_;
  bool on_;
};

/// "45 s", "12 min", "3.5 h".
std::string duration_text(double seconds);

/// A bar for work of one thread whose length is known as a share, on a terminal only.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `done`: 0 to 1.
  void show(std::string_view stage, double done);
  /// Takes the line away so that other text can be printed; `show` draws it again.
  void clear();

 private:
  std::string shown_;
  bool on_;
};

/// A `ProgressLine` that appears only where work takes longer than a second. Calls may come from
/// any thread. It goes with the object.
class LateProgressLine {
 public:
  explicit LateProgressLine(bool wanted);
  ~LateProgressLine();
  LateProgressLine(const LateProgressLine&) = delete;
  LateProgressLine& operator=(const LateProgressLine&) = delete;

  void show(std::string_view stage, double done);

 private:
  void wait();

  std::mutex mutex_;
  std::condition_variable ended_;
  ProgressLine line_;
  std::string stage_;
  double done_ = 0;
  bool is_late_ = false;
  bool has_ended_ = false;
  std::thread waiting_;
};

}  // namespace kinemend::cli
