// Lists the gaps of a take, marks samples as missing, and reads and writes the side file of gaps.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "base/cells.hpp"
#include "kinemend/error.hpp"
#include "kinemend/take.hpp"
#include "motion/names.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace {

template <class IsMissing>
void append_gaps(std::size_t track, std::size_t frames, IsMissing is_missing,
                 std::vector<Gap>& gaps) {
  bool open = false;
  for (std::size_t f = 0; f < frames; ++f) {
    if (!is_missing(f)) {
      open = false;
    } else if (open) {
      gaps.back().last_frame = f;
    } else {
      gaps.push_back({track, f, f});
      open = true;
    }
  }
}

// Calls `mark(track, first, last)` for every track of each gap.
template <class Mark>
void for_each_named(std::span<const NamedGap> gaps, const std::vector<std::string>& names,
                    std::size_t frames, std::int64_t first_number, std::string_view kind,
                    Mark mark) {
  const auto number = [&](std::size_t frame) {
    return static_cast<std::int64_t>(frame) + first_number;
  };
  for (const NamedGap& gap : gaps) {
    if (gap.first_frame > gap.last_frame || gap.last_frame >= frames) {
      throw Error(
          ErrorKind::usage,
          fmt::format("gap of {} \"{}\": frames {} to {} are not in a take of frames {} to {}",
                      kind, gap.name, number(gap.first_frame), number(gap.last_frame), first_number,
                      number(frames) - 1));
    }
    // The exact name is tried first, because an unlabelled marker may be called *12.
    const bool has_name = std::find(names.begin(), names.end(), gap.name) != names.end();
    const std::vector<std::uint8_t> meant =
        has_name ? std::vector<std::uint8_t>{} : names_meant(names, gap.name);
    bool found = false;
    for (std::size_t n = 0; n < names.size(); ++n) {
      if (has_name ? gap.name != names[n] : meant[n] == 0) continue;
      mark(n, gap.first_frame, gap.last_frame);
      found = true;
    }
    if (!found) {
      throw Error(ErrorKind::usage,
                  fmt::format("gap of {} \"{}\": the take has no such {} (it has {})", kind,
                              gap.name, kind, fmt::join(names, ", ")));
    }
  }
}

void mark_gaps_of_joints(Take& clip, std::span<const NamedGap> gaps) {
  const std::size_t joints = clip.joint_count(), positions = clip.point_count();
  for_each_named(gaps, clip.skeleton.names, clip.frame_count(), first_frame_number(clip), "joint",
                 [&](std::size_t joint, std::size_t first, std::size_t last) {
                   if (clip.observed.empty()) clip.observed.assign(clip.rotations.size(), 1);
                   for (std::size_t f = first; f <= last; ++f)
                     clip.observed[f * joints + joint] = 0;
                   const auto position = point_of_joint(clip, joint);
                   const bool stays = joint == 0 && !clip.skeleton.has_position_channels(0);
                   if (!position || stays) return;
                   if (clip.observed_positions.empty())
                     clip.observed_positions.assign(clip.frame_count() * positions, 1);
                   for (std::size_t f = first; f <= last; ++f)
                     clip.observed_positions[f * positions + *position] = 0;
                 });
}

void mark_gaps_of_markers(Take& clip, std::span<const NamedGap> gaps) {
  const std::size_t markers = clip.marker_count();
  for_each_named(gaps, clip.names, clip.frame_count(), first_frame_number(clip), "marker",
                 [&](std::size_t marker, std::size_t first, std::size_t last) {
                   for (std::size_t f = first; f <= last; ++f) {
                     clip.observed[f * markers + marker] = 0;
                     clip.position(f, marker) = {};
                     if (!clip.residuals.empty()) clip.residuals[f * markers + marker] = -1;
                   }
                 });
}

}  // namespace

std::vector<Gap> find_gaps(const Take& take) {
  std::vector<Gap> gaps;
  if (take.observed.empty()) return gaps;
  const std::size_t owners = take.has_joints() ? take.joint_count() : take.marker_count();
  for (std::size_t n = 0; n < owners; ++n) {
    if (!take.has_joints() && !take.holds_positions(n)) continue;
    append_gaps(
        n, take.frame_count(), [&](std::size_t f) { return !take.is_observed(f, n); }, gaps);
  }
  return gaps;
}

std::vector<Gap> find_position_gaps(const Take& clip) {
  std::vector<Gap> gaps;
  if (clip.observed_positions.empty()) return gaps;
  for (std::size_t p = 0; p <= clip.translated_joints.size(); ++p) {
    append_gaps(
        p, clip.frame_count(), [&](std::size_t f) { return !clip.is_position_observed(f, p); },
        gaps);
  }
  return gaps;
}

void mark_gaps(Take& take, std::span<const NamedGap> gaps) {
  if (take.has_joints()) {
    mark_gaps_of_joints(take, gaps);
  } else {
    mark_gaps_of_markers(take, gaps);
  }
}

namespace {

constexpr std::string_view heading = "name,first_frame,last_frame";

bool starts_with_digit(std::string_view text) {
  if (!text.empty() && text.front() == '-') text.remove_prefix(1);
  return !text.empty() && text.front() >= '0' && text.front() <= '9';
}

NamedGap gap_of(const std::vector<std::string>& cells, std::string_view name, std::size_t number,
                std::int64_t first_frame) {
  const auto first = whole_number(cells[1], first_frame);
  const auto last = whole_number(cells[2], first_frame);
  if (!first || !last) {
    throw Error::at_line(name, number,
                         fmt::format("expected a frame number from {}, found \"{}\"", first_frame,
                                     first ? cells[2] : cells[1]));
  }
  if (*last < *first) {
    throw Error::at_line(name, number,
                         fmt::format("the last frame, {}, is before the first, {}", *last, *first));
  }
  return {cells[0], static_cast<std::size_t>(*first - first_frame),
          static_cast<std::size_t>(*last - first_frame)};
}

}  // namespace

std::vector<NamedGap> parse_gaps(std::string_view text, std::string_view name,
                                 std::int64_t first_frame) {
  std::vector<NamedGap> gaps;
  bool may_be_heading = true;
  for (const auto& [number, cells] : cell_lines(text, name)) {
    if (cells.size() != 3) {
      throw Error::at_line(name, number,
                           fmt::format("expected name,first,last, found {} cell{}", cells.size(),
                                       cells.size() == 1 ? "" : "s"));
    }
    const bool is_heading =
        may_be_heading && !starts_with_digit(cells[1]) && !starts_with_digit(cells[2]);
    may_be_heading = false;
    if (!is_heading) gaps.push_back(gap_of(cells, name, number, first_frame));
  }
  return gaps;
}

std::string gaps_text(std::span<const NamedGap> gaps, std::int64_t first_frame) {
  std::string text = fmt::format("{}\n", heading);
  for (const NamedGap& gap : gaps) {
    text += fmt::format("{},{},{}\n", cell_of(gap.name),
                        static_cast<std::int64_t>(gap.first_frame) + first_frame,
                        static_cast<std::int64_t>(gap.last_frame) + first_frame);
  }
  return text;
}

}  // namespace kinemend
