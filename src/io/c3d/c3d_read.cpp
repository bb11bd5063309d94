// Reads C3D files as takes of markers, and repairs damage. The `mend_c3d_` functions replace
// numbers that are not finite (nan, inf) in the bytes, so that no output written from them contains
// one; each returns how many values or samples it changed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/portable.hpp"
#include "io/c3d/c3d.hpp"
#include "io/text/text.hpp"

namespace kinemend {

namespace {

// Chosen by hand (docs/formats/c3d.md).
constexpr double c3d_rate_when_unknown_hz = 100;

void put(std::string& bytes, C3dProcessor processor, std::size_t offset, float value) {
  with_words(processor, [&](auto words) { words.put_real(bytes.data() + offset, value); });
}

float real_at(const std::string& bytes, C3dProcessor processor, std::size_t offset) {
  return with_words(processor, [&](auto words) { return words.real(bytes.data() + offset); });
}

// Whether the parameter is SCALE, SCALE2, ... or GEN_SCALE.
bool is_scale(const std::string& name) {
  return equal_ignoring_case(std::string_view(name).substr(0, 5), "SCALE") ||
         equal_ignoring_case(name, "GEN_SCALE");
}

// Whether a row of stored reals has one that is not finite, which has all bits of the exponent set.
// The loop has no branch so that it is fast for the usual file.
template <C3dProcessor processor>
bool has_not_finite(const char* row, std::size_t count) {
  constexpr std::uint32_t exponent = 0x7F800000u;
  std::uint32_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto bits = bits_as<std::uint32_t>(C3dWords<processor>::real(row + 4 * i));
    found |= (bits & exponent) == exponent ? 1u : 0u;
  }
  return found != 0;
}

template <C3dProcessor processor>
std::size_t mend_analog(std::string& bytes, const C3dLayout& layout) {
  using Words = C3dWords<processor>;
  const std::size_t channels = std::max<std::size_t>(layout.analog_count, 1);
  std::size_t mended = 0;
  for (std::size_t f = 0; f < layout.frame_count; ++f) {
    char* const row =
        bytes.data() + layout.data_begin + f * layout.frame_bytes() + layout.point_bytes();
    if (!has_not_finite<processor>(row, layout.analog_values)) continue;
    for (std::size_t i = 0; i < layout.analog_values; ++i) {
      if (std::isfinite(Words::real(row + 4 * i))) continue;
      float held = 0;
      if (i >= channels) {
        held = Words::real(row + 4 * (i - channels));
      } else if (f > 0 && layout.analog_values >= channels) {
        held = Words::real(row - layout.frame_bytes() + 4 * (layout.analog_values - channels + i));
      }
      Words::put_real(row + 4 * i, held);
      ++mended;
    }
  }
  return mended;
}

// Gives the reals of POINT and ANALOG that are not finite a neutral value: 1 for the scales of
// analog channels, 0 for all others, which readers treat as unknown.
std::size_t mend_c3d_parameters(std::string& bytes, C3dProcessor processor,
                                C3dParameters& parameters) {
  std::size_t mended = 0;
  for (C3dParameter& entry : parameters.entries) {
    if (entry.type != C3dType::real) continue;
    const bool of_analog = parameters.holds("ANALOG", entry);
    if (!of_analog && !parameters.holds("POINT", entry)) continue;
    const float neutral = of_analog && is_scale(entry.name) ? 1 : 0;
    for (std::size_t i = 0; i < entry.numbers.size(); ++i) {
      if (std::isfinite(entry.numbers[i])) continue;
      entry.numbers[i] = static_cast<double>(neutral);
      put(bytes, processor, entry.data_begin + 4 * i, neutral);
      ++mended;
    }
  }
  return mended;
}

// Replaces the scale and the rate of the header, which are also in POINT, in the same way.
std::size_t mend_c3d_header(std::string& bytes, C3dProcessor processor, C3dHeader& header,
                            const C3dParameters& parameters) {
  constexpr std::size_t scale_word = 7, rate_word = 11;
  std::size_t mended = 0;
  const auto mend = [&](float& value, std::size_t word, std::string_view name) {
    if (std::isfinite(value)) return;
    value = static_cast<float>(parameters.number("POINT", name).value_or(0));
    if (!std::isfinite(value)) value = 0;
    put(bytes, processor, header.place_of(word), value);
    ++mended;
  };
  mend(header.scale, scale_word, "SCALE");
  mend(header.rate_hz, rate_word, "RATE");
  return mended;
}

// Marks samples of points with a number that is not finite as missing: zeros, and -1.
std::size_t mend_c3d_points(std::string& bytes, C3dProcessor processor, const C3dLayout& layout) {
  std::size_t mended = 0;
  for (std::size_t f = 0; layout.is_float && f < layout.frame_count; ++f) {
    for (std::size_t p = 0; p < layout.point_count; ++p) {
      const std::size_t sample = layout.data_begin + f * layout.frame_bytes() + 16 * p;
      float sum = 0;
      for (std::size_t i = 0; i < 4; ++i) sum += 0 * real_at(bytes, processor, sample + 4 * i);
      if (std::isfinite(sum)) continue;
      for (std::size_t i = 0; i < 3; ++i) put(bytes, processor, sample + 4 * i, 0);
      put(bytes, processor, sample + 12, static_cast<float>(missing_point_word));
      ++mended;
    }
  }
  return mended;
}

// Replaces an analog sample that is not finite by the previous sample of its channel, or by 0 at
// the start.
std::size_t mend_c3d_analog(std::string& bytes, C3dProcessor processor, const C3dLayout& layout) {
  if (!layout.is_float || layout.analog_values == 0) return 0;
  // Every real of a DEC file is a finite number.
  if (processor == C3dProcessor::dec) return 0;
  return processor == C3dProcessor::mips ? mend_analog<C3dProcessor::mips>(bytes, layout)
                                         : mend_analog<C3dProcessor::intel>(bytes, layout);
}

class C3dReader {
 public:
  C3dReader(C3dSource& source, C3dDocument& document, Take& clip)
      : source_(source), document_(document), clip_(clip) {}

  void read(const ReadOptions& options) {
    C3dHeader header = read_c3d_header(source_);
    document_.processor = source_.processor;
    document_.parameters = read_c3d_parameters(source_, header);
    mend_header(header);
    document_.layout = find_c3d_layout(source_, header, document_.parameters);
    read_names();
    read_kinds();
    clip_.unit = as_utf8(parameters().text("POINT", "UNITS"));
    clip_.first_frame = layout().first_frame;
    read_rate(options);
    clip_.events = read_c3d_events(source_, header, parameters());
    document_.event_times_finite = c3d_event_times_are_finite(source_, header, parameters());
    if (!document_.event_times_finite && source_.diagnostics.count("event_time_not_finite") == 0) {
      source_.note("event_time_not_finite", header.begin,
                   "the time of an event is not finite: the event is left out");
    }
    read_points();
    remember();
  }

 private:
  // Scales and rates that are not finite would spread to every sample.
  void mend_header(C3dHeader& header) {
    std::size_t mended =
        mend_c3d_parameters(document_.bytes, source_.processor, document_.parameters);
    mended += mend_c3d_header(document_.bytes, source_.processor, header, document_.parameters);
    source_.note("parameter_not_finite", header.parameters_begin,
                 "a rate, scale or offset is not finite: taken as unknown", mended);
  }

  const C3dLayout& layout() const { return document_.layout; }
  const C3dParameters& parameters() const { return document_.parameters; }

  void read_names() {
    clip_.names = parameters().texts("POINT", "LABELS");
    clip_.names.resize(std::min(clip_.names.size(), layout().point_count));
    for (std::string& name : clip_.names) {
      std::string converted = as_utf8(name);
      if (converted != name) {
        source_.note("label_not_utf8", layout().parameters_begin,
                     "the name of a marker is not UTF-8: read as Latin 1");
        name = std::move(converted);
      }
    }
    clip_.names.reserve(layout().point_count);
    while (clip_.names.size() < layout().point_count)
      clip_.names.push_back(fmt::format("*{}", clip_.names.size() + 1));
  }

  // POINT:ANGLES and similar lists, and the lists that POINT:TYPE_GROUPS names, contain the points
  // that are not positions.
  void read_kinds() {
    clip_.is_position.assign(clip_.marker_count(), 1);
    std::set<std::string, std::less<>> lists{"ANGLES", "FORCES",  "MOMENTS",
                                             "POWERS", "SCALARS", "REACTIONS"};
    const std::vector<std::string> groups = parameters().texts("POINT", "TYPE_GROUPS");
    for (std::size_t i = 0; i < groups.size(); i += 2) {
      // These lists contain positions, such as joint centres.
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
        fmt::format("the file has no frame rate: {:g} Hz is assumed", clip_.frame_rate_hz));
  }

  // Reads blocks that stay in the cache, so that the clip's memory is written once and never read.
  void read_points() {
    const std::size_t points = layout().point_count, frames = layout().frame_count;
    if (frames == 0) return;
    source_.note("analog_not_finite", layout().data_begin,
                 "an analog sample is not finite: held from the sample before",
                 mend_c3d_analog(document_.bytes, source_.processor, layout()));
    if (points == 0) return;
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

  // Marks samples whose fourth word has a residual or a camera; a sample that was not seen has
  // neither.
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
    source_.note("value_not_finite", layout().data_begin,
                 "a position is not finite and not marked as missing: taken as missing",
                 counts.not_finite);
    // Some programs mark missing points in this way too, so a strict reader accepts it.
    for (std::size_t i = 0; i < counts.missing_not_finite; ++i) {
      source_.diagnostics.add("missing_not_finite",
                              "a missing point holds a number that is not finite: zeros are "
                              "written");
    }
    if (counts.not_finite + counts.missing_not_finite > 0)
      mend_c3d_points(document_.bytes, source_.processor, layout());
    if (counts.zeros == 0) return;
    document_.zero_gaps =
        find_zero_gaps(clip_, layout().is_float ? 0 : layout().scale, samples_with_a_measure());
    if (document_.zero_gaps.empty()) return;
    mark_missing(document_.zero_gaps, clip_);
    source_.note("zero_is_missing", layout().data_begin,
                 "a marker is at 0, 0, 0 where it cannot have been: taken as missing",
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
  Take& clip_;
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
  Take& clip = result.take;
  auto document = std::make_shared<C3dDocument>();
  document->bytes = std::move(bytes);
  C3dSource source{name, document->bytes, options.strict, result.diagnostics};
  C3dReader(source, *document, clip).read(options);
  clip.source.name = name;
  clip.source.format = "c3d";
  clip.source.document = std::move(document);
  return result;
}

}  // namespace kinemend
