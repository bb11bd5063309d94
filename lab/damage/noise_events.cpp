// Draws the times of events as a Poisson process and fades each event in and out.
#include "lab/damage/track_errors.hpp"

#include <algorithm>

#include "base/portable.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend::corrupt {

namespace {

// Draws starts from `longest_s` before frame 0; `duration` draws from the same generator.
template <class Duration>
std::vector<NoiseEvent> poisson(double per_minute, double longest_s, double seconds, Random random,
                                const Duration& duration) {
  std::vector<NoiseEvent> events;
  if (!(per_minute > 0)) return events;
  double time = -longest_s;
  while (true) {
    time += -portable::log1p(-random.uniform()) * 60 / per_minute;
    if (!(time < seconds)) return events;
    const NoiseEvent event{time, duration(random)};
    if (event.start_s + event.duration_s > 0) events.push_back(event);
  }
}

}  // namespace

std::vector<NoiseEvent> uniform_events(double per_minute, double shortest_s, double longest_s,
                                       double seconds, const Random& random) {
  return poisson(per_minute, longest_s, seconds, random,
                 [&](Random& own) { return own.uniform(shortest_s, longest_s); });
}

std::vector<NoiseEvent> exponential_events(double per_minute, double mean_s, double seconds,
                                           const Random& random) {
  const double longest = 10 * mean_s;
  return poisson(per_minute, longest, seconds, random, [&](Random& own) {
    return std::min(longest, -mean_s * portable::log1p(-own.uniform()));
  });
}

double event_window(NoiseEvent event, double edge_s, double time_s) {
  const double since = time_s - event.start_s, left = event.duration_s - since;
  if (since <= 0 || left <= 0) return 0;
  const double edge = std::min(edge_s, event.duration_s / 2), nearest = std::min(since, left);
  return nearest >= edge ? 1 : 0.5 - 0.5 * portable::cos(pi * nearest / edge);
}

}  // namespace kinemend::corrupt
