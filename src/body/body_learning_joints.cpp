// Learns a layout of joints: which joints turn, their mean rotations, and the usual place of the
// root.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "body/body_frame.hpp"
#include "body/body_learning.hpp"
#include "body/body_rest.hpp"
#include "kinemend/error.hpp"
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

}  // namespace kinemend::representation
