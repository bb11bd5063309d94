// Finds when feet come down and lift off. A part of a foot stands while it does not move; the foot
// carries load from before that until after it, because heels are pressed down and toes roll.
#include "feet/ground_times.hpp"

#include <algorithm>
#include <cmath>

#include "base/frame_span.hpp"
#include "kinemend/extend/signal.hpp"

namespace kinemend::feet {

namespace {

// Heights of a foot over time, smoothed.
struct FootHeights {
  double frame_rate_hz = 0;
  std::vector<double> heel, toe;

  std::size_t frames() const { return heel.size(); }
  /// Vertical speed of the middle of the foot, per second.
  double speed(std::size_t f) const {
    const std::size_t a = f - std::min<std::size_t>(f, 1), b = std::min(f + 1, frames() - 1);
    return 0.5 * (heel[b] + toe[b] - heel[a] - toe[a]) * frame_rate_hz /
           static_cast<double>(std::max<std::size_t>(b - a, 1));
  }
};

// The second difference of a path; 0 at its ends.
double second_difference(const std::vector<double>& path, std::size_t f) {
  if (f == 0 || f + 1 >= path.size()) return 0;
  return path[f - 1] - 2 * path[f] + path[f + 1];
}

FootHeights heights_of(const Soles& soles, std::size_t leg) {
  // Published gait events use markers below 20 Hz or so.
  constexpr double cutoff_hz = 20;
  const BodyPoints& body = soles.body;
  PoseMatrix heights(body.frames, 2);
  for (std::size_t f = 0; f < body.frames; ++f) {
    for (std::size_t part = 0; part < 2; ++part)
      heights(f, part) = along(body.at(f, 2 * leg + part), soles.up);
  }
  if (body.frame_rate_hz > 2.5 * cutoff_hz)
    filter_zero_phase(heights, butterworth_lowpass(2, cutoff_hz, body.frame_rate_hz));
  FootHeights result{body.frame_rate_hz, {}, {}};
  for (std::size_t f = 0; f < body.frames; ++f) {
    result.heel.push_back(heights(f, 0));
    result.toe.push_back(heights(f, 1));
  }
  return result;
}

// Returns the frame of the largest value of a range, between frames by a parabola.
template <class Value>
double peak_frame(std::size_t first, std::size_t last, std::size_t frames, const Value& value) {
  std::size_t best = first;
  for (std::size_t f = first; f <= last; ++f) {
    if (value(f) > value(best)) best = f;
  }
  const auto frame = static_cast<double>(best);
  if (best == first || best == last || best == 0 || best + 1 >= frames) return frame;
  const double before = value(best - 1), after = value(best + 1);
  const double curve = before - 2 * value(best) + after;
  return curve < 0 ? frame + 0.5 * (before - after) / curve : frame;
}

// A time in which a foot stands on any part, and the part that comes down first.
struct FootSpan {
  FrameSpan span;
  FootPart first_part = FootPart::heel;
};

std::vector<FootSpan> spans_of_foot(const std::vector<FootContact>& contacts, std::size_t leg,
                                    std::size_t most_between) {
  std::vector<FootSpan> parts;
  for (const FootContact& contact : contacts) {
    if (contact.leg == leg)
      parts.push_back({{contact.first_frame, contact.last_frame}, contact.part});
  }
  std::stable_sort(parts.begin(), parts.end(), [](const FootSpan& a, const FootSpan& b) {
    return a.span.first < b.span.first;
  });
  std::vector<FootSpan> spans;
  for (const FootSpan& part : parts) {
    if (spans.empty() || part.span.first > spans.back().span.last + 1 + most_between)
      spans.push_back(part);
    else
      spans.back().span.last = std::max(spans.back().span.last, part.span.last);
  }
  return spans;
}

// After O'Connor, Thorpe, O'Malley & Vaughan 2007 the foot falls fastest just before it comes down;
// after Hreljac & Marshall 2000 its first part then slows down most as it hits the floor.
double touch_down(const FootHeights& heights, const FootSpan& stand, std::size_t first_free) {
  // Chosen by hand, tuned on four takes with force plates (docs/details/feet.md).
  constexpr double before_s = 0.15, after_s = 0.03, blow_s = 0.06;
  const double rate = heights.frame_rate_hz;
  const std::size_t start = stand.span.first;
  const std::size_t first =
      std::max(first_free, start - std::min(start, frames_in(before_s, rate, 1)));
  const std::size_t last = std::min(stand.span.last, start + frames_in(after_s, rate, 1));
  const double fastest =
      peak_frame(first, last, heights.frames(), [&](std::size_t f) { return -heights.speed(f); });
  const auto from = static_cast<std::size_t>(std::lround(fastest));
  const std::size_t to = std::min(heights.frames() - 1, from + frames_in(blow_s, rate, 1));
  const std::vector<double>& part = stand.first_part == FootPart::heel ? heights.heel : heights.toe;
  return peak_frame(from, to, heights.frames(),
                    [&](std::size_t f) { return second_difference(part, f); });
}

// After O'Connor et al. the foot rises fastest as its toes leave the floor.
double lift_off(const FootHeights& heights, const FrameSpan& stand, std::size_t last_free) {
  constexpr double after_s = 0.2;  // Chosen by hand, as above.
  const std::size_t last =
      std::min(last_free, stand.last + frames_in(after_s, heights.frame_rate_hz, 1));
  return peak_frame(stand.last, std::max(stand.last, last), heights.frames(),
                    [&](std::size_t f) { return heights.speed(f); });
}

}  // namespace

std::vector<GroundTime> ground_times(const Soles& soles, const std::vector<FootContact>& contacts) {
  // Between heel and toe a foot may roll for so long without a part at rest. Chosen by hand.
  constexpr double rolling_s = 0.1;
  const double rate = soles.body.frame_rate_hz;
  std::vector<GroundTime> times;
  for (std::size_t leg = 0; leg < soles.legs(); ++leg) {
    const std::vector<FootSpan> spans = spans_of_foot(contacts, leg, frames_in(rolling_s, rate, 0));
    if (spans.empty()) continue;
    const FootHeights heights = heights_of(soles, leg);
    for (std::size_t i = 0; i < spans.size(); ++i) {
      const FrameSpan& span = spans[i].span;
      const std::size_t first_free = i == 0 ? 0 : spans[i - 1].span.last + 1;
      const std::size_t end = i + 1 == spans.size() ? heights.frames() : spans[i + 1].span.first;
      GroundTime& time = times.emplace_back();
      time.leg = leg;
      if (span.first > 0) time.touch_down_s = touch_down(heights, spans[i], first_free) / rate;
      if (span.last + 1 < heights.frames())
        time.lift_off_s = lift_off(heights, span, end - 1) / rate;
      time.first_frame = span.first;
      time.last_frame = span.last;
    }
  }
  return times;
}

}  // namespace kinemend::feet
