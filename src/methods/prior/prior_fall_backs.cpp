// Sums up the parts that were left to `auto`, by reason and by joint or marker.
#include "methods/prior/prior_fall_backs.hpp"

#include <utility>

namespace kinemend {

namespace {

// For messages, chosen by hand.
constexpr double least_share = 0.005;  // smaller shares are not reported

// Sets `track` to the joint or marker of a part, or to -1 for the root position; false if the part
// is not selected.
bool track_of(const PriorWork& work, const std::vector<std::uint8_t>& selected, bool place,
              std::size_t part, std::int32_t& track) {
  const std::vector<std::int32_t>& parts = work.match->tracks;
  track = part < parts.size() ? parts[part] : -1;
  if (part == parts.size()) return place;
  return track >= 0 && selected[static_cast<std::size_t>(track)] != 0;
}

}  // namespace

void add_fall_back(PriorWork& work, std::string reason, std::vector<double> shares) {
  for (PartFallBack& before : work.fall_backs) {
    for (std::size_t part = 0; part < shares.size(); ++part)
      before.shares[part] *= 1 - shares[part];
  }
  work.fall_backs.push_back({std::move(reason), std::move(shares)});
}

bool is_fallen_back(const PriorWork& work, std::size_t part) {
  double share = 0;
  for (const PartFallBack& noted : work.fall_backs) share += noted.shares[part];
  return share > 0.5;
}

std::vector<FallBack> fall_backs_of(const PriorWork& work,
                                    const std::vector<std::uint8_t>& selected, bool place) {
  std::vector<FallBack> result;
  for (const PartFallBack& noted : work.fall_backs) {
    FallBack fall_back;
    fall_back.reason = noted.reason;
    for (std::size_t part = 0; part < noted.shares.size(); ++part) {
      std::int32_t track = -1;
      if (noted.shares[part] < least_share || !track_of(work, selected, place, part, track))
        continue;
      fall_back.tracks.push_back(track);
      fall_back.shares.push_back(noted.shares[part]);
    }
    if (!fall_back.tracks.empty()) result.push_back(std::move(fall_back));
  }
  std::vector<std::uint8_t> unknown = selected;
  for (const std::int32_t track : work.match->tracks) {
    if (track >= 0) unknown[static_cast<std::size_t>(track)] = 0;
  }
  FallBack fall_back;
  fall_back.reason = "the model does not know them";
  for (std::size_t track = 0; track < unknown.size(); ++track) {
    if (unknown[track] != 0) fall_back.tracks.push_back(static_cast<std::int32_t>(track));
  }
  fall_back.shares.assign(fall_back.tracks.size(), 1);
  if (!fall_back.tracks.empty()) result.push_back(std::move(fall_back));
  return result;
}

}  // namespace kinemend
