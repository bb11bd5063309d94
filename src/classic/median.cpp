// The method `median`: the L1 median of a moving window of each track.
#include <algorithm>

#include "classic/medians.hpp"
#include "cleaner/live.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/method_options.hpp"

namespace kinemend {

namespace {

const OptionTable<MedianOptions>& median_table() {
  static const auto options = OptionTable<MedianOptions>().number(
      &MedianOptions::window_s, "window_s", "s", 0.001, 2, "length of the whole window");
  return options;
}

template <class Sample>
using SampleTrack = std::span<const Sample>;

// Median of the window about `t`, which shrinks towards the ends and stays centred.
template <class Sample>
Sample inner_median(SampleTrack<Sample> track, std::size_t t, std::size_t half,
                    std::vector<Vec3>& scratch) {
  const std::size_t h = std::min({half, t, track.size() - 1 - t});
  if (h == 0) return track[t];
  const auto window = track.subspan(t - h, 2 * h + 1);
  return l1_median(window, medoid(window), scratch);
}

Quat extrapolated(Quat near, Quat far) {
  return normalized(near * exp(2.0 * log(conjugate(far) * near)));
}
Vec3 extrapolated(Vec3 near, Vec3 far) { return near + 2.0 * (near - far); }

// Tukey's rule for the last sample at either end: the median of that sample, of the median beside
// it, and of the extrapolation of the medians beside it.
template <class Sample>
Sample end_median(Sample end, Sample near, Sample far, std::vector<Vec3>& scratch) {
  const Sample three[3] = {end, near, extrapolated(near, far)};
  const SampleTrack<Sample> samples(three);
  return l1_median(samples, medoid(samples), scratch);
}

// The result for a sample without neighbours on both sides, or for a window of one sample.
template <class Sample>
Sample lone_median(SampleTrack<Sample> track, std::size_t t, std::size_t half,
                   std::vector<Vec3>& scratch) {
  const std::size_t last = track.size() - 1;
  if (track.size() < 4 || half == 0) return track[t];
  const std::size_t near = t == 0 ? 1 : last - 1, far = t == 0 ? 2 : last - 2;
  return end_median(track[t], inner_median(track, near, half, scratch),
                    inner_median(track, far, half, scratch), scratch);
}

struct MedianFilter {
  std::size_t half;

  template <class Sample>
  void operator()(Piece<Sample>& piece) const {
    const std::vector<Sample> samples = piece.samples;
    const SampleTrack<Sample> track(samples);
    std::vector<Vec3> scratch;
    MovingMedoid<Sample> medoids(track, 2 * half + 1);
    for (std::size_t t = 0; t < track.size(); ++t) {
      const std::size_t h = std::min({half, t, track.size() - 1 - t});
      if (h == 0) {
        piece.samples[t] = lone_median(track, t, half, scratch);
      } else {
        const std::size_t middle = medoids.find(t - h, t + h);
        piece.samples[t] = l1_median(track.subspan(t - h, 2 * h + 1), middle - (t - h), scratch);
      }
    }
  }
};

// The median of the `half` samples on either side, within a window that may be longer.
template <class Sample>
class MedianStep {
 public:
  MedianStep(std::size_t half, std::size_t window_half)
      : half_(half), window_half_(window_half), window_(2 * window_half + 1) {
    sums_.reserve(2 * half + 1);
    scratch_.reserve(2 * half + 1);
  }

  Sample step(Sample sample) {
    window_.push(sample);
    const auto about = window_.samples().subspan(window_half_ - half_, 2 * half_ + 1);
    return half_ == 0 ? about[0] : l1_median(about, medoid(about, sums_), scratch_);
  }

 private:
  std::size_t half_, window_half_;
  SlidingWindow<Sample> window_;
  std::vector<double> sums_;
  std::vector<Vec3> scratch_;
};

class Median final : public Cleaner {
 public:
  explicit Median(const MedianOptions& options) : options_(options) {}

  std::string_view name() const override { return "median"; }
  OptionValues options() const override { return median_table().values(options_); }

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& progress) const override {
    filter_pieces(take, sink, progress, MedianFilter{half_frames(take.frame_rate_hz)});
    return {};
  }

  LiveSupport live_support(double) const override { return {}; }

  std::unique_ptr<LiveFilter> live(const TakeView& like) const override {
    const std::size_t half = half_frames(like.frame_rate_hz);
    // The ends use the medians of the two frames beside them.
    const std::size_t end = half == 0 ? 0 : half == 1 ? 3 : 4;
    const std::size_t window_half = std::max(half, end);
    return windowed_filter<MedianStep>(
        like, window_half,
        [&](const kinemend::Track&, auto sample) {
          return MedianStep<decltype(sample)>(half, window_half);
        },
        MedianFilter{half});
  }

 private:
  std::size_t half_frames(double rate_hz) const {
    return frames_in(options_.window_s / 2, window_rate_hz(rate_hz), 1);
  }

  MedianOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_median(const MedianOptions& options) {
  median_table().validate(options);
  return std::make_unique<Median>(options);
}

Method median_method() {
  return {"median", "running median: removes short spikes and keeps sudden moves",
          "Tukey 1977; the median of rotations is Hartley et al.'s L1 mean (2011)",
          median_table().specs(),
          [](const OptionValues& values) { return make_median(median_table().parse(values)); }};
}

}  // namespace kinemend
