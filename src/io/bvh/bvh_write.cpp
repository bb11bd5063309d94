// Writes BVH: into the text of its source if only samples or the rate changed, with the source's
// hierarchy if other frames are to be written, else in a plain layout.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "io/bvh/bvh.hpp"
#include "io/bvh/bvh_hierarchy.hpp"
#include "io/motion/motion_rows.hpp"
#include "io/motion/motion_write.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

std::string frame_time_text(double frame_rate_hz) {
  const double frame_time_s = 1 / frame_rate_hz;
  std::array<char, fixed_number_room> text;
  for (unsigned decimals = 6; decimals <= 9; ++decimals) {
    const std::string_view written(
        text.data(),
        static_cast<std::size_t>(write_fixed(text.data(), frame_time_s, decimals) - text.data()));
    const NumberToken number = read_number(written);
    if (number.value > 0 && rate_from_frame_time(number.value, written) == frame_rate_hz)
      return std::string(written);
  }
  return {text.data(), write_shortest(text.data(), frame_time_s)};
}

namespace {

// Writes the hierarchy as text, children directly after their parent, and gives the resulting order
// of joints.
class HierarchyWriter {
 public:
  HierarchyWriter(const Skeleton& skeleton, TextBuffer& out) : skeleton_(skeleton), out_(out) {
    children_.resize(skeleton.joint_count());
    sites_.resize(skeleton.joint_count());
    for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
      if (skeleton.parents[j] >= 0)
        children_[static_cast<std::size_t>(skeleton.parents[j])].push_back(j);
    }
    for (const EndSite& site : skeleton.end_sites)
      sites_[static_cast<std::size_t>(site.parent)].push_back(&site);
  }

  std::vector<std::size_t> write() {
    out_.append("HIERARCHY\n");
    for (std::size_t j = 0; j < skeleton_.joint_count(); ++j) {
      if (skeleton_.parents[j] < 0) write_tree(j);
    }
    return std::move(order_);
  }

 private:
  struct Open {
    std::size_t joint;
    std::size_t next_child = 0;
  };

  void write_tree(std::size_t root) {
    std::vector<Open> open{{root}};
    begin_joint(root, 0);
    while (!open.empty()) {
      Open& top = open.back();
      if (top.next_child < children_[top.joint].size()) {
        const std::size_t child = children_[top.joint][top.next_child++];
        begin_joint(child, open.size());
        open.push_back({child});
      } else {
        end_joint(top.joint, open.size() - 1);
        open.pop_back();
      }
    }
  }

  void line(std::size_t depth, std::string_view text) {
    for (std::size_t i = 0; i < depth; ++i) out_.append("\t");
    out_.append(text);
    out_.append("\n");
  }

  static void check_name(const std::string& name) {
    if (name.find_first_of("{}\r\n") != name.npos) {
      throw Error(ErrorKind::usage, fmt::format("BVH cannot hold the name {}", quote(name)));
    }
  }

  void offset_line(std::size_t depth, Vec3 offset) {
    for (std::size_t i = 0; i < depth; ++i) out_.append("\t");
    out_.append("OFFSET");
    out_.append_each(" ", {offset.x, offset.y, offset.z});
    out_.append("\n");
  }

  void begin_joint(std::size_t joint, std::size_t depth) {
    order_.push_back(joint);
    check_name(skeleton_.names[joint]);
    line(depth, fmt::format("{} {}", depth == 0 ? "ROOT" : "JOINT", skeleton_.names[joint]));
    line(depth, "{");
    offset_line(depth + 1, skeleton_.offsets[joint]);
    std::string channels = fmt::format("CHANNELS {}", skeleton_.channels[joint].size());
    for (const Channel channel : skeleton_.channels[joint]) {
      channels += ' ';
      channels += channel_names[static_cast<std::size_t>(channel)];
    }
    line(depth + 1, channels);
  }

  void end_joint(std::size_t joint, std::size_t depth) {
    for (const EndSite* site : sites_[joint]) {
      check_name(site->name);
      line(depth + 1, site->name.empty() ? "End Site" : "End Site " + site->name);
      line(depth + 1, "{");
      offset_line(depth + 2, site->offset);
      line(depth + 1, "}");
    }
    line(depth, "}");
  }

  const Skeleton& skeleton_;
  TextBuffer& out_;
  std::vector<std::vector<std::size_t>> children_;
  std::vector<std::vector<const EndSite*>> sites_;
  std::vector<std::size_t> order_;
};

// Appends `MOTION` and all frames, one per line, with joints in the given order.
void append_motion(TextBuffer& out, const Take& clip, const std::vector<std::size_t>& joints,
                   std::string_view line_end, unsigned decimals, std::string_view frame_time) {
  out.append(fmt::format("MOTION{0}Frames: {1}{0}Frame Time: {2}{0}", line_end, clip.frame_count(),
                         frame_time));
  std::vector<WrittenValue> values;
  for (const std::size_t j : joints) {
    for (std::size_t c = 0; c < clip.skeleton.channels[j].size(); ++c) {
      values.push_back({values.empty() ? "" : " ", j, c});
    }
  }
  append_rows(out, clip, values, offset_replacing_frames(clip.skeleton), {line_end, decimals});
}

std::string rewrite_bvh(const Take& clip, const BvhDocument& document) {
  std::vector<DocumentEdit> edits;
  if (clip.frame_rate_hz != document.frame_rate_hz || document.frame_time_is_none) {
    edits.push_back({document.frame_time, frame_time_text(clip.frame_rate_hz)});
  }
  const bool counts_wrong = document.wrong_frame_count.size > 0;
  std::string bytes = rewrite_motion(clip, document, edits);
  if (!(counts_wrong || document.frame_time_is_unusable) || bytes == document.bytes) return bytes;
  if (document.frame_time_is_unusable && edits.empty())
    edits.push_back({document.frame_time, frame_time_text(clip.frame_rate_hz)});
  if (counts_wrong)
    edits.push_back({document.wrong_frame_count, std::to_string(clip.frame_count())});
  std::ranges::sort(edits, {}, [](const DocumentEdit& edit) { return edit.place.begin; });
  return rewrite_motion(clip, document, edits);
}

std::string write_plain_bvh(const Take& clip) {
  check_channels(clip, RestRotations::in_channels);
  TextBuffer out(4096);
  const std::vector<std::size_t> order = HierarchyWriter(clip.skeleton, out).write();
  const std::string frame_time = frame_time_text(clip.frame_rate_hz);
  append_motion(out, clip, order, "\n", 6, frame_time);
  return std::move(out).take();
}

// Writes the source's hierarchy unchanged, for a clip whose frames differ from the source's.
std::string write_with_hierarchy(const Take& clip, const BvhDocument& document) {
  TextBuffer out(4096);
  const std::string_view hierarchy =
      std::string_view(document.bytes).substr(0, document.hierarchy_end);
  const std::string_view line_end = line_ending_of(hierarchy);
  out.append(hierarchy);
  out.append(line_end);
  const bool same_rate = clip.frame_rate_hz == document.frame_rate_hz &&
                         document.frame_time.size > 0 && !document.frame_time_is_unusable;
  const std::string frame_time = same_rate ? std::string(document.text(document.frame_time))
                                           : frame_time_text(clip.frame_rate_hz);
  std::vector<std::size_t> order(clip.joint_count());
  for (std::size_t j = 0; j < order.size(); ++j) order[j] = j;
  append_motion(out, clip, order, line_end, document.written_decimals(), frame_time);
  return std::move(out).take();
}

}  // namespace

std::string write_bvh(const Take& clip) {
  check_lengths(clip);
  const auto* document = dynamic_cast<const BvhDocument*>(clip.source.document.get());
  if (document == nullptr || !same_skeleton(clip.skeleton, document->skeleton))
    return write_plain_bvh(clip);
  const MotionColumns columns(clip.skeleton);
  const auto translated = columns.translated_joints();
  const bool same_translated =
      std::equal(translated.begin(), translated.end(), clip.translated_joints.begin(),
                 clip.translated_joints.end());
  const bool same_rate =
      clip.frame_rate_hz == document->frame_rate_hz || document->frame_time.size > 0;
  if (clip.frame_count() == document->frame_count && same_rate && same_translated)
    return rewrite_bvh(clip, *document);
  return write_with_hierarchy(clip, *document);
}

namespace {

class BvhRowReader : public RowReader {
 public:
  explicit BvhRowReader(const BvhDocument& document)
      : width_(MotionColumns(document.skeleton).count()),
        rows_(document.bytes.data() + document.data_begin,
              document.bytes.data() + document.data_end, document.commas) {}

  void next(double* values, std::size_t frames, TokenSpan* tokens) override {
    rows_.next(values, frames * width_, tokens);
  }

 private:
  std::size_t width_;
  MotionRows rows_;
};

}  // namespace

std::unique_ptr<RowReader> BvhDocument::rows() const {
  return std::make_unique<BvhRowReader>(*this);
}

}  // namespace kinemend
