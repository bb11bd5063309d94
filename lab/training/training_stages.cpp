// Writes and reads checkpoints of trainings, and rejects those of other takes or options.
#include "lab/training/training_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "kinemend/error.hpp"
#include "kinemend/extend/system.hpp"

namespace kinemend {

namespace {

// A file is this line, the checksum of the rest, and the rest.
constexpr std::string_view first_line = "kinemend training 1\n";

[[noreturn]] void refuse_damaged(const std::string& name) {
  throw Error(ErrorKind::unreadable_input,
              name + ": is damaged, or no checkpoint; train from the beginning");
}

[[noreturn]] void refuse_other(const std::string& name, const std::string& why) {
  throw Error(ErrorKind::usage, name + ": is of another training: " + why);
}

void write_text(StageWriter& writer, std::string_view text) {
  writer.values(std::span<const char>(text));
}

std::string read_text(StageReader& reader) {
  const std::vector<char> text = reader.values<char>();
  return {text.begin(), text.end()};
}

std::string_view checked_content(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with(first_line)) refuse_damaged(name);
  bytes.remove_prefix(first_line.size());
  if (bytes.size() < content_hash_digits) refuse_damaged(name);
  const std::string_view content = bytes.substr(content_hash_digits);
  if (content_hash(content) != bytes.substr(0, content_hash_digits)) refuse_damaged(name);
  return content;
}

// Throws for a fact that differs or that only one side has.
void check_same(const std::string& checkpoint, const TrainingFacts& kept,
                const TrainingFacts& now) {
  const auto value_of = [](const TrainingFacts& facts, const std::string& name) {
    const auto found = std::find_if(facts.begin(), facts.end(),
                                    [&](const auto& fact) { return fact.first == name; });
    return found == facts.end() ? std::string("nothing") : found->second;
  };
  for (const TrainingFacts* facts : {&now, &kept}) {
    for (const auto& [name, value] : *facts) {
      const std::string then = value_of(kept, name), here = value_of(now, name);
      if (then == here) continue;
      refuse_other(checkpoint, fmt::format("{} was {}, and is {}", name, then, here));
    }
  }
}

}  // namespace

void StageReader::refuse() { refuse_damaged("checkpoint"); }

const char* StageReader::next(std::size_t count) {
  if (count > bytes_.size()) refuse();
  const char* const place = bytes_.data();
  bytes_.remove_prefix(count);
  return place;
}

TrainingStages::TrainingStages(TrainCheckpoint checkpoint, TrainingFacts facts)
    : checkpoint_(std::move(checkpoint)), facts_(std::move(facts)) {
  if (checkpoint_.start.empty()) return;
  StageReader reader(checked_content(checkpoint_.start, checkpoint_.name));
  TrainingFacts kept;
  for (auto left = reader.value<std::uint64_t>(); left > 0; --left) {
    std::string name = read_text(reader);
    kept.emplace_back(std::move(name), read_text(reader));
  }
  check_same(checkpoint_.name, kept, facts_);
  known_takes_ = read_text(reader);
  for (auto left = reader.value<std::uint64_t>(); left > 0; --left) {
    const std::string name = read_text(reader);
    states_[name] = read_text(reader);
  }
  reader.end();
  checkpoint_.start.clear();
  checkpoint_.start.shrink_to_fit();
}

std::string TrainingStages::bytes() const {
  StageWriter writer;
  writer.value<std::uint64_t>(facts_.size());
  for (const auto& [name, value] : facts_) {
    write_text(writer, name);
    write_text(writer, value);
  }
  write_text(writer, takes_);
  writer.value<std::uint64_t>(states_.size());
  for (const auto& [name, state] : states_) {
    write_text(writer, name);
    write_text(writer, state);
  }
  const std::string content = writer.take();
  return std::string(first_line) + content_hash(content) + content;
}

void TrainingStages::see(std::string_view bytes) {
  takes_ = content_hash(takes_ + content_hash(bytes));
}

void TrainingStages::end_of_takes() {
  if (known_takes_.empty() || known_takes_ == takes_) return;
  refuse_other(checkpoint_.name,
               "its takes were others, or have changed since, or came in another order");
}

std::string_view TrainingStages::kept(const std::string& stage) const {
  const std::lock_guard lock(mutex_);
  const auto found = states_.find(stage);
  return found == states_.end() ? std::string_view() : found->second;
}

bool TrainingStages::is_due(const std::string& stage) const {
  if (!checkpoint_.keep && !checkpoint_.stop) return false;
  if (is_stopping()) return true;
  const std::lock_guard lock(mutex_);
  const auto last = times_.find(stage);
  return last == times_.end() ||
         Clock::now() - last->second >= std::chrono::duration<double>(checkpoint_.every_s);
}

void TrainingStages::keep(const std::string& stage, std::string state) {
  const std::lock_guard lock(mutex_);
  states_[stage] = std::move(state);
  if (checkpoint_.keep) checkpoint_.keep(bytes());
  times_[stage] = Clock::now();
}

bool TrainingStages::is_stopping() const { return checkpoint_.stop && checkpoint_.stop(); }

void TrainingStages::stop_if_asked() const {
  if (is_stopping()) throw TrainingStopped();
}

}  // namespace kinemend
