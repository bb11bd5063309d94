// Learns a layout of markers: mean positions, the shape of the body, and its anchors.
#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <utility>

#include "base/portable.hpp"
#include "body/body_anchors.hpp"
#include "body/body_frame.hpp"
#include "body/body_learning.hpp"
#include "body/body_names.hpp"
#include "body/body_rest.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "motion/names.hpp"

namespace kinemend::representation {

namespace {

// Markers that are seen rarely, or have no name of their own, are not tracks.
std::vector<std::int32_t> usable_markers(const Take& clip, const std::vector<std::uint8_t>& meant) {
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

// Finds the direction from feet to head by usual marker names, else from the apparent floor.
Quat upright_by_names(const Take& clip) {
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

// Returns the name of the same marker on the other side: "rank" for "lank".
std::string mirrored(std::string name) {
  if (name.starts_with("left")) return "right" + name.substr(4);
  if (name.starts_with('l')) name.front() = 'r';
  return name;
}

// Turns the shape so that its left side is at the left.
void face_ahead(BodyLayout& layout) {
  std::vector<std::string> names;
  for (const std::string& name : layout.names) names.push_back(plain_name(name));
  Vec3 left;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto other = std::find(names.begin(), names.end(), mirrored(names[i]));
    if (!names[i].starts_with('l') || other == names.end()) continue;
    left += layout.shape[i] - layout.shape[static_cast<std::size_t>(other - names.begin())];
  }
  if (left.x == 0 && left.z == 0) return;
  const TurnAboutY turn(portable::atan2(-left.z, left.x));
  for (Vec3& point : layout.shape) point = turn.back(point);
}

std::size_t fullest_frame(const Take& clip, const BodyLayout& layout,
                          const std::vector<std::int32_t>& markers) {
  std::size_t best = 0, most = 0;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    std::size_t seen = 0;
    for (std::size_t i = 0; i < markers.size(); ++i) {
      const auto marker = static_cast<std::size_t>(markers[i]);
      seen += layout.anchors[i] != 0 && clip.is_observed(f, marker) ? 1 : 0;
    }
    if (seen <= most) continue;
    most = seen;
    best = f;
  }
  return best;
}

}  // namespace

MarkerLearning::MarkerLearning(std::vector<std::string> patterns, double trend_s)
    : patterns_(std::move(patterns)) {
  layout_.kind = BodyKind::markers;
  layout_.with_place = false;
  layout_.trend_s = trend_s;
}

void MarkerLearning::sum_distances(const Take& clip, const BodyMatch& match) {
  // Frames are evenly spread, for speed; not swept.
  constexpr std::size_t most_frames = 256;
  const std::size_t count = tracks_.size(), frames = clip.frame_count();
  const std::size_t sampled = std::min(frames, most_frames);
  for (std::size_t s = 0; s < sampled; ++s) {
    const std::size_t f = s * frames / sampled;
    for (std::size_t i = 0; i < count; ++i) {
      const auto a = static_cast<std::size_t>(match.tracks[i]);
      if (match.tracks[i] < 0 || !clip.is_observed(f, a)) continue;
      for (std::size_t k = i + 1; k < count; ++k) {
        const auto b = static_cast<std::size_t>(match.tracks[k]);
        if (match.tracks[k] < 0 || !clip.is_observed(f, b)) continue;
        const double d = norm(clip.position(f, a) - clip.position(f, b)) / match.body_height;
        Distance& distance = distances_[i * count + k];
        distance.sum += d;
        distance.square_sum += d * d;
        ++distance.samples;
      }
    }
  }
}

// Returns how much the distances between a track and others vary: the variance below which three in
// ten of them stay. Near markers weigh less, because the markers of a hand are steady among
// themselves.
double MarkerLearning::unsteadiness(std::size_t track) const {
  // The distance at which a neighbour has full weight, and the share of the neighbours
  // (docs/details/bodies.md, "Anchors"). Chosen by hand, not swept.
  constexpr double far = 0.15;  // body heights
  constexpr double share_of_others = 0.3;
  const std::size_t count = tracks_.size();
  std::vector<std::pair<double, double>> others;  // variance, weight
  double total = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (k == track) continue;
    const Distance& distance = distances_[std::min(track, k) * count + std::max(track, k)];
    if (distance.samples == 0) continue;
    const double share = 1 / static_cast<double>(distance.samples);
    const double mean = share * distance.sum;
    const double weight = std::min(mean / far, 1.0);
    others.emplace_back(share * distance.square_sum - mean * mean, weight);
    total += weight;
  }
  std::sort(others.begin(), others.end());
  double passed = 0;
  for (const auto& [variance, weight] : others) {
    passed += weight;
    if (passed >= share_of_others * total) return variance;
  }
  return std::numeric_limits<double>::infinity();
}

// Chooses the steadiest third of the tracks, at least four, as anchors.
void MarkerLearning::choose_anchors() {
  // Chosen by hand, not swept.
  constexpr std::size_t least = 4;
  const std::size_t count = tracks_.size();
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < count; ++i) order.emplace_back(unsteadiness(i), i);
  std::sort(order.begin(), order.end());
  layout_.anchors.assign(count, 0);
  for (std::size_t k = 0; k < std::min(count, std::max(least, count / 3)); ++k)
    layout_.anchors[order[k].second] = 1;
}

void MarkerLearning::sum_shape(const Take& clip, const BodyMatch& match) {
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const auto fit = fit_frame(clip, layout_, match, f);
    if (!fit) continue;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const auto marker = static_cast<std::size_t>(match.tracks[i]);
      if (match.tracks[i] < 0 || !clip.is_observed(f, marker)) continue;
      const Vec3 p = (1 / match.body_height) *
                     fit->expected_at(upright_position(clip, match.upright, f, marker));
      tracks_[i].shape_sum += p;
      ++tracks_[i].shaped;
    }
  }
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (tracks_[i].shaped > 0)
      layout_.shape[i] = (1 / static_cast<double>(tracks_[i].shaped)) * tracks_[i].shape_sum;
  }
}

void MarkerLearning::sum_means(const Take& clip, const BodyMatch& match) {
  BodyChannels frame;
  follow_anchors(clip, layout_, match, floor_height(clip, layout_, match), frame);
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (match.tracks[i] < 0) continue;
    const auto marker = static_cast<std::size_t>(match.tracks[i]);
    ++tracks_[i].takes;
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      if (!clip.is_observed(f, marker)) continue;
      tracks_[i].mean_sum +=
          (1 / match.body_height) *
          TurnAboutY(frame.headings[f])
              .back(upright_position(clip, match.upright, f, marker) - frame.places[f]);
      ++tracks_[i].samples;
    }
    if (tracks_[i].samples > 0)
      layout_.means[i] = (1 / static_cast<double>(tracks_[i].samples)) * tracks_[i].mean_sum;
  }
}

// Turns the shape so that it is upright on average, faces ahead and is centred on its anchors.
void MarkerLearning::stand_upright(const Take& clip, const BodyMatch& match) {
  Vec3 up;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    if (const auto fit = fit_frame(clip, layout_, match, f))
      up += rotate(conjugate(fit->rotation), {0, 1, 0});
  }
  const double length = norm(up);
  if (length > 0) {
    const Quat turn = shortest_rotation((1 / length) * up, {0, 1, 0});
    for (Vec3& point : layout_.shape) point = rotate(turn, point);
  }
  face_ahead(layout_);
  Vec3 centre;
  int anchors = 0;
  for (std::size_t i = 0; i < layout_.track_count(); ++i) {
    if (layout_.anchors[i] == 0) continue;
    centre += layout_.shape[i];
    ++anchors;
  }
  for (Vec3& point : layout_.shape) point = point - (1.0 / anchors) * centre;
}

// Learns the shape of the first take, beginning with the frame in which most anchors are seen.
BodyMatch MarkerLearning::start(const Take& clip) {
  // The alternations of fitting the shape to frames and updating it. Not swept.
  constexpr int rounds = 4;
  BodyMatch match;
  match.tracks = usable_markers(clip, names_meant(clip.names, patterns_, "marker"));
  const std::size_t count = match.tracks.size();
  if (count < 3)
    throw Error(ErrorKind::usage, "fewer than three markers are seen in half of the frames");
  match.upright = upright_by_names(clip);
  match.body_height = body_height(clip);
  match.feet = match.tracks;
  tracks_.resize(count);
  distances_.resize(count * count);
  layout_.means.resize(count);
  for (const std::int32_t marker : match.tracks)
    layout_.names.emplace_back(without_subject(clip.names[static_cast<std::size_t>(marker)]));
  sum_distances(clip, match);
  choose_anchors();
  const std::size_t best = fullest_frame(clip, layout_, match.tracks);
  std::vector<std::uint8_t> anchors(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto marker = static_cast<std::size_t>(match.tracks[i]);
    layout_.shape.push_back((1 / match.body_height) *
                            upright_position(clip, match.upright, best, marker));
    anchors[i] = clip.is_observed(best, marker) ? layout_.anchors[i] : 0;
  }
  // Anchors not seen in that frame are first placed by the others.
  std::swap(anchors, layout_.anchors);
  for (int round = 0; round < rounds; ++round) {
    tracks_.assign(count, {});
    sum_shape(clip, match);
    layout_.anchors = anchors;
  }
  stand_upright(clip, match);
  tracks_.assign(count, {});
  return match;
}

void MarkerLearning::add(const Take& clip) {
  const bool first = takes_ == 0;
  const BodyMatch match = first ? start(clip) : match_body(layout_, clip);
  sum_means(clip, match);
  sum_shape(clip, match);
  if (!first) {
    sum_distances(clip, match);
    choose_anchors();
  }
  ++takes_;
}

BodyLayout MarkerLearning::finish() const {
  BodyLayout layout;
  layout.kind = BodyKind::markers;
  layout.with_place = false;
  layout.trend_s = layout_.trend_s;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (2 * tracks_[i].takes < takes_) continue;
    layout.names.push_back(layout_.names[i]);
    layout.means.push_back(layout_.means[i]);
    layout.anchors.push_back(layout_.anchors[i]);
    layout.shape.push_back(layout_.shape[i]);
  }
  return layout;
}

}  // namespace kinemend::representation
