// Runs a live session: splits bytes into lines, and starts a stage for each header. Lists the
// methods that can clean a live stream.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "io/motion/motion_write.hpp"
#include "io/text/text.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/sessions.hpp"
#include "kinemend/extend/text.hpp"
#include "live/frame_lines.hpp"
#include "live/live_lines.hpp"
#include "live/live_stage.hpp"

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

}  // namespace

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
