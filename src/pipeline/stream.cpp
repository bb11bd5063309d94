#include "kinemend/stream.hpp"

#include <utility>

#include "kinemend/error.hpp"

namespace kinemend {

namespace {

Clip without_frames(const Clip& like) {
  Clip clip;
  clip.skeleton = like.skeleton;
  clip.frame_rate_hz = like.frame_rate_hz;
  clip.translated_joints = like.translated_joints;
  return clip;
}

MarkerClip without_frames(const MarkerClip& like) {
  MarkerClip clip = make_marker_clip(like.names, 0, like.frame_rate_hz);
  if (!like.is_position.empty()) clip.is_position = like.is_position;
  clip.unit = like.unit;
  return clip;
}

void check_frame(const Frame& frame, const TakeView& like) {
  const std::size_t rotations = like.joints ? like.owners : 0;
  const std::size_t positions = like.tracks.size() - rotations;
  const bool observed = frame.observed.empty() || frame.observed.size() == like.owners;
  if (frame.rotations.size() == rotations && frame.positions.size() == positions && observed)
    return;
  throw Error(ErrorKind::usage, like.joints
                                    ? "a live frame does not have the joints of its stream"
                                    : "a live frame does not have the markers of its stream");
}

}  // namespace

Stream::Stream(const Cleaner& cleaner, std::variant<Clip, MarkerClip> like,
               const Selection& selection)
    : cleaner_(cleaner),
      like_(std::move(like)),
      view_(std::visit([&](const auto& take) { return view_of(take, selection); }, like_)),
      filter_(cleaner.live(view_)) {}

bool Stream::push(const Frame& in, Frame& out) {
  check_frame(in, view_);
  return filter_->push(in, out);
}

std::unique_ptr<Stream> make_stream(const Cleaner& cleaner, const Clip& like) {
  return std::make_unique<Stream>(cleaner, without_frames(like), Selection{});
}

std::unique_ptr<Stream> make_stream(const Cleaner& cleaner, const MarkerClip& like,
                                    double body_height) {
  Selection selection;
  selection.body_height = body_height;
  return std::make_unique<Stream>(cleaner, without_frames(like), selection);
}

}  // namespace kinemend
