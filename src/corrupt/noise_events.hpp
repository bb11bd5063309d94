#pragma once

#include <vector>

#include "kinemend/experimental/random.hpp"

namespace kinemend::corrupt {

/// Something that begins at `start_s` (seconds from frame 0; may be before it) and lasts for
/// `duration_s`.
struct NoiseEvent {
  double start_s = 0;
  double duration_s = 0;
};

/// A Poisson process of events, those that reach into [0, seconds) from before it too; durations
/// uniform in [shortest_s, longest_s).
std::vector<NoiseEvent> uniform_events(double per_minute, double shortest_s, double longest_s,
                                       double seconds, const Random& random);
/// The same with exponential durations, cut at ten times their mean.
std::vector<NoiseEvent> exponential_events(double per_minute, double mean_s, double seconds,
                                           const Random& random);

/// How far an event is on at a time, 0 to 1: a raised cosine that rises and falls over `edge_s`
/// each, or over half of the duration where that is shorter, and is 1 between.
double event_window(NoiseEvent event, double edge_s, double time_s);

}  // namespace kinemend::corrupt
