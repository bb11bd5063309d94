// Feeds any bytes in pieces of any size: frame counts are consistent, the text does not depend on
// the pieces, and there are no errors. The first byte selects how lines are read and the size of
// pieces. The same holds for datagrams, which end at each zero byte, however often the sender
// disconnects and frames wait.
#include <cstddef>
#include <string_view>

#include "kinemend/extend/sessions.hpp"
#include "kinemend/methods.hpp"
#include "laws.hpp"

namespace {

using namespace kinemend;

struct Result {
  std::string text;
  LiveCounts counts;
};

LiveOptions options_of(std::uint8_t choice) {
  LiveOptions options;
  options.numbered = (choice & 1) != 0;
  options.format = (choice & 2) != 0 ? LiveFormat::jsonl : LiveFormat::bvh;
  options.skipped_words = (choice & 4) != 0 ? 1 : 0;
  options.strength = (choice & 8) != 0 ? 0.5 : 1;
  options.longest_gap_s = 0.1;
  options.most_line_bytes = 4096;
  return options;
}

template <class Feed>
Result result_of(const LiveOptions& options, const Feed& feed) {
  static const auto cleaner = make_cleaner("median");
  Result result;
  LiveSession session(*cleaner, options, [&](const LivePiece& out) { result.text += out.text; });
  feed(session);
  session.finish();
  result.counts = session.counts();
  const LiveCounts& c = result.counts;
  check(c.frames_out == c.frames_in + c.made_up + c.held);
  return result;
}

Result in_pieces(std::string_view bytes, std::uint8_t choice, std::size_t piece) {
  return result_of(options_of(choice), [&](LiveSession& session) {
    for (; !bytes.empty(); bytes.remove_prefix(piece < bytes.size() ? piece : bytes.size()))
      session.feed(bytes.substr(0, piece));
    session.hold();
  });
}

Result as_datagrams(std::string_view bytes, std::uint8_t choice) {
  LiveOptions options = options_of(choice);
  options.datagrams = true;
  options.reorder_frames = choice / 32;
  return result_of(options, [&](LiveSession& session) {
    for (std::size_t sent = 0; !bytes.empty(); ++sent) {
      const std::string_view datagram = bytes.substr(0, bytes.find('\0'));
      bytes.remove_prefix(std::min(datagram.size() + 1, bytes.size()));
      session.feed(datagram);
      session.end_line();
      if ((choice & 16) != 0 && sent % 5 == 4) session.settle();
      if ((choice & 16) != 0 && sent % 7 == 6) session.drop_line();
    }
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const Result whole = in_pieces(bytes, data[0], bytes.size() + 1);
  check(in_pieces(bytes, data[0], 1 + data[0] / 16).text == whole.text);
  const Result datagrams = as_datagrams(bytes, data[0]);
  // Invalid datagrams are counted, and only a missing number is a lost frame.
  if ((data[0] & 1) == 0) check(datagrams.counts.made_up == 0);
  check(datagrams.counts.reordered <= datagrams.counts.frames_in);
  return 0;
}
