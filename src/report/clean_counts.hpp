// Counts of the changes that `clean` made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "kinemend/clean.hpp"

namespace kinemend {

std::size_t count_spans(const CleanReport& report, Action action);
/// Counts spikes of three frames or more.
std::size_t count_bursts(const CleanReport& report);
/// Counts joints, or markers without points that are angles or forces.
std::size_t tracks_counted(const CleanReport& report);
std::size_t tracks_changed(const CleanReport& report);
/// Counts the frames in which at least one joint or marker was repaired.
std::size_t frames_repaired(const CleanReport& report);
std::size_t gaps_left(const CleanReport& report);
/// Returns the number of frames cleaned a second.
double frames_per_second(const CleanReport& report);
/// `track`: -1 for the root position.
bool is_changed(const CleanReport& report, std::int32_t track);
std::string track_name(const CleanReport& report, std::int32_t track);
/// Counts the frames in which a leg turned or the body was lowered.
std::size_t frames_adjusted(const FeetReport& report);
std::size_t contacts_held(const FeetReport& report);

}  // namespace kinemend
