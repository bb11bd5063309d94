// Links the pairs of markers whose distance is short and steady, until all groups are connected.
#include "report/page/links.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "base/quantiles.hpp"

namespace kinemend::page {

namespace {

// For speed, not swept.
constexpr std::size_t most_frames = 120, fewest_frames = 24;
// The most distances measured, whatever the number of markers. For speed, not swept.
constexpr std::size_t most_distances = 4'000'000;
constexpr std::size_t most_markers = 1000;
// Share of the frames looked at in which both markers must be observed. Chosen by hand, not swept.
constexpr double least_together = 0.2;
// Limits of a line: its length as a share of the body height, and the variation of the distance as
// a share of itself. Chosen by hand, not swept.
constexpr double longest_line = 0.4, largest_change = 0.35;
// The cost of distance relative to that of variation; on a rigid body it prefers neighbours. Chosen
// by hand, not swept.
constexpr double weight_of_length = 0.25;

struct Candidate {
  double cost;
  std::size_t a, b;
};

// Sets of markers that are already connected.
class Groups {
 public:
  explicit Groups(std::size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
  }
  // Returns false if both are already in one group.
  bool join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    parents_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::size_t root(std::size_t marker) {
    while (parents_[marker] != marker) marker = parents_[marker] = parents_[parents_[marker]];
    return marker;
  }
  std::vector<std::size_t> parents_;
};

std::vector<std::size_t> linked_markers(const Take& clip) {
  std::vector<std::size_t> markers;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    // A name with a star is a piece of an unlabelled trajectory.
    if (clip.holds_positions(m) && !clip.names[m].starts_with('*')) markers.push_back(m);
  }
  return markers;
}

std::vector<std::size_t> frames_to_look_at(std::size_t frames, std::size_t markers) {
  const std::size_t pairs = std::max<std::size_t>(1, markers * (markers - 1) / 2);
  const std::size_t count =
      std::min(frames, std::clamp(most_distances / pairs, fewest_frames, most_frames));
  std::vector<std::size_t> looked_at(count);
  for (std::size_t i = 0; i < count; ++i) looked_at[i] = i * frames / count;
  return looked_at;
}

}  // namespace

std::vector<std::array<std::size_t, 2>> marker_links(const Take& clip, double body_height) {
  const std::vector<std::size_t> markers = linked_markers(clip);
  if (markers.size() < 2 || markers.size() > most_markers) return {};
  const std::vector<std::size_t> frames = frames_to_look_at(clip.frame_count(), markers.size());
  const auto fewest = std::max<std::size_t>(
      1, static_cast<std::size_t>(least_together * static_cast<double>(frames.size())));
  std::vector<Candidate> candidates;
  std::vector<double> distances;
  for (std::size_t i = 0; i < markers.size(); ++i) {
    for (std::size_t k = i + 1; k < markers.size(); ++k) {
      const std::size_t a = markers[i], b = markers[k];
      distances.clear();
      for (const std::size_t f : frames) {
        if (clip.is_observed(f, a) && clip.is_observed(f, b))
          distances.push_back(norm(clip.position(f, a) - clip.position(f, b)));
      }
      if (distances.size() < fewest) continue;
      // Quantiles ignore swaps and spikes.
      const double usual = quantile_of(distances, 0.5);
      const double change = quantile_of(distances, 0.9) - quantile_of(distances, 0.1);
      if (!(usual > 0) || usual > longest_line * body_height || change > largest_change * usual)
        continue;
      candidates.push_back({change + weight_of_length * usual, a, b});
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& x, const Candidate& y) {
    return std::tie(x.cost, x.a, x.b) < std::tie(y.cost, y.a, y.b);
  });
  Groups groups(clip.marker_count());
  std::vector<std::array<std::size_t, 2>> links;
  for (const Candidate& candidate : candidates) {
    if (groups.join(candidate.a, candidate.b)) links.push_back({candidate.a, candidate.b});
  }
  return links;
}

}  // namespace kinemend::page
