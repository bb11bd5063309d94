// Writes names, skeleton, gaps and stage of a take as JSON.
#include "report/page/take_json.hpp"

#include <string>

#include "kinemend/experimental/frame_numbers.hpp"
#include "kinemend/gaps.hpp"
#include "kinemend/report.hpp"
#include "report/page/links.hpp"

namespace kinemend::page {

namespace {

Json json_of(Vec3 v) { return {v.x, v.y, v.z}; }
Json json_of(Quat q) { return {q.w, q.x, q.y, q.z}; }

Json json_of(const std::vector<Gap>& gaps) {
  Json list = Json::array();
  for (const Gap& gap : gaps) list.push_back({gap.track, gap.first_frame, gap.last_frame});
  return list;
}

Json json_of(const Stage& stage) {
  static constexpr const char* axes[] = {"x", "y", "z"};
  Json contacts = Json::array();
  for (const StageContact& contact : stage.contacts) {
    contacts.push_back(
        {{"points", contact.points}, {"first", contact.first_frame}, {"last", contact.last_frame}});
  }
  return {{"up", axes[static_cast<std::size_t>(stage.up.axis)]},
          {"sign", stage.up.sign},
          {"floor", stage.floor},
          {"height", stage.height},
          {"contacts", std::move(contacts)}};
}

Json skeleton_json(const Take& before, const Take* after) {
  const Skeleton& skeleton = before.skeleton;
  Json offsets = Json::array(), rests = Json::array(), ends = Json::array();
  Json orders = Json::array();
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    offsets.push_back(json_of(skeleton.offsets[j]));
    rests.push_back(json_of(skeleton.rest_rotations[j]));
    const RotationOrder order = told_order(before, after, j);
    orders.push_back(order.count > 0 ? to_string(order) : "");
  }
  for (const EndSite& end : skeleton.end_sites)
    ends.push_back({{"parent", end.parent}, {"offset", json_of(end.offset)}});
  return {{"parents", skeleton.parents},
          {"offsets", offsets},
          {"rests", rests},
          {"orders", orders},
          {"ends", ends},
          {"translated", before.translated_joints}};
}

Json gaps_json(const Take* take) {
  if (take == nullptr) return nullptr;
  return {{"own", json_of(find_gaps(*take))}, {"positions", json_of(find_position_gaps(*take))}};
}

}  // namespace

Json take_json(const Take& before, const Take* after, const Channels& channels,
               const Stage& stage) {
  const TakeFacts facts = take_facts(before);
  Json json = {{"kind", before.has_joints() ? "joints" : "markers"},
               {"names", facts.tracks},
               {"frames", facts.frames},
               {"told", channels.frames},
               {"step", channels.step},
               {"stride", part_stride(channels.frames, channels.samples.size())},
               {"first_frame", facts.first_frame},
               {"rate", facts.frame_rate_hz},
               {"unit", facts.unit},
               {"two", after != nullptr},
               {"quanta", channels.quanta},
               {"stage", json_of(stage)},
               {"gaps", {{"before", gaps_json(&before)}, {"after", gaps_json(after)}}}};
  if (before.has_joints()) {
    json["skeleton"] = skeleton_json(before, after);
    return json;
  }
  json["shown"] = Json::array();
  for (std::size_t m = 0; m < before.marker_count(); ++m)
    json["shown"].push_back(before.holds_positions(m));
  json["links"] = marker_links(before, stage.height);
  return json;
}

}  // namespace kinemend::page
