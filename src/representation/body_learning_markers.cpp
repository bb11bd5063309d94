#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numeric>
#include <utility>

#include "kinemend/convert.hpp"
#include "kinemend/error.hpp"
#include "representation/body_anchors.hpp"
#include "representation/body_frame.hpp"
#include "representation/body_learning.hpp"
#include "representation/body_names.hpp"
#include "representation/body_rest.hpp"

namespace kinemend::representation {

namespace {

// Markers that are seen now and then only, or have no name of their own, are no parts.
std::vector<std::int32_t> usable_markers(const MarkerClip& clip,
                                         const std::vector<std::uint8_t>& meant) {
  std::vector<std::int32_t> usable;
  std::vector<std::string> taken;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    const std::string name = plain_name(clip.names[m]);
    if (meant[m] == 0 || !clip.holds_positions(m) || name.empty() || clip.names[m].starts_with('*'))
      continue;
    std::size_t seen = 0;
    for (std::size_t f = 0; f < clip.frame_count(); ++f) seen += clip.is_observed(f, m) ? 1 : 0;
    if (2 * seen < clip.frame_count() || seen == 0 ||
        std::find(taken.begin(), taken.end(), name) != taken.end())
      continue;
    taken.push_back(name);
    usable.push_back(static_cast<std::int32_t>(m));
  }
  return usable;
}

bool names_any(std::string_view name, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return name.find(word) != name.npos; });
}

// From feet to head by their usual names, else where the floor seems to be.
Quat upright_by_names(const MarkerClip& clip) {
  std::vector<std::size_t> high, low;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    const std::string name = plain_name(clip.names[m]);
    if (!clip.holds_positions(m)) continue;
    if (names_any(name, {"head", "fhd", "bhd"})) high.push_back(m);
    if (names_any(name, {"toe", "hee", "ank", "foot"})) low.push_back(m);
  }
  Vec3 sum;
  double length = 0;
  for (std::size_t f = 0; f < clip.frame_count(); f += 1 + clip.frame_count() / 64) {
    for (const std::size_t h : high) {
      for (const std::size_t l : low) {
        if (!clip.is_observed(f, h) || !clip.is_observed(f, l)) continue;
        const Vec3 up = clip.position(f, h) - clip.position(f, l);
        sum += up;
        length += norm(up);
      }
    }
  }
  if (norm(sum) > 0.5 * length && length > 0)
    return shortest_rotation(nearest_axis(sum), {0, 1, 0});
  const Axis axis = guess_up_axis(clip);
  return shortest_rotation(
      {axis == Axis::x ? 1.0 : 0.0, axis == Axis::y ? 1.0 : 0.0, axis == Axis::z ? 1.0 : 0.0},
      {0, 1, 0});
}

// The name of the same marker on the other side: "rank" for "lank".
std::string mirrored(std::string name) {
  if (name.starts_with("left")) return "right" + name.substr(4);
  if (name.starts_with('l')) name.front() = 'r';
  return name;
}

// Turns the means so that left is left.
void face_ahead(BodyLayout& layout) {
  std::vector<std::string> names;
  for (const std::string& name : layout.names) names.push_back(plain_name(name));
  Vec3 left;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto other = std::find(names.begin(), names.end(), mirrored(names[i]));
    if (!names[i].starts_with('l') || other == names.end()) continue;
    left += layout.means[i] - layout.means[static_cast<std::size_t>(other - names.begin())];
  }
  if (left.x == 0 && left.z == 0) return;
  const TurnAboutY turn(std::atan2(-left.z, left.x));
  for (Vec3& mean : layout.means) mean = turn.back(mean);
}

}  // namespace

MarkerLearning::MarkerLearning(std::vector<std::string> patterns, double trend_s)
    : patterns_(std::move(patterns)) {
  layout_.kind = BodyKind::markers;
  layout_.with_place = false;
  layout_.trend_s = trend_s;
}

// The steadiest third, at least four.
void MarkerLearning::choose_anchors() {
  constexpr std::size_t least = 4;
  const std::size_t count = parts_.size();
  std::vector<double> variances(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Part& part = parts_[i];
    const double share = 1 / static_cast<double>(std::max<std::size_t>(part.samples, 1));
    const Vec3 mean = share * part.sum, square = share * part.sum_of_squares;
    variances[i] = square.x - mean.x * mean.x + square.z - mean.z * mean.z;
    if (part.samples > 0) layout_.means[i] = mean;
  }
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return variances[a] < variances[b]; });
  layout_.anchors.assign(count, 0);
  for (std::size_t k = 0; k < std::min(count, std::max(least, count / 3)); ++k)
    layout_.anchors[order[k]] = 1;
}

void MarkerLearning::sum_up(const MarkerClip& clip, const BodyMatch& match) {
  BodyChannels frame;
  follow_anchors(clip, layout_, match, floor_height(clip, layout_, match), frame);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (match.parts[i] < 0) continue;
    const auto marker = static_cast<std::size_t>(match.parts[i]);
    ++parts_[i].takes;
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      if (!clip.is_observed(f, marker)) continue;
      const Vec3 p = (1 / match.stature) *
                     TurnAboutY(frame.headings[f])
                         .back(upright_position(clip, match.upright, f, marker) - frame.places[f]);
      parts_[i].sum += p;
      parts_[i].sum_of_squares += Vec3{p.x * p.x, p.y * p.y, p.z * p.z};
      ++parts_[i].samples;
    }
  }
}

// The shape of the first take: all markers are anchors first, then the steadiest ones of the round
// before.
BodyMatch MarkerLearning::start(const MarkerClip& clip) {
  constexpr int rounds = 4;
  BodyMatch match;
  match.parts = usable_markers(clip, names_meant(clip.names, patterns_, "marker"));
  if (match.parts.size() < 3)
    throw Error(ErrorKind::usage, "fewer than three markers are seen in half of the frames");
  match.upright = upright_by_names(clip);
  match.stature = body_height(clip);
  match.feet = match.parts;
  const double floor = low_level(clip, match.upright, match.parts);
  // The frame in which most is seen is the first guess.
  std::size_t best = 0, most = 0;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const auto seen = static_cast<std::size_t>(std::count_if(
        match.parts.begin(), match.parts.end(),
        [&](std::int32_t m) { return clip.is_observed(f, static_cast<std::size_t>(m)); }));
    if (seen > most) {
      most = seen;
      best = f;
    }
  }
  for (const std::int32_t index : match.parts) {
    const auto marker = static_cast<std::size_t>(index);
    layout_.names.emplace_back(without_subject(clip.names[marker]));
    Vec3 p = upright_position(clip, match.upright, best, marker);
    p.y -= floor;
    layout_.means.push_back((1 / match.stature) * p);
    layout_.anchors.push_back(clip.is_observed(best, marker) ? 1 : 0);
  }
  for (int round = 0; round < rounds; ++round) {
    parts_.assign(match.parts.size(), {});
    sum_up(clip, match);
    choose_anchors();
  }
  face_ahead(layout_);
  parts_.assign(match.parts.size(), {});
  return match;
}

void MarkerLearning::add(const MarkerClip& clip) {
  const BodyMatch match = takes_ == 0 ? start(clip) : match_body(layout_, clip);
  sum_up(clip, match);
  choose_anchors();
  ++takes_;
}

BodyLayout MarkerLearning::finish() const {
  BodyLayout layout;
  layout.kind = BodyKind::markers;
  layout.with_place = false;
  layout.trend_s = layout_.trend_s;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (2 * parts_[i].takes < takes_) continue;
    layout.names.push_back(layout_.names[i]);
    layout.means.push_back(layout_.means[i]);
    layout.anchors.push_back(layout_.anchors[i]);
  }
  return layout;
}

}  // namespace kinemend::representation
