// Compares the stands of feet with the loads of force plates, which measure when a foot comes down
// and leaves.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "check/checks.hpp"

namespace kinemend::check {

namespace {

// A time in which a plate is loaded.
struct LoadedTime {
  std::size_t plate = 0;
  double first_s = 0, last_s = 0;
  bool begins = false, ends = false;  // within the take
};

// Newtons under a person who steps on plates; less is drift of an amplifier, because the person
// stood on the plate in the frames that the file calls unloaded. Chosen by hand, not swept.
constexpr double least_of_person = 50;
// A share of the largest load: some 25 N. Less is noise. Chosen by hand, not swept.
constexpr double least_load = 0.03;

// Returns infinity without a person on the plates.
double least_load_of(const std::vector<ForcePlate>& plates) {
  double most = 0;
  for (const ForcePlate& plate : plates) {
    for (const double load : plate.loads) most = std::max(most, load);
  }
  return most > least_of_person ? least_load * most : std::numeric_limits<double>::infinity();
}

std::vector<LoadedTime> loaded_times(const ForcePlate& plate, std::size_t index, double least) {
  // A shorter time is a knock against the plate, and a shorter break its oscillation. Chosen by
  // hand, not swept.
  constexpr double shortest_s = 0.1, shortest_break_s = 0.03;
  std::vector<LoadedTime> times;
  const auto is_loaded = [&](std::size_t i) { return plate.loads[i] > least; };
  const auto between = static_cast<std::size_t>(shortest_break_s * plate.rate_hz);
  for (const FrameSpan& span : runs_where(plate.loads.size(), is_loaded, between)) {
    if (static_cast<double>(span.length()) < shortest_s * plate.rate_hz) continue;
    times.push_back({index, static_cast<double>(span.first) / plate.rate_hz,
                     static_cast<double>(span.last + 1) / plate.rate_hz, span.first > 0,
                     span.last + 1 < plate.loads.size()});
  }
  return times;
}

// Whether a place is above the plate.
bool is_on(const ForcePlate& plate, Vec3 place) {
  const Vec3 along = plate.corners[1] - plate.corners[0],
             across = plate.corners[3] - plate.corners[0];
  const double a = dot(along, along), b = dot(along, across), c = dot(across, across);
  const double determinant = a * c - b * b;
  if (!(determinant > 0)) return false;
  const Vec3 way = place - plate.corners[0];
  const double x = dot(way, along), y = dot(way, across);
  const double u = (c * x - b * y) / determinant, v = (a * y - b * x) / determinant;
  return u >= 0 && u <= 1 && v >= 0 && v <= 1;
}

// Whether heel and toe are seen above the plate.
bool is_foot_on(const Take& clip, std::size_t frame, const std::array<std::size_t, 2>& markers,
                const ForcePlate& plate) {
  return std::all_of(markers.begin(), markers.end(), [&](std::size_t marker) {
    return clip.is_observed(frame, marker) && is_on(plate, clip.position(frame, marker));
  });
}

// Whether the foot is above the plate for most of the time.
bool stands_on(const Take& clip, const std::array<std::size_t, 2>& markers, const ForcePlate& plate,
               const LoadedTime& time) {
  const double rate = clip.frame_rate_hz;
  const auto first = static_cast<std::size_t>(time.first_s * rate);
  const auto end = std::min(clip.frame_count(), static_cast<std::size_t>(time.last_s * rate) + 1);
  std::size_t on = 0;
  for (std::size_t f = first; f < end; ++f) on += is_foot_on(clip, f, markers, plate) ? 1 : 0;
  return first < end && 2 * on > end - first;
}

// A foot that stands on a plate loads it. Where it does not, the plate was loaded in the frames
// that its file calls unloaded, or its axes are others.
bool loads_agree(const Take& clip, const FootStands& stands, const ForcePlate& plate,
                 double least) {
  constexpr std::size_t times_more = 4;  // Chosen by hand, not swept.
  std::size_t loaded = 0, unloaded = 0;
  for (const FootContact& contact : stands.contacts) {
    for (std::size_t f = contact.first_frame; f <= contact.last_frame; ++f) {
      if (!is_foot_on(clip, f, stands.tracks[contact.leg], plate)) continue;
      const auto sample =
          static_cast<std::size_t>(static_cast<double>(f) / clip.frame_rate_hz * plate.rate_hz);
      if (sample >= plate.loads.size()) continue;
      ++(plate.loads[sample] > least ? loaded : unloaded);
    }
  }
  return loaded > times_more * unloaded;
}

// Loads of one foot that overlap: it stands on several plates.
struct FootLoad {
  std::vector<std::size_t> plates;
  double first_s = 0, last_s = 0;
  bool begins = true, ends = true;
};

void add_load(const LoadedTime& time, std::vector<FootLoad>& loads) {
  const auto overlapping = std::find_if(loads.begin(), loads.end(), [&](const FootLoad& load) {
    return time.first_s <= load.last_s && load.first_s <= time.last_s;
  });
  if (overlapping == loads.end()) {
    loads.push_back({{time.plate}, time.first_s, time.last_s, time.begins, time.ends});
    return;
  }
  overlapping->plates.push_back(time.plate);
  overlapping->first_s = std::min(overlapping->first_s, time.first_s);
  overlapping->last_s = std::max(overlapping->last_s, time.last_s);
  overlapping->begins = overlapping->begins && time.begins;
  overlapping->ends = overlapping->ends && time.ends;
}

PlateStand compared(const FootLoad& load, std::size_t foot, const FootStands& stands,
                    double frame_rate_hz) {
  constexpr double ms = 1000;
  PlateStand result{load.plates, foot, load.first_s, load.last_s, false, {}, {}};
  std::sort(result.plates.begin(), result.plates.end());
  for (const GroundTime& time : stands.ground) {
    const double from = static_cast<double>(time.first_frame) / frame_rate_hz;
    const double to = static_cast<double>(time.last_frame + 1) / frame_rate_hz;
    if (time.leg != foot || to < load.first_s || from > load.last_s) continue;
    if (!std::exchange(result.is_found, true) && time.touch_down_s && load.begins)
      result.onset_ms = ms * (*time.touch_down_s - load.first_s);
    result.offset_ms.reset();
    if (time.lift_off_s && load.ends) result.offset_ms = ms * (*time.lift_off_s - load.last_s);
  }
  return result;
}

}  // namespace

std::vector<PlateStand> plate_stands(const Take& clip, const FootStands& stands,
                                     const std::vector<ForcePlate>& plates) {
  std::vector<std::vector<FootLoad>> loads(stands.sides.size());
  const double least = least_load_of(plates);
  for (std::size_t p = 0; p < plates.size(); ++p) {
    if (!loads_agree(clip, stands, plates[p], least)) continue;
    for (const LoadedTime& time : loaded_times(plates[p], p, least)) {
      std::vector<std::size_t> feet;
      for (std::size_t foot = 0; foot < stands.sides.size(); ++foot) {
        if (stands_on(clip, stands.tracks[foot], plates[p], time)) feet.push_back(foot);
      }
      // The load of a plate under two feet does not tell when either comes down.
      if (feet.size() == 1) add_load(time, loads[feet.front()]);
    }
  }
  std::vector<PlateStand> result;
  for (std::size_t foot = 0; foot < loads.size(); ++foot) {
    for (const FootLoad& load : loads[foot])
      result.push_back(compared(load, foot, stands, clip.frame_rate_hz));
  }
  std::stable_sort(result.begin(), result.end(), [](const PlateStand& a, const PlateStand& b) {
    return a.foot != b.foot ? a.foot < b.foot : a.first_s < b.first_s;
  });
  return result;
}

}  // namespace kinemend::check

namespace kinemend {

PlateFigures plate_figures(const std::vector<PlateStand>& stands) {
  PlateFigures figures;
  std::vector<double> onsets, offsets;
  for (const PlateStand& stand : stands) {
    ++figures.loads;
    figures.found += stand.is_found ? 1 : 0;
    if (stand.onset_ms) onsets.push_back(std::fabs(*stand.onset_ms));
    if (stand.offset_ms) offsets.push_back(std::fabs(*stand.offset_ms));
  }
  if (!onsets.empty()) figures.onset_ms = median_of(onsets);
  if (!offsets.empty()) figures.offset_ms = median_of(offsets);
  return figures;
}

}  // namespace kinemend
