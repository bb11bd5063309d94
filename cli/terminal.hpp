// Messages, colours and progress on the standard streams.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend::cli {

/// Thrown if the reader of standard output has closed the pipe, as `head` does. Not an error.
struct ClosedPipe {};

/// Opens closed standard streams (descriptors 0 to 2) on the null device, so that the next opened
/// file does not become one of them. Call it first in `main`.
void open_standard_streams();
/// Errors: `cannot_write` if standard output was closed from the start, so that no take is lost.
void check_out_is_open();
/// Throws `ClosedPipe`, or `Error` of kind `cannot_write`.
void write_out(std::string_view text);
/// Ignores errors.
void write_err(std::string_view text);
/// `kinemend: text` on standard error, as one line (`printable`).
void say(std::string_view text);
void say_warning(std::string_view text);
void say_error(std::string_view text);

/// Colours for a standard stream that is a terminal, unless NO_COLOR is set.
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

/// A progress bar on standard error if that is a terminal. Thread-safe.
class ProgressBar {
 public:
  /// `work` is the total amount of work in any unit; 0 gives all takes the same weight.
  explicit ProgressBar(std::size_t total, double work = 0);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Counts one more take with this share of the work; `is_new` is false if an earlier run did it.
  void step(double work = 1, bool is_new = true);
  /// Erases the bar so that other text can be printed; `step` draws it again.
  void clear();

 private:
  void draw();

  std::mutex mutex_;
  std::size_t total_;
  std::size_t done_ = 0;
  double work_, work_done_ = 0;  ///< work of earlier runs is subtracted from `work_`
  std::chrono::steady_clock::time_point start_;
  bool on_;
};

/// "45 s", "12 min", "3.5 h".
std::string duration_text(double seconds);

/// A progress bar for a share of 0 to 1, if standard error is a terminal. For one thread.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `done`: 0 to 1.
  void show(std::string_view stage, double done);
  /// Erases the line so that other text can be printed; `show` draws it again.
  void clear();

 private:
  std::string shown_;
  bool on_;
};

/// A `ProgressLine` that appears only if work takes longer than a second, and is erased by the
/// destructor. Thread-safe.
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
