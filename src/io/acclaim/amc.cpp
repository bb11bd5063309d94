// Reads AMC and ASF files as takes, writes AMC in the layout of its source or in a plain one, and
// looks for the skeleton's file by the likely names, then by the subject of the take.
#include "io/acclaim/amc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "io/acclaim/amc_document.hpp"
#include "io/acclaim/asf.hpp"
#include "io/motion/clip_rows.hpp"
#include "io/motion/motion_document.hpp"
#include "io/motion/motion_write.hpp"
#include "io/text/text.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"
#include "motion/take.hpp"

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
  head = without_byte_order_mark(head);
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

namespace {

namespace fs = std::filesystem;

bool is_asf(const fs::path& path) { return equal_ignoring_case(path.extension().string(), ".asf"); }

// Returns the part before the number of the take: 35 for 35_01.
std::string subject_of(const std::string& stem) { return stem.substr(0, stem.find('_')); }

// Returns file names, the most likely first. A path inside the file is from the machine that wrote
// it, so only its last part is used.
std::vector<std::string> likely_names(const std::string& stem, std::string_view named_inside) {
  std::vector<std::string> names;
  const auto add = [&](std::string name) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(std::move(name));
  };
  const std::string_view inside = named_inside.substr(named_inside.find_last_of("\\/") + 1);
  if (is_asf(fs::path(inside))) add(std::string(inside));
  add(stem + ".asf");
  if (!subject_of(stem).empty()) add(subject_of(stem) + ".asf");
  return names;
}

// Whether a file belongs to a subject, as 35-walk.asf belongs to 35.
bool names_subject(const fs::path& file, const std::string& subject) {
  const std::string stem = file.stem().string();
  if (subject.empty() || stem.size() <= subject.size()) return false;
  const auto next = static_cast<unsigned char>(stem[subject.size()]);
  return equal_ignoring_case(stem.substr(0, subject.size()), subject) && std::isalnum(next) == 0;
}

std::vector<fs::path> asf_files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (is_asf(entry->path())) files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

fs::path find_skeleton_file(std::string_view amc_name, std::string_view named_inside,
                            const ReadOptions& options) {
  if (!options.skeleton.empty()) return options.skeleton;
  const fs::path parent = fs::path(amc_name).parent_path();
  const fs::path folder = parent.empty() ? fs::path(".") : parent;
  const std::string stem = fs::path(amc_name).stem().string();
  const std::vector<std::string> names = likely_names(stem, named_inside);
  const std::vector<fs::path> files = asf_files_in(folder);
  for (const std::string& name : names) {
    const auto same = [&](const fs::path& file) {
      return equal_ignoring_case(file.filename().string(), name);
    };
    const auto found = std::find_if(files.begin(), files.end(), same);
    if (found != files.end()) return parent / found->filename();
  }
  std::vector<fs::path> of_subject;
  for (const fs::path& file : files) {
    if (names_subject(file, subject_of(stem))) of_subject.push_back(file);
  }
  if (of_subject.size() == 1) return parent / of_subject[0].filename();
  if (files.size() == 1) return parent / files[0].filename();
  throw Error(
      ErrorKind::unreadable_input,
      fmt::format(
          "{}: an AMC file needs its skeleton: its folder has no {}, and {}; name one "
          "with --asf",
          amc_name, fmt::join(names, ", "),
          files.empty() ? "no other ASF file" : fmt::format("{} other ASF files", files.size())));
}

fs::path skeleton_place(const fs::path& output, std::string_view named_inside,
                        std::string_view asf_bytes, const std::string& usual_name) {
  const fs::path parent = output.parent_path();
  const std::string stem = output.stem().string();
  // Lists the files before reading them, because a take written meanwhile may add this skeleton.
  const std::vector<fs::path> files = asf_files_in(parent.empty() ? fs::path(".") : parent);
  const auto holds_it = [&](const fs::path& path) {
    std::error_code error;
    const auto size = fs::file_size(path, error);
    return !error && size == asf_bytes.size() && read_file(path) == asf_bytes;
  };
  try {
    if (holds_it(find_skeleton_file(output.string(), named_inside, {}))) return {};
  } catch (const Error&) {
    // The file does not exist yet.
  }
  const auto is_there = [&](const std::string& name) {
    return std::any_of(files.begin(), files.end(), [&](const fs::path& file) {
      return equal_ignoring_case(file.filename().string(), name);
    });
  };
  // A reader uses the first likely name that exists. Names before it are free and would be found
  // first.
  const std::vector<std::string> names = likely_names(stem, named_inside);
  const auto taken = std::find_if(names.begin(), names.end(), is_there);
  for (const std::string& wanted : {usual_name, stem + ".asf"}) {
    const auto found = std::find_if(names.begin(), taken, [&](const std::string& name) {
      return equal_ignoring_case(name, wanted);
    });
    if (found != taken) return parent / *found;
  }
  return parent / *taken;
}

}  // namespace kinemend
