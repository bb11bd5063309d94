// Writes AMC in the layout of its source or in a plain one, and the ASF file beside it.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "io/acclaim/amc.hpp"
#include "io/acclaim/amc_document.hpp"
#include "io/acclaim/amc_skeleton_file.hpp"
#include "io/acclaim/asf.hpp"
#include "io/acclaim/asf_plan.hpp"
#include "io/motion/motion_rewrite.hpp"
#include "io/motion/motion_write.hpp"
#include "io/text/text.hpp"

namespace kinemend {

namespace {

// Lists a line for each bone: its name, then its values in the order of the degrees of freedom.
class LineList {
 public:
  explicit LineList(std::string_view line_end) : line_end_(line_end) {}

  void begin(const std::string& bone) {
    lead_.clear();
    if (!values_.empty()) lead_ = line_end_;
    lead_ += bone;
    lead_ += ' ';
  }
  void add(std::size_t joint, std::size_t channel) {
    values_.push_back({std::exchange(lead_, std::string(1, ' ')), joint, channel});
  }
  std::vector<WrittenValue> take() && { return std::move(values_); }

 private:
  std::string line_end_;
  std::string lead_;
  std::vector<WrittenValue> values_;
};

std::vector<WrittenValue> lines_of(const AmcDocument& document, std::string_view line_end) {
  LineList lines(line_end);
  std::vector<std::size_t> first_column(1);
  for (const auto& channels : document.skeleton.channels) {
    first_column.push_back(first_column.back() + channels.size());
  }
  for (const AmcBone& bone : document.layout) {
    lines.begin(bone.name);
    for (const std::size_t column : bone.columns) {
      lines.add(bone.joint, column == AmcBone::no_column ? WrittenValue::no_channel
                                                         : column - first_column[bone.joint]);
    }
  }
  return std::move(lines).take();
}

std::vector<WrittenValue> lines_of(const std::vector<PlannedBone>& bones) {
  LineList lines("\n");
  for (const PlannedBone& bone : bones) {
    lines.begin(bone.name);
    for (const auto& slot : channel_slots(bone.dofs)) {
      lines.add(static_cast<std::size_t>(bone.joint), *slot);
    }
  }
  return std::move(lines).take();
}

std::string plain_header(double degrees_per_value) {
  return degrees_per_value == 1 ? ":FULLY-SPECIFIED\n:DEGREES\n" : ":FULLY-SPECIFIED\n:RADIANS\n";
}

// Writes a clip whose frames differ from its source's.
std::string write_with_header(const Take& clip, const AmcDocument& document) {
  const std::string_view header = std::string_view(document.bytes).substr(0, document.data_begin);
  const std::string_view line_end = line_ending_of(header);
  TextBuffer out(4096);
  out.append(header.empty() ? plain_header(document.degrees_per_value) : header);
  if (!header.empty() && !is_line_end(header.back())) out.append(line_end);
  append_rows(out, clip, lines_of(document, line_end), document.position_frames,
              {line_end, document.bytes.empty() ? 9 : document.written_decimals(),
               RestRotations::apart, document.degrees_per_value, true});
  return std::move(out).take();
}

std::string write_plain_amc(const Take& clip) {
  // Joint positions stay within 1e-9 of the figure's size.
  constexpr unsigned decimals = 9;
  check_channels(clip, RestRotations::apart);
  std::vector<PositionFrame> position_frames = offset_adding_frames(clip.skeleton);
  position_frames[0] = {};
  TextBuffer out(4096);
  out.append(plain_header(1));
  append_rows(out, clip, lines_of(plan_bones(clip.skeleton)), position_frames,
              {"\n", decimals, RestRotations::apart, 1, true});
  return std::move(out).take();
}

bool has_positions_of(const Take& clip, const Skeleton& skeleton) {
  const auto& translated = clip.translated_joints;
  std::size_t next = 0;
  for (std::size_t j = 1; j < skeleton.joint_count(); ++j) {
    if (!skeleton.has_position_channels(j)) continue;
    if (next == translated.size() || translated[next++] != static_cast<std::int32_t>(j))
      return false;
  }
  return next == translated.size();
}

}  // namespace

std::optional<SideFile> amc_side_file(const Take& clip, std::string_view bytes,
                                      const std::filesystem::path& output) {
  const auto* document = dynamic_cast<const AmcDocument*>(clip.source.document.get());
  Diagnostics ignored;
  const std::string name = output.string();
  const AmcHeader header = read_amc_header({name, bytes}, ignored);
  SideFile skeleton{{}, write_asf(clip)};
  skeleton.path = skeleton_place(output, header.skeleton_file, skeleton.bytes,
                                 document != nullptr ? document->skeleton_name : "");
  if (skeleton.path.empty()) return std::nullopt;
  return skeleton;
}

std::string write_amc(const Take& clip) {
  check_lengths(clip);
  const auto* document = dynamic_cast<const AmcDocument*>(clip.source.document.get());
  if (document != nullptr && same_skeleton(clip.skeleton, document->skeleton) &&
      has_positions_of(clip, document->skeleton)) {
    if (clip.frame_count() == document->frame_count && !document->bytes.empty()) {
      return rewrite_motion(clip, *document);
    }
    return write_with_header(clip, *document);
  }
  Skeleton skeleton = with_root_positions(clip.skeleton);
  if (skeleton.channels[0] == clip.skeleton.channels[0]) return write_plain_amc(clip);
  Take rooted = clip;
  rooted.skeleton = std::move(skeleton);
  return write_plain_amc(rooted);
}

}  // namespace kinemend
