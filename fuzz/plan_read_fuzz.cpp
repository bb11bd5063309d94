// Reads any bytes as a gap plan of joints and of markers: rows that name gaps of the take and are
// written back as the same plan, as a table and as JSON, or a one-line error that names the file.
#include <vector>

#include "kinemend/extend/gap_plan.hpp"
#include "laws.hpp"
#include "small_takes.hpp"

namespace {

using namespace kinemend;

Take with_gaps(Take clip, const std::vector<NamedGap>& gaps) {
  mark_gaps(clip, gaps);
  return clip;
}

bool is_same(const PlannedGap& a, const PlannedGap& b) {
  return a.gap == b.gap && a.is_position == b.is_position && a.verdict == b.verdict &&
         a.method == b.method && a.donor == b.donor && a.longest_gap_s == b.longest_gap_s &&
         a.filled_by == b.filled_by && a.reason == b.reason;
}

void check_same(const std::vector<PlannedGap>& plan, const std::vector<PlannedGap>& again) {
  check(plan.size() == again.size());
  for (std::size_t i = 0; i < plan.size(); ++i) check(is_same(plan[i], again[i]));
}

void check_plan(const std::string& text, const Take& clip) {
  std::vector<PlannedGap> plan;
  try {
    plan = parse_plan(text, "fuzz", clip);
  } catch (const Error& error) {
    check_refusal(error, {ErrorKind::unreadable_input});
    return;
  }
  // JSON replaces bytes that are not UTF-8 the first time only.
  const std::string json = plan_json(clip, plan);
  check(plan_json(clip, parse_plan(json, "again", clip)) == json);
  check_same(plan, parse_plan(plan_csv(clip, plan), "again", clip));
  try {
    Take filled = clip;
    fill_with_plan(filled, plan);
    filled.validate();
  } catch (const Error& error) {
    check_refusal(error, {ErrorKind::usage}, "");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Take joints =
      with_gaps(small_clip(), {{"Spine", 4, 6}, {"LeftLeg", 9, 12}, {"Hips", 15, 15}});
  static const Take markers =
      with_gaps(small_markers(), {{"LASI", 4, 6}, {"LASI", 10, 10}, {"RKNE", 12, 16}});
  const std::string text = text_of(data, size);
  check_plan(text, joints);
  check_plan(text, markers);
  return 0;
}
