#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "kinemend/experimental/live.hpp"
#include "kinemend/methods.hpp"

// Any bytes, in pieces of any size: frames that add up and the same text however the bytes arrive,
// and never an error. The first byte chooses how lines are read and how large the pieces are.
namespace {

using namespace kinemend;

struct Result {
  std::string text;
  LiveCounts counts;
};

Result feed(std::string_view bytes, std::uint8_t choice, std::size_t piece) {
  static const auto cleaner = make_cleaner("median");
  LiveOptions options;
  options.numbered = (choice & 1) != 0;
  options.format = (choice & 2) != 0 ? LiveFormat::jsonl : LiveFormat::bvh;
  options.skipped_words = (choice & 4) != 0 ? 1 : 0;
  options.strength = (choice & 8) != 0 ? 0.5 : 1;
  options.longest_gap_s = 0.1;
  options.most_line_bytes = 4096;
  Result result;
  LiveSession session(*cleaner, options, [&](const LivePiece& out) { result.text += out.text; });
  for (; !bytes.empty(); bytes.remove_prefix(piece < bytes.size() ? piece : bytes.size()))
    session.feed(bytes.substr(0, piece));
  session.hold();
  session.finish();
  result.counts = session.counts();
  return result;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const Result whole = feed(bytes, data[0], bytes.size() + 1);
  const LiveCounts& c = whole.counts;
  if (c.frames_out != c.frames_in + c.made_up + c.held) std::abort();
  if (feed(bytes, data[0], 1 + data[0] / 16).text != whole.text) std::abort();
  return 0;
}
