#include <algorithm>
#include <utility>

#include "clean/marker_tracks.hpp"
#include "kinemend/error.hpp"
#include "kinemend/stream.hpp"
#include "stream/refusal.hpp"

namespace kinemend {

namespace {

void check_frame(const MarkerFrame& frame, std::size_t markers) {
  const bool observed = frame.observed.empty() || frame.observed.size() == markers;
  if (frame.positions.size() == markers && observed) return;
  throw Error(ErrorKind::usage, "a live frame does not have the markers of its stream");
}

// Names, kinds and rate.
MarkerClip without_frames(const MarkerClip& like) {
  MarkerClip clip = make_marker_clip(like.names, 0, like.frame_rate_hz);
  if (!like.is_position.empty()) clip.is_position = like.is_position;
  clip.unit = like.unit;
  return clip;
}

class CausalMarkerStream final : public MarkerStream {
 public:
  CausalMarkerStream(const Cleaner& cleaner, const MarkerClip& like, double body_height)
      : cleaner_(cleaner), like_(without_frames(like)), body_height_(body_height) {
    reset();
  }

  std::size_t latency_frames() const override { return 0; }
  bool push(const MarkerFrame& in, MarkerFrame& out) override {
    check_frame(in, like_.marker_count());
    out = in;
    filter_->filter(out);
    for (std::size_t m = 0; m < like_.marker_count(); ++m) {
      if (like_.is_position[m] == 0) out.positions[m] = in.positions[m];
    }
    return true;
  }
  bool flush(MarkerFrame&) override { return false; }
  void reset() override { filter_ = cleaner_.make_marker_filter(like_, body_height_); }

 private:
  const Cleaner& cleaner_;
  MarkerClip like_;
  double body_height_;
  std::unique_ptr<MarkerFilter> filter_;
};

// Keeps the frames that the next result depends on, as the stream of joints does.
class WindowedMarkerStream final : public MarkerStream {
 public:
  WindowedMarkerStream(const Cleaner& cleaner, const MarkerClip& like, double body_height,
                       std::size_t half)
      : cleaner_(cleaner), half_(half), window_(without_frames(like)) {
    selection_.markers.assign(window_.marker_count(), 1);
    selection_.body_height = body_height;
  }

  std::size_t latency_frames() const override { return half_; }

  bool push(const MarkerFrame& in, MarkerFrame& out) override {
    const std::size_t markers = window_.marker_count();
    check_frame(in, markers);
    window_.positions.insert(window_.positions.end(), in.positions.begin(), in.positions.end());
    if (in.observed.empty()) {
      window_.observed.insert(window_.observed.end(), markers, 1);
    } else {
      window_.observed.insert(window_.observed.end(), in.observed.begin(), in.observed.end());
    }
    ++frames_;
    if (next_ + half_ >= frames_) return false;
    give(out);
    return true;
  }

  bool flush(MarkerFrame& out) override {
    if (next_ >= frames_) return false;
    give(out);
    return true;
  }

  void reset() override {
    drop(frames_);
    next_ = 0;
  }

 private:
  void give(MarkerFrame& out) {
    MarkerClip copy = window_;
    cleaner_.clean_markers(copy, selection_);
    const auto width = static_cast<std::ptrdiff_t>(copy.marker_count());
    const auto row = static_cast<std::ptrdiff_t>(next_) * width;
    out.positions.assign(copy.positions.begin() + row, copy.positions.begin() + row + width);
    out.observed.assign(copy.observed.begin() + row, copy.observed.begin() + row + width);
    ++next_;
    if (next_ > half_) {
      drop(next_ - half_);
      next_ = half_;
    }
  }

  // Forgets the oldest frames.
  void drop(std::size_t frames) {
    const auto count = static_cast<std::ptrdiff_t>(frames * window_.marker_count());
    window_.positions.erase(window_.positions.begin(), window_.positions.begin() + count);
    window_.observed.erase(window_.observed.begin(), window_.observed.begin() + count);
    frames_ -= frames;
  }

  const Cleaner& cleaner_;
  std::size_t half_;
  MarkerClip window_;
  MarkerSelection selection_;
  std::size_t frames_ = 0;  // in the window
  std::size_t next_ = 0;    // the frame of the window that comes out next
};

}  // namespace

std::unique_ptr<MarkerStream> make_marker_stream(const Cleaner& cleaner, const MarkerClip& like,
                                                 double body_height) {
  const double rate_hz = like.frame_rate_hz;
  const LiveSupport support = cleaner.live_support(rate_hz);
  switch (support.kind) {
    case LiveSupport::Kind::causal:
      if (!cleaner.make_marker_filter(like, body_height)) {
        throw Error(ErrorKind::usage, "this method runs live on joints, not on markers");
      }
      return std::make_unique<CausalMarkerStream>(cleaner, like, body_height);
    case LiveSupport::Kind::windowed:
      return std::make_unique<WindowedMarkerStream>(
          cleaner, like, body_height,
          support.half_window_frames + longest_bridge(rate_hz) + bridge_support(rate_hz) + 1);
    case LiveSupport::Kind::none:
      break;
  }
  refuse_whole_take_method();
}

}  // namespace kinemend
