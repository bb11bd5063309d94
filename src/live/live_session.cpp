// Runs a live session: splits bytes into lines, and starts a stage for each header, which puts
// frames in order, interpolates lost ones, and passes them through the stream. Lists the methods
// that can clean a live stream.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "feet/live_feet.hpp"
#include "io/motion/motion_write.hpp"
#include "io/text/text.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/sessions.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/live.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/take.hpp"
#include "live/frame_lines.hpp"
#include "live/live_lines.hpp"
#include "live/stream_measures.hpp"

namespace kinemend {

namespace {

// The most notes on bad headers; further ones are only counted. Chosen by hand.
constexpr std::size_t most_header_notes = 3;

void check(const LiveOptions& options) {
  const auto refuse = [](std::string_view what) {
    throw Error(ErrorKind::usage, fmt::format("live: {}", what));
  };
  if (!(options.strength >= 0 && options.strength <= 1)) refuse("strength is outside 0 to 1");
  if (options.frame_rate_hz != 0) check_frame_rate(options.frame_rate_hz);
  if (!(options.body_height > 0 && std::isfinite(options.body_height)))
    refuse("body_height is not above 0");
  if (!(options.longest_gap_s >= 0 && options.longest_gap_s <= 3600))
    refuse("longest_gap_s is outside 0 to 3600 s");
}

bool is_blank(std::string_view line) { return std::all_of(line.begin(), line.end(), is_space); }

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

// Cleans a live stream of one skeleton or one set of markers: takes lines and gives cleaned lines.
// Lost frames are interpolated, so that the output keeps its rate. It has a name outside this file
// because a member of `LiveSession::Work` is one.
class LiveStage {
 public:
  // Writes the header of the output immediately. All arguments except `header` must outlive the
  // stage.
  LiveStage(const Cleaner& cleaner, const LiveOptions& options, LiveHeader header,
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

  const LiveHeader& header() const { return header_; }
  const FrameReader& reader() const { return *reader_; }
  std::size_t latency_frames() const { return stream_->latency_frames(); }
  std::vector<TrackChange> changes() const {
    const bool joints = header_.markers.empty();
    const std::vector<std::string>& names = joints ? header_.skeleton.names : header_.markers;
    std::vector<TrackChange> all;
    for (std::size_t t = 0; given_ > 0 && t < names.size(); ++t)
      all.push_back({names[t], joints ? degrees_per_radian * changes_.rms(t) : changes_.rms(t)});
    return all;
  }

  FrameReader::Read take(std::string_view line) {
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

  // Reports that a malformed line replaced a frame.
  void miss() {
    if (!numbered_ && has_started_ && missed_ < longest_gap_) ++missed_;
  }

  // Reports that the sender restarts: the next frame may have any number.
  void expect_any_number() {
    settle();
    any_number_ = true;
  }

  void hold() {
    if (!has_started_) return;
    settle();
    if (header_.markers.empty()) last_.observed.clear();
    ++held_;
    ++counts_.held;
    push(last_, last_number_ + static_cast<std::int64_t>(held_));
  }

  // Gives the frames that wait for a missing one.
  void settle() {
    while (!overtakers_.empty()) take_next_overtaker();
  }

  // Gives the remaining frames. No frame may follow.
  void finish() {
    if (!has_started_) return;
    settle();
    const std::size_t missed = std::exchange(missed_, 0);
    counts_.lost += missed;
    while (held_ < missed) hold();
    while (stream_->flush(out_)) give();
  }

 private:
  // A frame of the input whose result is not given yet.
  struct Waiting {
    Frame frame;
    std::int64_t number = 0;
  };

  // A frame that arrived before earlier ones, and waits for them.
  struct Overtaker {
    Frame frame;
    std::int64_t number = 0;
    std::size_t gaps = 0;
  };

  // Whether earlier frames are missing that may still arrive.
  bool may_be_overtaker(std::int64_t number) const {
    const std::int64_t ahead = number - last_number_;
    return reorder_ > 0 && !any_number_ && ahead > 1 &&
           ahead <= static_cast<std::int64_t>(longest_gap_) + 1;
  }

  void keep(std::int64_t number) {
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
  void give_overtakers() {
    while (!overtakers_.empty() &&
           (overtakers_.front().number == last_number_ + 1 || overtakers_.size() > reorder_)) {
      take_next_overtaker();
    }
  }

  void take_next_overtaker() {
    const Overtaker next = std::move(overtakers_.front());
    overtakers_.erase(overtakers_.begin());
    accept(next.frame, next.number, next.gaps);
  }

  void accept(const Frame& frame, std::int64_t number, std::size_t gaps) {
    if (!is_due(frame, number)) return;
    ++counts_.frames_in;
    counts_.not_finite += gaps;
    last_ = frame;
    last_number_ = numbered_ ? number : last_number_ + 1;
    held_ = missed_ = 0;
    push(frame, last_number_);
  }

  // Interpolates the frames lost before this one. Returns false if the frame is too late.
  bool is_due(const Frame& frame, std::int64_t number) {
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
  void make_up(std::size_t frames, const Frame& before) {
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

  void push(const Frame& frame, std::int64_t number) {
    Waiting& waiting = waiting_[pushed_++ % waiting_.size()];
    waiting.frame = frame;
    waiting.number = number;
    if (stream_->push(frame, out_)) give();
  }

  void give() {
    const Waiting& waiting = waiting_[given_++ % waiting_.size()];
    note_changes(waiting.frame);
    if (strength_ < 1) blend(waiting.frame);
    if (feet_) feet_->hold(out_.rotations, out_.positions);
    ++counts_.frames_out;
    sink_({false, writer_->write(out_, waiting.number)});
  }

  // Unmeasured samples have no noise and are skipped.
  void note_changes(const Frame& from) {
    const bool joints = !from.rotations.empty();
    for (std::size_t t = 0; t < (joints ? from.rotations.size() : from.positions.size()); ++t) {
      if (!from.observed.empty() && from.observed[t] == 0) continue;
      changes_.add(t, joints ? angle_between(from.rotations[t], out_.rotations[t])
                             : norm(out_.positions[t] - from.positions[t]));
    }
  }

  // An unmeasured joint is repaired, and a repair is complete at any strength.
  void blend(const Frame& from) {
    for (std::size_t j = 0; j < out_.rotations.size(); ++j) {
      const bool seen = from.is_observed(j);
      if (seen || strength_ == 0)
        out_.rotations[j] = slerp(from.rotations[j], out_.rotations[j], strength_);
    }
    for (std::size_t i = 0; i < out_.positions.size(); ++i) {
      out_.positions[i] = from.positions[i] + strength_ * (out_.positions[i] - from.positions[i]);
    }
  }

  const LiveSink& sink_;
  LiveCounts& counts_;
  LiveHeader header_;
  double strength_;
  bool numbered_;
  std::size_t longest_gap_;
  std::size_t reorder_;
  std::unique_ptr<FrameReader> reader_;
  std::unique_ptr<FrameWriter> writer_;
  std::unique_ptr<Stream> stream_;
  std::vector<Waiting> waiting_;  // a ring buffer
  std::size_t pushed_ = 0, given_ = 0;
  std::vector<Overtaker> overtakers_;  // by number, at most `reorder_` between calls
  RunningChanges changes_;             // for joints in radians, or for markers
  std::optional<feet::LiveFeet> feet_;
  Frame last_, made_, out_;
  std::int64_t last_number_ = -1;
  std::size_t missed_ = 0;  // frames without a number that were lost since the last frame
  std::size_t held_ = 0;    // repeated frames since the last frame
  bool has_started_ = false;
  bool any_number_ = false;
};

class LiveSession::Work {
 public:
  Work(const Cleaner& cleaner, const LiveOptions& options, LiveSink sink)
      : cleaner_(cleaner),
        options_(options),
        sink_(std::move(sink)),
        splitter_(options.most_line_bytes),
        header_lines_(options.most_header_bytes) {
    check(options_);
    if (const LiveSupport support = cleaner_.live_support(120); !support.runs())
      throw Error(ErrorKind::usage, support.why_not);
    if (options_.skeleton.empty()) return;
    LiveHeader header = read_live_header(options_.skeleton, "skeleton", options_.frame_rate_hz);
    header.frames = 0;  // the number in the stream is unknown
    open(std::move(header));
  }

  void feed(std::string_view bytes) {
    std::string_view line;
    while (!bytes.empty()) take(splitter_.next(bytes, ends_with_bars(), line), line);
  }

  void end_line() {
    std::string_view line;
    if (!collects_) take(splitter_.end(line), line);
  }

  void drop_line() {
    splitter_.drop();
    header_lines_.clear();
    collects_ = false;
    if (stage_) stage_->expect_any_number();
  }

  void hold() {
    if (stage_) stage_->hold();
  }
  void settle() {
    if (stage_) stage_->settle();
  }

  void finish() {
    std::string_view line;
    take(splitter_.end(line), line);
    if (std::exchange(collects_, false)) open_collected();
    if (stage_) stage_->finish();
  }

  std::vector<std::string> take_notes() { return std::exchange(notes_, {}); }
  const LiveCounts& counts() const { return counts_; }
  const LiveStage* stage() const { return stage_ ? &*stage_ : nullptr; }

 private:
  bool ends_with_bars() const { return (stage_ || options_.neuron) && !collects_; }

  void take(LineSplitter::Found found, std::string_view line) {
    switch (found) {
      case LineSplitter::Found::nothing:
        return;
      case LineSplitter::Found::too_long:
        if (collects_) return refuse_header("a line of the header is too long");
        return count_malformed("a line is too long", false);
      case LineSplitter::Found::line:
        return collects_ ? collect(line) : take_line(line);
    }
  }

  void take_line(std::string_view line) {
    if (begins_header(line, stage_.has_value())) {
      collects_ = true;
      header_lines_.clear();
      return collect(line);
    }
    if (is_blank(line)) return;
    if (options_.neuron && !is_of_the_avatar(line)) return;
    if (is_marker_header(line)) return take_marker_header(line);
    if (!stage_) return count_malformed("frames arrived before a header", false);
    switch (stage_->take(line)) {
      case FrameReader::Read::frame:
        return;
      case FrameReader::Read::number:
        return count_malformed("a line does not begin with a frame number", true);
      case FrameReader::Read::text:
        return count_malformed("a line does not hold a frame", false);
      case FrameReader::Read::values: {
        const FrameReader& reader = stage_->reader();
        const bool more = reader.values_found() > reader.values_expected();
        return count_malformed(
            is_told_malformed_
                ? std::string()
                : fmt::format("expected {} channel values, found {}", reader.values_expected(),
                              more ? "more" : fmt::to_string(reader.values_found())),
            true);
      }
    }
  }

  // Whether the line is for the stage. A stage begins with the first line of a form.
  bool is_of_the_avatar(std::string_view line) {
    const std::optional<NeuronForm> form = neuron_form(line);
    if (!form) return true;
    if (avatar_.empty()) avatar_ = form->avatar;
    if (form->avatar != avatar_) {
      if (!std::exchange(is_told_other_avatar_, true))
        notes_.push_back(fmt::format("ignored avatar {}: a stream is for one, avatar {}",
                                     printable_name(form->avatar), printable_name(avatar_)));
      return false;
    }
    const bool is_new = !stage_ || form->displaced != is_displaced_;
    options_.skipped_words = form->skipped_words;
    is_displaced_ = form->displaced;
    if (is_new && options_.skeleton.empty())
      open(read_live_header(neuron_skeleton(is_displaced_), "Axis Neuron", options_.frame_rate_hz));
    return true;
  }

  void take_marker_header(std::string_view line) {
    try {
      open(read_marker_header(line, options_.frame_rate_hz));
    } catch (const Error& error) {
      refuse_header(error.what());
    }
  }

  // `has_place`: the line was meant to be a frame.
  void count_malformed(std::string_view why, bool has_place) {
    ++counts_.malformed;
    if (has_place && stage_ && !options_.datagrams) stage_->miss();
    if (std::exchange(is_told_malformed_, true)) return;
    notes_.push_back(
        fmt::format("ignored a malformed line: {} (more of them are only counted)", why));
  }

  void collect(std::string_view line) {
    if (!header_lines_.text().empty() && begins_header(line, true)) header_lines_.clear();
    switch (header_lines_.take(line)) {
      case HeaderLines::Next::more:
        return;
      case HeaderLines::Next::complete:
        collects_ = false;
        return open_collected();
      case HeaderLines::Next::over:
        collects_ = false;
        open_collected();
        return take_line(line);
      case HeaderLines::Next::too_long:
        return refuse_header("the header is too long");
    }
  }

  void open_collected() {
    try {
      open(read_live_header(header_lines_.text(), "header", options_.frame_rate_hz));
    } catch (const Error& error) {
      refuse_header(error.what());
    }
  }

  void refuse_header(std::string_view why) {
    collects_ = false;
    header_lines_.clear();
    if (++counts_.bad_headers <= most_header_notes) notes_.emplace_back(why);
  }

  void open(LiveHeader header) {
    if (stage_ && stage_->header().markers == header.markers &&
        same_skeleton(stage_->header().skeleton, header.skeleton) &&
        stage_->header().frame_rate_hz == header.frame_rate_hz) {
      return stage_->expect_any_number();
    }
    if (stage_) stage_->finish();
    for (const std::string& repair : header.repairs) notes_.push_back(repair);
    stage_.emplace(cleaner_, options_, std::move(header), sink_, counts_);
    ++counts_.sessions;
    is_told_malformed_ = false;
    const double rate_hz = stage_->header().frame_rate_hz;
    const std::size_t delay = stage_->latency_frames();
    const LiveHeader& opened = stage_->header();
    const bool joints = opened.markers.empty();
    notes_.push_back(fmt::format("{} {} at {:.6g} Hz: {} frames of delay, {:.3g} ms",
                                 joints ? opened.skeleton.joint_count() : opened.markers.size(),
                                 joints ? "joints" : "markers", rate_hz, delay,
                                 1000 * static_cast<double>(delay) / rate_hz));
    if (std::string warning = cleaner_.live_support(rate_hz).warning; !warning.empty())
      notes_.push_back(std::move(warning));
  }

  const Cleaner& cleaner_;
  LiveOptions options_;
  LiveSink sink_;
  LineSplitter splitter_;
  HeaderLines header_lines_;
  bool collects_ = false;
  bool is_told_malformed_ = false;
  std::string avatar_;  ///< of Axis Neuron: the cleaned one
  bool is_displaced_ = false;
  bool is_told_other_avatar_ = false;
  std::optional<LiveStage> stage_;
  LiveCounts counts_;
  std::vector<std::string> notes_;
};

LiveSession::LiveSession(const Cleaner& cleaner, const LiveOptions& options, LiveSink sink)
    : work_(std::make_unique<Work>(cleaner, options, std::move(sink))) {}
LiveSession::~LiveSession() = default;

void LiveSession::feed(std::string_view bytes) { work_->feed(bytes); }
void LiveSession::end_line() { work_->end_line(); }
void LiveSession::drop_line() { work_->drop_line(); }
void LiveSession::hold() { work_->hold(); }
void LiveSession::settle() { work_->settle(); }
void LiveSession::finish() { work_->finish(); }
const LiveCounts& LiveSession::counts() const noexcept { return work_->counts(); }
bool LiveSession::has_skeleton() const noexcept { return work_->stage() != nullptr; }
std::size_t LiveSession::joint_count() const noexcept {
  return has_skeleton() ? work_->stage()->header().skeleton.joint_count() : 0;
}
double LiveSession::frame_rate_hz() const noexcept {
  return has_skeleton() ? work_->stage()->header().frame_rate_hz : 0;
}
std::size_t LiveSession::latency_frames() const noexcept {
  return has_skeleton() ? work_->stage()->latency_frames() : 0;
}
std::vector<TrackChange> LiveSession::changes() const {
  return has_skeleton() ? work_->stage()->changes() : std::vector<TrackChange>();
}
std::vector<std::string> LiveSession::take_notes() { return work_->take_notes(); }

namespace {

// Whether a method reads a model file. (A `model` with choices is a filter's setting.)
bool is_learned(const Method& method) {
  return std::any_of(method.options.begin(), method.options.end(), [](const OptionSpec& spec) {
    return spec.name == "model" && spec.choices.empty();
  });
}

bool runs_live(const Method& method, const OptionValues& options) {
  // The rate is arbitrary, by definition.
  constexpr double any_rate_hz = 120;
  try {
    return method.make(options)->live_support(any_rate_hz).runs();
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

std::vector<LiveMethod> live_methods() {
  std::vector<LiveMethod> list;
  for (const Method& method : methods()) {
    // Making a learned method reads a model, which takes long. One of those that run live, by their
    // option, cleans any body.
    if (is_learned(method)) {
      if (method.name == "learned") list.push_back({method.name, {{"live", true}}});
      continue;
    }
    if (runs_live(method, {})) {
      list.push_back({method.name, {}});
      continue;
    }
    for (const OptionSpec& spec : method.options) {
      const bool* const is_on = std::get_if<bool>(&spec.default_value);
      if (is_on == nullptr || !runs_live(method, {{spec.name, !*is_on}})) continue;
      list.push_back({method.name, {{spec.name, !*is_on}}});
      break;
    }
  }
  return list;
}

}  // namespace kinemend
