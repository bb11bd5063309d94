// Reads any bytes as a side file of gaps: gaps that are written back as equal gaps and mark samples
// of a take, or a one-line error that names the file.
#include <span>
#include <vector>

#include "kinemend/take.hpp"
#include "laws.hpp"
#include "small_takes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinemend;
  static const Take joints = small_clip();
  static const Take markers = small_markers();
  const std::int64_t first_frame = size % 2 == 0 ? 1 : -3;
  std::vector<NamedGap> gaps;
  try {
    gaps = parse_gaps(text_of(data, size), "fuzz", first_frame);
  } catch (const Error& error) {
    check_refusal(error, {ErrorKind::unreadable_input});
    return 0;
  }
  const std::string text = gaps_text(gaps, first_frame);
  const std::vector<NamedGap> again = parse_gaps(text, "again", first_frame);
  check(again.size() == gaps.size() && gaps_text(again, first_frame) == text);
  for (const NamedGap& gap : gaps) {
    check(gap.first_frame <= gap.last_frame);
    const std::span<const NamedGap> one(&gap, 1);
    try {
      Take clip = joints;
      mark_gaps(clip, one);
      clip.validate();
      check(!find_gaps(clip).empty());
    } catch (const Error& error) {
      check_refusal(error, {ErrorKind::usage}, "");
    }
    try {
      Take clip = markers;
      mark_gaps(clip, one);
      clip.validate();
    } catch (const Error& error) {
      check_refusal(error, {ErrorKind::usage}, "");
    }
  }
  return 0;
}
