// Reads AMC and ASF files as takes, and recognises AMC.
#include <fmt/format.h>

#include <array>
#include <limits>
#include <utility>

#include "io/acclaim/amc.hpp"
#include "io/acclaim/amc_document.hpp"
#include "io/acclaim/amc_rows.hpp"
#include "io/acclaim/amc_skeleton_file.hpp"
#include "io/acclaim/asf.hpp"
#include "io/acclaim/asf_scanner.hpp"
#include "io/motion/clip_rows.hpp"
#include "io/motion/joined_numbers.hpp"
#include "io/text/text.hpp"
#include "kinemend/error.hpp"
#include "motion/frame_numbers.hpp"

namespace kinemend {

namespace {

// The rate of most CMU takes (docs/formats/amc.md).
constexpr double custom_rate_hz = 120;

// A frame has at least its number, the names, and a digit and a space per value.
std::size_t least_frame_bytes(const AmcLayout& layout) {
  std::size_t bytes = 2;
  for (const AmcBone& bone : layout) bytes += bone.name.size() + 1 + 2 * bone.columns.size();
  return bytes;
}

void note_repairs(const SourceText& text, Diagnostics& diagnostics, const AmcRows& rows) {
  const auto note = [&](const char* place, std::size_t count, std::string_view kind,
                        std::string_view message) {
    if (count == 0) return;
    note_repair(text, diagnostics, kind, static_cast<std::size_t>(place - text.bytes.data()),
                message, count);
  };
  note(rows.first_gap(), rows.gaps(), "value_not_finite",
       "a value is not finite: held from a neighbouring frame");
  note(rows.joins().empty() ? nullptr : rows.joins().front(), rows.joins().size(), "numbers_joined",
       joined_numbers_text);
  note(rows.first_number_jump(), rows.number_jumps(), "frame_number_jump",
       "the number of a frame is not one more than the number before: frames are kept in the order "
       "of the file");
}

// Reports a cut frame, and makes reads and writes end before it.
void note_cut(const SourceText& text, Diagnostics& diagnostics, const AmcRows& rows,
              std::size_t frames) {
  if (rows.cut_frame() == nullptr) return;
  if (frames == 0)
    throw text.error_at(rows.cut_frame(), "the file ends in the middle of its first frame");
  note_repair(text, diagnostics, "file_cut",
              static_cast<std::size_t>(rows.cut_frame() - text.bytes.data()),
              "the file ends in the middle of a frame: the frames before it are read");
}

void read_frames(const SourceText& text, Diagnostics& diagnostics, Take& clip,
                 AmcDocument& document) {
  document.is_angle = angle_columns(clip.skeleton);
  ClipRows clip_rows(clip, offset_adding_frames(clip.skeleton),
                     text.bytes.size() + document.asf_bytes.size());
  AmcRows rows(text, document.data_begin, document.layout, document.is_angle,
               document.degrees_per_value);
  const std::size_t width = clip_rows.columns().count(), block = clip_rows.columns().block_frames();
  clip_rows.reserve(
      std::numeric_limits<std::size_t>::max(),
      (text.bytes.size() - document.data_begin) / least_frame_bytes(document.layout) + 1);
  std::vector<double> values(block * width);
  std::size_t filled = 0, gaps_before = 0;
  for (bool more = true; more;) {
    more = rows.next(values.data() + filled * width);
    filled += more ? 1 : 0;
    if (filled < block && more) continue;
    if (!clip_rows.fits(clip_rows.frames() + filled)) {
      throw text.error_at(document.data_begin,
                          fmt::format("{} joints: too much memory for a file of {} bytes",
                                      clip.joint_count(), text.bytes.size()));
    }
    clip_rows.append(values.data(), filled, rows.gaps() > gaps_before);
    gaps_before = rows.gaps();
    filled = 0;
  }
  if (rows.gaps() > 0 && rows.gaps() == clip.frame_count() * width) {
    throw text.error_at(rows.first_gap(), "every value is not finite");
  }
  note_cut(text, diagnostics, rows, clip.frame_count());
  note_repairs(text, diagnostics, rows);
  clip_rows.finish(document, rows.gaps() > 0);
  note_first_frame(clip, rows.first_frame_number());
  document.data_end = rows.last_end();
  document.decimals = rows.most_decimals();
  if (rows.cut_frame() != nullptr)
    document.bytes.resize(static_cast<std::size_t>(rows.cut_frame() - text.bytes.data()));
  separate_numbers(document, rows.joins());
}

void set_rate(Take& clip, Diagnostics& diagnostics, const ReadOptions& options) {
  clip.frame_rate_hz = options.frame_rate_hz;
  if (options.frame_rate_hz != 0) return;
  clip.frame_rate_hz = custom_rate_hz;
  // Not a repair: no AMC file states a rate, so a strict reader accepts it.
  diagnostics.add("frame_rate_assumed",
                  fmt::format("AMC files hold no frame rate: {:.0f} Hz assumed", custom_rate_hz));
}

class AmcRowReader : public RowReader {
 public:
  explicit AmcRowReader(const AmcDocument& document)
      : width_(document.is_angle.size()),
        rows_({document.name, document.bytes}, document.data_begin, document.layout,
              document.is_angle, document.degrees_per_value) {}

  void next(double* values, std::size_t frames, TokenSpan* tokens) override {
    for (std::size_t f = 0; f < frames; ++f) rows_.next(values + f * width_, tokens + f * width_);
  }

 private:
  std::size_t width_;
  AmcRows rows_;
};

}  // namespace

std::unique_ptr<RowReader> AmcDocument::rows() const {
  return std::make_unique<AmcRowReader>(*this);
}

std::vector<std::uint8_t> angle_columns(const Skeleton& skeleton) {
  std::vector<std::uint8_t> angles;
  for (const auto& channels : skeleton.channels) {
    for (const Channel channel : channels) angles.push_back(is_rotation(channel) ? 1 : 0);
  }
  return angles;
}

int sniff_amc(std::string_view head) {
  if (head.substr(0, 3) == "\xEF\xBB\xBF") head.remove_prefix(3);
  constexpr std::string_view mark = "#!OML:ASF";
  if (equal_ignoring_case(head.substr(0, mark.size()), mark)) return 100;
  AsfScanner scanner(head);
  const std::string_view word = scanner.next();
  constexpr std::array<std::string_view, 4> keywords{":FULLY-SPECIFIED", ":DEGREES", ":RADIANS",
                                                     ":FORCE-ALL-JOINTS-BE-3DOF"};
  for (const std::string_view keyword : keywords) {
    if (equal_ignoring_case(word, keyword)) return 100;
  }
  return word == "1" && equal_ignoring_case(scanner.next(), "root") ? 90 : 0;
}

TakeResult read_amc(std::string bytes, std::string_view name, std::string asf_bytes,
                    std::string_view asf_name, const ReadOptions& options) {
  const auto document = std::make_shared<AmcDocument>();
  document->bytes = std::move(bytes);
  document->asf_bytes = std::move(asf_bytes);
  document->name = name;
  document->skeleton_name = std::filesystem::path(asf_name).filename().string();
  TakeResult result;
  const SourceText asf_text{asf_name, document->asf_bytes, options.strict};
  AsfSkeleton asf = parse_asf(asf_text, result.diagnostics, options.max_depth);
  const SourceText text{name, document->bytes, options.strict};
  if (text.bytes.empty()) throw text.error_at(std::size_t{0}, "the file is empty");
  const AmcHeader header = read_amc_header(text, result.diagnostics);
  document->data_begin = document->data_end = header.data_begin;
  document->degrees_per_value = header.radians.value_or(asf.radians) ? degrees_per_radian : 1;
  const bool has_frames = header.data_begin < text.bytes.size();
  document->layout = has_frames ? read_amc_layout(text, result.diagnostics, header, asf, asf_name)
                                : make_amc_layout(asf);
  Take& clip = result.take;
  clip.metres_per_unit = document->metres_per_unit = asf.metres_per_unit;
  clip.skeleton = std::move(asf.skeleton);
  set_rate(clip, result.diagnostics, options);
  read_frames(text, result.diagnostics, clip, *document);
  document->skeleton = clip.skeleton;
  document->frame_rate_hz = clip.frame_rate_hz;
  document->frame_count = clip.frame_count();
  std::vector<SourceFact> facts = std::move(clip.source.facts);
  facts.insert(facts.begin(), {"skeleton", std::string(asf_name)});
  clip.source = {std::string(name), "amc", document, std::move(facts)};
  return result;
}

TakeResult read_amc(std::string bytes, std::string_view name, const ReadOptions& options) {
  if (bytes.empty()) throw Error::at_line(name, 1, "the file is empty");
  Diagnostics ignored;
  const AmcHeader header = read_amc_header({name, bytes}, ignored);
  const std::filesystem::path asf = find_skeleton_file(name, header.skeleton_file, options);
  return read_amc(std::move(bytes), name, read_file(asf), asf.string(), options);
}

TakeResult read_asf(std::string bytes, std::string_view name, const ReadOptions& options) {
  const auto document = std::make_shared<AmcDocument>();
  document->asf_bytes = std::move(bytes);
  document->name = name;
  TakeResult result;
  const SourceText text{name, document->asf_bytes, options.strict};
  AsfSkeleton asf = parse_asf(text, result.diagnostics, options.max_depth);
  document->layout = make_amc_layout(asf);
  document->degrees_per_value = asf.radians ? degrees_per_radian : 1;
  Take& clip = result.take;
  clip.metres_per_unit = document->metres_per_unit = asf.metres_per_unit;
  clip.frame_rate_hz = options.frame_rate_hz != 0 ? options.frame_rate_hz : custom_rate_hz;
  clip.skeleton = std::move(asf.skeleton);
  document->is_angle = angle_columns(clip.skeleton);
  document->position_frames = offset_adding_frames(clip.skeleton);
  const MotionColumns columns(clip.skeleton);
  clip.translated_joints.assign(columns.translated_joints().begin(),
                                columns.translated_joints().end());
  document->skeleton = clip.skeleton;
  document->frame_rate_hz = clip.frame_rate_hz;
  clip.source = {std::string(name), "asf", document};
  return result;
}

}  // namespace kinemend
