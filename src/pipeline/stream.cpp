#include "kinemend/stream.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "kinemend/error.hpp"
#include "methods/core/inner_filter.hpp"
#include "methods/core/pieces.hpp"

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

// The number of rotations and positions of frames.
struct FrameShape {
  bool of_joints = true;
  std::size_t rotations = 0, positions = 0;

  explicit FrameShape(const TakeView& like)
      : of_joints(like.joints != nullptr),
        rotations(of_joints ? like.owners : 0),
        positions(like.tracks.size() - rotations) {}

  void check(const Frame& frame) const {
    const std::size_t owners = of_joints ? rotations : positions;
    const bool observed = frame.observed.empty() || frame.observed.size() == owners;
    if (frame.rotations.size() == rotations && frame.positions.size() == positions && observed)
      return;
    throw Error(ErrorKind::usage, of_joints
                                      ? "a live frame does not have the joints of its stream"
                                      : "a live frame does not have the markers of its stream");
  }
};

template <class T>
void append_all(std::vector<T>& values, std::span<const T> more) {
  values.insert(values.end(), more.begin(), more.end());
}

void append_observed(std::vector<std::uint8_t>& values, const Frame& frame, std::size_t owners) {
  if (frame.observed.empty()) {
    values.insert(values.end(), owners, 1);
  } else {
    append_all<std::uint8_t>(values, frame.observed);
  }
}

void append(Clip& window, const Frame& frame) {
  if (!frame.observed.empty() && window.observed.empty())
    window.observed.assign(window.rotations.size(), 1);
  if (!window.observed.empty() || !frame.observed.empty())
    append_observed(window.observed, frame, window.joint_count());
  append_all<Quat>(window.rotations, frame.rotations);
  append_all<Vec3>(window.positions, frame.positions);
}

void append(MarkerClip& window, const Frame& frame) {
  append_all<Vec3>(window.positions, frame.positions);
  append_observed(window.observed, frame, window.marker_count());
}

template <class T>
void drop_rows(std::vector<T>& values, std::size_t rows, std::size_t width) {
  const std::size_t count = std::min(values.size(), rows * width);
  values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
}

// Forgets the oldest frames.
void drop(Clip& window, std::size_t frames) {
  drop_rows(window.positions, frames, window.point_count());
  drop_rows(window.rotations, frames, window.joint_count());
  drop_rows(window.observed, frames, window.joint_count());
}

void drop(MarkerClip& window, std::size_t frames) {
  drop_rows(window.positions, frames, window.marker_count());
  drop_rows(window.observed, frames, window.marker_count());
}

template <class T>
void copy_row(const std::vector<T>& values, std::size_t row, std::size_t width,
              std::vector<T>& result) {
  result.clear();
  if (values.empty()) return;
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(row * width);
  result.assign(first, first + static_cast<std::ptrdiff_t>(width));
}

// A frame of the input.
void copy_frame(const Clip& window, std::size_t frame, Frame& result) {
  copy_row(window.rotations, frame, window.joint_count(), result.rotations);
  copy_row(window.positions, frame, window.point_count(), result.positions);
  copy_row(window.observed, frame, window.joint_count(), result.observed);
}

void copy_frame(const MarkerClip& window, std::size_t frame, Frame& result) {
  result.rotations.clear();
  copy_row(window.positions, frame, window.marker_count(), result.positions);
  copy_row(window.observed, frame, window.marker_count(), result.observed);
}

template <class AnyClip>
class CausalStream final : public Stream {
 public:
  CausalStream(const Cleaner& cleaner, const AnyClip& like, const Selection& selection)
      : cleaner_(cleaner),
        like_(without_frames(like)),
        view_(view_of(like_, selection)),
        shape_(view_) {
    reset();
  }

  std::size_t latency_frames() const override { return 0; }
  bool push(const Frame& in, Frame& out) override {
    shape_.check(in);
    out = in;
    filter_->filter(out);
    return true;
  }
  bool flush(Frame&) override { return false; }
  void reset() override { filter_ = cleaner_.make_frame_filter(view_); }

 private:
  const Cleaner& cleaner_;
  AnyClip like_;
  TakeView view_;
  FrameShape shape_;
  std::unique_ptr<FrameFilter> filter_;
};

template <class AnyClip>
class DelayedStream final : public Stream {
 public:
  DelayedStream(const Cleaner& cleaner, const AnyClip& like, const Selection& selection,
                std::size_t ahead)
      : cleaner_(cleaner),
        like_(without_frames(like)),
        view_(view_of(like_, selection)),
        shape_(view_),
        ahead_(ahead) {
    reset();
  }

  std::size_t latency_frames() const override { return ahead_; }
  bool push(const Frame& in, Frame& out) override {
    shape_.check(in);
    return filter_->push(in, out);
  }
  bool flush(Frame& out) override { return filter_->flush(out); }
  void reset() override { filter_ = cleaner_.make_delayed_filter(view_); }

 private:
  const Cleaner& cleaner_;
  AnyClip like_;
  TakeView view_;
  FrameShape shape_;
  std::size_t ahead_;
  std::unique_ptr<DelayedFilter> filter_;
};

// Keeps the frames that the next result depends on: at most half a window before it and half a
// window after it. At the ends of the stream the window is shorter, as it is at the ends of a take.
// If nothing is missing in the window, some cleaners have a faster form.
template <class AnyClip>
class WindowedStream final : public Stream {
 public:
  // `ahead`: those frames of `half` that the cleaner itself does not use.
  WindowedStream(const Cleaner& cleaner, const AnyClip& like, Selection selection, std::size_t half,
                 std::size_t ahead)
      : cleaner_(cleaner),
        half_(half),
        ahead_(ahead),
        window_(without_frames(like)),
        selection_(std::move(selection)),
        shape_(view_of(window_, selection_)) {
    make_inner();
  }

  std::size_t latency_frames() const override { return half_; }

  bool push(const Frame& in, Frame& out) override {
    shape_.check(in);
    append(window_, in);
    ++frames_;
    const bool is_due = next_ + half_ < frames_;
    if (is_due) copy_frame(window_, next_, out);
    const bool is_clean = feed_inner(is_due ? out : inner_out_) && is_due;
    if (!is_due) return false;
    if (is_clean) {
      advance();
    } else {
      give(out);
    }
    return true;
  }

  bool flush(Frame& out) override {
    if (next_ >= frames_) return false;
    give(out);
    return true;
  }

  void reset() override {
    forget(frames_);
    next_ = 0;
    make_inner();
  }

 private:
  void make_inner() {
    const auto* cleaner = dynamic_cast<const WindowedCleaner*>(&cleaner_);
    const TakeView view = view_of(window_, selection_);
    if (cleaner != nullptr) inner_ = cleaner->make_inner_filter(view);
    inner_out_.rotations.resize(shape_.rotations);
    inner_out_.positions.resize(shape_.positions);
  }

  // Returns whether the next frame of the output is clean.
  bool feed_inner(Frame& out) {
    if (!inner_ || frames_ <= ahead_) return false;
    copy_frame(window_, frames_ - 1 - ahead_, inner_in_);
    return inner_->filter(inner_in_, out);
  }

  void give(Frame& out) {
    out = cleaner_.clean_frame(view_of(window_, selection_), next_);
    advance();
  }

  void advance() {
    ++next_;
    if (next_ > half_) {
      forget(next_ - half_);
      next_ = half_;
    }
  }

  void forget(std::size_t frames) {
    drop(window_, frames);
    frames_ -= frames;
  }

  const Cleaner& cleaner_;
  std::size_t half_, ahead_;
  AnyClip window_;
  Selection selection_;
  FrameShape shape_;
  std::size_t frames_ = 0;  // in the window
  std::size_t next_ = 0;    // the frame of the window that comes out next
  std::unique_ptr<InnerFilter> inner_;
  Frame inner_in_, inner_out_;
};

template <class AnyClip>
std::unique_ptr<Stream> stream_of(const Cleaner& cleaner, const AnyClip& like,
                                  const Selection& selection) {
  const TakeView view = view_of(like, selection);
  const double rate_hz = like.frame_rate_hz;
  const LiveSupport support = cleaner.live_support(rate_hz);
  switch (support.kind) {
    case LiveSupport::Kind::causal:
      if (!cleaner.make_frame_filter(view))
        throw Error(ErrorKind::usage, "this method runs live on joints, not on markers");
      return std::make_unique<CausalStream<AnyClip>>(cleaner, like, selection);
    case LiveSupport::Kind::windowed: {
      const bool cuts = view.gaps == GapTreatment::cut;
      const std::size_t bridge = cuts ? longest_bridge(rate_hz) + bridge_support(rate_hz) + 1 : 0;
      return std::make_unique<WindowedStream<AnyClip>>(cleaner, like, selection,
                                                       support.half_window_frames + bridge, bridge);
    }
    case LiveSupport::Kind::delayed:
      return std::make_unique<DelayedStream<AnyClip>>(cleaner, like, selection,
                                                      support.ahead_frames);
    case LiveSupport::Kind::none:
      if (!support.why_not.empty()) throw Error(ErrorKind::usage, support.why_not);
      break;
  }
  throw Error(ErrorKind::usage,
              "this method needs the whole take; live, use a method with a window or a causal one");
}

}  // namespace

std::unique_ptr<Stream> make_stream(const Cleaner& cleaner, const Clip& like) {
  return stream_of(cleaner, like, {});
}

std::unique_ptr<Stream> make_stream(const Cleaner& cleaner, const MarkerClip& like,
                                    double body_height) {
  Selection selection;
  selection.body_height = body_height;
  return stream_of(cleaner, like, selection);
}

}  // namespace kinemend
