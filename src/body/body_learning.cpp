// Learns layouts: for joints which of them turn, their mean rotations, and the usual place of the
// root; for markers their mean positions, the shape of the body, and its anchors.
#include "body/body_learning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <memory>
#include <utility>

#include "base/frame_span.hpp"
#include "base/portable.hpp"
#include "body/body_anchors.hpp"
#include "body/body_frame.hpp"
#include "body/body_names.hpp"
#include "body/body_rest.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "motion/names.hpp"
#include "motion/rotation.hpp"
#include "motion/take.hpp"

namespace kinemend::representation {

namespace {

bool moves(const Take& clip, std::size_t joint) {
  // Radians; a smaller turn is rounding.
  constexpr double least = 1e-3;
  for (std::size_t f = 1; f < clip.frame_count(); ++f) {
    if (clip.is_observed(f, joint) &&
        angle_between(clip.rotation(0, joint), clip.rotation(f, joint)) > least)
      return true;
  }
  if (joint > 0) return point_of_joint(clip, joint).has_value();
  for (std::size_t f = 1; f < clip.frame_count(); ++f) {
    if (clip.root_position(f) != clip.root_position(0)) return true;
  }
  return false;
}

// Finds the body's root; joints that only carry the hips do not belong to the body.
std::size_t body_root(const Take& clip) {
  std::size_t root = 0;
  while (!moves(clip, root)) {
    const auto is_child = [&](std::int32_t parent) {
      return parent == static_cast<std::int32_t>(root);
    };
    const auto& parents = clip.skeleton.parents;
    if (std::count_if(parents.begin(), parents.end(), is_child) != 1) break;
    root = static_cast<std::size_t>(std::find_if(parents.begin(), parents.end(), is_child) -
                                    parents.begin());
  }
  return root;
}

Vec3 lower(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }

class JointLearning : public BodyLearning {
 public:
  JointLearning(std::vector<std::string> patterns, double trend_s)
      : patterns_(std::move(patterns)) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    layout_.kind = BodyKind::joints;
    layout_.trend_s = trend_s;
    place_low_ = {infinity, infinity, infinity};
    place_high_ = -place_low_;
  }

  void add(const Take& clip) override {
    if (takes_ == 0) start(clip);
    const BodyMatch match = match_body(layout_, clip);
    BodyChannels channels;
    const RootMotion root = root_motion(clip, match);
    follow_root(clip, layout_, match, root, channels);
    for (std::size_t track = 0; track < tracks_.size(); ++track) {
      if (match.tracks[track] >= 0)
        add_rotations(clip, match, track, track_rotations(clip, match, root, channels, track));
    }
    const std::size_t track = root_track(clip, match);
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      if (!clip.is_position_observed(f, track)) continue;
      const Vec3 p = (1 / match.body_height) * rotate(exp({0, -channels.headings[f], 0}),
                                                      root.positions[f] - channels.places[f]);
      place_sum_ += p;
      place_low_ = lower(place_low_, p);
      place_high_ = -lower(-place_high_, -p);
      ++places_;
    }
    ++takes_;
  }

  BodyLayout finish() const override {
    // Joints that move less do not belong to the body. Chosen by hand, not swept.
    constexpr double least_turn = 0.1 * radians_per_degree;
    constexpr double least_travel = 1e-5;  // body heights
    BodyLayout layout;
    layout.kind = BodyKind::joints;
    layout.trend_s = layout_.trend_s;
    std::vector<std::int32_t> kept_at;  // new index of a track or of the one it was attached to
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const Track& track = tracks_[i];
      const std::int32_t parent = layout_.parents[i];
      const std::int32_t above = parent < 0 ? -1 : kept_at[static_cast<std::size_t>(parent)];
      kept_at.push_back(above);
      if (i > 0 && (track.largest_turn < least_turn || 2 * track.takes < takes_)) continue;
      kept_at.back() = static_cast<std::int32_t>(layout.names.size());
      layout.names.push_back(layout_.names[i]);
      layout.parents.push_back(above);
      layout.bones.push_back(layout_.bones[i]);
      layout.references.push_back(rotation::leading_eigenvector(track.moment, track.first));
    }
    const Vec3 travel = place_high_ - place_low_;
    layout.with_place = places_ > 0 && norm(travel) > least_travel;
    if (places_ > 0) layout.place = (1 / static_cast<double>(places_)) * place_sum_;
    const bool still = layout.track_count() == 1 && tracks_[0].largest_turn < least_turn;
    if (still && !layout.with_place)
      throw Error(ErrorKind::usage, "nothing moves in the takes to learn from");
    return layout;
  }

 private:
  struct Track {
    rotation::Matrix4 moment{};  // sum of q q^T
    Quat first;
    double largest_turn = 0;  // from the first, radians
    std::size_t samples = 0, takes = 0;
  };

  void start(const Take& clip) {
    const Skeleton& skeleton = clip.skeleton;
    const std::size_t root = body_root(clip);
    const auto meant = names_meant(skeleton.names, patterns_, "joint");
    // The track of a joint, or the one it is attached to; -1 outside the body.
    std::vector<std::int32_t> track_at(clip.joint_count(), -1), tracks;
    for (std::size_t j = root; j < clip.joint_count(); ++j) {
      const std::int32_t above = j == root || skeleton.parents[j] < 0
                                     ? -1
                                     : track_at[static_cast<std::size_t>(skeleton.parents[j])];
      track_at[j] = above;
      if (j != root && (above < 0 || meant[j] == 0 || skeleton.rotation_order(j).count == 0))
        continue;
      track_at[j] = static_cast<std::int32_t>(tracks.size());
      tracks.push_back(static_cast<std::int32_t>(j));
      layout_.names.push_back(skeleton.names[j]);
      layout_.parents.push_back(above);
    }
    layout_.references.assign(tracks.size(), {});
    layout_.bones.assign(tracks.size(), {});
    layout_.bones =
        bone_directions(layout_, clip, rest_pose(clip, bone_names(skeleton.names)), tracks);
    tracks_.resize(tracks.size());
  }

  void add_rotations(const Take& clip, const BodyMatch& match, std::size_t track,
                     const std::vector<Quat>& rotations) {
    Track& sums = tracks_[track];
    const auto joint = static_cast<std::size_t>(match.tracks[track]);
    for (std::size_t f = 0; f < rotations.size(); ++f) {
      if (!clip.is_observed(f, joint)) continue;
      const Quat q = normalized(rotations[f]);
      if (sums.samples++ == 0) sums.first = q;
      sums.largest_turn = std::max(sums.largest_turn, angle_between(sums.first, q));
      const std::array<double, 4> values{q.w, q.x, q.y, q.z};
      for (std::size_t r = 0; r < 4; ++r) {
        for (std::size_t c = 0; c < 4; ++c) sums.moment[r][c] += values[r] * values[c];
      }
    }
    ++sums.takes;
  }

  std::vector<std::string> patterns_;
  BodyLayout layout_;  // all tracks that may turn; references are identity, the place is the floor
  std::vector<Track> tracks_;
  Vec3 place_sum_, place_low_, place_high_;
  std::size_t places_ = 0, takes_ = 0;
};

}  // namespace

std::unique_ptr<BodyLearning> learn_joints(std::vector<std::string> patterns, double trend_s) {
  return std::make_unique<JointLearning>(std::move(patterns), trend_s);
}

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

class MarkerLearning : public BodyLearning {
 public:
  MarkerLearning(std::vector<std::string> patterns, double trend_s)
      : patterns_(std::move(patterns)) {
    layout_.kind = BodyKind::markers;
    layout_.with_place = false;
    layout_.trend_s = trend_s;
  }

  void add(const Take& clip) override {
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

  BodyLayout finish() const override {
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

 private:
  struct Track {
    Vec3 mean_sum;   // of positions in the body's frame, body heights
    Vec3 shape_sum;  // in a frame that leans with the anchors
    std::size_t samples = 0, shaped = 0, takes = 0;
  };
  struct Distance {  // between two tracks, body heights
    double sum = 0, square_sum = 0;
    std::size_t samples = 0;
  };

  void sum_distances(const Take& clip, const BodyMatch& match) {
    // Frames are evenly spread, for speed; not swept.
    constexpr std::size_t most_frames = 256;
    const std::size_t count = tracks_.size();
    for (const std::size_t f : evenly_spread(clip.frame_count(), most_frames)) {
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

  // Returns how much the distances between a track and others vary: the variance below which three
  // in ten of them stay. Near markers weigh less, because the markers of a hand are steady among
  // themselves.
  double unsteadiness(std::size_t track) const {
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
  void choose_anchors() {
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

  void sum_shape(const Take& clip, const BodyMatch& match) {
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

  void sum_means(const Take& clip, const BodyMatch& match) {
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
  void stand_upright(const Take& clip, const BodyMatch& match) {
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
  BodyMatch start(const Take& clip) {
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

  std::vector<std::string> patterns_;
  BodyLayout layout_;  // the part known so far
  std::vector<Track> tracks_;
  std::vector<Distance> distances_;  // N x N, from a track to later ones
  std::size_t takes_ = 0;
};

}  // namespace

std::unique_ptr<BodyLearning> learn_markers(std::vector<std::string> patterns, double trend_s) {
  return std::make_unique<MarkerLearning>(std::move(patterns), trend_s);
}

}  // namespace kinemend::representation
