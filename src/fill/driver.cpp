// Fills gaps in rounds, leaves out spikes beside them, applies limits, and reports.
#include "fill/driver.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "base/parallel.hpp"
#include "base/text.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend::fill {

namespace {

// A doubted sample is a spike if it is farther from the filling than this many expected errors. Not
// swept.
constexpr double spike_errors = 4;

// Returns the doubted samples that are far from a filling made without them.
Doubt spikes_among(Doubt doubt, const Track& around, FrameSpan gap, const Filling& filling,
                   double spike_size) {
  const double far = std::max(spike_size, spike_errors * filling.expected_error);
  const auto is_far = [&](std::size_t frame) {
    const Vec3 value = filling.values[frame - doubt.widened(gap).first];
    return size_of(around, around.offset_from(around.sample_of(frame, value), frame)) > far;
  };
  return {doubt.before > 0 && is_far(gap.first - 1) ? doubt.before : 0,
          doubt.behind > 0 && is_far(gap.last + 1) ? doubt.behind : 0};
}

// Fills a gap without the samples beside it that are spikes.
Filling fill_gap(const GappedTake& take, const OpenGap& gap) {
  if (gap.request->refusal) return *gap.request->refusal;
  const FrameSpan span = gap.span();
  if (span.length() == take.frames)
    return Filling::refused(gap.request->method->about.name, std::string(take.never_seen));
  const Track around = take.around(gap);
  const FrameSpan inner = within(around, span);
  const double spike_size = take.spike_size(gap);
  Doubt doubt = doubt_beside(around, inner, take.frame_rate_hz, spike_size);
  for (int round = 0; round < 2 && doubt.any(); ++round) {
    Filling filling = take.fill(gap, doubt.widened(span));
    if (!filling.made()) {
      if (take.rests_on_doubted) break;
      return filling;
    }
    const Doubt spikes = spikes_among(doubt, around, inner, filling, spike_size);
    if (spikes == doubt) {
      const auto first = filling.values.begin() + static_cast<std::ptrdiff_t>(doubt.before);
      filling.values = {first, first + static_cast<std::ptrdiff_t>(span.length())};
      return filling;
    }
    doubt = spikes;
  }
  return take.fill(gap, span);
}

// Refuses a filling whose expected error is above the request's limit. Such a gap is tried again in
// a later round, when other gaps are filled.
Filling within_limit(const GappedTake& take, const OpenGap& gap, Filling filling) {
  const std::string unit = take.unit_of(gap);
  const double limit = unit == "deg" ? gap.request->max_error_deg : gap.request->max_error;
  if (!filling.made() || limit == 0) return filling;
  const bool is_known = filling.expected_error > 0;
  if (is_known && filling.expected_error <= limit) return filling;
  const std::string allowed = measure_text(limit, unit);
  Filling refused = Filling::refused(
      filling.method,
      is_known
          ? fmt::format("the expected error of {}, {}, is above the limit of {}", filling.method,
                        measure_text(filling.expected_error, unit), allowed)
          : fmt::format("{} cannot tell its error, and the limit is {}", filling.method, allowed),
      true);
  refused.expected_error = filling.expected_error;
  refused.left_to_auto = std::move(filling.left_to_auto);
  return refused;
}

class Rounds {
 public:
  Rounds(GappedTake& take, const std::vector<OpenGap>& gaps, const Check& check)
      : take_(take), gaps_(gaps), check_(check), fillings_(gaps.size()) {}

  // Runs rounds until one fills nothing.
  void run() {
    std::vector<std::size_t> open(gaps_.size());
    std::iota(open.begin(), open.end(), std::size_t{0});
    while (!open.empty()) {
      try_gaps(open);
      const std::size_t before = open.size();
      std::erase_if(open, [&](std::size_t g) { return fillings_[g].made(); });
      if (open.size() == before) break;
      std::erase_if(open, [&](std::size_t g) { return !fillings_[g].may_wait; });
    }
  }

  void refine() {
    take_.begin_round();
    std::vector<std::uint8_t> gains(gaps_.size());
    for_each_index(gaps_.size(), [&](std::size_t g) {
      gains[g] = fillings_[g].made() && take_.gains(gaps_[g]) ? 1 : 0;
    });
    std::vector<std::size_t> again;
    for (std::size_t g = 0; g < gaps_.size(); ++g) {
      if (gains[g]) again.push_back(g);
    }
    if (!again.empty()) try_gaps(again);
  }

  std::vector<FilledGap> finish() {
    std::vector<FilledGap> found;
    for (std::size_t g = 0; g < gaps_.size(); ++g) {
      Filling& filling = fillings_[g];
      if (filling.made()) take_.store(gaps_[g], filling);
      found.push_back({{gaps_[g].gap, std::move(filling.method), filling.made(),
                        std::move(filling.reason), filling.expected_error, gaps_[g].is_position},
                       std::move(filling.markers_used),
                       std::move(filling.left_to_auto)});
    }
    return found;
  }

 private:
  void try_gaps(const std::vector<std::size_t>& chosen) {
    take_.begin_round();
    std::vector<Filling> found(chosen.size());
    for_each_index(chosen.size(), [&](std::size_t i) {
      if (check_) check_();
      const OpenGap& gap = gaps_[chosen[i]];
      found[i] = within_limit(take_, gap, fill_gap(take_, gap));
    });
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      Filling& before = fillings_[chosen[i]];
      // A refill never replaces a filling by a refusal.
      if (!found[i].made() && before.made()) continue;
      // Trials know the true positions of filled companions, so their expected error is too small
      // here.
      if (before.made()) found[i].expected_error = before.expected_error;
      before = std::move(found[i]);
      take_.learn(gaps_[chosen[i]], before);
    }
  }

  GappedTake& take_;
  const std::vector<OpenGap>& gaps_;
  const Check& check_;
  std::vector<Filling> fillings_;
};

}  // namespace

std::vector<FilledGap> fill_take(GappedTake& take, const std::vector<OpenGap>& gaps,
                                 const Check& check) {
  Rounds rounds(take, gaps, check);
  rounds.run();
  rounds.refine();
  return rounds.finish();
}

namespace {

// Returns one line for each reason why gaps requested from a model were left to `auto`.
std::vector<std::string> left_to_auto(const std::vector<FilledGap>& gaps,
                                      const std::vector<std::string>& names) {
  // Chosen by hand.
  constexpr std::size_t most_names = 5;  // in one line
  struct Left {
    std::string reason;
    std::size_t count = 0;
    std::vector<std::string> names = {};
  };
  std::vector<Left> all;
  for (const FilledGap& gap : gaps) {
    if (gap.left_to_auto.empty()) continue;
    auto found = std::find_if(all.begin(), all.end(),
                              [&](const Left& left) { return left.reason == gap.left_to_auto; });
    if (found == all.end()) found = all.insert(all.end(), {gap.left_to_auto});
    ++found->count;
    const std::string& name = names[gap.outcome.gap.track];
    if (std::find(found->names.begin(), found->names.end(), name) == found->names.end())
      found->names.push_back(name);
  }
  std::vector<std::string> lines;
  for (Left& left : all) {
    if (left.names.size() > most_names) {
      left.names.resize(most_names);
      left.names.emplace_back("...");
    }
    lines.push_back(fmt::format("{} left to auto ({}): {}", counted(left.count, "gap"),
                                fmt::join(left.names, ", "), left.reason));
  }
  return lines;
}

}  // namespace

FillReport report_of(const std::vector<FilledGap>& gaps, const std::vector<std::string>& names) {
  FillReport report;
  for (const FilledGap& gap : gaps) report.gaps.push_back(gap.outcome);
  report.warnings = left_to_auto(gaps, names);
  return report;
}

std::vector<FilledGap> fill_asked(Take& clip, const RequestOf& request_of, const Check& check) {
  return clip.has_joints() ? fill_asked_joints(clip, request_of, check)
                           : fill_asked_markers(clip, request_of, check);
}

std::vector<OpenGap> open_gaps(const Take& clip) {
  return clip.has_joints() ? open_joint_gaps(clip) : open_marker_gaps(clip);
}

namespace {

// Not swept.
constexpr double clearly = 3;
constexpr double compared_s = 0.5;
constexpr std::size_t compared_more = 8, least_seen = 8;
constexpr std::size_t most_doubted = 2;

// Returns the size of the second difference over frames f - 1 to f + 1, negative if one is not
// observed.
double leap(const Track& track, std::size_t f) {
  if (!track.observed[f - 1] || !track.observed[f] || !track.observed[f + 1]) return -1;
  return size_of(track, track.values[f - 1] - 2 * track.values[f] + track.values[f + 1]);
}

}  // namespace

std::size_t doubt_reach(double frame_rate_hz) {
  return static_cast<std::size_t>(compared_s * frame_rate_hz) + compared_more;
}

Doubt doubt_beside(const Track& track, FrameSpan gap, double frame_rate_hz, double least) {
  const std::size_t frames = track.frames();
  const FrameSpan compared = surroundings(gap, {}, doubt_reach(frame_rate_hz), frames);
  const auto is_near = [](std::size_t a, std::size_t b) {
    return (a > b ? a - b : b - a) <= most_doubted;
  };
  // The middle frames of the second differences that end at the samples next to the gap.
  const std::size_t before = gap.first >= 2 ? gap.first - 2 : frames;
  const std::size_t behind = gap.last + 2 < frames ? gap.last + 2 : frames;
  double usual = least / clearly;
  std::size_t seen = 0;
  for (std::size_t f = std::max<std::size_t>(compared.first, 1); f < compared.last; ++f) {
    if (is_near(f, before) || is_near(f, behind)) continue;
    const double size = leap(track, f);
    seen += size >= 0;
    usual = std::max(usual, size);
  }
  Doubt doubt;
  if (seen < least_seen) return doubt;
  if (gap.first >= 3 + most_doubted && leap(track, before) > clearly * usual)
    doubt.before = most_doubted;
  if (gap.last + 3 + most_doubted < frames && leap(track, behind) > clearly * usual)
    doubt.behind = most_doubted;
  return doubt;
}

}  // namespace kinemend::fill
