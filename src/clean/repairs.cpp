// Interpolates the residuals of measured neighbours for each repaired sample.
#include "clean/repairs.hpp"

#include <algorithm>

namespace kinemend {

namespace {

// Chosen by hand, not swept.
constexpr std::size_t most_neighbours = 8;

// The mean of some residuals at their mean frame.
struct Side {
  double frame = 0;
  Vec3 residual;
  bool found = false;
};

class Neighbours {
 public:
  Neighbours(const std::vector<Evidence>& evidence,
             const std::function<Vec3(std::size_t)>& residual)
      : evidence_(evidence), residual_(residual) {}

  // Uses frames before `end`, the nearest first.
  Side before(std::size_t end) const {
    Sum sum;
    for (std::size_t f = end; f-- > 0 && sum.count < most_neighbours;) add(f, sum);
    return sum.mean();
  }
  Side from(std::size_t begin) const {
    Sum sum;
    for (std::size_t f = begin; f < evidence_.size() && sum.count < most_neighbours; ++f)
      add(f, sum);
    return sum.mean();
  }

 private:
  struct Sum {
    std::size_t count = 0;
    double frames = 0;
    Vec3 residuals;

    Side mean() const {
      if (count == 0) return {};
      const double share = 1 / static_cast<double>(count);
      return {share * frames, share * residuals, true};
    }
  };

  void add(std::size_t frame, Sum& sum) const {
    if (evidence_[frame] != Evidence::measured) return;
    sum.frames += static_cast<double>(frame);
    sum.residuals += residual_(frame);
    ++sum.count;
  }

  const std::vector<Evidence>& evidence_;
  const std::function<Vec3(std::size_t)>& residual_;
};

Vec3 between(const Side& before, const Side& after, double frame) {
  if (!before.found || !after.found) return before.found ? before.residual : after.residual;
  const double share = (frame - before.frame) / (after.frame - before.frame);
  return before.residual + share * (after.residual - before.residual);
}

}  // namespace

std::vector<Evidence> evidence_of(std::size_t frames, const std::vector<std::uint8_t>& observed,
                                  const std::vector<Action>& stated) {
  std::vector<Evidence> evidence(frames, Evidence::measured);
  for (std::size_t f = 0; f < frames; ++f) {
    const Action action = stated.empty() ? Action::kept : stated[f];
    if (action == Action::despiked || action == Action::filled) evidence[f] = Evidence::repaired;
    if (!observed.empty() && observed[f] == 0) evidence[f] = Evidence::missing;
  }
  return evidence;
}

std::vector<Vec3> residuals_of_repaired(const std::vector<Evidence>& evidence,
                                        const std::function<Vec3(std::size_t)>& residual) {
  const std::size_t frames = evidence.size();
  if (std::find(evidence.begin(), evidence.end(), Evidence::repaired) == evidence.end()) return {};
  const Neighbours neighbours(evidence, residual);
  std::vector<Vec3> residuals(frames);
  for (std::size_t f = 0; f < frames;) {
    std::size_t end = f;
    while (end < frames && evidence[end] == Evidence::repaired) ++end;
    if (end == f) {
      ++f;
      continue;
    }
    const Side before = neighbours.before(f), after = neighbours.from(end);
    for (; f < end; ++f) residuals[f] = between(before, after, static_cast<double>(f));
  }
  return residuals;
}

}  // namespace kinemend
