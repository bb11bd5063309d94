// Writes C3D into the bytes of its source if they can hold the take, else as a new file. Compares
// the frames of a take with its source's, and lists the data that is lost.
#include "io/c3d/c3d.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/text/text.hpp"

namespace kinemend {

namespace {

// Relative tolerance; chosen by hand, not swept.
constexpr double rounding = 1e-6;

bool has_analog(const C3dLayout& layout) {
  return layout.analog_values > 0 && layout.frame_count > 0;
}

// Whether the channels of analog values are known; in a damaged file they may not be.
bool knows_channels(const C3dLayout& layout) {
  return layout.analog_count * layout.analog_instants() == layout.analog_values;
}

double analog_rate_hz(const C3dDocument& source) {
  return source.frame_rate_hz * static_cast<double>(source.layout.analog_instants());
}

// Returns the analog instants per frame of the clip at the source's analog rate; 0 if that is not a
// whole number.
std::size_t instants_at(double frame_rate_hz, const C3dDocument& source) {
  const double ratio = analog_rate_hz(source) / frame_rate_hz, whole = std::round(ratio);
  const bool fits = whole >= 1 && std::fabs(ratio - whole) <= rounding * whole &&
                    whole * static_cast<double>(source.layout.analog_count) <= most_in_a_word;
  return fits ? static_cast<std::size_t>(whole) : 0;
}

// Returns how many bytes follow the frames and the padding of their last block.
std::size_t bytes_behind(const C3dDocument& source) {
  const std::string_view bytes = source.bytes;
  const std::size_t end = std::min(source.layout.data_end(), bytes.size());
  const std::size_t last = bytes.find_last_not_of('\0');
  const std::size_t block_end =
      source.layout.header_begin +
      (end - source.layout.header_begin + c3d_block_bytes - 1) / c3d_block_bytes * c3d_block_bytes;
  return last == bytes.npos || last < block_end ? 0 : last + 1 - block_end;
}

std::string analog_text(const C3dDocument& source) {
  return fmt::format("{} at {:g} Hz", count_text(source.layout.analog_count, "analog channel"),
                     analog_rate_hz(source));
}

void add_analog_losses(const Take& clip, const C3dOrigin& origin, Diagnostics& losses) {
  const C3dDocument& source = *origin.document;
  const C3dLayout& layout = source.layout;
  if (!has_analog(layout)) return;
  const C3dCarried carried = c3d_carried(clip, origin);
  if (carried.analog_count == 0) {
    losses.add("analog_lost",
               !knows_channels(layout) ? "analog values without a channel are left out"
               : !carried.follows_frames
                   ? fmt::format("{} are left out: the frames are not those of the source",
                                 analog_text(source))
                   : fmt::format("{} are left out: their rate is not a multiple of {:g} Hz",
                                 analog_text(source), clip.frame_rate_hz));
    const std::size_t plates = source.parameters.count("FORCE_PLATFORM", "USED").value_or(0);
    if (plates > 0) {
      losses.add("force_plates_lost",
                 fmt::format("{} {} left out with the analog channels",
                             count_text(plates, "force plate"), plates == 1 ? "is" : "are"));
    }
    return;
  }
  const std::size_t wanted = c3d_frame_count(clip, origin) * carried.analog_instants;
  const std::size_t there = layout.frame_count * layout.analog_instants();
  if (wanted > there) {
    losses.add("analog_held", fmt::format("the last frame reaches {} analog samples beyond the "
                                          "last measured one, which is repeated",
                                          wanted - there));
  } else if (wanted < there) {
    losses.add("analog_cut", fmt::format("{} analog samples of each channel after the last frame "
                                         "are left out",
                                         there - wanted));
  }
}

// Whether the clip has the layout of its source, which was not converted.
bool has_source_layout(const Take& clip, const C3dOrigin& origin) {
  return origin.document != nullptr && !origin.converted &&
         keeps_c3d_layout(clip, *origin.document);
}

// Whether all samples fit into the source's integers. If not, a trial rewrite decides, because
// unchanged samples need not fit.
bool samples_fit(const Take& clip, const C3dLayout& layout) {
  if (layout.is_float) return true;
  constexpr double most_steps = 32767;
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    if (clip.observed[i] == 0) continue;
    const Vec3 p = clip.positions[i];
    const double most = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    if (!(most / layout.scale < most_steps)) return false;
  }
  return true;
}

// Whether the clip can be written into the bytes of its source, changing only samples and rate.
bool goes_in_place(const Take& clip, const C3dOrigin& origin) {
  return has_source_layout(clip, origin) && (samples_fit(clip, origin.document->layout) ||
                                             rewrite_c3d(clip, *origin.document).has_value());
}

}  // namespace

std::size_t C3dCarried::source_frame(std::size_t frame, std::size_t source_count) const {
  const double place = std::floor(static_cast<double>(frame) * source_frames + rounding);
  return std::min(static_cast<std::size_t>(place), source_count - 1);
}

std::size_t c3d_frame_count(const Take& clip, const C3dOrigin& origin) {
  // A file with only analog samples has frames, but a clip without markers does not.
  const bool no_points =
      origin.document != nullptr && clip.marker_count() + origin.document->layout.point_count == 0;
  return no_points ? origin.document->layout.frame_count : clip.frame_count();
}

C3dCarried c3d_carried(const Take& clip, const C3dOrigin& origin) {
  C3dCarried carried;
  if (origin.document == nullptr) return carried;
  const C3dDocument& source = *origin.document;
  const C3dLayout& layout = source.layout;
  carried.follows_frames =
      origin.change.resampled || c3d_frame_count(clip, origin) == layout.frame_count;
  if (!carried.follows_frames || layout.frame_count == 0) return carried;
  carried.keeps_words = clip.names == source.names;
  if (origin.change.resampled) carried.source_frames = source.frame_rate_hz / clip.frame_rate_hz;
  if (!has_analog(layout) || !knows_channels(layout)) return carried;
  carried.analog_instants =
      origin.change.resampled ? instants_at(clip.frame_rate_hz, source) : layout.analog_instants();
  carried.analog_count = carried.analog_instants > 0 ? layout.analog_count : 0;
  return carried;
}

Diagnostics lost_in_c3d(const Take& clip) {
  const C3dOrigin origin = c3d_origin(clip.source);
  Diagnostics losses;
  if (origin.document == nullptr || goes_in_place(clip, origin)) return losses;
  add_analog_losses(clip, origin, losses);
  if (const std::string encoding = c3d_encoding(*origin.document); encoding != "Intel reals")
    losses.add("encoding_changed", encoding + " are saved as Intel floats");
  const C3dParameters& parameters = origin.document->parameters;
  if (parameters.has_group("ROTATION")) {
    losses.add("rotations_lost", fmt::format("rotations of {} segments are left out",
                                             parameters.count("ROTATION", "USED").value_or(0)));
  } else if (parameters.has_group("DATA_BLOCKS")) {
    losses.add("data_blocks_lost", "the data of the group DATA_BLOCKS is left out");
  } else if (const std::size_t bytes = bytes_behind(*origin.document); bytes > 0) {
    losses.add("bytes_lost", fmt::format("{} bytes after the frames are left out", bytes));
  }
  return losses;
}

std::vector<std::string> c3d_beside_points(const SourceInfo& source) {
  const C3dDocument* const document = c3d_origin(source).document;
  if (document == nullptr) return {};
  const C3dParameters& parameters = document->parameters;
  std::vector<std::string> parts;
  if (has_analog(document->layout)) parts.push_back(analog_text(*document));
  const auto add_count = [&](const char* group, const char* what) {
    const std::size_t count = parameters.count(group, "USED").value_or(0);
    if (count > 0) parts.push_back(count_text(count, what));
  };
  add_count("FORCE_PLATFORM", "force plate");
  add_count("ROTATION", "segment's rotation");
  std::string groups;
  for (const C3dGroup& group : parameters.groups) {
    const auto is = [&](std::string_view name) { return equal_ignoring_case(group.name, name); };
    const bool said = is("POINT") || is("ANALOG") || is("FORCE_PLATFORM") || is("ROTATION") ||
                      is("EVENT") || is("EVENTS") || is("EVENT_CONTEXT") || is("TRIAL");
    const bool is_empty =
        std::none_of(parameters.entries.begin(), parameters.entries.end(),
                     [&](const C3dParameter& entry) { return entry.group == group.number; });
    if (!said && !is_empty) groups += (groups.empty() ? "" : ", ") + as_utf8(group.name);
  }
  if (!groups.empty()) parts.push_back("the parameters of " + groups);
  return parts;
}

std::string write_c3d(const Take& clip) {
  clip.validate();
  const C3dOrigin origin = c3d_origin(clip.source);
  if (has_source_layout(clip, origin)) {
    if (std::optional<std::string> bytes = rewrite_c3d(clip, *origin.document))
      return *std::move(bytes);
  }
  return new_c3d(clip, origin);
}

}  // namespace kinemend
