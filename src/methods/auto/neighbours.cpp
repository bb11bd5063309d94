// Finds neighbours by the skeleton or, for markers, by distances that hardly change.
#include "methods/auto/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.hpp"
#include "base/quantiles.hpp"
#include "methods/auto/spikes.hpp"

namespace kinemend {

namespace {

std::vector<std::vector<std::size_t>> rigid_neighbours(const TakeView& take,
                                                       const std::vector<std::size_t>& markers) {
  // Frames used, evenly over the take, for speed; frames that two markers must share; neighbours
  // kept. All are chosen by hand, not swept.
  constexpr std::size_t most_frames = 50, least_frames = 10, most_neighbours = 4;
  constexpr double farthest = 0.3, largest_spread = 0.02;  // body heights
  const Take& clip = *take.markers;
  const std::size_t frames = take.frames, sampled = std::min(frames, most_frames);
  std::vector<std::vector<std::size_t>> result(markers.size());
  for_each_parallel(markers.size(), markers.size() * markers.size() * sampled, [&](std::size_t n) {
    std::vector<std::pair<double, std::size_t>> near;
    std::vector<double> distances;
    for (std::size_t other = 0; other < markers.size(); ++other) {
      if (other == n) continue;
      distances.clear();
      for (std::size_t i = 0; i < sampled; ++i) {
        const std::size_t f = sampled < 2 ? 0 : i * (frames - 1) / (sampled - 1);
        if (clip.is_observed(f, markers[n]) && clip.is_observed(f, markers[other]))
          distances.push_back(
              norm(clip.position(f, markers[n]) - clip.position(f, markers[other])));
      }
      if (distances.size() < std::min(least_frames, sampled) || distances.empty()) continue;
      const double usual = upper_median_of(distances);
      if (usual > farthest * take.body_height) continue;
      for (double& distance : distances) distance = std::fabs(distance - usual);
      if (upper_median_of(distances) < largest_spread * take.body_height)
        near.emplace_back(usual, other);
    }
    std::sort(near.begin(), near.end());
    for (std::size_t i = 0; i < std::min(near.size(), most_neighbours); ++i)
      result[n].push_back(near[i].second);
  });
  return result;
}

std::vector<std::vector<std::size_t>> joint_neighbours(const Skeleton& skeleton,
                                                       const std::vector<std::size_t>& joints) {
  const auto joints_near = joints_nearby(skeleton.parents);
  std::vector<std::vector<std::size_t>> result(joints.size());
  for (std::size_t n = 0; n < joints.size(); ++n) {
    for (const std::size_t other : joints_near[joints[n]]) {
      const auto found = std::lower_bound(joints.begin(), joints.end(), other);
      if (found != joints.end() && *found == other)
        result[n].push_back(static_cast<std::size_t>(found - joints.begin()));
    }
  }
  return result;
}

}  // namespace

std::vector<std::vector<std::size_t>> tracks_nearby(const TakeView& take,
                                                    const std::vector<std::size_t>& tracks) {
  if (take.markers) return rigid_neighbours(take, tracks);
  if (tracks.empty() || take.tracks[tracks.front()].space == Space::position)
    return std::vector<std::vector<std::size_t>>(tracks.size());
  return joint_neighbours(take.joints->skeleton, tracks);
}

}  // namespace kinemend
