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

#include "kinemend/experimental/train.hpp"

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

/// The same values in the same order. Errors: `ErrorKind::unreadable_input` at the end of the
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
  /// Errors: `ErrorKind::unreadable_input` for bytes that are left.
  void end() const { expect(bytes_.empty()); }
  /// Errors: `ErrorKind::unreadable_input` where what was read does not fit together.
  static void expect(bool holds) {
    if (!holds) refuse();
  }

 private:
  [[noreturn]] static void refuse();
  const char* next(std::size_t count);
  std::string_view bytes_;
};

/// What sets one training apart from another: names with values, as text.
using TrainingFacts = std::vector<std::pair<std::string, std::string>>;

/// The states of a training's stages, by name: those that an earlier one has kept, and those to
/// keep. Safe from several threads; each stage belongs to one of them.
class TrainingStages {
 public:
  /// Errors: `ErrorKind::unreadable_input` for a start that is damaged, `ErrorKind::usage` for one
  /// of other facts.
  TrainingStages(TrainCheckpoint checkpoint, TrainingFacts facts);

  /// All that the method learns from, one after the other.
  void see(std::string_view bytes);
  /// After all takes. Errors: `ErrorKind::usage` where the start is of other ones.
  void end_of_takes();

  /// Empty where there is none.
  std::string_view kept(const std::string& stage) const;
  /// Whether the state of a stage that goes on should be kept now.
  bool is_due(const std::string& stage) const;
  /// Errors: as of `TrainCheckpoint::keep`.
  void keep(const std::string& stage, std::string state);
  /// Whether the training is to end, when all stages that run have kept their states.
  bool is_stopping() const;
  /// Errors: `TrainingStopped` where it is.
  void stop_if_asked() const;

 private:
  using Clock = std::chrono::steady_clock;
  std::string bytes() const;

  TrainCheckpoint checkpoint_;
  TrainingFacts facts_;
  std::string takes_, known_takes_;  // digests: so far, and of the start
  std::map<std::string, std::string> states_;
  std::map<std::string, Clock::time_point> times_;
  mutable std::mutex mutex_;
};

}  // namespace kinemend
