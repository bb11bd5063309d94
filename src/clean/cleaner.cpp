#include "kinemend/cleaner.hpp"

#include "clean/live_frames.hpp"

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
      return "foot-adjusted";
    case Action::refused:
      return "refused";
  }
  return "unknown";
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

}  // namespace kinemend
