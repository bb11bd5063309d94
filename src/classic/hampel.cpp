// The method `hampel`: replaces samples that deviate from the median of their window, and changes
// nothing else.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/quantiles.hpp"
#include "classic/medians.hpp"
#include "cleaner/live.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/method_options.hpp"

namespace kinemend {

namespace {

const OptionTable<HampelOptions>& hampel_table() {
  static const auto options =
      OptionTable<HampelOptions>()
          .number(&HampelOptions::window_s, "window_s", "s", 0.01, 5, "length of the whole window")
          .number(&HampelOptions::threshold, "threshold", "", 0, 100,
                  "a sample farther from the median than this many robust deviations is a spike")
          .number(&HampelOptions::minimum_deg, "minimum_deg", "deg", 0, 180,
                  "smallest distance from the median that counts as a spike");
  return options;
}

struct Rule {
  std::size_t half = 1;       // frames
  double threshold = 4;       // standard deviations per axis
  double least_distance = 0;  // radians or file units
};

template <class Sample>
using SampleTrack = std::span<const Sample>;

template <class Sample>
class Despiker {
 public:
  Despiker(SampleTrack<Sample> track, const Rule& rule)
      : track_(track), rule_(rule), medoids_(track, 2 * rule.half + 1) {}

  /// Replaces `sample` by the median of the samples about `t` if the one at `t` is a spike. `t`
  /// must increase from call to call.
  bool despike(std::size_t t, Sample& sample) {
    const std::size_t first = t - std::min(t, rule_.half);
    const std::size_t last = std::min(track_.size() - 1, t + rule_.half);
    if (!is_spike(t, first, last)) return false;
    const std::size_t near = std::max<std::size_t>(std::min(t - first, last - t), 2);
    const std::size_t from = std::max(first, t - std::min(t, near));
    const std::size_t to = std::min(last, t + near);
    const auto window = track_.subspan(from, to - from + 1);
    sample = l1_median(window, medoid(window), scratch_);
    return true;
  }

 private:
  bool is_spike(std::size_t t, std::size_t first, std::size_t last) {
    // Frames of a window; shorter ones are not changed. Chosen by hand, not swept.
    constexpr std::size_t least_frames = 5;
    if (last - first + 1 < least_frames) return false;
    const std::size_t middle = medoids_.find(first, last);
    const double own = medoids_.distance(middle, t);
    if (own <= rule_.least_distance) return false;
    distances_.clear();
    for (std::size_t f = first; f <= last; ++f) distances_.push_back(medoids_.distance(middle, f));
    if (own <= rule_.threshold * upper_median_of(distances_) / median_of_chi3) return false;
    return last - first == 2 * rule_.half || stands_alone(t, first, last, own);
  }

  // If the take's end cuts the window, the outermost samples are far from the median in any motion.
  // They are spikes only if the sample beside them, towards the end or inwards, is far off as well.
  bool stands_alone(std::size_t t, std::size_t first, std::size_t last, double own) const {
    const bool at_start = t - first < last - t;
    const std::size_t outer =
        at_start ? t - std::min<std::size_t>(t - first, 1) : std::min(t + 1, last);
    const std::size_t beside = outer != t ? outer : at_start ? t + 1 : t - 1;
    return medoids_.distance(beside, t) >= own / 2;
  }

  SampleTrack<Sample> track_;
  Rule rule_;
  MovingMedoid<Sample> medoids_;
  std::vector<Vec3> scratch_;
  std::vector<double> distances_;
};

struct HampelFilter {
  std::vector<Rule> rules;  // one per track

  template <class Sample>
  void operator()(Piece<Sample>& piece) const {
    const std::vector<Sample> track = piece.samples;
    Despiker<Sample> despiker(track, rules[piece.track]);
    piece.actions.assign(track.size(), Action::kept);
    for (std::size_t t = 0; t < track.size(); ++t) {
      if (despiker.despike(t, piece.samples[t])) piece.actions[t] = Action::despiked;
    }
  }
};

// The rule away from the ends, where windows are whole.
template <class Sample>
class HampelStep {
 public:
  explicit HampelStep(const Rule& rule) : rule_(rule), window_(2 * rule.half + 1) {
    sums_.reserve(2 * rule.half + 1);
    distances_.reserve(2 * rule.half + 1);
    scratch_.reserve(2 * rule.half + 1);
  }

  Sample step(Sample newest) {
    window_.push(newest);
    const SampleTrack<Sample> samples = window_.samples();
    const Sample own = samples[rule_.half];
    const std::size_t middle = medoid(samples, sums_);
    const double distance = chord(samples[middle], own);
    if (distance <= rule_.least_distance) return own;
    distances_.clear();
    for (const Sample& sample : samples) distances_.push_back(chord(samples[middle], sample));
    if (distance <= rule_.threshold * upper_median_of(distances_) / median_of_chi3) return own;
    return l1_median(samples, middle, scratch_);
  }

 private:
  Rule rule_;
  SlidingWindow<Sample> window_;
  std::vector<double> sums_, distances_;
  std::vector<Vec3> scratch_;
};

class Hampel final : public Cleaner {
 public:
  explicit Hampel(const HampelOptions& options) : options_(options) {}

  std::string_view name() const override { return "hampel"; }
  OptionValues options() const override { return hampel_table().values(options_); }

  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>& progress) const override {
    filter_pieces(take, sink, progress, filter_for(take));
    return {};
  }

  LiveSupport live_support(double) const override { return {}; }

  std::unique_ptr<LiveFilter> live(const TakeView& like) const override {
    return windowed_filter<HampelStep>(
        like, half_frames(like.frame_rate_hz),
        [&](const kinemend::Track& track, auto sample) {
          return HampelStep<decltype(sample)>(rule_for(track, like.frame_rate_hz));
        },
        filter_for(like));
  }

 private:
  std::size_t half_frames(double rate_hz) const {
    return frames_in(options_.window_s / 2, window_rate_hz(rate_hz), 3);
  }
  Rule rule_for(const kinemend::Track& track, double rate_hz) const {
    return {half_frames(rate_hz), options_.threshold,
            options_.minimum_deg * radians_per_degree * track.radian};
  }
  HampelFilter filter_for(const TakeView& take) const {
    HampelFilter filter;
    for (const kinemend::Track& track : take.tracks)
      filter.rules.push_back(rule_for(track, take.frame_rate_hz));
    return filter;
  }

  HampelOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_hampel(const HampelOptions& options) {
  hampel_table().validate(options);
  return std::make_unique<Hampel>(options);
}

Method hampel_method() {
  return {"hampel",
          "replaces spikes by the median of their window; all other samples stay unchanged",
          "Hampel 1974; Davies & Gather 1993", hampel_table().specs(),
          [](const OptionValues& values) { return make_hampel(hampel_table().parse(values)); }};
}

}  // namespace kinemend
