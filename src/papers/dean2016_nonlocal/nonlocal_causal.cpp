// Keeps the last poses and their distances, and averages each new pose with similar ones.
#include "papers/dean2016_nonlocal/nonlocal_causal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "kinemend/rotation.hpp"

namespace kinemend {

namespace {

// The noise of the frames so far, from second differences of whole poses: their median over frames
// ignores the few frames with a jump.
class RunningNoise {
 public:
  // Sum over joints of the squared second difference of three successive poses.
  void add(double squared_difference, std::size_t joints) {
    // The mean is 3 channels x 6 noise^2 a joint; the median of a chi-square distribution of n
    // degrees is about n (1 - 2 / (9 n))^3.
    const double degrees = 3 * static_cast<double>(joints);
    const double median_share = portable::pow(1 - 2 / (9 * degrees), 3);
    values_[count_++ % most_frames] = squared_difference / (6 * degrees * median_share);
  }
  bool known() const { return count_ >= least_frames; }
  double variance() {
    sorted_.assign(values_.begin(),
                   values_.begin() + static_cast<std::ptrdiff_t>(std::min(count_, most_frames)));
    return upper_median_of(sorted_);
  }

 private:
  // Fewest frames before the noise is known, and the number over which it is measured. Chosen by
  // hand, not swept.
  static constexpr std::size_t least_frames = 8;
  static constexpr std::size_t most_frames = 256;
  std::size_t count_ = 0;
  std::vector<double> values_ = std::vector<double>(most_frames);  // a ring
  std::vector<double> sorted_;
};

// A ring of the last items, the newest first. Their memory is reused.
template <class T>
class Latest {
 public:
  explicit Latest(std::size_t most) : things_(most) {}
  std::size_t size() const { return std::min(count_, things_.size()); }
  // Returns a place for a new item, overwriting the oldest.
  T& add() { return things_[count_++ % things_.size()]; }
  // 0 is the newest.
  T& operator[](std::size_t age) { return things_[(count_ - 1 - age) % things_.size()]; }
  const T& operator[](std::size_t age) const {
    return things_[(count_ - 1 - age) % things_.size()];
  }

 private:
  std::vector<T> things_;
  std::size_t count_ = 0;
};

class CausalNonlocal final : public LiveFilter {
 public:
  CausalNonlocal(const CausalNonlocalSettings& settings, std::vector<std::size_t> joints)
      : settings_(settings),
        joints_(std::move(joints)),
        past_(settings.window + 1),
        distances_(std::max<std::size_t>(settings.patch, 1)) {}

  std::size_t lookahead() const override { return 0; }

  bool push(const Frame& in, Frame& out) override {
    remember(in);
    find_weights();
    out = in;
    const Frame& present = past_[0];
    for (const std::size_t joint : joints_)
      out.rotations[joint] = present.rotations[joint] * exp(mean_turn(joint));
    for (std::size_t i = 1; i < out.positions.size(); ++i)
      out.positions[i] = present.positions[i] + mean_move(i);
    return true;
  }

  bool flush(Frame&) override { return false; }

 private:
  // For one frame and each lag: the sum of squared angles to the frame that long ago, over joints
  // measured in both.
  struct Distances {
    std::vector<double> sums, pairs;
  };

  static bool is_observed(const Frame& frame, std::size_t joint) {
    return frame.observed.empty() || frame.observed[joint] != 0;
  }

  // Adds the frame to the past ones. Unmeasured rotations are held.
  void remember(const Frame& frame) {
    past_.add() = frame;
    for (const std::size_t joint : joints_) {
      if (past_.size() > 1 && !is_observed(frame, joint)) {
        past_[0].rotations[joint] = past_[1].rotations[joint];
      }
    }
    Distances& row = distances_.add();
    row.sums.clear();
    row.pairs.clear();
    for (std::size_t lag = 1; lag < past_.size(); ++lag) {
      double sum = 0, pairs = 0;
      for (const std::size_t joint : joints_) {
        if (!is_observed(frame, joint) || !is_observed(past_[lag], joint)) continue;
        const double angle = angle_between(frame.rotations[joint], past_[lag].rotations[joint]);
        sum += angle * angle;
        pairs += 1;
      }
      row.sums.push_back(sum);
      row.pairs.push_back(pairs);
    }
    if (past_.size() >= 3) measure_noise();
  }

  void measure_noise() {
    double sum = 0;
    std::size_t count = 0;
    for (const std::size_t joint : joints_) {
      if (!is_observed(past_[0], joint) || !is_observed(past_[1], joint) ||
          !is_observed(past_[2], joint)) {
        continue;
      }
      const Quat middle = conjugate(past_[1].rotations[joint]);
      const Vec3 bend =
          log(middle * past_[0].rotations[joint]) + log(middle * past_[2].rotations[joint]);
      sum += dot(bend, bend);
      ++count;
    }
    if (count > 0) noise_.add(sum, count);
  }

  // sum_s w_s Log(q^-1 q_s) / (1 + sum_s w_s) over the measured samples.
  Vec3 mean_turn(std::size_t joint) const {
    const Quat present = conjugate(past_[0].rotations[joint]);
    Vec3 sum;
    double total = is_observed(past_[0], joint) ? 1 : 0;
    for (std::size_t lag = 1; lag <= weights_.size(); ++lag) {
      const double weight = weights_[lag - 1];
      if (weight == 0 || !is_observed(past_[lag], joint)) continue;
      sum += weight * log(present * past_[lag].rotations[joint]);
      total += weight;
    }
    return total > 0 ? (1 / total) * sum : Vec3{};
  }

  Vec3 mean_move(std::size_t column) const {
    Vec3 sum;
    double total = 1;
    for (std::size_t lag = 1; lag <= weights_.size(); ++lag) {
      sum += weights_[lag - 1] * (past_[lag].positions[column] - past_[0].positions[column]);
      total += weights_[lag - 1];
    }
    return (1 / total) * sum;
  }

  // Mean squared difference per channel of the patches that end now and `lag` frames ago.
  double patch_distance(std::size_t lag) const {
    double sum = 0, pairs = 0;
    for (std::size_t age = 0; age < distances_.size(); ++age) {
      const Distances& row = distances_[age];
      if (row.sums.size() < lag) break;
      sum += row.sums[lag - 1];
      pairs += row.pairs[lag - 1];
    }
    return pairs > 0 ? sum / (3 * pairs) : std::numeric_limits<double>::infinity();
  }

  void find_weights() {
    const bool automatic = settings_.bandwidth == 0;
    const double variance = automatic && noise_.known() ? noise_.variance() : 0;
    weights_.clear();
    if (automatic && variance == 0) return;
    for (std::size_t lag = 1; lag < past_.size(); ++lag) weights_.push_back(patch_distance(lag));
    keep_nearest(weights_);
    const double bandwidth2 = automatic ? settings_.noise_share * settings_.noise_share * variance
                                        : settings_.bandwidth * settings_.bandwidth;
    double floor = 2 * variance;
    if (!automatic && !weights_.empty())
      floor = *std::min_element(weights_.begin(), weights_.end());
    if (std::isinf(floor)) floor = 0;
    for (double& value : weights_) {
      value = portable::exp(-std::max(0.0, value - floor) / (2 * bandwidth2));
    }
  }

  void keep_nearest(std::vector<double>& distances) {
    if (settings_.neighbours == 0 || settings_.neighbours >= distances.size()) return;
    sorted_ = distances;
    const double limit = of_rank(sorted_, settings_.neighbours - 1);
    for (double& value : distances) {
      if (value > limit) value = std::numeric_limits<double>::infinity();
    }
  }

  CausalNonlocalSettings settings_;
  std::vector<std::size_t> joints_;
  RunningNoise noise_;
  Latest<Frame> past_;           // the present frame first
  Latest<Distances> distances_;  // of the frames of a patch, the present one first
  std::vector<double> weights_;  // of the poses 1, 2, ... frames ago; the present one has weight 1
  std::vector<double> sorted_;
};

}  // namespace

std::unique_ptr<LiveFilter> make_causal_nonlocal(const CausalNonlocalSettings& settings,
                                                 std::vector<std::size_t> joints) {
  return std::make_unique<CausalNonlocal>(settings, std::move(joints));
}

}  // namespace kinemend
