#include <memory>

#include "clean/filter_tracks.hpp"
#include "clean/marker_tracks.hpp"
#include "clean/method_list.hpp"
#include "kinemend/frame_rate.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/metrics.hpp"
#include "tracks/bilateral_filter.hpp"

namespace kinemend {

namespace {

const OptionTable<BilateralOptions>& table() {
  static const OptionTable<BilateralOptions> result =
      OptionTable<BilateralOptions>()
          .number(&BilateralOptions::sigma_t_s, "sigma_t_s", "s", 0.001, 1, "temporal width")
          .number(&BilateralOptions::sigma_g_deg, "sigma_g_deg", "deg", 0.01, 1000,
                  "width in rotation angle: turns much larger than this are kept as edges")
          .integer(&BilateralOptions::passes, "passes", "", 1, 100, "how many times it is applied")
          .choice(&BilateralOptions::ends, "ends", {"reflect", "mirror"},
                  "how the signal goes on beyond its ends: straight on, or back in time");
  return result;
}

// A body turned by sigma_g moves its far end by sigma_g times this: the width for positions. Travel
// is no edge, as it would be for the length of a bone.
double reach(const Skeleton& skeleton) {
  const double height = skeleton_height(skeleton);
  return height > 0 ? height : 1.0;
}

class BilateralCleaner final : public Cleaner {
 public:
  explicit BilateralCleaner(const BilateralOptions& options) : options_(options) {
    table().validate(options);
  }

  CleanTrace clean(Clip& clip, const Selection& selection) const override {
    const double sigma_t = options_.sigma_t_s * window_rate_hz(clip.frame_rate_hz);
    const double sigma_g = options_.sigma_g_deg * radians_per_degree;
    const auto passes = static_cast<std::size_t>(options_.passes);
    const BilateralKernel turns = bilateral_kernel(sigma_t, sigma_g);
    const BilateralKernel moves = bilateral_kernel(sigma_t, sigma_g * reach(clip.skeleton));
    return filter_tracks(
        clip, selection,
        [&](RotationTrack& track, const std::vector<double>& weights) {
          bilateral_filter(track, weights, turns, passes, ends());
        },
        [&](VectorTrack& track) { bilateral_filter(track, {}, moves, passes, ends()); });
  }

  MarkerTrace clean_markers(MarkerClip& clip, const MarkerSelection& selection) const override {
    const double sigma_t = options_.sigma_t_s * window_rate_hz(clip.frame_rate_hz);
    const double sigma_g = options_.sigma_g_deg * radians_per_degree;
    const BilateralKernel moves = bilateral_kernel(sigma_t, sigma_g * selection.body_height);
    // Bridges count like samples: a mean of one side only would lag behind a marker that travels.
    return filter_marker_tracks(
        clip, selection, [&](VectorTrack& track, const std::vector<double>&) {
          bilateral_filter(track, {}, moves, static_cast<std::size_t>(options_.passes), ends());
        });
  }

  LiveSupport live_support(double frame_rate_hz) const override {
    const double sigma_t = options_.sigma_t_s * window_rate_hz(frame_rate_hz);
    const std::size_t k = bilateral_kernel(sigma_t, 1).half_width();
    return {LiveSupport::Kind::windowed, k * static_cast<std::size_t>(options_.passes)};
  }

 private:
  BilateralEnds ends() const {
    return options_.ends == "mirror" ? BilateralEnds::mirror : BilateralEnds::reflect;
  }

  BilateralOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_bilateral(const BilateralOptions& options) {
  return std::make_unique<BilateralCleaner>(options);
}

Method bilateral_method() {
  return {"bilateral", "edge-preserving filter on the rotations themselves",
          "Courty 2008, Bilateral Human Motion Filtering", table().specs(),
          [](const OptionValues& values) { return make_bilateral(table().parse(values)); }};
}

}  // namespace kinemend
