// Learns a layout from takes: the first take decides whether it is one of joints or of markers.
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "body/body_learning.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/body.hpp"

namespace kinemend {

struct BodyLayoutBuilder::State {
  std::vector<std::string> names;
  double trend_s = 0;
  std::variant<std::monostate, representation::JointLearning, representation::MarkerLearning>
      learning;

  // The data learned from takes of one kind; the first take decides the kind.
  template <class Learning>
  Learning& of_kind(BodyKind kind) {
    if (std::holds_alternative<std::monostate>(learning))
      learning.emplace<Learning>(names, trend_s);
    if (auto* const known = std::get_if<Learning>(&learning)) return *known;
    throw Error(ErrorKind::usage,
                fmt::format("takes of different kinds: one holds {}, those before it do not",
                            to_string(kind)));
  }
};

BodyLayoutBuilder::BodyLayoutBuilder(std::vector<std::string> names, double trend_s)
    : state_(std::make_unique<State>()) {
  if (!(trend_s > 0) || !std::isfinite(trend_s))
    throw Error(ErrorKind::usage, fmt::format("a trend of {} s is not positive", trend_s));
  state_->names = std::move(names);
  state_->trend_s = trend_s;
}

BodyLayoutBuilder::~BodyLayoutBuilder() = default;
BodyLayoutBuilder::BodyLayoutBuilder(BodyLayoutBuilder&&) noexcept = default;

void BodyLayoutBuilder::add(const Take& take) {
  if (take.has_joints()) {
    state_->of_kind<representation::JointLearning>(BodyKind::joints).add(take);
  } else {
    state_->of_kind<representation::MarkerLearning>(BodyKind::markers).add(take);
  }
}

BodyLayout BodyLayoutBuilder::finish() const {
  BodyLayout layout = std::visit(
      [](const auto& learning) -> BodyLayout {
        if constexpr (std::is_same_v<std::decay_t<decltype(learning)>, std::monostate>)
          throw Error(ErrorKind::usage, "no takes to learn from");
        else
          return learning.finish();
      },
      state_->learning);
  layout.validate();
  return layout;
}

}  // namespace kinemend
