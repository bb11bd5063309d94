// Describes the noise and the source of a take in words.
#include <fmt/format.h>

#include "base/measure.hpp"
#include "kinemend/experimental/text.hpp"
#include "report/texts.hpp"

namespace kinemend {

namespace {

// Noise is called slow from this correlation on; the frequencies are given for this share of it.
// Chosen by hand, not swept.
constexpr double slow_correlation = 0.7, shown_share = 0.9;

std::string colour_words(const NoiseCharacter& noise, double frame_rate_hz) {
  if (noise.correlation == 0) return "white";
  return fmt::format("{}, {:.0f} % below {} Hz",
                     noise.correlation < slow_correlation ? "coloured" : "slow", 100 * shown_share,
                     figure(noise.frequency_of_share(shown_share, frame_rate_hz)));
}

}  // namespace

std::string source_words(const TakeSource& source) {
  if (source.source == Source::unknown) return source.reason;
  return fmt::format("{} ({})", to_string(source.source), source.reason);
}

std::string noise_words(const NoiseCharacter& noise, TakeKind kind, std::string_view unit,
                        double frame_rate_hz) {
  const bool is_of_tracks = (kind == TakeKind::joints) == (noise.space == Space::rotation);
  const std::string lead = is_of_tracks ? "" : "positions: ";
  const std::string_view shown = is_of_tracks ? unit : std::string_view();
  if (noise.is_expected && noise.correlation > 0)
    return fmt::format(
        "{}about {} per axis, {}; the model expects it, the take alone does not show it", lead,
        measure_text(noise.strength, shown), colour_words(noise, frame_rate_hz));
  if (noise.is_expected)
    return fmt::format(
        "{}about {}, slow; the model expects it, as in markerless video; the take alone does not "
        "show it. Cleaning improves velocities; poses change little",
        lead, measure_text(noise.strength, shown));
  std::string words = fmt::format("{}{} per axis, {}", lead, measure_text(noise.strength, shown),
                                  colour_words(noise, frame_rate_hz));
  if (noise.frames_per_sample == 1) return words;
  const double rate_hz = frame_rate_hz / noise.frames_per_sample;
  if (noise.is_interpolated)
    return words + fmt::format("; {} Hz samples joined by lines", figure(rate_hz));
  return words + fmt::format("; {} Hz samples, each held for {} frames", figure(rate_hz),
                             figure(noise.frames_per_sample));
}

}  // namespace kinemend
