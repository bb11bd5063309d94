#include "kinemend/cleaner.hpp"

#include <utility>

#include "clean/clip_tracks.hpp"
#include "clean/live_frames.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

std::string_view to_string(Action action) {
  switch (action) {
    case Action::kept:
      return "kept";
    case Action::denoised:
      return "denoised";
    case Action::despiked:
      return "despiked";
    case Action::filled:
      return "filled";
    case Action::foot_adjusted:
      return "foot_adjusted";
    case Action::refused:
      return "refused";
  }
  return "unknown";
}

MarkerSelection MarkerSelection::all(const MarkerClip& clip) {
  return {std::vector<std::uint8_t>(clip.marker_count(), 1), kinemend::body_height(clip)};
}

CleanTrace Cleaner::clean_joints(Clip& clip, const Selection& selection, const JointSink& sink,
                                 const std::function<void(double)>& /*progress*/) const {
  Clip cleaned = clip;
  CleanTrace trace = clean(cleaned, selection);
  hand_over(clip, std::move(cleaned), sink, trace);
  return trace;
}

MarkerTrace Cleaner::clean_markers(MarkerClip&, const MarkerSelection&) const {
  throw Error(ErrorKind::usage, "this method works on joints, not on markers");
}

LiveSupport Cleaner::live_support(double) const { return {}; }

LiveFrame Cleaner::clean_frame(const Clip& window, std::size_t frame) const {
  Clip copy = window;
  clean(copy, Selection::all(copy));
  return frame_of(copy, frame);
}

std::unique_ptr<FrameFilter> Cleaner::make_frame_filter(const Skeleton&, double) const {
  return nullptr;
}

std::unique_ptr<MarkerFilter> Cleaner::make_marker_filter(const MarkerClip&, double) const {
  return nullptr;
}

}  // namespace kinemend
