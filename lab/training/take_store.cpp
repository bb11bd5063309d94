// Moves the frames of takes to a spool and back.
#include "lab/training/take_store.hpp"

#include <type_traits>
#include <utility>

namespace kinemend {

namespace {

// All arrays over frames.
template <class Action>
void for_each_array(Take& take, const Action& action) {
  action(take.positions);
  action(take.rotations);
  action(take.observed);
  action(take.observed_positions);
  action(take.residuals);
}

}  // namespace

void TakeStore::add(Take take) {
  const std::size_t first_record = frames_.count();
  take.source.document.reset();
  for_each_array(take, [&]<class Value>(std::vector<Value>& values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    append_values<Value>(frames_, std::exchange(values, {}));
  });
  takes_.push_back({std::move(take), first_record});
}

Take TakeStore::take(std::size_t index) const {
  Take take = takes_[index].head;
  std::size_t record = takes_[index].first_record;
  for_each_array(take, [&]<class Value>(std::vector<Value>& values) {
    values = read_values<Value>(frames_, record++);
  });
  return take;
}

}  // namespace kinemend
