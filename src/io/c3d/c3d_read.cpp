#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "io/c3d/c3d.hpp"
#include "io/c3d/c3d_document.hpp"
#include "io/c3d/c3d_events.hpp"
#include "io/c3d/c3d_facts.hpp"
#include "io/c3d/c3d_points.hpp"

namespace kinemend {

namespace {

constexpr double c3d_rate_when_unknown_hz = 100;

class C3dReader {
 public:
  C3dReader(C3dSource& source, C3dDocument& document, MarkerClip& clip)
      : source_(source), document_(document), clip_(clip) {}

  void read(const ReadOptions& options) {
    const C3dHeader header = read_c3d_header(source_);
    document_.processor = source_.processor;
    document_.parameters = read_c3d_parameters(source_, header);
    document_.layout = find_c3d_layout(source_, header, document_.parameters);
    read_names();
    read_kinds();
    clip_.unit = as_utf8(parameters().text("POINT", "UNITS"));
    clip_.first_frame = layout().first_frame;
    read_rate(options);
    clip_.events = read_c3d_events(source_, header, parameters());
    read_points();
    remember();
  }

 private:
  const C3dLayout& layout() const { return document_.layout; }
  const C3dParameters& parameters() const { return document_.parameters; }

  void read_names() {
    clip_.names = parameters().texts("POINT", "LABELS");
    clip_.names.resize(std::min(clip_.names.size(), layout().point_count));
    for (std::string& name : clip_.names) {
      std::string converted = as_utf8(name);
      if (converted != name) {
        source_.note("label_not_utf8", layout().parameters_begin,
                     "a marker's name is not UTF-8; it is taken as Latin 1");
        name = std::move(converted);
      }
    }
    clip_.names.reserve(layout().point_count);
    while (clip_.names.size() < layout().point_count)
      clip_.names.push_back(fmt::format("*{}", clip_.names.size() + 1));
  }

  // POINT:ANGLES and its like, and what POINT:TYPE_GROUPS names, list the points that are none.
  void read_kinds() {
    clip_.is_position.assign(clip_.marker_count(), 1);
    std::set<std::string, std::less<>> lists{"ANGLES", "FORCES",  "MOMENTS",
                                             "POWERS", "SCALARS", "REACTIONS"};
    const std::vector<std::string> groups = parameters().texts("POINT", "TYPE_GROUPS");
    for (std::size_t i = 0; i < groups.size(); i += 2) {
      // These are joint centres and the like: positions.
      if (groups[i] != "MODELED_MARKERS" && groups[i] != "LABELS") lists.insert(groups[i]);
    }
    std::set<std::string, std::less<>> names;
    for (const std::string& list : lists) {
      for (const std::string& name : parameters().texts("POINT", list)) names.insert(as_utf8(name));
    }
    names.erase("");
    for (std::size_t m = 0; m < clip_.marker_count(); ++m) {
      const std::string& name = clip_.names[m];
      if (names.count(name) > 0 || names.count(without_subject(name)) > 0) clip_.is_position[m] = 0;
    }
  }

  void read_rate(const ReadOptions& options) {
    clip_.frame_rate_hz = layout().rate_hz;
    if (clip_.frame_rate_hz > 0) return;
    clip_.frame_rate_hz =
        options.frame_rate_hz > 0 ? options.frame_rate_hz : c3d_rate_when_unknown_hz;
    source_.note(
        "frame_rate_assumed", layout().header_begin + 20,
        fmt::format("the file has no frame rate; it is taken to be {:g} Hz", clip_.frame_rate_hz));
  }

  // Blocks that stay in the cache, so that the clip's memory is written once and never read.
  void read_points() {
    const std::size_t points = layout().point_count, frames = layout().frame_count;
    if (points == 0 || frames == 0) return;
    const std::size_t block = c3d_block_frames(layout());
    C3dPoints part;
    part.resize(block * points);
    C3dPointDecoder decoder(source_.processor, layout());
    clip_.positions.reserve(frames * points);
    clip_.observed.reserve(frames * points);
    clip_.residuals.reserve(frames * points);
    for (std::size_t f = 0; f < frames; f += block) {
      const std::size_t count = std::min(block, frames - f);
      decoder.decode(source_.bytes.data() + layout().data_begin + f * layout().frame_bytes(), count,
                     part);
      const auto append = [&](auto& all, const auto& some) {
        all.insert(all.end(), some.data(), some.data() + count * points);
      };
      append(clip_.positions, part.positions);
      append(clip_.observed, part.observed);
      append(clip_.residuals, part.residuals);
    }
    repair_points(decoder.counts());
    document_.events = clip_.events;
    clip_.source.facts = c3d_facts(document_, decoder.counts());
  }

  // Samples whose fourth word has a residual or a camera: what was not seen has neither.
  std::vector<std::uint8_t> samples_with_a_measure() const {
    std::vector<std::uint8_t> measured(clip_.positions.size());
    const std::size_t bytes = layout().value_bytes();
    for (std::size_t i = 0; i < measured.size(); ++i) {
      if (clip_.observed[i] == 0 || !(clip_.positions[i] == Vec3{})) continue;
      const std::size_t frame = i / layout().point_count, point = i % layout().point_count;
      const std::size_t place =
          layout().data_begin + frame * layout().frame_bytes() + (4 * point + 3) * bytes;
      measured[i] = layout().is_float ? source_.real(place) >= 1 : source_.word(place) > 0;
    }
    return measured;
  }

  void repair_points(const C3dPointCounts& counts) {
    if (counts.not_finite > 0) {
      source_.note("value_not_finite", layout().data_begin,
                   "a position is no number although it is not marked as missing; it is missing",
                   counts.not_finite);
    }
    if (counts.zeros == 0) return;
    document_.zero_gaps =
        find_zero_gaps(clip_, layout().is_float ? 0 : layout().scale, samples_with_a_measure());
    if (document_.zero_gaps.empty()) return;
    mark_missing(document_.zero_gaps, clip_);
    source_.note("zero_is_missing", layout().data_begin,
                 "a marker is at 0, 0, 0 where it cannot have been; it is missing",
                 sample_count(document_.zero_gaps));
  }

  void remember() {
    document_.names = clip_.names;
    document_.unit = clip_.unit;
    document_.frame_rate_hz = clip_.frame_rate_hz;
    document_.events = clip_.events;
    if (clip_.source.facts.empty()) clip_.source.facts = c3d_facts(document_, {});
  }

  C3dSource& source_;
  C3dDocument& document_;
  MarkerClip& clip_;
};

}  // namespace

int sniff_c3d(std::string_view head) {
  const std::size_t begin = head.find_first_not_of('\0');
  if (begin == head.npos || begin + 1 >= head.size() || head[begin + 1] != 0x50) return 0;
  const std::size_t block = static_cast<unsigned char>(head[begin]);
  const std::size_t parameters = begin + (block - 1) * c3d_block_bytes;
  if (block < 2) return 0;
  if (parameters + 4 > head.size()) return begin == 0 ? 60 : 10;
  const auto processor = static_cast<unsigned char>(head[parameters + 3]);
  if (processor >= 84 && processor <= 86) return 100;
  return head[parameters + 1] == 0x50 ? 70 : 10;
}

TakeResult read_c3d(std::string bytes, std::string_view name, const ReadOptions& options) {
  TakeResult result;
  auto document = std::make_shared<C3dDocument>();
  document->bytes = std::move(bytes);
  MarkerClip clip;
  C3dSource source{name, document->bytes, options.strict, result.diagnostics};
  C3dReader(source, *document, clip).read(options);
  clip.source.name = name;
  clip.source.format = "c3d";
  clip.source.document = std::move(document);
  result.take = std::move(clip);
  return result;
}

}  // namespace kinemend
