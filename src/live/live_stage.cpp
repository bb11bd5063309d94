// Puts frames in order, interpolates lost ones, and passes them through the stream.
#include "live/live_stage.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kinemend/take.hpp"

namespace kinemend {

namespace {

Take clip_like(const LiveHeader& header) {
  Take clip;
  clip.skeleton = header.skeleton;
  clip.frame_rate_hz = header.frame_rate_hz;
  const MotionColumns columns(header.skeleton);
  clip.translated_joints.assign(columns.translated_joints().begin(),
                                columns.translated_joints().end());
  return clip;
}

std::unique_ptr<FrameReader> reader_of(const LiveHeader& header, const LiveOptions& options) {
  if (header.markers.empty())
    return std::make_unique<JointReader>(header.skeleton, options.numbered, options.skipped_words);
  return std::make_unique<MarkerReader>(header.markers.size(), options.numbered,
                                        options.skipped_words);
}

std::unique_ptr<FrameWriter> writer_of(const LiveHeader& header, LiveFormat format) {
  if (header.markers.empty()) return std::make_unique<JointWriter>(header, format);
  return std::make_unique<MarkerWriter>(header, format);
}

std::unique_ptr<Stream> stream_of(const Cleaner& cleaner, const LiveHeader& header,
                                  const LiveOptions& options) {
  // Axis Neuron sends the recordings of a suit.
  const Source source =
      options.neuron && options.source == Source::unknown ? Source::suit : options.source;
  if (header.markers.empty()) return make_stream(cleaner, clip_like(header), 0, source);
  const Take like = make_marker_take(header.markers, 0, header.frame_rate_hz);
  return make_stream(cleaner, like, options.body_height, source);
}

// Interpolates between two frames. A marker is observed if it is in both.
void go_between(const Frame& from, const Frame& to, double share, Frame& result) {
  result.rotations.resize(from.rotations.size());
  result.positions.resize(from.positions.size());
  result.observed.clear();
  if (from.rotations.empty()) {
    for (std::size_t m = 0; m < from.positions.size(); ++m)
      result.observed.push_back(from.observed[m] != 0 && to.observed[m] != 0 ? 1 : 0);
  }
  for (std::size_t j = 0; j < from.rotations.size(); ++j)
    result.rotations[j] = slerp(from.rotations[j], to.rotations[j], share);
  for (std::size_t i = 0; i < from.positions.size(); ++i)
    result.positions[i] = from.positions[i] + share * (to.positions[i] - from.positions[i]);
}

}  // namespace

LiveStage::LiveStage(const Cleaner& cleaner, const LiveOptions& options, LiveHeader header,
                     const LiveSink& sink, LiveCounts& counts)
    : sink_(sink),
      counts_(counts),
      header_(std::move(header)),
      strength_(options.strength),
      numbered_(options.numbered),
      longest_gap_(
          static_cast<std::size_t>(std::ceil(options.longest_gap_s * header_.frame_rate_hz))),
      reorder_(options.numbered ? options.reorder_frames : 0),
      reader_(reader_of(header_, options)),
      writer_(writer_of(header_, options.format)),
      stream_(stream_of(cleaner, header_, options)),
      waiting_(stream_->latency_frames() + 1),
      changes_(std::max(header_.skeleton.joint_count(), header_.markers.size())) {
  if (options.feet && header_.markers.empty()) feet_.emplace(clip_like(header_));
  const std::string text = writer_->header_text(stream_->latency_frames());
  sink_({true, text});
}

FrameReader::Read LiveStage::take(std::string_view line) {
  const FrameReader::Read read = reader_->read(line);
  if (read != FrameReader::Read::frame) return read;
  const Frame& frame = reader_->frame();
  if (!std::exchange(has_started_, true)) {
    writer_->start_near(reader_->values());
    last_ = frame;
    last_number_ = numbered_ ? reader_->number() - 1 : -1;
    any_number_ = false;
    missed_ = 0;
  }
  const std::int64_t number = numbered_ ? reader_->number() : last_number_ + 1;
  if (may_be_overtaker(number)) {
    keep(number);
  } else {
    // After a jump of the numbers, missing frames will not arrive any more.
    if (std::abs(number - last_number_) > static_cast<std::int64_t>(longest_gap_)) settle();
    counts_.reordered += !overtakers_.empty() && number == last_number_ + 1 ? 1 : 0;
    accept(frame, number, reader_->gaps());
  }
  give_overtakers();
  return read;
}

// Whether earlier frames are missing that may still arrive.
bool LiveStage::may_be_overtaker(std::int64_t number) const {
  const std::int64_t ahead = number - last_number_;
  return reorder_ > 0 && !any_number_ && ahead > 1 &&
         ahead <= static_cast<std::int64_t>(longest_gap_) + 1;
}

void LiveStage::keep(std::int64_t number) {
  const auto place = std::lower_bound(
      overtakers_.begin(), overtakers_.end(), number,
      [](const Overtaker& overtaker, std::int64_t n) { return overtaker.number < n; });
  if (place != overtakers_.end() && place->number == number) {
    ++counts_.doubled;
    return;
  }
  counts_.reordered += place != overtakers_.end() ? 1 : 0;
  overtakers_.insert(place, {reader_->frame(), number, reader_->gaps()});
}

// Gives the frames whose predecessors have arrived, and those that have waited long enough.
void LiveStage::give_overtakers() {
  while (!overtakers_.empty() &&
         (overtakers_.front().number == last_number_ + 1 || overtakers_.size() > reorder_)) {
    take_next_overtaker();
  }
}

void LiveStage::take_next_overtaker() {
  const Overtaker next = std::move(overtakers_.front());
  overtakers_.erase(overtakers_.begin());
  accept(next.frame, next.number, next.gaps);
}

void LiveStage::settle() {
  while (!overtakers_.empty()) take_next_overtaker();
}

void LiveStage::accept(const Frame& frame, std::int64_t number, std::size_t gaps) {
  if (!is_due(frame, number)) return;
  ++counts_.frames_in;
  counts_.not_finite += gaps;
  last_ = frame;
  last_number_ = numbered_ ? number : last_number_ + 1;
  held_ = missed_ = 0;
  push(frame, last_number_);
}

// Interpolates the frames lost before this one. Returns false if the frame is too late.
bool LiveStage::is_due(const Frame& frame, std::int64_t number) {
  const bool may_be_any = std::exchange(any_number_, false);
  if (!numbered_) {
    counts_.lost += missed_;
    make_up(missed_, frame);
    return true;
  }
  const auto longest = static_cast<std::int64_t>(longest_gap_);
  const std::int64_t ahead = number - last_number_;
  if (ahead > 0 && ahead <= longest + 1) {
    counts_.lost += static_cast<std::size_t>(ahead - 1);
    make_up(static_cast<std::size_t>(ahead - 1), frame);
    return true;
  }
  if (may_be_any || ahead > 0 || ahead < -longest) {
    ++counts_.restarts;
    return true;
  }
  ++(ahead == 0 ? counts_.doubled : counts_.late);
  return false;
}

// Repeated frames replace an equal number of lost ones.
void LiveStage::make_up(std::size_t frames, const Frame& before) {
  if (frames <= held_) return;
  const std::size_t count = frames - held_;
  const std::int64_t first = last_number_ + static_cast<std::int64_t>(held_) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    go_between(last_, before, static_cast<double>(i + 1) / static_cast<double>(count + 1), made_);
    push(made_, first + static_cast<std::int64_t>(i));
  }
  counts_.made_up += count;
  if (!numbered_) last_number_ += static_cast<std::int64_t>(frames);
}

void LiveStage::miss() {
  if (!numbered_ && has_started_ && missed_ < longest_gap_) ++missed_;
}

void LiveStage::expect_any_number() {
  settle();
  any_number_ = true;
}

void LiveStage::hold() {
  if (!has_started_) return;
  settle();
  if (header_.markers.empty()) last_.observed.clear();
  ++held_;
  ++counts_.held;
  push(last_, last_number_ + static_cast<std::int64_t>(held_));
}

void LiveStage::finish() {
  if (!has_started_) return;
  settle();
  const std::size_t missed = std::exchange(missed_, 0);
  counts_.lost += missed;
  while (held_ < missed) hold();
  while (stream_->flush(out_)) give();
}

void LiveStage::push(const Frame& frame, std::int64_t number) {
  Waiting& waiting = waiting_[pushed_++ % waiting_.size()];
  waiting.frame = frame;
  waiting.number = number;
  if (stream_->push(frame, out_)) give();
}

void LiveStage::give() {
  const Waiting& waiting = waiting_[given_++ % waiting_.size()];
  note_changes(waiting.frame);
  if (strength_ < 1) blend(waiting.frame);
  if (feet_) feet_->hold(out_.rotations, out_.positions);
  ++counts_.frames_out;
  sink_({false, writer_->write(out_, waiting.number)});
}

// Unmeasured samples have no noise and are skipped.
void LiveStage::note_changes(const Frame& from) {
  const bool joints = !from.rotations.empty();
  for (std::size_t t = 0; t < (joints ? from.rotations.size() : from.positions.size()); ++t) {
    if (!from.observed.empty() && from.observed[t] == 0) continue;
    changes_.add(t, joints ? angle_between(from.rotations[t], out_.rotations[t])
                           : norm(out_.positions[t] - from.positions[t]));
  }
}

std::vector<TrackChange> LiveStage::changes() const {
  const bool joints = header_.markers.empty();
  const std::vector<std::string>& names = joints ? header_.skeleton.names : header_.markers;
  std::vector<TrackChange> all;
  for (std::size_t t = 0; given_ > 0 && t < names.size(); ++t)
    all.push_back({names[t], joints ? degrees_per_radian * changes_.rms(t) : changes_.rms(t)});
  return all;
}

// An unmeasured joint is repaired, and a repair is complete at any strength.
void LiveStage::blend(const Frame& from) {
  for (std::size_t j = 0; j < out_.rotations.size(); ++j) {
    const bool seen = from.is_observed(j);
    if (seen || strength_ == 0)
      out_.rotations[j] = slerp(from.rotations[j], out_.rotations[j], strength_);
  }
  for (std::size_t i = 0; i < out_.positions.size(); ++i) {
    out_.positions[i] = from.positions[i] + strength_ * (out_.positions[i] - from.positions[i]);
  }
}

}  // namespace kinemend
