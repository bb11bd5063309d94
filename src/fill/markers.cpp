#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "fill/beside_gap.hpp"
#include "fill/gap_range.hpp"
#include "fill/marker_group.hpp"
#include "fill/marker_methods.hpp"
#include "kinemend/error.hpp"
#include "kinemend/fill.hpp"
#include "motion/name_pattern.hpp"

namespace kinemend {

namespace {

using fill::Filling;
using fill::MarkerGap;
using fill::MarkerRequest;
using fill::Samples;

struct NamedMethod {
  std::string_view name;
  fill::FillMarkerGap fill;
};

constexpr NamedMethod marker_methods[] = {
    {"auto", fill::fill_by_auto},
    {"spline", fill::fill_by_spline},
    {"quintic", fill::fill_by_quintic},
    {"pchip", fill::fill_by_pchip},
    {"hermite", fill::fill_by_hermite},
    {"pattern", fill::fill_by_pattern},
    {"rigid-body", fill::fill_by_rigid_body},
    {"pca", fill::fill_by_pca},
    {"local-regression", fill::fill_by_local_regression},
    {"cyclic", fill::fill_by_cycles},
};

const NamedMethod& method_of(std::string_view name) {
  std::vector<std::string_view> known;
  for (const NamedMethod& method : marker_methods) {
    if (method.name == name) return method;
    known.push_back(method.name);
  }
  throw Error(ErrorKind::usage,
              fmt::format("fill: expected a method for markers ({}), found \"{}\"",
                          fmt::join(known, ", "), name));
}

std::size_t donor_of(const MarkerClip& clip, const FillSettings& settings) {
  if (settings.donor.empty()) {
    if (settings.method != "pattern") return MarkerRequest::no_marker;
    throw Error(ErrorKind::usage, "fill: the method pattern needs a donor");
  }
  std::int32_t donor = clip.find(settings.donor);
  if (donor < 0) {
    const std::vector<std::uint8_t> meant = names_meant(clip.names, settings.donor);
    if (std::count(meant.begin(), meant.end(), 1) == 1)
      donor = static_cast<std::int32_t>(std::find(meant.begin(), meant.end(), 1) - meant.begin());
  }
  if (donor < 0) {
    throw Error(ErrorKind::usage, fmt::format("fill: there is no donor \"{}\" (the take has {})",
                                              settings.donor, fmt::join(clip.names, ", ")));
  }
  return static_cast<std::size_t>(donor);
}

Samples samples_of(const MarkerClip& clip, const std::vector<std::uint8_t>& seen) {
  Samples samples;
  samples.frames = clip.frame_count();
  samples.markers = clip.marker_count();
  samples.frame_rate_hz = clip.frame_rate_hz;
  samples.first_frame = clip.first_frame;
  samples.positions = clip.positions;
  samples.measured = clip.observed;
  samples.seen = seen;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (clip.is_position.empty() || clip.is_position[m] != 0) samples.bodies.push_back(m);
  }
  samples.radius = body_radius(samples);
  return samples;
}

// A sample beside a gap is a spike where it is farther from a filling without it than this share of
// the body's radius, and than this many expected errors.
constexpr double spike_share = 0.1;
constexpr double spike_errors = 4;

// Fills the gaps of a clip in rounds: what one round fills is evidence for the next.
class Filler {
 public:
  Filler(MarkerClip& clip, const NamedMethod& method, const MarkerRequest& request,
         std::vector<Gap> gaps)
      : clip_(clip),
        name_(method.name),
        method_(method.fill),
        request_(request),
        gaps_(std::move(gaps)),
        fillings_(gaps_.size()),
        seen_(clip.observed) {}

  void run() {
    std::vector<std::size_t> open(gaps_.size());
    std::iota(open.begin(), open.end(), std::size_t{0});
    while (!open.empty()) {
      try_gaps(open);
      const std::size_t before = open.size();
      std::erase_if(open, [&](std::size_t g) { return !fillings_[g].positions.empty(); });
      if (open.size() == before) break;
      std::erase_if(open, [&](std::size_t g) { return !fillings_[g].may_wait; });
    }
  }

  // Once more where a steady companion was missing too: what was filled of it is evidence now.
  void refine() {
    const Samples samples = samples_of(clip_, seen_);
    std::vector<std::uint8_t> gains(gaps_.size());
    tbb::parallel_for(std::size_t{0}, gaps_.size(), [&](std::size_t g) {
      gains[g] = !fillings_[g].positions.empty() && overlaps_another(g) &&
                 has_filled_companion(samples, gaps_[g]);
    });
    std::vector<std::size_t> again;
    for (std::size_t g = 0; g < gaps_.size(); ++g) {
      if (gains[g]) again.push_back(g);
    }
    try_gaps(again);
  }

  FillReport finish() {
    FillReport report;
    for (std::size_t g = 0; g < gaps_.size(); ++g) {
      Filling& filling = fillings_[g];
      const bool filled = !filling.positions.empty();
      if (filled) mark(gaps_[g]);
      report.gaps.push_back({gaps_[g], std::move(filling.method), filled, std::move(filling.reason),
                             filling.expected_error});
    }
    return report;
  }

 private:
  void try_gaps(const std::vector<std::size_t>& chosen) {
    const Samples samples = samples_of(clip_, seen_);
    std::vector<Filling> found(chosen.size());
    tbb::parallel_for(std::size_t{0}, chosen.size(), [&](std::size_t i) {
      const Gap& gap = gaps_[chosen[i]];
      found[i] = attempt(samples, {gap.track, {gap.first_frame, gap.last_frame}});
    });
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      Filling& before = fillings_[chosen[i]];
      // A second look never takes back what the first has found.
      if (found[i].positions.empty() && !before.positions.empty()) continue;
      // Trials know the true places of companions that were filled, and expect too little then.
      if (!before.positions.empty()) found[i].expected_error = before.expected_error;
      before = std::move(found[i]);
      put(gaps_[chosen[i]], before);
    }
  }

  // The method, or where all are to be filled and it cannot, the best guess there is.
  Filling attempt(const Samples& samples, const MarkerGap& gap) const {
    if (gap.span.length() == samples.frames) {
      return Filling::refused(name_, "the marker is never seen");
    }
    const double length_s = static_cast<double>(gap.span.length()) / samples.frame_rate_hz;
    if (!request_.lenient && request_.longest_gap_s > 0 && length_s > request_.longest_gap_s) {
      return Filling::refused(name_, fmt::format("the gap of {:.2f} s is longer than {:.2f} s",
                                                 length_s, request_.longest_gap_s));
    }
    const fill::Doubt doubt = doubt_of(samples, gap);
    if (doubt.any()) {
      // No filling rests on what may be a spike, also where there is none without it.
      if (std::optional<Filling> filling = fill_without(doubt, samples, gap))
        return *std::move(filling);
    }
    return fill_span(samples, gap);
  }

  Filling fill_span(const Samples& samples, const MarkerGap& gap) const {
    Filling filling = method_(samples, gap, request_);
    if (!filling.positions.empty() || !request_.lenient) return filling;
    return fill::fill_by_auto(samples, gap, request_);
  }

  static fill::Doubt doubt_of(const Samples& samples, const MarkerGap& gap) {
    const auto leap = [&](std::size_t f) {
      for (const std::size_t k : {f - 1, f, f + 1}) {
        if (!samples.measures(k, gap.marker)) return -1.0;
      }
      return norm(samples.at(f - 1, gap.marker) - 2 * samples.at(f, gap.marker) +
                  samples.at(f + 1, gap.marker));
    };
    return fill::doubt_beside(gap.span, samples.frames, samples.frame_rate_hz,
                              spike_share * samples.radius, leap);
  }

  // The filling of the gap with what is doubted beside it; none where that bears the doubted
  // samples out.
  std::optional<Filling> fill_without(fill::Doubt doubt, const Samples& samples,
                                      const MarkerGap& gap) const {
    MarkerGap wider = gap;
    wider.span = doubt.widened(gap.span);
    Filling filling = fill_span(samples, wider);
    if (filling.positions.empty()) return filling;
    const double far =
        std::max(spike_share * samples.radius, spike_errors * filling.expected_error);
    const auto is_far = [&](std::size_t frame) {
      const Vec3 filled = filling.positions[frame - wider.span.first];
      return norm(samples.at(frame, gap.marker) - filled) > far;
    };
    const bool spike_before = doubt.before > 0 && is_far(gap.span.first - 1);
    const bool spike_behind = doubt.behind > 0 && is_far(gap.span.last + 1);
    if (spike_before != (doubt.before > 0) || spike_behind != (doubt.behind > 0)) {
      if (!spike_before && !spike_behind) return std::nullopt;
      doubt = {spike_before ? doubt.before : 0, spike_behind ? doubt.behind : 0};
      wider.span = doubt.widened(gap.span);
      filling = fill_span(samples, wider);
      if (filling.positions.empty()) return filling;
    }
    const auto first = filling.positions.begin() + static_cast<std::ptrdiff_t>(doubt.before);
    filling.positions = {first, first + static_cast<std::ptrdiff_t>(gap.span.length())};
    return filling;
  }

  void put(const Gap& gap, const Filling& filling) {
    for (std::size_t i = 0; i < filling.positions.size(); ++i) {
      const std::size_t frame = gap.first_frame + i;
      clip_.position(frame, gap.track) = filling.positions[i];
      seen_[frame * clip_.marker_count() + gap.track] = filling.is_evidence ? 1 : 0;
    }
  }

  void mark(const Gap& gap) {
    for (std::size_t f = gap.first_frame; f <= gap.last_frame; ++f) {
      const std::size_t sample = f * clip_.marker_count() + gap.track;
      clip_.observed[sample] = 1;
      if (!clip_.residuals.empty()) clip_.residuals[sample] = 0;
    }
  }

  bool overlaps_another(std::size_t g) const {
    return std::any_of(gaps_.begin(), gaps_.end(), [&](const Gap& other) {
      return other.track != gaps_[g].track && other.first_frame <= gaps_[g].last_frame &&
             gaps_[g].first_frame <= other.last_frame;
    });
  }

  bool has_filled_companion(const Samples& samples, const Gap& gap) const {
    constexpr std::size_t steadiest = 8;
    const MarkerGap asked{gap.track, {gap.first_frame, gap.last_frame}};
    const auto companions = companions_of(samples, asked, helpers_of(samples, asked));
    for (std::size_t k = 0; k < std::min(steadiest, companions.size()); ++k) {
      for (std::size_t f = gap.first_frame; f <= gap.last_frame; ++f) {
        if (!clip_.is_observed(f, companions[k].marker)) return true;
      }
    }
    return false;
  }

  MarkerClip& clip_;
  std::string_view name_;
  fill::FillMarkerGap method_;
  MarkerRequest request_;
  std::vector<Gap> gaps_;
  std::vector<Filling> fillings_;
  std::vector<std::uint8_t> seen_;  // F x M: observed, or filled in an earlier round
};

}  // namespace

FillReport fill_gaps(MarkerClip& clip, const FillSettings& settings) {
  clip.validate();
  const NamedMethod& method = method_of(settings.method);
  const std::vector<std::uint8_t> chosen = names_meant(clip.names, settings.names, "marker");
  const MarkerRequest request{donor_of(clip, settings), settings.longest_gap_s, settings.fill_all};
  std::vector<Gap> gaps = find_gaps(clip);
  std::erase_if(gaps, [&](const Gap& gap) {
    return chosen[gap.track] == 0 || !fill::lies_within(gap, 0, settings);
  });
  Filler filler(clip, method, request, std::move(gaps));
  filler.run();
  filler.refine();
  return filler.finish();
}

}  // namespace kinemend
