// Counts the requests of each tab; a run that is no longer the latest one stops.
#include "view_turns.hpp"

#include "kinemend/error.hpp"

namespace kinemend::cli {

void ViewTurns::Turn::check() const {
  if (is_overtaken()) throw Error(ErrorKind::usage, overtaken);
}

ViewTurns::Turn ViewTurns::begin(const std::string& tab, ViewTurn kind) {
  const std::lock_guard lock(mutex_);
  Tab& asking = tabs_[tab];
  Turn turn;
  turn.latest_ = kind == ViewTurn::run ? asking.run : asking.curves;
  turn.ended_ = ended_;
  turn.own_ = ++*turn.latest_;
  // A new run also makes the curves of its tab outdated.
  if (kind == ViewTurn::run) ++*asking.curves;
  return turn;
}

void ViewTurns::leave(const std::string& tab) {
  const std::lock_guard lock(mutex_);
  const auto found = tabs_.find(tab);
  if (found == tabs_.end()) return;
  ++*found->second.run;
  ++*found->second.curves;
  tabs_.erase(found);
}

}  // namespace kinemend::cli
