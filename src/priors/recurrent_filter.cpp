#include "priors/recurrent_filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "priors/auto_channels.hpp"
#include "tracks/held_samples.hpp"
#include "tracks/vector_tracks.hpp"

namespace kinemend {

namespace {

// Frames at the network's rate: of a stretch, and by which it reaches into its neighbours, where
// the weights of both cross over. The network sees 0.5 s about a frame, its kernels 0.4 s.
constexpr std::size_t hop = 4096, hop_margin = 256;
// Below it each frame stands for several of the network's, which was trained on no such takes.
constexpr double least_rate_hz = 45;

// Frames of the network's time; where each lies in the take.
struct Timing {
  double take_frames_a_frame = 1;
  std::size_t frames = 0;

  bool is_same() const { return take_frames_a_frame == 1; }
};

Timing timing_of(std::size_t frames, double rate_hz, double network_rate_hz) {
  constexpr double same_rate = 1e-3;
  const double ratio = rate_hz / network_rate_hz;
  if (std::abs(ratio - 1) < same_rate || frames < 2) return {1, frames};
  const double last = static_cast<double>(frames - 1);
  return {ratio, static_cast<std::size_t>(std::floor(last / ratio + 1e-9)) + 1};
}

// The mean of the take's frames that a frame of the network stands for; the straight line between
// two where the take has fewer.
class Reader {
 public:
  Reader(const RecurrentFacts& facts, const Timing& timing) : facts_(facts), timing_(timing) {}

  RecurrentTake read(std::size_t begin, std::size_t end) const {
    const std::size_t channels = facts_.measured.channels, tracks = channels / 3;
    RecurrentTake take;
    take.frames = end - begin;
    take.channels = channels;
    take.measured.reserve(take.frames * channels);
    take.automatic.reserve(take.frames * channels);
    take.marks.assign(take.frames * tracks, 0);
    for (std::size_t f = begin; f < end; ++f) {
      const Span span = span_of(f);
      for (std::size_t c = 0; c < channels; ++c) {
        const bool is_missing = is_marked(span, c);
        take.automatic.push_back(value(facts_.automatic, span, c));
        take.measured.push_back(is_missing ? take.automatic.back()
                                           : value(facts_.measured, span, c));
        if (is_missing) take.marks[(f - begin) * tracks + c / 3] = 1;
      }
    }
    return take;
  }

 private:
  struct Span {
    std::size_t first, last;  // frames of the take
    double share;             // of the last, where the straight line is taken
    bool is_mean;
  };

  Span span_of(std::size_t frame) const {
    if (timing_.is_same()) return {frame, frame, 0, false};
    const std::size_t end = facts_.measured.frames - 1;
    const double place = static_cast<double>(frame) * timing_.take_frames_a_frame;
    const double half = 0.5 * timing_.take_frames_a_frame;
    if (half > 0.5 + 1e-6) {
      const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(place - half)));
      const auto last = static_cast<std::size_t>(std::ceil(place + half)) - 1;
      return {std::min(first, end), std::min(std::max(first, last), end), 0, true};
    }
    const auto before = std::min(static_cast<std::size_t>(place + 1e-9), end);
    const double share = std::max(0.0, place - static_cast<double>(before));
    return {before, share > 1e-6 ? std::min(before + 1, end) : before, share, false};
  }

  bool is_marked(const Span& span, std::size_t channel) const {
    for (std::size_t f = span.first; f <= span.last; ++f) {
      if (facts_.missing[f * facts_.measured.channels + channel] != 0) return true;
    }
    return false;
  }

  static float value(const PoseMatrix& poses, const Span& span, std::size_t channel) {
    if (!span.is_mean) {
      const double from = poses(span.first, channel);
      return static_cast<float>(from + span.share * (poses(span.last, channel) - from));
    }
    double sum = 0;
    for (std::size_t f = span.first; f <= span.last; ++f) sum += poses(f, channel);
    return static_cast<float>(sum / static_cast<double>(span.last - span.first + 1));
  }

  const RecurrentFacts& facts_;
  const Timing& timing_;
};

// How much of a frame is a stretch's: 1, and over the margins to 0.
float weight_of(std::size_t frame, std::size_t begin, std::size_t end, std::size_t frames) {
  const auto ramp = [](double place) {
    return static_cast<float>(std::clamp(place / static_cast<double>(hop_margin) + 0.5, 0.0, 1.0));
  };
  const double at = static_cast<double>(frame) + 0.5;
  const float rises = begin == 0 ? 1.0F : ramp(at - static_cast<double>(begin));
  const float falls = end >= frames ? 0.0F : ramp(at - static_cast<double>(end));
  return rises - falls;
}

// F' x D at the network's rate.
std::vector<float> correction_of(const RecurrentNetwork& network, const Reader& reader,
                                 std::size_t frames) {
  const std::size_t channels = network.channels();
  std::vector<float> correction(frames * channels, 0.0F);
  for (std::size_t begin = 0; begin < frames; begin += hop) {
    // What is left behind the last whole stretch belongs to it.
    const bool is_last = begin + hop + hop_margin >= frames;
    const std::size_t end = is_last ? frames : begin + hop;
    const std::size_t first = begin - std::min(begin, hop_margin);
    const std::size_t last = std::min(end + hop_margin, frames);
    const std::vector<float> part = ensemble_correction(network, reader.read(first, last));
    for (std::size_t f = first; f < last; ++f) {
      const float weight = weight_of(f, begin, end, frames);
      for (std::size_t c = 0; c < channels; ++c)
        correction[f * channels + c] += weight * part[(f - first) * channels + c];
    }
    if (is_last) break;
  }
  return correction;
}

// F x D at the take's rate.
PoseMatrix correction_at_take(const RecurrentNetwork& network, const RecurrentFacts& facts) {
  const std::size_t channels = facts.automatic.channels;
  PoseMatrix result(facts.automatic.frames, channels);
  if (result.frames == 0) return result;
  const Timing timing = timing_of(result.frames, facts.rate_hz, network.rate_hz);
  const std::vector<float> correction =
      correction_of(network, Reader(facts, timing), timing.frames);
  const std::size_t end = timing.frames - 1;
  for (std::size_t f = 0; f < result.frames; ++f) {
    const double place = static_cast<double>(f) / timing.take_frames_a_frame;
    const std::size_t before = std::min(static_cast<std::size_t>(place + 1e-9), end);
    const std::size_t next = std::min(before + 1, end);
    const double share = std::clamp(place - static_cast<double>(before), 0.0, 1.0);
    for (std::size_t c = 0; c < channels; ++c) {
      const double from = static_cast<double>(correction[before * channels + c]);
      const double to = static_cast<double>(correction[next * channels + c]);
      result(f, c) = from + share * (to - from);
    }
  }
  return result;
}

// A take whose truth is known: what `auto` made of this one, with what it took away backwards.
struct Trial {
  PoseMatrix measured;
  std::vector<std::uint8_t> observed;  // F x D / 3
};

Trial trial_of(const RecurrentFacts& facts) {
  const PoseMatrix &y = facts.measured, &a = facts.automatic;
  Trial trial{a, std::vector<std::uint8_t>(y.frames * (y.channels / 3), 1)};
  for (std::size_t f = 0; f < y.frames; ++f) {
    for (std::size_t c = 0; c < y.channels; ++c) {
      const std::size_t from = (y.frames - 1 - f) * y.channels + c;
      if (facts.missing[from] == 0) trial.measured(f, c) += y.values[from] - a.values[from];
      if (facts.missing[f * y.channels + c] != 0) trial.observed[f * (y.channels / 3) + c / 3] = 0;
    }
  }
  return trial;
}

// `auto` knows frames that repeat or join samples of a lower rate; the network would take them for
// measurements.
bool has_lower_rate(const RecurrentFacts& facts) {
  const PoseMatrix& y = facts.measured;
  VectorTracks tracks(y.frames, y.channels / 3);
  SampleMarks missing(y.frames, tracks.tracks());
  for (std::size_t n = 0; n < tracks.tracks(); ++n) {
    for (std::size_t f = 0; f < y.frames; ++f) {
      tracks.set(f, n, {y(f, 3 * n), y(f, 3 * n + 1), y(f, 3 * n + 2)});
      missing(f, n) = facts.missing[f * y.channels + 3 * n];
    }
  }
  return find_sample_pattern(tracks, missing).join != SampleJoin::none;
}

// How much of the correction brings a trial nearest to its truth, for each track.
std::vector<double> shares_in_trial(const RecurrentNetwork& network, const BodyLayout& layout,
                                    const RecurrentFacts& facts) {
  const Trial trial = trial_of(facts);
  const AutoChannels cleaned =
      auto_of_channels(layout, facts.rate_hz, trial.measured, trial.observed);
  std::vector<std::uint8_t> missing = cleaned.suspect;
  for (std::size_t i = 0; i < missing.size(); ++i) {
    if (facts.missing[i] != 0) missing[i] = 1;
  }
  const PoseMatrix correction =
      correction_at_take(network, {trial.measured, cleaned.poses, missing, facts.rate_hz});
  const std::size_t tracks = correction.channels / 3;
  std::vector<double> product(tracks), square(tracks), shares;
  for (std::size_t i = 0; i < correction.values.size(); ++i) {
    if (missing[i] != 0) continue;
    const double step = correction.values[i];
    const std::size_t track = i % correction.channels / 3;
    product[track] += step * (facts.automatic.values[i] - cleaned.poses.values[i]);
    square[track] += step * step;
  }
  for (std::size_t n = 0; n < tracks; ++n)
    shares.push_back(square[n] > 0 ? std::clamp(product[n] / square[n], 0.0, 1.0) : 1);
  return shares;
}

}  // namespace

PoseMatrix recurrent_filter(const RecurrentNetwork& network, const RecurrentFacts& facts) {
  PoseMatrix result = correction_at_take(network, facts);
  for (std::size_t i = 0; i < result.values.size(); ++i)
    result.values[i] += facts.automatic.values[i];
  return result;
}

PoseMatrix guarded_recurrent_filter(const RecurrentNetwork& network, const BodyLayout& layout,
                                    const RecurrentFacts& facts, std::vector<double>* shares) {
  PoseMatrix result = facts.automatic;
  std::vector<double> helpful(result.channels / 3, 0.0);
  if (facts.rate_hz >= least_rate_hz && !has_lower_rate(facts)) {
    helpful = shares_in_trial(network, layout, facts);
    std::fill(helpful.begin() + static_cast<std::ptrdiff_t>(layout.track_count()), helpful.end(),
              0.0);
    const PoseMatrix correction = correction_at_take(network, facts);
    for (std::size_t i = 0; i < result.values.size(); ++i)
      result.values[i] += helpful[i % result.channels / 3] * correction.values[i];
  }
  if (shares != nullptr) *shares = std::move(helpful);
  return result;
}

}  // namespace kinemend
