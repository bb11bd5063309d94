// Writes to the standard streams, draws progress where they are terminals, and remembers whether
// standard output was closed.
#include "terminal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>

#include "platform/console.hpp"

namespace kinemend::cli {

namespace {

bool is_colourful(int stream) {
  const char* no_color = std::getenv("NO_COLOR");
  return !(no_color && *no_color) && platform::understands_colours(stream);
}

bool out_was_closed = false;

constexpr std::string_view erase_line = "\r\033[K";

std::string bar_text(double share) {
  constexpr std::size_t width = 30;
  const auto full = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * width);
  return fmt::format("{}[{:=<{}}{:<{}}]", erase_line, "", full, "", width - full);
}

void say_as(Paint paint, std::string_view kind, std::string_view text) {
  write_err(fmt::format("kinemend: {}{}\n", Colours::of_err().paint(paint, kind), printable(text)));
}

}  // namespace

void open_standard_streams() { out_was_closed = !platform::open_standard_streams(); }

void check_out_is_open() {
  if (out_was_closed) throw Error(ErrorKind::cannot_write, "standard output: is closed");
}

void write_out(std::string_view text) {
  const int error = platform::write_all(platform::standard_output, text);
  if (error == EPIPE) throw ClosedPipe();
  if (error != 0)
    throw Error(ErrorKind::cannot_write, fmt::format("standard output: {}", std::strerror(error)));
}

void write_err(std::string_view text) { platform::write_all(platform::standard_error, text); }

void say(std::string_view text) { say_as(Paint::bold, "", text); }
void say_warning(std::string_view text) { say_as(Paint::yellow, "warning: ", text); }
void say_error(std::string_view text) { say_as(Paint::red, "", text); }

Colours Colours::of_out() { return Colours(is_colourful(platform::standard_output)); }
Colours Colours::of_err() { return Colours(is_colourful(platform::standard_error)); }

std::string Colours::paint(Paint paint, std::string_view text) const {
  return painted(paint, text, on_);
}

std::string duration_text(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  if (seconds < 90 * 60) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

ProgressBar::ProgressBar(std::size_t total, double work)
    : total_(total),
      work_(work > 0 ? work : static_cast<double>(total)),
      start_(std::chrono::steady_clock::now()),
      on_(total > 1 && platform::is_terminal(platform::standard_error)) {
  draw();
}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::step(double work, bool is_new) {
  const std::lock_guard lock(mutex_);
  ++done_;
  (is_new ? work_done_ : work_) += is_new ? work : -work;
  draw();
}

void ProgressBar::clear() {
  if (on_) write_err(erase_line);
}

void ProgressBar::draw() {
  if (!on_) return;
  const double share = static_cast<double>(done_) / static_cast<double>(total_);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  std::string left;
  if (work_done_ > 0 && done_ < total_) {
    left =
        fmt::format(", {} left", duration_text(spent.count() * (work_ - work_done_) / work_done_));
  }
  write_err(fmt::format("{} {}/{} takes{}", bar_text(share), done_, total_, left));
}

ProgressLine::ProgressLine() : on_(platform::is_terminal(platform::standard_error)) {}

ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::show(std::string_view stage, double done) {
  if (!on_) return;
  std::string text = fmt::format("{} {:3.0f} % {}", bar_text(done), 100 * done, stage);
  if (text == shown_) return;
  write_err(text);
  shown_ = std::move(text);
}

void ProgressLine::clear() {
  if (!shown_.empty()) write_err(erase_line);
  shown_.clear();
}

LateProgressLine::LateProgressLine(bool wanted) {
  if (wanted && platform::is_terminal(platform::standard_error))
    waiting_ = std::thread([this] { wait(); });
}

LateProgressLine::~LateProgressLine() {
  {
    const std::lock_guard lock(mutex_);
    has_ended_ = true;
  }
  ended_.notify_all();
  if (waiting_.joinable()) waiting_.join();
}

void LateProgressLine::wait() {
  constexpr std::chrono::seconds patience(1);
  std::unique_lock lock(mutex_);
  if (ended_.wait_for(lock, patience, [this] { return has_ended_; })) return;
  is_late_ = true;
  if (!stage_.empty()) line_.show(stage_, done_);
}

void LateProgressLine::show(std::string_view stage, double done) {
  const std::lock_guard lock(mutex_);
  stage_ = stage;
  done_ = done;
  if (is_late_) line_.show(stage_, done_);
}

}  // namespace kinemend::cli
