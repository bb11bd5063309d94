// Cleans the frames of one header of a live stream: takes lines and returns cleaned lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "feet/live_feet.hpp"
#include "kinemend/extend/sessions.hpp"
#include "kinemend/live.hpp"
#include "live/frame_lines.hpp"
#include "live/live_lines.hpp"
#include "live/stream_measures.hpp"

namespace kinemend {

/// Cleans a live stream of one skeleton or one set of markers: takes lines and gives cleaned lines.
/// Lost frames are interpolated, so that the output keeps its rate.
class LiveStage {
 public:
  /// Writes the header of the output immediately. All arguments except `header` must outlive the
  /// stage.
  LiveStage(const Cleaner& cleaner, const LiveOptions& options, LiveHeader header,
            const LiveSink& sink, LiveCounts& counts);

  const LiveHeader& header() const { return header_; }
  const FrameReader& reader() const { return *reader_; }
  std::size_t latency_frames() const { return stream_->latency_frames(); }
  std::vector<TrackChange> changes() const;

  FrameReader::Read take(std::string_view line);
  /// Reports that a malformed line replaced a frame.
  void miss();
  /// Reports that the sender restarts: the next frame may have any number.
  void expect_any_number();
  void hold();
  /// Gives the frames that wait for a missing one.
  void settle();
  /// Gives the remaining frames. No frame may follow.
  void finish();

 private:
  /// A frame of the input whose result is not given yet.
  struct Waiting {
    Frame frame;
    std::int64_t number = 0;
  };

  /// A frame that arrived before earlier ones, and waits for them.
  struct Overtaker {
    Frame frame;
    std::int64_t number = 0;
    std::size_t gaps = 0;
  };

  bool may_be_overtaker(std::int64_t number) const;
  void keep(std::int64_t number);
  void give_overtakers();
  void take_next_overtaker();
  void accept(const Frame& frame, std::int64_t number, std::size_t gaps);
  bool is_due(const Frame& frame, std::int64_t number);
  void make_up(std::size_t frames, const Frame& before);
  void push(const Frame& frame, std::int64_t number);
  void give();
  void note_changes(const Frame& from);
  void blend(const Frame& from);

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
  std::vector<Waiting> waiting_;  ///< a ring buffer
  std::size_t pushed_ = 0, given_ = 0;
  std::vector<Overtaker> overtakers_;  ///< by number, at most `reorder_` between calls
  RunningChanges changes_;             ///< for joints in radians, or for markers
  std::optional<feet::LiveFeet> feet_;
  Frame last_, made_, out_;
  std::int64_t last_number_ = -1;
  std::size_t missed_ = 0;  ///< frames without a number that were lost since the last frame
  std::size_t held_ = 0;    ///< repeated frames since the last frame
  bool has_started_ = false;
  bool any_number_ = false;
};

}  // namespace kinemend
