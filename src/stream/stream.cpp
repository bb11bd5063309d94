#include "kinemend/stream.hpp"

#include <algorithm>
#include <utility>

#include "kinemend/error.hpp"
#include "stream/refusal.hpp"

namespace kinemend {

namespace {

void check_frame(const LiveFrame& frame, std::size_t joints, std::size_t translations) {
  const bool observed = frame.observed.empty() || frame.observed.size() == joints;
  if (frame.rotations.size() == joints && frame.joint_translations.size() == translations &&
      observed) {
    return;
  }
  throw Error(ErrorKind::usage, "a live frame does not have the joints of its stream");
}

class CausalStream final : public Stream {
 public:
  CausalStream(const Cleaner& cleaner, const Clip& like)
      : cleaner_(cleaner),
        skeleton_(like.skeleton),
        frame_rate_hz_(like.frame_rate_hz),
        translations_(like.translated_joints.size()) {
    reset();
  }

  std::size_t latency_frames() const override { return 0; }
  bool push(const LiveFrame& in, LiveFrame& out) override {
    check_frame(in, skeleton_.joint_count(), translations_);
    out = in;
    filter_->filter(out);
    return true;
  }
  bool flush(LiveFrame&) override { return false; }
  void reset() override { filter_ = cleaner_.make_frame_filter(skeleton_, frame_rate_hz_); }

 private:
  const Cleaner& cleaner_;
  Skeleton skeleton_;
  double frame_rate_hz_;
  std::size_t translations_;
  std::unique_ptr<FrameFilter> filter_;
};

// Keeps the frames that the next result depends on: at most half a window behind it and half a
// window ahead. At the ends of the stream the window is cut, as it is at the ends of a take.
class WindowedStream final : public Stream {
 public:
  WindowedStream(const Cleaner& cleaner, const Clip& like, std::size_t half)
      : cleaner_(cleaner), half_(half) {
    window_.skeleton = like.skeleton;
    window_.frame_rate_hz = like.frame_rate_hz;
    window_.translated_joints = like.translated_joints;
  }

  std::size_t latency_frames() const override { return half_; }

  bool push(const LiveFrame& in, LiveFrame& out) override {
    check_frame(in, window_.joint_count(), window_.translated_joints.size());
    append(in);
    if (next_ + half_ >= window_.frame_count()) return false;
    give(out);
    return true;
  }

  bool flush(LiveFrame& out) override {
    if (next_ >= window_.frame_count()) return false;
    give(out);
    return true;
  }

  void reset() override {
    drop(window_.frame_count());
    next_ = 0;
  }

 private:
  void append(const LiveFrame& in) {
    if (!in.observed.empty() && window_.observed.empty()) {
      window_.observed.assign(window_.local_rotations.size(), 1);
    }
    if (!window_.observed.empty() || !in.observed.empty()) {
      const std::vector<std::uint8_t> all(window_.joint_count(), 1);
      const auto& marks = in.observed.empty() ? all : in.observed;
      window_.observed.insert(window_.observed.end(), marks.begin(), marks.end());
    }
    window_.root_positions.push_back(in.root_position);
    window_.local_rotations.insert(window_.local_rotations.end(), in.rotations.begin(),
                                   in.rotations.end());
    window_.joint_translations.insert(window_.joint_translations.end(),
                                      in.joint_translations.begin(), in.joint_translations.end());
  }

  void give(LiveFrame& out) {
    out = cleaner_.clean_frame(window_, next_);
    ++next_;
    if (next_ > half_) {
      drop(next_ - half_);
      next_ = half_;
    }
  }

  // Forgets the oldest frames.
  void drop(std::size_t frames) {
    const auto cut = [frames](auto& values, std::size_t width) {
      const std::size_t count = std::min(values.size(), frames * width);
      values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
    };
    cut(window_.root_positions, 1);
    cut(window_.local_rotations, window_.joint_count());
    cut(window_.joint_translations, window_.translated_joints.size());
    cut(window_.observed, window_.joint_count());
  }

  const Cleaner& cleaner_;
  std::size_t half_;
  Clip window_;
  std::size_t next_ = 0;  // the frame of the window that comes out next
};

}  // namespace

std::unique_ptr<Stream> make_stream(const Cleaner& cleaner, const Clip& like) {
  const LiveSupport support = cleaner.live_support(like.frame_rate_hz);
  switch (support.kind) {
    case LiveSupport::Kind::causal:
      return std::make_unique<CausalStream>(cleaner, like);
    case LiveSupport::Kind::windowed:
      return std::make_unique<WindowedStream>(cleaner, like, support.half_window_frames);
    case LiveSupport::Kind::none:
      break;
  }
  refuse_whole_take_method();
}

}  // namespace kinemend
