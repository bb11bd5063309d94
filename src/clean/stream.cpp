// Checks the frames of a stream and passes them to the live filter of the cleaner.
#include "kinemend/live.hpp"

#include <utility>

#include "kinemend/error.hpp"

namespace kinemend {

namespace {

Take without_frames(const Take& like) {
  Take take;
  take.skeleton = like.skeleton;
  take.translated_joints = like.translated_joints;
  take.names = like.names;
  take.is_position = like.is_position;
  take.unit = like.unit;
  take.frame_rate_hz = like.frame_rate_hz;
  return take;
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

Stream::Stream(const Cleaner& cleaner, Take like, const Selection& selection)
    : cleaner_(cleaner),
      like_(std::move(like)),
      view_(view_of(like_, selection)),
      filter_(cleaner.live(view_)) {}

bool Stream::push(const Frame& in, Frame& out) {
  check_frame(in, view_);
  return filter_->push(in, out);
}

std::unique_ptr<Stream> make_stream(const Cleaner& cleaner, const Take& like, double body_height,
                                    Source source) {
  Selection selection;
  selection.source = source_of(like, source).source;
  selection.body_height = body_height;
  return std::make_unique<Stream>(cleaner, without_frames(like), selection);
}

}  // namespace kinemend
