// Finds the markers of a layout in a take by name, and the person with the most matches.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "base/frame_span.hpp"
#include "base/quantiles.hpp"
#include "body/body_anchors.hpp"
#include "body/body_correspondence.hpp"
#include "body/body_names.hpp"
#include "body/body_rest.hpp"
#include "kinemend/error.hpp"
#include "motion/names.hpp"

namespace kinemend {

namespace representation {

namespace {

// Frames are evenly spread, for speed; not swept.
constexpr std::size_t most_frames = 64;

// Returns LASI for `Subject36_LASI`.
std::string after_underscore(std::string_view name) {
  const std::size_t at = name.find_last_of('_');
  return at == name.npos ? std::string() : plain_name(name.substr(at + 1));
}

std::vector<std::size_t> seen_often(const Take& clip) {
  std::vector<std::size_t> seen(clip.marker_count());
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t m = 0; m < clip.marker_count(); ++m) seen[m] += clip.is_observed(f, m) ? 1 : 0;
  }
  return seen;
}

std::vector<std::pair<std::size_t, std::size_t>> anchors_of(const BodyLayout& layout,
                                                            const BodyMatch& match) {
  std::vector<std::pair<std::size_t, std::size_t>> anchors;  // track, marker
  for (std::size_t i = 0; i < layout.track_count(); ++i) {
    if (layout.anchors[i] != 0 && match.tracks[i] >= 0)
      anchors.emplace_back(i, static_cast<std::size_t>(match.tracks[i]));
  }
  return anchors;
}

// Finds the up direction from how the person stands most of the time.
Quat upright_by_anchors(const Take& clip, const BodyLayout& layout, const BodyMatch& match) {
  Vec3 up;
  for (const std::size_t f : evenly_spread(clip.frame_count(), most_frames)) {
    if (const auto fit = fit_frame(clip, layout, match, f)) up += rotate(fit->rotation, {0, 1, 0});
  }
  return shortest_rotation(nearest_axis(up), {0, 1, 0});
}

// Returns the median ratio of distances between anchors to those in the layout.
double body_height_by_anchors(const Take& clip, const BodyLayout& layout, const BodyMatch& match) {
  // Anchors closer together give no reliable ratio. Chosen by hand, not swept.
  constexpr double least_distance = 0.03;  // body heights
  const auto anchors = anchors_of(layout, match);
  std::vector<double> ratios;
  for (const std::size_t f : evenly_spread(clip.frame_count(), most_frames)) {
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

std::vector<std::int32_t> feet_of(const BodyLayout& layout, const Take& clip,
                                  const std::vector<std::int32_t>& tracks) {
  // Markers below this height on the model belong to feet. Chosen by hand, not swept.
  constexpr double foot_height = 0.1;  // body heights
  const std::vector<std::size_t> seen = seen_often(clip);
  std::vector<std::int32_t> feet;
  for (std::size_t i = 0; i < layout.track_count(); ++i) {
    if (tracks[i] >= 0 && layout.means[i].y < foot_height &&
        2 * seen[static_cast<std::size_t>(tracks[i])] > clip.frame_count())
      feet.push_back(tracks[i]);
  }
  return feet;
}

class MarkerMatcher {
 public:
  MarkerMatcher(const BodyLayout& layout, const Take& clip, const NameMap& map)
      : clip_(clip), mapped_(mapped_tracks(layout, clip.names, map)), seen_(seen_often(clip)) {
    for (const std::string& name : layout.names) {
      known_.push_back(plain_name(name));
      known_tails_.push_back(after_underscore(name));
    }
    for (const std::string& name : clip.names) {
      found_.push_back(plain_name(name));
      found_tails_.push_back(after_underscore(name));
    }
    choose_subject();
  }

  std::vector<std::int32_t> match() {
    match_by(known_, found_);
    match_by(known_, found_tails_);
    match_by(known_tails_, found_);
    return std::move(mapped_.tracks);
  }

 private:
  bool is_known(const std::string& name) const {
    return !name.empty() && std::find(known_.begin(), known_.end(), name) != known_.end();
  }

  // Chooses the person with the most known markers; the first one if several have the same number.
  void choose_subject() {
    std::map<std::string_view, std::size_t> counts;
    for (std::size_t m = 0; m < found_.size(); ++m) {
      if (!is_known(found_[m])) continue;
      ++counts[subject_part(clip_.names[m])];
    }
    std::size_t most = 0;
    for (const std::string& name : clip_.names) {
      const auto found = counts.find(subject_part(name));
      if (found == counts.end() || found->second <= most) continue;
      most = found->second;
      subject_ = found->first;
    }
  }

  bool is_candidate(std::size_t marker) const {
    const std::string_view subject = subject_part(clip_.names[marker]);
    return mapped_.used[marker] == 0 && clip_.holds_positions(marker) &&
           (subject.empty() || subject == subject_);
  }

  // Matches by name; of several markers with one name, the most seen one is taken.
  void match_by(const std::vector<std::string>& known, const std::vector<std::string>& found) {
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (mapped_.settled[i] != 0 || known[i].empty()) continue;
      std::size_t best = found.size();
      for (std::size_t m = 0; m < found.size(); ++m) {
        if (found[m] != known[i] || !is_candidate(m)) continue;
        if (best == found.size() || seen_[m] > seen_[best]) best = m;
      }
      if (best == found.size()) continue;
      mapped_.tracks[i] = static_cast<std::int32_t>(best);
      mapped_.settled[i] = 1;
      mapped_.used[best] = 1;
    }
  }

  const Take& clip_;
  MappedTracks mapped_;
  std::vector<std::size_t> seen_;
  std::vector<std::string> known_, known_tails_, found_, found_tails_;
  std::string_view subject_;
};

}  // namespace

std::vector<std::int32_t> match_markers(const BodyLayout& layout, const Take& clip,
                                        const NameMap& map) {
  return MarkerMatcher(layout, clip, map).match();
}

BodyMatch match_body_of_markers(const BodyLayout& layout, const Take& clip, const NameMap& names) {
  check_kind(layout, BodyKind::markers);
  BodyMatch match;
  match.tracks = match_markers(layout, clip, names);
  list_unmatched(layout, clip.names, possible_tracks(clip), match);
  if (anchors_of(layout, match).size() < 3) {
    throw Error(ErrorKind::usage,
                fmt::format("fewer than three of the markers that tell where the body stands are "
                            "in the take; it lacks {}",
                            fmt::join(match.missing, ", ")));
  }
  match.body_height = body_height_by_anchors(clip, layout, match);
  match.upright = upright_by_anchors(clip, layout, match);
  match.feet = feet_of(layout, clip, match.tracks);
  return match;
}

}  // namespace representation

}  // namespace kinemend
