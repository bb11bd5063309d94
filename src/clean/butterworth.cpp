#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "clean/clip_tracks.hpp"
#include "clean/live_frames.hpp"
#include "clean/marker_tracks.hpp"
#include "clean/method_list.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/representation.hpp"
#include "kinemend/signal.hpp"

namespace kinemend {

namespace {

const OptionTable<ButterworthOptions>& table() {
  static const auto options =
      OptionTable<ButterworthOptions>()
          .integer(&ButterworthOptions::order, "order", "", 1, 12, "order of one direction")
          .number(&ButterworthOptions::cutoff_hz, "cutoff_hz", "Hz", 0.05, 500,
                  "frequency at which one direction lets half the power pass")
          .flag(&ButterworthOptions::causal, "causal",
                "forward only: delays the motion, and runs live");
  return options;
}

// Forward filter of all channels of a frame: J quaternions, the root position, translations.
class ButterworthFrameFilter final : public FrameFilter {
 public:
  explicit ButterworthFrameFilter(std::vector<Biquad> sections) : state_(std::move(sections)) {}

  void filter(LiveFrame& frame) override {
    if (held_.empty()) start(frame);
    row_.clear();
    for (std::size_t j = 0; j < frame.rotations.size(); ++j) {
      // A joint that was not seen holds its last rotation.
      const bool seen = frame.observed.empty() || frame.observed[j] != 0;
      if (seen) held_[j] = signs_[j].next(frame.rotations[j]);
      const Quat q = held_[j];
      row_.insert(row_.end(), {q.w, q.x, q.y, q.z});
    }
    append(frame.root_position - origin_);
    for (std::size_t i = 0; i < origins_.size(); ++i) {
      append(frame.joint_translations[i] - origins_[i]);
    }
    state_.step(row_);
    const double* next = row_.data();
    for (Quat& q : frame.rotations) {
      q = normalized({next[0], next[1], next[2], next[3]});
      next += 4;
    }
    frame.root_position = origin_ + Vec3{next[0], next[1], next[2]};
    for (std::size_t i = 0; i < origins_.size(); ++i) {
      next += 3;
      frame.joint_translations[i] = origins_[i] + Vec3{next[0], next[1], next[2]};
    }
  }

 private:
  void start(const LiveFrame& frame) {
    held_ = frame.rotations;
    signs_.resize(held_.size());
    origin_ = frame.root_position;
    origins_ = frame.joint_translations;
  }
  void append(Vec3 p) { row_.insert(row_.end(), {p.x, p.y, p.z}); }

  CausalState state_;
  std::vector<Quat> held_;
  std::vector<SignContinuation> signs_;
  Vec3 origin_;
  std::vector<Vec3> origins_;
  std::vector<double> row_;
};

// Forward filter of one marker. What was not seen holds its last place.
class ButterworthTrack {
 public:
  explicit ButterworthTrack(std::vector<Biquad> sections) : state_(std::move(sections)) {}

  Vec3 step(Vec3 position, bool seen) {
    if (!started_ && !seen) return position;
    if (!started_) origin_ = position, started_ = true;
    if (seen) held_ = position;
    const Vec3 p = held_ - origin_;
    double row[] = {p.x, p.y, p.z};
    state_.step(row);
    return origin_ + Vec3{row[0], row[1], row[2]};
  }

 private:
  CausalState state_;
  Vec3 origin_, held_;
  bool started_ = false;
};

class Butterworth final : public Cleaner {
 public:
  explicit Butterworth(const ButterworthOptions& options) : options_(options) {}

  CleanTrace clean(Clip& clip, const Selection& selection) const override {
    if (!acts(clip.frame_rate_hz)) {
      CleanTrace trace;
      trace.warnings.push_back(nothing_to_do(clip.frame_rate_hz));
      return trace;
    }
    if (options_.causal) return clean_causally(*this, clip, selection);
    const auto sections = design(clip.frame_rate_hz);
    const std::size_t pad = settling_frames(sections);
    return clean_channels(clip, selection, ChannelChoice::quaternion, [&](PoseMatrix& channels) {
      filter_zero_phase(channels, sections, pad);
    });
  }

  MarkerTrace clean_markers(MarkerClip& clip, const MarkerSelection& selection) const override {
    if (!acts(clip.frame_rate_hz)) {
      MarkerTrace trace;
      trace.warnings.push_back(nothing_to_do(clip.frame_rate_hz));
      return trace;
    }
    if (options_.causal) return clean_markers_causally(*this, clip, selection);
    const auto sections = design(clip.frame_rate_hz);
    const std::size_t pad = settling_frames(sections);
    return filter_marker_channels(
        clip, selection, [&](PoseMatrix& channels) { filter_zero_phase(channels, sections, pad); });
  }

  LiveSupport live_support(double) const override {
    if (!options_.causal) return {};
    return {LiveSupport::Kind::causal, 0};
  }

  std::unique_ptr<FrameFilter> make_frame_filter(const Skeleton&, double rate_hz) const override {
    if (!options_.causal) return nullptr;
    return std::make_unique<ButterworthFrameFilter>(acts(rate_hz) ? design(rate_hz)
                                                                  : std::vector<Biquad>{});
  }

  std::unique_ptr<MarkerFilter> make_marker_filter(const MarkerClip& like, double) const override {
    if (!options_.causal) return nullptr;
    const double rate_hz = like.frame_rate_hz;
    return std::make_unique<TrackMarkerFilter<ButterworthTrack>>(
        like, ButterworthTrack(acts(rate_hz) ? design(rate_hz) : std::vector<Biquad>{}));
  }

 private:
  std::string nothing_to_do(double rate_hz) const {
    return fmt::format("a cutoff of {} Hz is not below half the frame rate of {} Hz: nothing to do",
                       options_.cutoff_hz, rate_hz);
  }
  bool acts(double rate_hz) const { return options_.cutoff_hz < rate_hz / 2; }
  std::vector<Biquad> design(double rate_hz) const {
    return butterworth_lowpass(static_cast<int>(options_.order), options_.cutoff_hz, rate_hz);
  }

  ButterworthOptions options_;
};

}  // namespace

std::unique_ptr<Cleaner> make_butterworth(const ButterworthOptions& options) {
  table().validate(options);
  return std::make_unique<Butterworth>(options);
}

Method butterworth_method() {
  return {"butterworth", "low-pass filter without delay: fixed cutoff, flat below it",
          "Butterworth 1930; the usual filter of biomechanics (Winter 1974)", table().specs(),
          [](const OptionValues& values) { return make_butterworth(table().parse(values)); }};
}

}  // namespace kinemend
