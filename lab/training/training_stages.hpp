// Keeps the state of a training that may be interrupted, so that it can be resumed.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstring>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinemend/lab/train.hpp"

namespace kinemend {

/// The state of a stage, value by value.
class StageWriter {
 public:
  template <class Value>
  void value(const Value& single) {
    static_assert(std::is_trivially_copyable_v<Value>);
    bytes_.append(reinterpret_cast<const char*>(&single), sizeof single);
  }
  template <class Value>
  void values(std::span<const Value> all) {
    value(all.size());
    bytes_.append(reinterpret_cast<const char*>(all.data()), all.size_bytes());
  }
  template <class Value>
  void values(const std::vector<Value>& all) {
    values(std::span<const Value>(all));
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads the same values in the same order. Errors: `ErrorKind::unreadable_input` at the end of the
/// bytes.
class StageReader {
 public:
  explicit StageReader(std::string_view bytes) : bytes_(bytes) {}
  template <class Value>
  Value value() {
    static_assert(std::is_trivially_copyable_v<Value>);
    Value single;
    std::memcpy(&single, next(sizeof single), sizeof single);
    return single;
  }
  template <class Value>
  std::vector<Value> values() {
    const auto count = value<std::size_t>();
    if (count > bytes_.size() / sizeof(Value)) refuse();
    std::vector<Value> all(count);
    const char* const from = next(count * sizeof(Value));
    if (count > 0) std::memcpy(all.data(), from, count * sizeof(Value));
    return all;
  }
  /// Errors: `ErrorKind::unreadable_input` if bytes are left.
  void end() const { expect(bytes_.empty()); }
  /// Errors: `ErrorKind::unreadable_input` if the values read are inconsistent.
  static void expect(bool holds) {
    if (!holds) refuse();
  }

 private:
  [[noreturn]] static void refuse();
  const char* next(std::size_t count);
  std::string_view bytes_;
};

/// The properties that identify a training: names with values, as text.
using TrainingFacts = std::vector<std::pair<std::string, std::string>>;

/// The states of a training's stages, by name: those of an earlier run, and those to keep. Safe
/// from several threads; each stage belongs to one of them.
class TrainingStages {
 public:
  /// Errors: `ErrorKind::unreadable_input` if the checkpoint is damaged, `ErrorKind::usage` if its
  /// facts differ.
  TrainingStages(TrainCheckpoint checkpoint, TrainingFacts facts);

  /// Takes the bytes of all motion that the method learns from, in order.
  void see(std::string_view bytes);
  /// Called after all takes. Errors: `ErrorKind::usage` if the checkpoint belongs to other takes.
  void end_of_takes();

  /// The kept state of a stage; empty if it has none.
  std::string_view kept(const std::string& stage) const;
  /// Whether the state of a running stage should be kept now.
  bool is_due(const std::string& stage) const;
  /// Errors: as of `TrainCheckpoint::keep`.
  void keep(const std::string& stage, std::string state);
  /// Whether the training is to end once all running stages have kept their states.
  bool is_stopping() const;
  /// Errors: `TrainingStopped` if it is to end.
  void stop_if_asked() const;

 private:
  using Clock = std::chrono::steady_clock;
  std::string bytes() const;

  TrainCheckpoint checkpoint_;
  TrainingFacts facts_;
  std::string takes_, known_takes_;  // digests: so far, and of the checkpoint
  std::map<std::string, std::string> states_;
  std::map<std::string, Clock::time_point> times_;
  mutable std::mutex mutex_;
};

}  // namespace kinemend
