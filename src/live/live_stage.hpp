#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "kinemend/experimental/live.hpp"
#include "kinemend/stream.hpp"
#include "live/frame_reader.hpp"
#include "live/frame_writer.hpp"
#include "live/live_header.hpp"

namespace kinemend {

/// A live stream of one skeleton, or one set of markers: lines in, cleaned lines out, on a clock
/// that lost frames do not stop.
class LiveStage {
 public:
  /// Gives the header of the output at once. All but `header` outlive the stage.
  LiveStage(const Cleaner& cleaner, const LiveOptions& options, LiveHeader header,
            const LiveSink& sink, LiveCounts& counts);

  const LiveHeader& header() const { return header_; }
  const FrameReader& reader() const { return *reader_; }
  std::size_t latency_frames() const { return stream_->latency_frames(); }

  FrameReader::Read take(std::string_view line);
  /// A frame was meant, and is lost.
  void miss();
  /// The next number may be any: the sender begins again.
  void expect_any_number() { any_number_ = true; }
  void hold();
  /// Gives what is left; no frame may follow.
  void finish();

 private:
  /// A frame between its way in and its way out.
  struct Waiting {
    Frame frame;
    std::int64_t number = 0;
  };

  bool is_due(std::int64_t number);
  void make_up(std::size_t frames);
  void push(const Frame& frame, std::int64_t number);
  void give();
  void blend(const Frame& from);

  const LiveSink& sink_;
  LiveCounts& counts_;
  LiveHeader header_;
  double strength_;
  bool numbered_;
  std::size_t longest_gap_;
  std::unique_ptr<FrameReader> reader_;
  std::unique_ptr<FrameWriter> writer_;
  std::unique_ptr<Stream> stream_;
  std::vector<Waiting> waiting_;  ///< a ring
  std::size_t pushed_ = 0, given_ = 0;
  Frame last_, made_, out_;
  std::int64_t last_number_ = -1;
  std::size_t missed_ = 0;  ///< frames without a number that were lost since the last one
  std::size_t held_ = 0;    ///< since the last one
  bool has_started_ = false;
  bool any_number_ = false;
};

}  // namespace kinemend
