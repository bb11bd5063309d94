// Estimates colour and strength of the noise from the evidence of short windows over the take, and
// compares changes of distances with those that independent noise would cause.
#include "methods/auto/noise_spectrum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "base/frame_span.hpp"
#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "kinemend/extend/frames.hpp"
#include "methods/auto/smoothing.hpp"
#include "motion/rotation.hpp"
#include "signal/evidence.hpp"

namespace kinemend {

namespace {

// Candidates, and limits against division by zero. Chosen by hand (docs/details/auto.md,
// "What colour has the noise?"), not swept.
constexpr std::array correlations{0.0, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.98};
constexpr std::size_t strengths = 80;
constexpr double least_deviation = 0.02, largest_deviation = 60;  // degrees
constexpr signal::CutoffGrid model_cutoffs{0.003, 50, 16};
constexpr double least_motion = 1e-3;  // degrees
// Windows of single channels whose evidence is summed: limits the time. Not swept.
constexpr std::size_t most_lanes = 2400;
constexpr std::size_t fewest_noisy_frames = 24;  // of a window

double deviation_of(std::size_t strength) {
  return least_deviation *
         portable::pow(largest_deviation / least_deviation,
                       static_cast<double>(strength) / static_cast<double>(strengths - 1));
}

double fast_share_of(double correlation) {
  return std::sqrt((1 - correlation) / (1 + correlation));
}

// Windows of `frames` frames from each of `starts`, in which the evidence is computed.
struct Windows {
  std::size_t frames;
  std::vector<std::size_t> starts;
};

Windows windows_of(std::size_t frames, std::size_t length, std::size_t most) {
  Windows windows{std::min(frames, length), {}};
  const std::size_t fit = std::max<std::size_t>(1, frames / windows.frames);
  const std::size_t count = std::min(fit, most);
  for (std::size_t k = 0; k < count; ++k) {
    windows.starts.push_back(count == 1 ? (frames - windows.frames) / 2
                                        : k * (frames - windows.frames) / (count - 1));
  }
  return windows;
}

using Curve = std::array<double, strengths>;  // -2 log likelihood of each strength

// The moving tracks without whitening and with marked samples filled. They are made one at a time:
// a copy of a long take would double its memory.
class MovingTracks {
 public:
  MovingTracks(const VectorTracks& tracks, const SampleMarks& marked,
               const std::vector<Whitening>* whitenings)
      : tracks_(tracks), marked_(marked), whitenings_(whitenings) {
    // A motionless track has no noise.
    for (std::size_t n = 0; n < tracks.tracks(); ++n) {
      const auto track = tracks.track(n);
      if (std::any_of(track.begin(), track.end(),
                      [&](Vec3 v) { return norm(v - track[0]) > least_motion; }))
        numbers_.push_back(n);
    }
  }

  std::size_t count() const { return numbers_.size(); }
  std::size_t frames() const { return tracks_.frames(); }
  std::size_t number(std::size_t i) const { return numbers_[i]; }
  std::span<const std::uint8_t> marked(std::size_t i) const { return marked_.track(numbers_[i]); }
  std::vector<Vec3> filled(std::size_t i) const {
    const auto track = tracks_.track(numbers_[i]);
    std::vector<Vec3> values(track.begin(), track.end());
    if (whitenings_ != nullptr) undo_whitening(values, (*whitenings_)[numbers_[i]]);
    fill_marked(values, marked(i));
    return values;
  }

 private:
  const VectorTracks& tracks_;
  const SampleMarks& marked_;
  const std::vector<Whitening>* whitenings_;
  std::vector<std::size_t> numbers_;
};

// Short marked runs are interpolated instead, so that the noise sequence stays contiguous.
void mark_long_runs(std::span<const std::uint8_t> marked, std::size_t few,
                    std::span<std::uint8_t> result) {
  for (std::size_t t = 0; t < marked.size();) {
    std::size_t end = t;
    while (end < marked.size() && marked[end] != 0) ++end;
    if (end - t > few)
      std::fill(result.begin() + static_cast<std::ptrdiff_t>(t),
                result.begin() + static_cast<std::ptrdiff_t>(end), std::uint8_t{1});
    t = end + 1;
  }
}

// The windows of all tracks, those of one track one after the other.
struct SeenWindows {
  std::size_t tracks, frames, count;  // frames of a window, windows of a track
  std::vector<Vec3> values;
  std::vector<std::uint8_t> missing;

  std::span<const Vec3> window(std::size_t track, std::size_t number) const {
    return std::span(values).subspan((track * count + number) * frames, frames);
  }
  std::span<const std::uint8_t> missing_in(std::size_t track, std::size_t number) const {
    return std::span(missing).subspan((track * count + number) * frames, frames);
  }
};

SeenWindows look_at(const MovingTracks& tracks, const Windows& windows,
                    const ColourTuning& tuning) {
  const std::size_t count = windows.starts.size(), size = tracks.count() * count * windows.frames;
  SeenWindows seen{tracks.count(), windows.frames, count, std::vector<Vec3>(size),
                   std::vector<std::uint8_t>(size)};
  for_each_parallel(tracks.count(), tracks.count() * tracks.frames(), [&](std::size_t i) {
    const std::vector<Vec3> values = tracks.filled(i);
    std::vector<std::uint8_t> missing(values.size());
    mark_long_runs(tracks.marked(i), tuning.few_marked, missing);
    for (std::size_t w = 0; w < count; ++w) {
      const auto from = static_cast<std::ptrdiff_t>(windows.starts[w]);
      const auto to = static_cast<std::ptrdiff_t>((i * count + w) * windows.frames);
      std::copy_n(values.begin() + from, windows.frames, seen.values.begin() + to);
      std::copy_n(missing.begin() + from, windows.frames, seen.missing.begin() + to);
    }
  });
  return seen;
}

// The misfit curve of every track and axis under noise of one colour, where each window has its
// likeliest motion. Windows with hardly a sample are ignored.
std::vector<Curve> misfit_curves(const SeenWindows& seen,
                                 std::span<const signal::SmoothingModel> models, double correlation,
                                 const ColourTuning& tuning) {
  const auto fewest_samples = static_cast<double>(tuning.fewest_samples);
  const std::size_t channels = 3 * seen.tracks, count = seen.count;
  std::vector<Curve> of_lanes(channels * count);
  Curve inverse, logarithm;
  for (std::size_t s = 0; s < strengths; ++s) {
    inverse[s] = 1 / (deviation_of(s) * deviation_of(s));
    logarithm[s] = -portable::log(inverse[s]);
  }
  const std::size_t blocks =
      (of_lanes.size() + signal::block_channels - 1) / signal::block_channels;
  for_each_parallel(blocks, of_lanes.size() * seen.frames * models.size(), [&](std::size_t b) {
    const std::size_t first = b * signal::block_channels;
    const std::size_t used = std::min(signal::block_channels, of_lanes.size() - first);
    signal::ChannelBlock y(seen.frames);
    signal::NoisePrecision precision(seen.frames);
    std::array<std::uint8_t, signal::block_channels> known{};
    for (std::size_t i = 0; i < used; ++i) {
      const std::size_t channel = (first + i) / count, number = (first + i) % count;
      const auto window = seen.window(channel / 3, number);
      const double origin = component(window[0], channel % 3);
      for (std::size_t t = 0; t < window.size(); ++t)
        y(t, i) = component(window[t], channel % 3) - origin;
      precision.set_channel(i, correlation, seen.missing_in(channel / 3, number));
      known[i] = precision.observed[i] >= fewest_samples ? 1 : 0;
      if (known[i] == 0) precision.set_channel(i, 0, {});
      of_lanes[first + i].fill(known[i] != 0 ? std::numeric_limits<double>::infinity() : 0);
    }
    for (const signal::SmoothingModel& model : models) {
      const signal::ColouredEvidence evidence = signal::evidence_of(y, precision, model);
      for (std::size_t i = 0; i < used; ++i) {
        Curve& least = of_lanes[first + i];
        if (known[i] == 0) continue;
        for (std::size_t s = 0; s < strengths; ++s) {
          least[s] = std::min(least[s], evidence.squares[i] * inverse[s] + evidence.logarithms[i] +
                                            evidence.differences[i] * logarithm[s]);
        }
      }
    }
  });
  std::vector<Curve> curves(channels, Curve{});
  for (std::size_t lane = 0; lane < of_lanes.size(); ++lane) {
    for (std::size_t s = 0; s < strengths; ++s) curves[lane / count][s] += of_lanes[lane][s];
  }
  return curves;
}

struct Estimate {
  double correlation = 0;
  std::vector<double> deviations;  // 3 N
  std::vector<double> misfits;     // N
  double misfit = std::numeric_limits<double>::infinity();
  double agreement = 1;  // share of the tracks that are likelier under it than under white noise
};

Estimate estimate_of_colour(const SeenWindows& seen, std::span<const signal::SmoothingModel> models,
                            double correlation, const ColourTuning& tuning) {
  Estimate found;
  found.correlation = correlation;
  found.misfits.assign(seen.tracks, 0);
  for (const Curve& curve : misfit_curves(seen, models, correlation, tuning)) {
    const auto least = std::min_element(curve.begin(), curve.end());
    found.misfits[found.deviations.size() / 3] += *least;
    found.deviations.push_back(deviation_of(static_cast<std::size_t>(least - curve.begin())));
  }
  found.misfit = std::accumulate(found.misfits.begin(), found.misfits.end(), 0.0);
  return found;
}

// The estimate of the likeliest of these colours.
Estimate estimate(const SeenWindows& seen, std::span<const std::size_t> orders,
                  std::span<const double> colours, double frame_rate_hz,
                  const ColourTuning& tuning) {
  const auto models = signal::models_of_orders(orders, model_cutoffs, seen.frames, frame_rate_hz);
  Estimate best, white;
  for (const double correlation : colours) {
    Estimate found = estimate_of_colour(seen, models, correlation, tuning);
    if (correlation == 0) white = found;
    if (found.misfit < best.misfit) best = std::move(found);
  }
  if (white.misfits.empty()) return best;
  std::size_t agreeing = 0;
  for (std::size_t n = 0; n < white.misfits.size(); ++n)
    agreeing += best.misfits[n] < white.misfits[n];
  best.agreement = static_cast<double>(agreeing) / static_cast<double>(white.misfits.size());
  return best;
}

bool is_white(const SeenWindows& seen, std::span<const std::size_t> orders, double frame_rate_hz,
              const ColourTuning& tuning) {
  // Noise of higher correlation, too, is likelier with a little correlation than with none.
  const auto colours = std::span(correlations).first(2);
  return estimate(seen, orders, colours, frame_rate_hz, tuning).correlation == 0;
}

// The root mean square velocity of a track's means over 0.25 s, along each axis.
Vec3 slow_speeds(std::span<const Vec3> track, double frame_rate_hz) {
  const auto half =
      static_cast<std::size_t>(std::max(1L, std::lround(0.125 * window_rate_hz(frame_rate_hz))));
  const std::size_t width = 2 * half + 1;
  if (track.size() < 2 * width) return {};
  // Means a window apart: their difference is proportional to that of the sums on either side.
  Vec3 squares, before, after;
  for (std::size_t t = 0; t < width; ++t) {
    before += track[t];
    after += track[t + width];
  }
  std::size_t count = 0;
  const double scale = frame_rate_hz / static_cast<double>(width * width);
  for (std::size_t t = 0;; ++t) {
    const Vec3 v = scale * (after - before);
    squares += Vec3{v.x * v.x, v.y * v.y, v.z * v.z};
    ++count;
    if (t + 2 * width >= track.size()) break;
    before += track[t + width] - track[t];
    after += track[t + 2 * width] - track[t + width];
  }
  const double share = 1 / static_cast<double>(count);
  return {std::sqrt(share * squares.x), std::sqrt(share * squares.y), std::sqrt(share * squares.z)};
}

bool is_clear(const NoiseSpectrum& spectrum, double frame_rate_hz, TrackKind kind,
              const ColourTuning& tuning) {
  const double folding = rate_factor_of(frame_rate_hz);
  const double at_120_hz = spectrum.fast_noise / folding,
               at_120_hz_ms = spectrum.fast_noise_ms / folding;
  if (kind == TrackKind::rotations)
    return at_120_hz > tuning.least_rotation_deg &&
           at_120_hz * at_120_hz * at_120_hz_ms > tuning.least_of_rotations;
  return at_120_hz > tuning.least_deg && at_120_hz_ms > tuning.least_ms &&
         spectrum.fast_noise * spectrum.fast_noise_ms > tuning.least_product;
}

}  // namespace

double NoiseSpectrum::fast_share() const { return fast_share_of(correlation); }

std::vector<double> NoiseSpectrum::strengths() const {
  std::vector<double> result;
  for (const Vec3 d : deviations) result.push_back(std::sqrt(dot(d, d) / 3));
  return result;
}

std::vector<double> coloured_shares(const NoiseSpectrum& spectrum, double scale,
                                    double frame_rate_hz, const ColourTuning& tuning) {
  std::vector<double> shares;
  for (const Vec3 d : spectrum.deviations) {
    const double level =
        scale * std::max({d.x, d.y, d.z}) * spectrum.fast_share() / rate_factor_of(frame_rate_hz);
    shares.push_back(smooth_ramp(level, tuning.start, tuning.full));
  }
  return shares;
}

NoiseSpectrum noise_spectrum_of(const VectorTracks& tracks, const SampleMarks& marked,
                                double frame_rate_hz, TrackKind kind,
                                std::optional<double> correlation,
                                const std::vector<Whitening>* whitenings,
                                const ColourTuning& tuning) {
  NoiseSpectrum spectrum;
  const auto second = static_cast<std::size_t>(std::lround(window_rate_hz(frame_rate_hz)));
  // Markers may stand still, or move steadily, for a second or two; so may joints at rates at which
  // a snappy move looks like some frames of noise.
  const bool needs_seconds =
      kind == TrackKind::positions || (!correlation && is_brief(tracks.frames(), frame_rate_hz));
  const std::size_t fewest = needs_seconds ? tuning.fewest_seconds * second : 0;
  if (tracks.frames() < std::max(fewest_noisy_frames, fewest)) return spectrum;
  const MovingTracks moving(tracks, marked, whitenings);
  if (moving.count() < tuning.fewest_tracks) return spectrum;
  // Orders of differences, as of `signal::ModelGrid`.
  constexpr std::size_t all_orders[] = {1, 2, 3}, smooth_order[] = {3};
  const std::size_t most_windows =
      std::clamp<std::size_t>(most_lanes / (3 * moving.count()), 4, 24);
  const std::size_t window = std::max(fewest_noisy_frames, second);
  // A few windows are enough to recognise white noise.
  const std::span<const double> colours =
      correlation ? std::span<const double>(&*correlation, 1) : std::span(correlations);
  const auto seen = [&](std::size_t length, std::size_t most) {
    return look_at(moving, windows_of(tracks.frames(), length, most), tuning);
  };
  if (!correlation && is_white(seen(window, tuning.few_windows), all_orders, frame_rate_hz, tuning))
    return spectrum;
  Estimate found = estimate(seen(window, most_windows), all_orders, colours, frame_rate_hz, tuning);
  if (found.correlation == 0 || found.agreement < tuning.least_agreement) return spectrum;

  const double share = fast_share_of(found.correlation);
  std::vector<double> levels, times;
  for (std::size_t i = 0; i < moving.count(); ++i) {
    const Vec3 speeds = slow_speeds(moving.filled(i), frame_rate_hz);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double level = share * found.deviations[3 * i + axis];
      levels.push_back(level);
      times.push_back(1000 * level / std::max(1e-6, component(speeds, axis)));
    }
  }
  spectrum.fast_noise = median_of(levels);
  spectrum.fast_noise_ms = median_of(times);
  spectrum.is_clear = correlation || is_clear(spectrum, frame_rate_hz, kind, tuning);
  if (!spectrum.is_clear) return spectrum;
  spectrum.is_slow = kind == TrackKind::positions && found.correlation >= tuning.slow_correlation;
  if (spectrum.is_slow) {
    const auto longest = static_cast<std::size_t>(tuning.longest_s * window_rate_hz(frame_rate_hz));
    Estimate whole = estimate(seen(longest, 2), smooth_order, colours, frame_rate_hz, tuning);
    const double most =
        tuning.most_of_quiet * fast_share_of(found.correlation) / fast_share_of(whole.correlation);
    for (std::size_t c = 0; c < whole.deviations.size(); ++c)
      whole.deviations[c] = std::min(whole.deviations[c], most * found.deviations[c]);
    // At very low rates no model of smooth motion exists.
    if (!whole.deviations.empty()) found = std::move(whole);
  }
  spectrum.correlation = found.correlation;
  spectrum.deviations.assign(tracks.tracks(), {});
  for (std::size_t i = 0; i < moving.count(); ++i) {
    const double* d = &found.deviations[3 * i];
    spectrum.deviations[moving.number(i)] = {d[0], d[1], d[2]};
  }
  return spectrum;
}

namespace {

// Chosen by hand, and for speed; not swept.
constexpr std::size_t most_frames = 240;   // limits the time
constexpr std::size_t fewest_frames = 12;  // for a median

// Evenly spaced frames that have a frame before them.
std::vector<std::size_t> sampled_frames(std::size_t frames) {
  const std::size_t count = std::min(most_frames, frames - 1);
  std::vector<std::size_t> sampled;
  for (std::size_t i = 0; i < count; ++i) sampled.push_back(1 + i * (frames - 1) / count);
  return sampled;
}

// The median change of a distance relative to that of noise whose differences have these variances
// along the axes. Infinite if the two tracks are seldom seen together.
double ratio_of(const VectorTracks& tracks, const SampleMarks& marked,
                const std::vector<std::size_t>& frames, std::size_t a, std::size_t b,
                Vec3 squares) {
  std::vector<double> changes, expected;
  for (const std::size_t t : frames) {
    if (marked(t, a) || marked(t - 1, a) || marked(t, b) || marked(t - 1, b)) continue;
    const Vec3 now = tracks.at(t, a) - tracks.at(t, b);
    const double distance = norm(now);
    if (distance == 0) continue;
    const Vec3 u = (1 / distance) * now;
    changes.push_back(std::fabs(distance - norm(tracks.at(t - 1, a) - tracks.at(t - 1, b))));
    expected.push_back(
        std::sqrt(u.x * u.x * squares.x + u.y * u.y * squares.y + u.z * u.z * squares.z));
  }
  if (changes.size() < fewest_frames) return std::numeric_limits<double>::infinity();
  // Median of the size of a normal number of deviation 1. By definition, to four digits.
  constexpr double median_of_normal = 0.6745;
  return median_of(changes) / (median_of_normal * median_of(expected));
}

}  // namespace

double noise_in_distances(const VectorTracks& tracks, const SampleMarks& marked,
                          const std::vector<Vec3>& deviations, double correlation) {
  if (tracks.frames() < 2) return 0;
  const std::vector<std::size_t> frames = sampled_frames(tracks.frames());
  const std::size_t count = tracks.tracks();
  // Differences from one frame to the next have this share of the noise's variance.
  const double share = 2 * (1 - correlation);
  std::vector<double> least(count, std::numeric_limits<double>::infinity());
  for_each_parallel(count, count * count * frames.size(), [&](std::size_t a) {
    const Vec3 d = deviations[a];
    if (norm(d) == 0) return;
    for (std::size_t b = 0; b < count; ++b) {
      const Vec3 e = deviations[b];
      if (a == b || norm(e) == 0) continue;
      const Vec3 squares =
          share * Vec3{d.x * d.x + e.x * e.x, d.y * d.y + e.y * e.y, d.z * d.z + e.z * e.z};
      least[a] = std::min(least[a], ratio_of(tracks, marked, frames, a, b, squares));
    }
  });
  std::erase_if(least, [](double ratio) { return !std::isfinite(ratio); });
  return least.empty() ? 0 : median_of(least);
}

}  // namespace kinemend
