#include <memory>

#include "clean/lanes.hpp"
#include "clean/method_list.hpp"
#include "kinemend/experimental/frame_rate.hpp"
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

class BilateralCleaner final : public Cleaner {
 public:
  explicit BilateralCleaner(const BilateralOptions& options) : options_(options) {
    table().validate(options);
  }

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& progress) const override {
    const double sigma_t = options_.sigma_t_s * window_rate_hz(take.frame_rate_hz);
    const double sigma_g = options_.sigma_g_deg * radians_per_degree;
    const auto passes = static_cast<std::size_t>(options_.passes);
    const BilateralKernel turns = bilateral_kernel(sigma_t, sigma_g);
    // A body turned by sigma_g moves its far end by sigma_g times its height. Travel is no edge, as
    // it would be for the length of a bone.
    const BilateralKernel moves = bilateral_kernel(sigma_t, sigma_g * height_of(take));
    filter_pieces(take, sink, progress,
                  Overloaded{[&](Piece<Quat>& piece) {
                               filter_lanes(piece, [&](RotationTrack& track) {
                                 bilateral_filter(track, lane_weights(piece), turns, passes,
                                                  ends());
                               });
                             },
                             // Bridges count like samples: a mean of one side only would lag behind
                             // a marker that travels.
                             [&](Piece<Vec3>& piece) {
                               filter_lanes(piece, [&](VectorTrack& track) {
                                 bilateral_filter(track, {}, moves, passes, ends());
                               });
                             }});
    return {};
  }

  LiveSupport live_support(double frame_rate_hz) const override {
    const double sigma_t = options_.sigma_t_s * window_rate_hz(frame_rate_hz);
    const std::size_t k = bilateral_kernel(sigma_t, 1).half_width();
    return {LiveSupport::Kind::windowed, k * static_cast<std::size_t>(options_.passes)};
  }

 private:
  static double height_of(const TakeView& take) {
    if (take.markers) return take.body_height;
    const double height = body_height(take.joints->skeleton);
    return height > 0 ? height : 1;
  }
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
