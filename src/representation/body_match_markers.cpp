#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/quantiles.hpp"
#include "kinemend/error.hpp"
#include "representation/body_anchors.hpp"
#include "representation/body_correspondence.hpp"
#include "representation/body_names.hpp"
#include "representation/body_rest.hpp"

namespace kinemend {

namespace representation {

namespace {

constexpr std::size_t most_frames = 64;

// Where `Subject36_LASI` is LASI.
std::string after_underscore(std::string_view name) {
  const std::size_t at = name.find_last_of('_');
  return at == name.npos ? std::string() : plain_name(name.substr(at + 1));
}

std::vector<std::size_t> seen_often(const MarkerClip& clip) {
  std::vector<std::size_t> seen(clip.marker_count());
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t m = 0; m < clip.marker_count(); ++m) seen[m] += clip.is_observed(f, m) ? 1 : 0;
  }
  return seen;
}

std::vector<std::pair<std::size_t, std::size_t>> anchors_of(const BodyLayout& layout,
                                                            const BodyMatch& match) {
  std::vector<std::pair<std::size_t, std::size_t>> anchors;  // part, marker
  for (std::size_t i = 0; i < layout.part_count(); ++i) {
    if (layout.anchors[i] != 0 && match.parts[i] >= 0)
      anchors.emplace_back(i, static_cast<std::size_t>(match.parts[i]));
  }
  return anchors;
}

// How the person stands most of the time tells what is up.
Quat upright_by_anchors(const MarkerClip& clip, const BodyLayout& layout, const BodyMatch& match) {
  const std::size_t frames = clip.frame_count(), sampled = std::min(frames, most_frames);
  Vec3 up;
  for (std::size_t i = 0; i < sampled; ++i) {
    if (const auto fit = fit_frame(clip, layout, match, i * frames / sampled))
      up += rotate(fit->rotation, {0, 1, 0});
  }
  return shortest_rotation(nearest_axis(up), {0, 1, 0});
}

// The median of how much longer distances between anchors are than in the layout.
double stature_by_anchors(const MarkerClip& clip, const BodyLayout& layout,
                          const BodyMatch& match) {
  constexpr double least_distance = 0.03;  // statures
  const auto anchors = anchors_of(layout, match);
  const std::size_t frames = clip.frame_count(), sampled = std::min(frames, most_frames);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < sampled; ++i) {
    const std::size_t f = i * frames / sampled;
    for (std::size_t a = 0; a < anchors.size(); ++a) {
      for (std::size_t b = a + 1; b < anchors.size(); ++b) {
        const double expected =
            norm(layout.shape[anchors[a].first] - layout.shape[anchors[b].first]);
        if (expected < least_distance || !clip.is_observed(f, anchors[a].second) ||
            !clip.is_observed(f, anchors[b].second))
          continue;
        ratios.push_back(
            norm(clip.position(f, anchors[a].second) - clip.position(f, anchors[b].second)) /
            expected);
      }
    }
  }
  const double ratio = median_of(ratios);
  return ratio > 0 ? ratio : body_height(clip);
}

std::vector<std::int32_t> feet_of(const BodyLayout& layout, const MarkerClip& clip,
                                  const std::vector<std::int32_t>& parts) {
  constexpr double foot_height = 0.1;  // statures
  const std::vector<std::size_t> seen = seen_often(clip);
  std::vector<std::int32_t> feet;
  for (std::size_t i = 0; i < layout.part_count(); ++i) {
    if (parts[i] >= 0 && layout.means[i].y < foot_height &&
        2 * seen[static_cast<std::size_t>(parts[i])] > clip.frame_count())
      feet.push_back(parts[i]);
  }
  return feet;
}

}  // namespace

std::vector<std::int32_t> match_markers(const BodyLayout& layout, const MarkerClip& clip,
                                        const NameMap& map) {
  MappedParts mapped = mapped_parts(layout, clip.names, map);
  const std::vector<std::size_t> seen = seen_often(clip);
  std::vector<std::string> plain, tails;
  for (const std::string& name : clip.names) {
    plain.push_back(plain_name(name));
    tails.push_back(after_underscore(name));
  }
  const auto match_by = [&](const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < layout.part_count(); ++i) {
      if (mapped.settled[i] != 0) continue;
      const std::string wanted = plain_name(layout.names[i]);
      // Of several of one name, the one that is seen most.
      std::size_t best = names.size();
      for (std::size_t m = 0; m < names.size(); ++m) {
        if (mapped.used[m] != 0 || !clip.holds_positions(m) || names[m] != wanted) continue;
        if (best == names.size() || seen[m] > seen[best]) best = m;
      }
      if (best == names.size()) continue;
      mapped.parts[i] = static_cast<std::int32_t>(best);
      mapped.settled[i] = 1;
      mapped.used[best] = 1;
    }
  };
  match_by(plain);
  match_by(tails);
  return std::move(mapped.parts);
}

}  // namespace representation

BodyMatch match_body(const BodyLayout& layout, const MarkerClip& clip, const NameMap& names) {
  using namespace representation;
  check_kind(layout, BodyKind::markers);
  BodyMatch match;
  match.parts = match_markers(layout, clip, names);
  list_unmatched(layout, clip.names, possible_parts(clip), match);
  if (anchors_of(layout, match).size() < 3) {
    throw Error(ErrorKind::usage,
                fmt::format("fewer than three of the markers that tell where the body stands are "
                            "in the take; it lacks {}",
                            fmt::join(match.missing, ", ")));
  }
  match.stature = stature_by_anchors(clip, layout, match);
  match.upright = upright_by_anchors(clip, layout, match);
  match.feet = feet_of(layout, clip, match.parts);
  return match;
}

}  // namespace kinemend
