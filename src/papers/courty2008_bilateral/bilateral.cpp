// The method `bilateral`: its options, its cleaner, and its steps on a live stream.
#include <algorithm>
#include <memory>
#include <vector>

#include "base/portable.hpp"
#include "cleaner/live.hpp"
#include "cleaner/pieces.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/metrics.hpp"
#include "motion/rotation.hpp"
#include "papers/courty2008_bilateral/bilateral_filter.hpp"

namespace kinemend {

namespace {

const OptionTable<BilateralOptions>& bilateral_table() {
  static const OptionTable<BilateralOptions> result =
      OptionTable<BilateralOptions>()
          .number(&BilateralOptions::sigma_t_s, "sigma_t_s", "s", 0.001, 1,
                  "standard deviation of the weights in time")
          .number(&BilateralOptions::sigma_g_deg, "sigma_g_deg", "deg", 0.01, 1000,
                  "standard deviation of the weights in rotation angle; much larger turns are kept")
          .integer(&BilateralOptions::passes, "passes", "", 1, 100,
                   "how many times the filter runs")
          .choice(&BilateralOptions::ends, "ends", {"reflect", "mirror"},
                  "padding at the ends of the take: reflect continues a steady turn, mirror runs "
                  "back in time");
  return result;
}

struct BilateralFilter {
  BilateralKernel turns, moves;
  std::size_t passes;
  BilateralEnds ends;

  void operator()(Piece<Quat>& piece) const {
    filter_lanes(piece, [&](RotationTrack& track) {
      bilateral_filter(track, lane_weights(piece), turns, passes, ends);
    });
  }
  // Bridges are treated as samples: a one-sided mean would lag behind a marker that travels.
  void operator()(Piece<Vec3>& piece) const {
    filter_lanes(piece,
                 [&](VectorTrack& track) { bilateral_filter(track, {}, moves, passes, ends); });
  }
};

// One pass away from the ends, equal to `bilateral_filter`: the weight of two samples is computed
// once, when the later of them arrives.
template <class Sample>
class BilateralPass {
 public:
  explicit BilateralPass(const BilateralKernel& kernel)
      : kernel_(kernel),
        k_(kernel.half_width()),
        samples_(2 * k_ + 1),
        increments_(2 * k_),
        weights_((2 * k_ + 1) * k_) {}

  Sample step(Sample newest) {
    const Sample before = samples_.samples().back();
    samples_.push(newest);
    increments_.push(difference(before, newest));
    const auto samples = samples_.samples();
    std::move(weights_.begin() + static_cast<std::ptrdiff_t>(k_), weights_.end(), weights_.begin());
    for (std::size_t r = 1; r <= k_; ++r) {
      const Vec3 way = difference(samples[2 * k_ - r], newest);
      weight(2 * k_, r) =
          kernel_.temporal_weights[r] * portable::exp(-kernel_.distance_scale * dot(way, way));
    }
    const auto increments = increments_.samples();
    Vec3 sum;
    double past = 0, next = 0;
    for (std::size_t r = k_; r > 0; --r) {
      past += weight(k_, r);
      next += weight(k_ + r, r);
      sum += next * increments[k_ + r - 1] - past * increments[k_ - r];
    }
    return moved(samples[k_], (1 / (1 + past + next)) * sum);
  }

 private:
  // The weight between sample i of the window and the one r before it.
  double& weight(std::size_t i, std::size_t r) { return weights_[i * k_ + r - 1]; }

  BilateralKernel kernel_;
  std::size_t k_;
  SlidingWindow<Sample> samples_;
  SlidingWindow<Vec3> increments_;
  std::vector<double> weights_;
};

template <class Sample>
class BilateralStep {
 public:
  BilateralStep(const BilateralKernel& kernel, std::size_t passes)
      : passes_(passes, BilateralPass<Sample>(kernel)) {}

  Sample step(Sample sample) {
    for (BilateralPass<Sample>& pass : passes_) sample = pass.step(sample);
    return sample;
  }

 private:
  std::vector<BilateralPass<Sample>> passes_;
};

class BilateralCleaner final : public Cleaner {
 public:
  explicit BilateralCleaner(const BilateralOptions& options) : options_(options) {
    bilateral_table().validate(options);
  }

  std::string_view name() const override { return "bilateral"; }
  OptionValues options() const override { return bilateral_table().values(options_); }

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& progress) const override {
    filter_pieces(take, sink, progress, filter_for(take));
    return {};
  }

  LiveSupport live_support(double) const override { return {}; }

  std::unique_ptr<LiveFilter> live(const TakeView& like) const override {
    const BilateralFilter filter = filter_for(like);
    return windowed_filter<BilateralStep>(
        like, filter.turns.half_width() * filter.passes,
        [&](const Track& track, auto sample) {
          const bool turns = track.space == Space::rotation;
          return BilateralStep<decltype(sample)>(turns ? filter.turns : filter.moves,
                                                 filter.passes);
        },
        filter);
  }

 private:
  BilateralFilter filter_for(const TakeView& take) const {
    return {kernel_of_turns(take), kernel_of_moves(take), static_cast<std::size_t>(options_.passes),
            options_.ends == "mirror" ? BilateralEnds::mirror : BilateralEnds::reflect};
  }
  double sigma_t_frames(const TakeView& take) const {
    return options_.sigma_t_s * window_rate_hz(take.frame_rate_hz);
  }
  BilateralKernel kernel_of_turns(const TakeView& take) const {
    return bilateral_kernel(sigma_t_frames(take), options_.sigma_g_deg * radians_per_degree);
  }
  // Distances are relative to the body height: a body turned by sigma_g moves its far end by
  // sigma_g times its height. Relative to the length of a bone, travel would be an edge.
  BilateralKernel kernel_of_moves(const TakeView& take) const {
    return bilateral_kernel(sigma_t_frames(take),
                            options_.sigma_g_deg * radians_per_degree * height_of(take));
  }
  static double height_of(const TakeView& take) {
    if (take.markers) return take.body_height;
    const double height = body_height(take.joints->skeleton);
    return height > 0 ? height : 1;
  }

  BilateralOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_bilateral(const BilateralOptions& options) {
  return std::make_unique<BilateralCleaner>(options);
}

Method bilateral_method() {
  return {
      "bilateral",
      "edge-preserving average of rotations: smooths slow motion and keeps quick moves",
      "Courty 2008, Bilateral Human Motion Filtering", bilateral_table().specs(),
      [](const OptionValues& values) { return make_bilateral(bilateral_table().parse(values)); }};
}

}  // namespace kinemend
