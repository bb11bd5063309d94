// Names the channels of a layout, checks its rules, and learns a layout from takes: the first take
// decides whether it is one of joints or of markers.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "body/body_anchors.hpp"
#include "body/body_learning.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/body.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace {

constexpr std::array axis_names{"x", "y", "z"};

[[noreturn]] void refuse(const BodyLayout& layout, std::size_t track, std::string_view what) {
  throw Error(ErrorKind::usage, fmt::format("{} {} \"{}\" of the body's layout: {}",
                                            layout.kind == BodyKind::joints ? "joint" : "marker",
                                            track, layout.names[track], what));
}

void check_array(std::string_view array, std::size_t found, std::size_t expected) {
  if (found == expected) return;
  throw Error(ErrorKind::usage,
              fmt::format("the body's layout: expected {} {}, found {}", expected, array, found));
}

void check_joints(const BodyLayout& layout) {
  // Tolerated rounding error of a length of 1.
  constexpr double unit = 1e-6;
  const std::size_t count = layout.track_count();
  check_array("parents", layout.parents.size(), count);
  check_array("references", layout.references.size(), count);
  check_array("bones", layout.bones.size(), count);
  check_array("means", layout.means.size(), 0);
  check_array("anchors", layout.anchors.size(), 0);
  check_array("points of its shape", layout.shape.size(), 0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t parent = layout.parents[i];
    if (i == 0 ? parent != -1 : parent < 0 || parent >= static_cast<std::int32_t>(i))
      refuse(layout, i, fmt::format("parent {} does not precede it", parent));
    if (!(std::fabs(norm(layout.references[i]) - 1) <= unit))
      refuse(layout, i, "the reference is not a unit quaternion");
    const double length = norm(layout.bones[i]);
    if (!(length == 0 || std::fabs(length - 1) <= unit))
      refuse(layout, i, "the bone is neither a unit vector nor zero");
  }
  if (!is_finite(layout.place))
    throw Error(ErrorKind::usage, "the body's layout: the place is not finite");
}

void check_markers(const BodyLayout& layout) {
  const std::size_t count = layout.track_count();
  check_array("parents", layout.parents.size(), 0);
  check_array("references", layout.references.size(), 0);
  check_array("bones", layout.bones.size(), 0);
  check_array("means", layout.means.size(), count);
  check_array("anchors", layout.anchors.size(), count);
  check_array("points of its shape", layout.shape.size(), count);
  std::size_t anchors = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_finite(layout.means[i]) || !is_finite(layout.shape[i]))
      refuse(layout, i, "the mean position is not finite");
    anchors += layout.anchors[i] != 0 ? 1 : 0;
  }
  if (anchors < representation::least_anchors) {
    throw Error(ErrorKind::usage, fmt::format("the body's layout: expected at least {} anchors, "
                                              "found {}",
                                              representation::least_anchors, anchors));
  }
}

}  // namespace

std::string_view to_string(BodyKind kind) {
  return kind == BodyKind::joints ? "joints" : "markers";
}

std::size_t BodyLayout::channel_count() const noexcept {
  return 3 * (track_count() + (kind == BodyKind::joints && with_place ? 1 : 0));
}

std::string BodyLayout::channel_name(std::size_t channel) const {
  const std::size_t track = channel / 3;
  return fmt::format("{} {}", track < track_count() ? names[track] : "place",
                     axis_names[channel % 3]);
}

void BodyLayout::validate() const {
  if (names.empty()) throw Error(ErrorKind::usage, "the body's layout has no parts");
  if (!(trend_s > 0) || !std::isfinite(trend_s))
    throw Error(ErrorKind::usage, fmt::format("the body's layout: trend of {} s", trend_s));
  if (kind == BodyKind::joints) {
    check_joints(*this);
  } else {
    check_markers(*this);
  }
}

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
