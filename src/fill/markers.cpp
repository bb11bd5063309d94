// Fills gaps of markers.
#include <fmt/format.h>

#include <algorithm>

#include "fill/driver.hpp"
#include "fill/marker_group.hpp"
#include "fill/methods.hpp"
#include "kinemend/error.hpp"
#include "motion/name_pattern.hpp"
#include "motion/unlabelled.hpp"

namespace kinemend::fill {

namespace {

// A sample beside a gap is a spike if it is farther from a filling without it than this share of
// the body's radius. Not swept.
constexpr double spike_share = 0.1;
// A gap is refilled if one of this many steadiest companions was missing in it. Not swept.
constexpr std::size_t steadiest = 8;

// `unlabelled`: whether unlabelled markers are evidence.
Samples samples_of(const Take& clip, const std::vector<std::uint8_t>& seen, bool unlabelled) {
  Samples samples;
  samples.frames = clip.frame_count();
  samples.markers = clip.marker_count();
  samples.frame_rate_hz = clip.frame_rate_hz;
  samples.first_frame = clip.first_frame;
  samples.positions = clip.positions;
  samples.measured = clip.observed;
  samples.seen = seen;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (clip.holds_positions(m) && (unlabelled || !is_unlabelled(clip.names[m])))
      samples.bodies.push_back(m);
  }
  samples.unit = clip.unit;
  samples.radius = body_radius(samples);
  return samples;
}

// The fillings of one round are evidence for the next.
class MarkerTake : public GappedTake {
 public:
  MarkerTake(Take& clip, const std::vector<OpenGap>& gaps)
      : clip_(clip), gaps_(gaps), seen_(clip.observed) {
    frames = clip.frame_count();
    frame_rate_hz = clip.frame_rate_hz;
    never_seen = "the marker is never seen";
    unlabelled_ = std::any_of(gaps.begin(), gaps.end(), [&](const OpenGap& gap) {
      return gap.request->unlabelled || is_unlabelled(clip.names[gap.track]);
    });
  }

  Track around(const OpenGap& gap) const override {
    return track_around(samples_, {gap.track, gap.span()});
  }

  std::string unit_of(const OpenGap&) const override { return clip_.unit; }

  double spike_size(const OpenGap&) const override { return spike_share * samples_.radius; }

  // Fills by the method; a lenient request falls back to the best guess if the method cannot.
  Filling fill(const OpenGap& gap, FrameSpan span) const override {
    const Method& method = *gap.request->method;
    const MarkerRequest request = gap.request->of_marker();
    const double length_s = static_cast<double>(gap.gap.length()) / frame_rate_hz;
    if (!request.lenient && request.longest_gap_s > 0 && length_s > request.longest_gap_s) {
      return Filling::refused(method.about.name,
                              fmt::format("the gap of {:.2f} s is longer than {:.2f} s", length_s,
                                          request.longest_gap_s));
    }
    const MarkerGap asked{gap.track, span};
    Filling filling = fill_marker(method, samples_, asked, request);
    if (filling.made() || !request.lenient) return filling;
    return fill_by_auto(samples_, asked, request);
  }

  void begin_round() override { samples_ = samples_of(clip_, seen_, unlabelled_); }

  void learn(const OpenGap& gap, const Filling& filling) override {
    for (std::size_t i = 0; i < filling.values.size(); ++i) {
      const std::size_t frame = gap.gap.first_frame + i;
      clip_.position(frame, gap.track) = filling.values[i];
      seen_[frame * clip_.marker_count() + gap.track] = filling.is_evidence ? 1 : 0;
    }
  }

  // A gap gains if a steady companion was missing in it, because the companion's filling is
  // evidence now.
  bool gains(const OpenGap& gap) const override {
    const FrameSpan span = gap.span();
    const bool overlaps = std::any_of(gaps_.begin(), gaps_.end(), [&](const OpenGap& other) {
      return other.track != gap.track && other.gap.first_frame <= span.last &&
             span.first <= other.gap.last_frame;
    });
    if (!overlaps) return false;
    const MarkerGap asked{gap.track, span};
    const auto companions = companions_of(samples_, asked, helpers_of(samples_, asked));
    for (std::size_t k = 0; k < std::min(steadiest, companions.size()); ++k) {
      for (std::size_t f = span.first; f <= span.last; ++f) {
        if (!clip_.is_observed(f, companions[k].marker)) return true;
      }
    }
    return false;
  }

  void store(const OpenGap& gap, const Filling&) override {
    for (std::size_t f = gap.gap.first_frame; f <= gap.gap.last_frame; ++f) {
      const std::size_t sample = f * clip_.marker_count() + gap.track;
      clip_.observed[sample] = 1;
      if (!clip_.residuals.empty()) clip_.residuals[sample] = 0;
    }
  }

 private:
  Take& clip_;
  const std::vector<OpenGap>& gaps_;
  std::vector<std::uint8_t> seen_;  // F x M: observed, or filled in an earlier round
  Samples samples_;
  bool unlabelled_ = false;
};

}  // namespace

std::size_t donor_of(const Take& clip, const std::string& name) {
  if (name.empty()) return MarkerRequest::no_marker;
  std::int32_t donor = clip.find(name);
  if (donor < 0) {
    const std::vector<std::uint8_t> meant = names_meant(clip.names, name);
    if (std::count(meant.begin(), meant.end(), 1) == 1)
      donor = static_cast<std::int32_t>(std::find(meant.begin(), meant.end(), 1) - meant.begin());
  }
  if (donor < 0) {
    throw Error(ErrorKind::usage, fmt::format("fill: there is no donor \"{}\" (the take has {})",
                                              name, fmt::join(clip.names, ", ")));
  }
  return static_cast<std::size_t>(donor);
}

std::vector<OpenGap> open_marker_gaps(const Take& clip) {
  std::vector<OpenGap> gaps;
  for (const Gap& gap : find_gaps(clip)) gaps.push_back({gap});
  return gaps;
}

std::vector<FilledGap> fill_asked_markers(Take& clip, const RequestOf& request_of,
                                          const Check& check) {
  std::vector<OpenGap> gaps;
  for (const Gap& gap : find_gaps(clip)) {
    if (const GapRequest* request = request_of(gap, false))
      gaps.push_back({gap, false, gap.track, request});
  }
  MarkerTake take(clip, gaps);
  return fill_take(take, gaps, check);
}

}  // namespace kinemend::fill
