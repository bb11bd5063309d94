// The parts of cleaners that do not depend on a method: names of actions, the spectrum of found
// noise, and cleaning in place.
#include "kinemend/extend/cleaner.hpp"

#include <utility>

#include "base/portable.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

std::string_view to_string(Action action) {
  switch (action) {
    case Action::kept:
      return "kept";
    case Action::denoised:
      return "denoised";
    case Action::despiked:
      return "despiked";
    case Action::filled:
      return "filled";
    case Action::foot_adjusted:
      return "foot_adjusted";
    case Action::refused:
      return "refused";
  }
  return "unknown";
}

double NoiseCharacter::frequency_of_share(double share, double frame_rate_hz) const {
  const double rate_hz = frame_rate_hz / frames_per_sample;
  // The spectrum of first-order noise, whose samples depend on the one before.
  return rate_hz / pi *
         portable::atan(portable::tan(share * pi / 2) * (1 - correlation) / (1 + correlation));
}

namespace {

void put_back(Take& take, std::size_t track, const CleanedTrack& cleaned) {
  if (!cleaned.rotations.empty()) set_track(take, track, cleaned.rotations);
  if (take.has_joints()) return set_track(take, track, cleaned.positions);
  for (std::size_t f = 0; f < cleaned.positions.size(); ++f) {
    const std::size_t sample = f * take.marker_count() + track;
    if (take.observed[sample] == 0) {
      if (cleaned.actions.empty() || cleaned.actions[f] != Action::filled) continue;
      take.observed[sample] = 1;
      if (!take.residuals.empty()) take.residuals[sample] = 0;
    }
    take.positions[sample] = cleaned.positions[f];
  }
}

}  // namespace

LiveSupport Cleaner::live_support(double) const {
  return {.why_not =
              "this method needs the whole take; live, use a method with a window or a "
              "causal one"};
}

std::unique_ptr<LiveFilter> Cleaner::live(const TakeView& like) const {
  throw Error(ErrorKind::usage, live_support(like.frame_rate_hz).why_not);
}

InPlaceTrace clean_in_place(const Cleaner& cleaner, Take& take, const Selection& selection,
                            const std::function<void(double)>& progress) {
  const TakeView view = view_of(take, selection);
  InPlaceTrace trace;
  trace.actions.resize(view.tracks.size());
  trace.coloured.resize(view.tracks.size());
  const TrackSink sink = [&](std::size_t track, CleanedTrack cleaned) {
    put_back(take, track, cleaned);
    trace.actions[track] = std::move(cleaned.actions);
    trace.coloured[track] = cleaned.noise;
  };
  static_cast<CleanTrace&>(trace) = cleaner.clean(view, sink, progress);
  return trace;
}

}  // namespace kinemend
