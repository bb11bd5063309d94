// Moves the frames of takes to a spool and back.
#include "learned/core/take_store.hpp"

#include <type_traits>
#include <utility>

namespace kinemend {

namespace {

// All arrays over frames.
template <class Action>
void for_each_array(Clip& clip, const Action& action) {
  action(clip.positions);
  action(clip.rotations);
  action(clip.observed);
  action(clip.observed_positions);
}
template <class Action>
void for_each_array(MarkerClip& clip, const Action& action) {
  action(clip.positions);
  action(clip.observed);
  action(clip.residuals);
}

}  // namespace

void TakeStore::add(std::variant<Clip, MarkerClip> take) {
  const std::size_t first_record = frames_.count();
  std::visit(
      [&](auto& clip) {
        clip.source.document.reset();
        for_each_array(clip, [&]<class Value>(std::vector<Value>& values) {
          static_assert(std::is_trivially_copyable_v<Value>);
          append_values<Value>(frames_, std::exchange(values, {}));
        });
      },
      take);
  takes_.push_back({std::move(take), first_record});
}

std::variant<Clip, MarkerClip> TakeStore::take(std::size_t index) const {
  std::variant<Clip, MarkerClip> take = takes_[index].head;
  std::size_t record = takes_[index].first_record;
  std::visit(
      [&](auto& clip) {
        for_each_array(clip, [&]<class Value>(std::vector<Value>& values) {
          values = read_values<Value>(frames_, record++);
        });
      },
      take);
  return take;
}

}  // namespace kinemend
