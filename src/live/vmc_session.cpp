// Assembles frames from the poses of datagrams of VMC, and holds datagrams until their bones are
// clean. Poses are read and replaced within the bytes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/extend/rotation.hpp"
#include "kinemend/extend/sessions.hpp"
#include "kinemend/extend/text.hpp"
#include "live/osc.hpp"
#include "live/stream_measures.hpp"
#include "live/vmc_stream.hpp"
#include "motion/take.hpp"

namespace kinemend {

/// A message `/VMC/Ext/Bone/Pos` or `/VMC/Ext/Root/Pos`. It has a name outside this file because a
/// member of `VmcSession::Work` holds such messages.
struct VmcPose {
  bool is_root = false;
  std::string_view name;
  std::size_t place =
      0;  ///< of its seven floats in the datagram: position, then quaternion x y z w
};

namespace {

constexpr std::size_t float_bytes = 4, position_floats = 3, pose_floats = 7;

bool write_floats(std::string& datagram, std::size_t place, std::span<const double> values) {
  for (const double value : values) {
    if (!std::isfinite(static_cast<float>(value))) return false;
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    set_osc_float(datagram, place + float_bytes * i, static_cast<float>(values[i]));
  return true;
}

// Appends the poses among the messages of a datagram, in order. Messages with other argument types
// are skipped.
void read_vmc_poses(std::string_view datagram, const std::vector<OscMessage>& messages,
                    std::vector<VmcPose>& poses) {
  for (const OscMessage& message : messages) {
    const bool is_root = message.address == "/VMC/Ext/Root/Pos";
    // Later versions of the protocol add arguments after these.
    if (!(is_root || message.address == "/VMC/Ext/Bone/Pos") ||
        !message.types.starts_with("sfffffff"))
      continue;
    const auto name = osc_string(datagram, message.arguments, message.end);
    if (!name) continue;
    const std::size_t place = message.arguments + osc_string_bytes(name->size());
    if (message.end - place < pose_floats * float_bytes) continue;
    poses.push_back({is_root, *name, place});
  }
}

struct VmcValues {
  Vec3 position;
  Quat rotation;  // as received: with any norm

  // Whether all values are finite and the quaternion is a rotation once it is normalised.
  bool is_usable() const {
    const double length = norm(rotation);
    // Senders round their quaternions; zeros mark a bone that is not tracked.
    constexpr double least = 0.5, most = 2;
    return is_finite(position) && length >= least && length <= most;
  }
};

VmcValues vmc_values(std::string_view datagram, std::size_t place) {
  std::array<double, pose_floats> v{};
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = osc_float(datagram, place + float_bytes * i);
  return {{v[0], v[1], v[2]}, {v[6], v[3], v[4], v[5]}};
}

// Sets the pose and returns true; values that a float cannot hold leave it unchanged and return
// false.
bool set_vmc_rotation(std::string& datagram, std::size_t place, Quat rotation) {
  const double values[] = {rotation.x, rotation.y, rotation.z, rotation.w};
  return write_floats(datagram, place + position_floats * float_bytes, values);
}

bool set_vmc_position(std::string& datagram, std::size_t place, Vec3 position) {
  const double values[] = {position.x, position.y, position.z};
  return write_floats(datagram, place, values);
}

// A sender sends the datagrams of a frame in succession: after a pause of this share of a frame the
// rest of the frame is lost.
constexpr double quiet_share = 0.3;
// A face may move on while the body rests; its values are kept no longer than this.
constexpr double silence_s = 0.25;
// A bone that is missing for longer is gone, and frames are complete without it.
constexpr std::size_t memory_frames = 60;
constexpr std::size_t most_named_bones = 5;
// A change below the resolution of a float keeps the sender's bytes.
constexpr double least_change = 1e-6;

void check_vmc_options(const VmcOptions& options) {
  constexpr double least_hz = 0.1, most_hz = 100000;
  if (!(options.frame_rate_hz >= least_hz && options.frame_rate_hz <= most_hz))
    throw Error(ErrorKind::usage, "frame_rate_hz: expected 0.1 to 100000 Hz");
  if (!(options.strength >= 0 && options.strength <= 1))
    throw Error(ErrorKind::usage, "strength: expected 0 to 1");
}

// A frame that is later than this share of a frame has missing frames before it.
constexpr double late_share = 0.75;
// The share of a frame's lateness that the clock follows: a tenth suppresses most jitter. All of
// these are chosen by hand, not swept.
constexpr double following = 0.1;
// The time over which the rate is measured.
constexpr double clock_window_s = 2;
// The relative difference between measured and expected rate from which a message is written.
constexpr double other_rate = 0.1;
constexpr std::size_t most_clock_notes = 5;

}  // namespace

// Measures a stream as it runs: how many frames were lost between two, by their arrival times, and
// their rate. It follows the sender's clock slowly, so that network jitter is not taken for losses.
class FrameClock {
 public:
  // `longest_gap_s`: after a longer gap no frame counts as lost.
  FrameClock(double frame_rate_hz, double longest_gap_s)
      : frame_rate_hz_(frame_rate_hz), longest_gap_s_(longest_gap_s) {}

  // Returns the number of frames missing before the one that arrived at `now_s`, which becomes the
  // last one.
  std::size_t frames_before(double now_s) {
    const double period_s = 1 / frame_rate_hz_;
    double late_s = now_s - expected_s_;
    if (!runs_ || late_s > longest_gap_s_ || late_s < -period_s) {
      if (!runs_ || late_s > 0) window_frames_ = 0;
      runs_ = true;
      late_s = 0;
      expected_s_ = now_s;
    }
    measure(now_s);
    const auto missing =
        late_s < late_share * period_s
            ? std::size_t{0}
            : static_cast<std::size_t>(std::floor(late_s / period_s + (1 - late_share)));
    late_s -= static_cast<double>(missing) * period_s;
    expected_s_ += static_cast<double>(missing + 1) * period_s + following * late_s;
    return missing;
  }

  // Announces a silence: no frame before the next one counts as lost.
  void pause() { runs_ = false; }
  // Returns the frames per second over the last seconds without a silence; 0: not measured yet.
  double measured_hz() const { return measured_hz_; }
  // Returns a message if the measured rate differs from the expected one, once for each rate; else
  // empty.
  std::string take_note(std::size_t latency_frames) {
    const double reference_hz = told_hz_ > 0 ? told_hz_ : frame_rate_hz_;
    if (measured_hz_ == 0 || notes_ == most_clock_notes ||
        std::fabs(measured_hz_ - reference_hz) <= other_rate * reference_hz)
      return {};
    told_hz_ = measured_hz_;
    ++notes_;
    return fmt::format(
        "{:.3g} frames per second arrive, and {:.6g} are expected (--fps): {}", measured_hz_,
        frame_rate_hz_,
        measured_hz_ < frame_rate_hz_
            ? std::string("missing ones are interpolated")
            : fmt::format("the delay is {:.3g} ms",
                          1000 * static_cast<double>(latency_frames) / measured_hz_));
  }

 private:
  void measure(double now_s) {
    if (window_frames_++ == 0) window_begin_s_ = now_s;
    if (now_s - window_begin_s_ < clock_window_s) return;
    measured_hz_ = static_cast<double>(window_frames_ - 1) / (now_s - window_begin_s_);
    window_begin_s_ = now_s;
    window_frames_ = 1;
  }

  double frame_rate_hz_, longest_gap_s_;
  bool runs_ = false;
  double expected_s_ = 0;  // when the next frame is due
  double window_begin_s_ = 0;
  std::size_t window_frames_ = 0;
  double measured_hz_ = 0;
  double told_hz_ = 0;
  std::size_t notes_ = 0;
};

class VmcSession::Work {
 public:
  Work(const Cleaner& cleaner, const VmcOptions& options, Sink sink)
      : options_((check_vmc_options(options), options)),
        sink_(std::move(sink)),
        bones_(options.bones),
        stream_(cleaner, bones_, options.frame_rate_hz, options.feet, options.source,
                [this](std::size_t, const VmcFrame& frame) { clean_poses(frame); }),
        clock_(options.frame_rate_hz, silence_s),
        chosen_(bones_.count(), options.bones.empty() ? 1 : 0),
        age_(bones_.count(), memory_frames),
        in_frame_(bones_.count(), 0),
        changes_(bones_.count()) {
    for (const std::string& name : options.bones)
      chosen_[static_cast<std::size_t>(bones_.find(name))] = 1;
    last_.rotations.resize(bones_.count());
    last_.measured.assign(bones_.count(), 1);
    next_ = last_;
  }

  void receive(std::string_view datagram, double now_s) {
    attend(now_s);
    ++counts_.datagrams_in;
    queue_.push_back({std::string(datagram), 0});
    queue_bytes_ += datagram.size();
    messages_.clear();
    poses_.clear();
    // The messages refer to the stored bytes.
    if (read_osc(queue_.back().bytes, messages_)) {
      read_vmc_poses(queue_.back().bytes, messages_, poses_);
      for (const VmcPose& pose : poses_) take_pose(pose, now_s);
    } else {
      ++counts_.not_osc;
    }
    release();
    if (queue_bytes_ > options_.most_waiting_bytes) settle();
  }

  void attend(double now_s) {
    if (has_open_frame_ && now_s >= last_pose_s_ + quiet_s()) close_frame();
    if (!queue_.empty() && now_s >= last_pose_s_ + silence_s) settle();
    release();
  }

  double due_s() const {
    if (has_open_frame_) return last_pose_s_ + quiet_s();
    return queue_.empty() ? std::numeric_limits<double>::infinity() : last_pose_s_ + silence_s;
  }

  // Repeats the last frame until all waiting datagrams have been cleaned.
  void settle() {
    if (has_open_frame_) close_frame();
    release();
    if (queue_.empty()) return;
    ++counts_.settled;
    clock_.pause();
    VmcFrame held = last_;
    held.measured.assign(bones_.count(), 1);
    for (std::size_t f = 0; f < stream_.latency_frames(); ++f) push_frame(held, {});
    release();
  }

  const VmcCounts& counts() const { return counts_; }
  std::size_t latency_frames() const { return stream_.latency_frames(); }
  double measured_hz() const { return clock_.measured_hz(); }
  std::size_t waiting_bytes() const { return queue_bytes_; }
  std::vector<std::string> take_notes() { return std::exchange(notes_, {}); }

  std::vector<TrackChange> changes() const {
    std::vector<TrackChange> all;
    for (std::size_t b = 0; b < bones_.count(); ++b) {
      if (changes_.has(b)) all.push_back({bones_.name(b), degrees_per_radian * changes_.rms(b)});
    }
    return all;
  }

 private:
  struct Waiting {
    std::string bytes;
    std::size_t pending;  ///< poses not cleaned yet
  };
  /// A pose that waits in a datagram.
  struct Pending {
    std::size_t bone;
    std::size_t datagram;  ///< its number
    std::size_t place;
  };

  double quiet_s() const { return quiet_share / options_.frame_rate_hz; }

  void take_pose(const VmcPose& pose, double now_s) {
    ++counts_.poses;
    const std::int32_t found =
        pose.is_root ? static_cast<std::int32_t>(VmcBones::root) : bones_.find(pose.name);
    if (found < 0) return count_other(pose.name);
    const auto bone = static_cast<std::size_t>(found);
    const VmcValues values = vmc_values(queue_.back().bytes, pose.place);
    const bool usable = values.is_usable();
    counts_.not_finite += usable ? 0 : 1;
    // An unusable pose cannot be replaced before the bone is known.
    if (!usable && !stream_.has(bone)) return;
    if (in_frame_[bone] != 0) close_frame();
    begin_frame(now_s);
    in_frame_[bone] = 1;
    next_.measured[bone] = usable ? 1 : 0;
    if (usable) take_values(bone, values);
    if (chosen_[bone] != 0) {
      next_poses_.push_back({bone, sent_ + queue_.size() - 1, pose.place});
      ++queue_.back().pending;
    }
    if (is_complete()) close_frame();
  }

  void take_values(std::size_t bone, const VmcValues& values) {
    next_.rotations[bone] = normalized(values.rotation);
    if (bone <= VmcBones::hips) next_.positions[bone] = values.position;
    if (stream_.has(bone)) return;
    stream_.add(bone, next_.rotations[bone], values.position);
    last_.rotations[bone] = next_.rotations[bone];
    if (bone <= VmcBones::hips) last_.positions[bone] = values.position;
  }

  void begin_frame(double now_s) {
    last_pose_s_ = now_s;
    if (std::exchange(has_open_frame_, true)) return;
    frame_s_ = now_s;
    next_ = last_;
    std::fill(next_.measured.begin(), next_.measured.end(), 0);
  }

  // Whether every bone of the last frames is present. Before the first frame no bone is known.
  bool is_complete() const {
    bool knows_any = false;
    for (std::size_t b = 0; b < bones_.count(); ++b) {
      if (age_[b] >= memory_frames) continue;
      knows_any = true;
      if (in_frame_[b] == 0) return false;
    }
    return knows_any;
  }

  void close_frame() {
    has_open_frame_ = false;
    ++counts_.frames;
    for (std::size_t b = 0; b < bones_.count(); ++b) {
      counts_.missing += in_frame_[b] == 0 && age_[b] < memory_frames ? 1 : 0;
      age_[b] = in_frame_[b] != 0 ? 0 : std::min(age_[b] + 1, memory_frames);
      if (age_[b] == memory_frames) next_.measured[b] = 1;
    }
    std::fill(in_frame_.begin(), in_frame_.end(), 0);
    const std::size_t missed = clock_.frames_before(frame_s_);
    for (std::size_t i = 1; i <= missed; ++i)
      push_frame(between(static_cast<double>(i) / static_cast<double>(missed + 1)), {});
    counts_.made_up += missed;
    if (std::string note = clock_.take_note(stream_.latency_frames()); !note.empty())
      notes_.push_back(std::move(note));
    last_ = next_;
    push_frame(next_, std::exchange(next_poses_, {}));
  }

  VmcFrame between(double share) const {
    VmcFrame frame = last_;
    for (std::size_t b = 0; b < bones_.count(); ++b) {
      if (!stream_.has(b)) continue;
      frame.rotations[b] = slerp(last_.rotations[b], next_.rotations[b], share);
      frame.measured[b] = 0;
    }
    for (std::size_t p = 0; p < frame.positions.size(); ++p)
      frame.positions[p] = last_.positions[p] + share * (next_.positions[p] - last_.positions[p]);
    return frame;
  }

  void push_frame(VmcFrame frame, std::vector<Pending> poses) {
    pending_.push_back(std::move(poses));
    stream_.push(std::move(frame));
  }

  // Cleans the poses of a frame from the stream.
  void clean_poses(const VmcFrame& frame) {
    const std::vector<Pending> poses = std::move(pending_.front());
    pending_.pop_front();
    for (const Pending& pose : poses) {
      Waiting& waiting = queue_[pose.datagram - sent_];
      counts_.cleaned += clean_pose(pose, frame, waiting.bytes) ? 1 : 0;
      --waiting.pending;
    }
  }

  // Returns true if a value changed.
  bool clean_pose(const Pending& pose, const VmcFrame& frame, std::string& bytes) {
    const VmcValues came = vmc_values(bytes, pose.place);
    const bool usable = came.is_usable();
    const Quat from = frame.rotations[pose.bone];
    const Quat to = stream_.rotation(pose.bone);
    const double change = angle_between(from, to);
    if (usable) changes_.add(pose.bone, change);
    // An unusable pose is replaced entirely.
    const double share = usable ? options_.strength : 1;
    bool changed = false;
    if (share > 0 && (!usable || change > least_change)) {
      // The result starts from the received pose and keeps its sign.
      changed = set_vmc_rotation(bytes, pose.place, slerp(from, to, share));
    }
    return clean_position(pose, frame, share, bytes) || changed;
  }

  // Cleans the positions of the root and the hips. Positions of other bones are the lengths of the
  // body and stay unchanged.
  bool clean_position(const Pending& pose, const VmcFrame& frame, double share,
                      std::string& bytes) {
    const bool finite = is_finite(vmc_values(bytes, pose.place).position);
    if (pose.bone > VmcBones::hips)
      return !finite && set_vmc_position(bytes, pose.place, stream_.offset(pose.bone));
    const Vec3 from = frame.positions[pose.bone];
    const Vec3 step = share * (stream_.position(pose.bone) - from);
    if (finite && norm(step) <= least_change * (1 + norm(from))) return false;
    return set_vmc_position(bytes, pose.place, from + step);
  }

  void count_other(std::string_view name) {
    ++counts_.other_bones;
    const std::string printable = printable_name(name);
    if (named_.size() == most_named_bones ||
        std::find(named_.begin(), named_.end(), printable) != named_.end())
      return;
    named_.push_back(printable);
    notes_.push_back(
        fmt::format("bone {} is not in Unity's humanoid and passes unchanged; name it with "
                    "--joints to clean it",
                    printable));
  }

  void release() {
    while (!queue_.empty() && queue_.front().pending == 0) {
      sink_(queue_.front().bytes);
      queue_bytes_ -= queue_.front().bytes.size();
      queue_.pop_front();
      ++sent_;
    }
    counts_.datagrams_out = sent_;
  }

  VmcOptions options_;
  Sink sink_;
  VmcBones bones_;
  VmcStream stream_;
  FrameClock clock_;
  std::vector<std::uint8_t> chosen_;  ///< for each bone
  std::vector<std::size_t> age_;      ///< frames since the bone was present, at most memory_frames
  std::vector<std::uint8_t> in_frame_;
  RunningChanges changes_;  ///< for rotations, in radians
  std::deque<Waiting> queue_;
  std::size_t queue_bytes_ = 0;
  std::size_t sent_ = 0;                      ///< datagrams
  std::deque<std::vector<Pending>> pending_;  ///< for each frame in the stream
  bool has_open_frame_ = false;
  double frame_s_ = 0;      ///< start of the open frame
  double last_pose_s_ = 0;  ///< arrival of the last pose
  VmcFrame last_, next_;
  std::vector<Pending> next_poses_;
  std::vector<OscMessage> messages_;
  std::vector<VmcPose> poses_;
  VmcCounts counts_;
  std::vector<std::string> named_;
  std::vector<std::string> notes_;
};

VmcSession::VmcSession(const Cleaner& cleaner, const VmcOptions& options, Sink sink)
    : work_(std::make_unique<Work>(cleaner, options, std::move(sink))) {}
VmcSession::~VmcSession() = default;

void VmcSession::receive(std::string_view datagram, double now_s) {
  work_->receive(datagram, now_s);
}
void VmcSession::attend(double now_s) { work_->attend(now_s); }
double VmcSession::due_s() const noexcept { return work_->due_s(); }
void VmcSession::settle() { work_->settle(); }
const VmcCounts& VmcSession::counts() const noexcept { return work_->counts(); }
std::size_t VmcSession::latency_frames() const noexcept { return work_->latency_frames(); }
double VmcSession::measured_hz() const noexcept { return work_->measured_hz(); }
std::size_t VmcSession::waiting_bytes() const noexcept { return work_->waiting_bytes(); }
std::vector<TrackChange> VmcSession::changes() const { return work_->changes(); }
std::vector<std::string> VmcSession::take_notes() { return work_->take_notes(); }

}  // namespace kinemend
