// The table of file formats, and the functions that read and write takes with it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "io/acclaim/amc.hpp"
#include "io/acclaim/asf.hpp"
#include "io/bvh/bvh.hpp"
#include "io/c3d/c3d.hpp"
#include "io/fbx/fbx.hpp"
#include "io/gltf/gltf.hpp"
#include "io/npz/npz.hpp"
#include "io/table/tables.hpp"
#include "io/text/number.hpp"
#include "io/text/text.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/io.hpp"

namespace kinemend {

namespace {

// Chosen by hand: more than any format needs to be recognised.
constexpr std::size_t sniffed_bytes = 4096;

std::string known_formats() {
  std::string names;
  for (const Format& format : formats())
    names += (names.empty() ? "" : ", ") + std::string(format.name);
  return names;
}

const Format& format_called(std::string_view name) {
  for (const Format& format : formats()) {
    if (format.name == name) return format;
  }
  throw Error(ErrorKind::usage,
              fmt::format("unknown format {}; the formats are: {}", quote(name), known_formats()));
}

// A repository with Git LFS holds a few lines in place of a large file, which a clone without LFS
// leaves there.
void refuse_lfs_pointer(std::string_view bytes, std::string_view name) {
  if (!bytes.starts_with("version https://git-lfs.github.com/spec/")) return;
  const std::size_t at = bytes.find("\nsize ");
  const NumberToken size = at == bytes.npos ? NumberToken{} : read_number(bytes.substr(at + 6, 24));
  throw Error::at_line(
      name, 1,
      size.kind == TokenKind::number
          ? fmt::format("a Git LFS pointer: the file itself ({} bytes) was not downloaded; "
                        "git lfs pull does that",
                        grouped(static_cast<std::size_t>(std::clamp(size.value, 0.0, 1e15))))
          : std::string("a Git LFS pointer: the file itself was not downloaded"));
}

const Format& format_of(std::string_view bytes, std::string_view name) {
  refuse_lfs_pointer(bytes, name);
  const Format* best = format_of_content(bytes.substr(0, sniffed_bytes));
  if (best == nullptr) best = format_of_path(std::filesystem::path(name));
  if (best != nullptr) return *best;
  if (bytes.empty()) throw Error::at_line(name, 1, "the file is empty");
  throw Error::at_line(name, 1,
                       fmt::format("not a motion file of a known format ({})", known_formats()));
}

// A table with tabs may have the extension .tsv, whichever program wrote it.
bool may_be_called(const Format& format, const Format& by_name) {
  return &format == &by_name || (format.name == "csv" && by_name.name == "tsv");
}

// Notes that the extension belongs to another format than the content.
void note_extension(const Format& format, std::string_view name, bool strict,
                    Diagnostics& diagnostics) {
  const std::filesystem::path path(name);
  const Format* const by_name = format_of_path(path);
  if (by_name == nullptr || may_be_called(format, *by_name)) return;
  const std::string message =
      fmt::format("the name ends in {}, but the content is {} ({}): read as {}",
                  path.extension().string(), format.name, format.description, format.name);
  note_repair(name, strict, diagnostics, "extension_mismatch", message);
}

// Lists the contents of a C3D file that a format for points only cannot store.
Diagnostics lost_beside_points(const Take& clip, std::string_view format) {
  std::vector<std::string> parts = c3d_beside_points(clip.source);
  if (!clip.events.empty() && format != "tsv") {
    parts.push_back(
        fmt::format("{} event{}", clip.events.size(), clip.events.size() == 1 ? "" : "s"));
  }
  if (const std::size_t others = clip.marker_count() - clip.position_count(); others > 0) {
    parts.push_back(others == 1 ? "a point that is not a position"
                                : fmt::format("{} points that are not positions", others));
  }
  const bool has_gaps =
      std::find(clip.observed.begin(), clip.observed.end(), 0) != clip.observed.end();
  const auto zeros = std::count(clip.positions.begin(), clip.positions.end(), Vec3{});
  if (format == "tsv" && clip.source.format != "tsv" && !has_gaps && zeros > 0)
    parts.push_back(
        fmt::format("measured samples at 0 0 0 ({}), which it uses for missing markers", zeros));
  Diagnostics losses;
  if (!parts.empty()) {
    losses.add("not_kept", fmt::format("{} files cannot hold {}", format, fmt::join(parts, "; ")));
  }
  return losses;
}

// Returns the requested format, else the source's, else the usual one.
const Format& format_to_write(const Take& take, std::string_view asked) {
  if (!asked.empty()) return format_called(asked);
  if (!take.source.format.empty()) return format_called(take.source.format);
  return format_called(take.has_joints() ? "bvh" : "c3d");
}

TakeResult with_joints(TakeResult result) {
  if (result.take.has_joints()) return result;
  throw Error(ErrorKind::usage, fmt::format("{}: holds markers; a take of joints is needed here",
                                            result.take.source.name));
}

std::string write_markers(const Take& take, const Format& format) {
  if (format.write_markers == nullptr)
    throw Error(ErrorKind::usage, fmt::format("{} files hold joints, not markers", format.name));
  if (format.name == "c3d" || take.position_count() == take.marker_count())
    return format.write_markers(take);
  const Take markers = positions_only(take);
  if (markers.marker_count() == 0) {
    throw Error(
        ErrorKind::usage,
        fmt::format("none of the points is a position of a marker; {} files hold nothing else",
                    format.name));
  }
  return format.write_markers(markers);
}

}  // namespace

std::span<const Format> formats() {
  static const std::vector<Format> list{
      {"bvh", "Biovision hierarchy", {".bvh"}, &sniff_bvh, &read_bvh, &write_bvh, nullptr},
      {"amc",
       "Acclaim motion, with its ASF skeleton",
       {".amc"},
       &sniff_amc,
       &read_amc,
       &write_amc,
       nullptr},
      {"asf", "Acclaim skeleton", {".asf"}, &sniff_asf, &read_asf, &write_asf, nullptr},
      {"c3d", "C3D motion capture", {".c3d"}, &sniff_c3d, &read_c3d, nullptr, &write_c3d},
      {"trc", "Track Row Column", {".trc"}, &sniff_trc, &read_trc, nullptr, &write_trc},
      {"tsv",
       "Table of markers of Qualisys Track Manager",
       {".tsv"},
       &sniff_tsv,
       &read_tsv,
       nullptr,
       &write_tsv},
      {"csv",
       "Table of markers or joints",
       {".csv"},
       &sniff_csv,
       &read_csv,
       &write_csv,
       &write_csv_markers},
      {"glb",
       "Binary glTF 2.0, a scene with an animated skeleton or markers",
       {".glb", ".vrm", ".vrma"},
       &sniff_glb,
       &read_glb,
       &write_glb,
       &write_glb,
       &lost_beside_gltf,
       &glb_files_of_take},
      {"gltf",
       "glTF 2.0 as text, a scene with an animated skeleton or markers",
       {".gltf"},
       &sniff_gltf,
       &read_gltf,
       &write_gltf,
       &write_gltf,
       &lost_beside_gltf,
       &gltf_files_of_take},
      {"fbx",
       "Autodesk FBX, an animated skeleton",
       {".fbx"},
       &sniff_fbx,
       &read_fbx,
       &write_fbx,
       &write_fbx,
       &lost_beside_fbx},
      {"npz",
       "Arrays of NumPy, joints or markers",
       {".npz"},
       &sniff_npz,
       &read_npz,
       &write_npz,
       &write_npz,
       &lost_beside_npz},
  };
  return list;
}

const Format* format_of_path(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  for (const Format& format : formats()) {
    const auto matches = [&](std::string_view known) {
      return equal_ignoring_case(known, extension);
    };
    if (std::any_of(format.extensions.begin(), format.extensions.end(), matches)) return &format;
  }
  return nullptr;
}

const Format* format_of_content(std::string_view head) {
  const Format* best = nullptr;
  int best_score = 0;
  for (const Format& format : formats()) {
    const int score = format.sniff(head);
    if (score > best_score) {
      best = &format;
      best_score = score;
    }
  }
  return best;
}

TakeResult read_take(const std::filesystem::path& path, const ReadOptions& options) {
  return read_take(read_file(path), path == "-" ? "standard input" : path.string(), options);
}

TakeResult read_take(std::string bytes, std::string_view name, const ReadOptions& options) {
  if (options.frame_rate_hz != 0) check_frame_rate(options.frame_rate_hz);
  const Format& format =
      options.format.empty() ? format_of(bytes, name) : format_called(options.format);
  Diagnostics about_name;
  if (options.format.empty()) note_extension(format, name, options.strict, about_name);
  TakeResult result = format.read(std::move(bytes), name, options);
  for (const Diagnostic& entry : about_name.entries())
    result.diagnostics.add(entry.name, entry.message);
  return result;
}

TakeResult read_joints(const std::filesystem::path& path, const ReadOptions& options) {
  return with_joints(read_take(path, options));
}

TakeResult read_joints(std::string bytes, std::string_view name, const ReadOptions& options) {
  return with_joints(read_take(std::move(bytes), name, options));
}

std::string write_with_curves(const Take& take, std::string_view format,
                              std::span<const NamedCurve> curves) {
  take.validate();
  if (!take.has_joints()) throw Error(ErrorKind::usage, "curves are written for takes of joints");
  for (const NamedCurve& curve : curves) {
    if (curve.values.size() != take.frame_count())
      throw Error(ErrorKind::usage, fmt::format("curve {}: {} values for {} frames", curve.name,
                                                curve.values.size(), take.frame_count()));
  }
  if (format == "fbx") return new_fbx_file(take, curves);
  if (format == "glb") return new_glb_of(take, curves);
  throw Error(ErrorKind::usage, fmt::format("{} holds no curves; expected fbx or glb", format));
}

std::string write_take(const Take& take, std::string_view format) {
  const Format& found = format_to_write(take, format);
  if (!take.has_joints()) return write_markers(take, found);
  if (found.write != nullptr) return found.write(take);
  throw Error(ErrorKind::usage, fmt::format("{} files hold markers, not joints", found.name));
}

Diagnostics lost_in_writing(const Take& take, std::string_view format) {
  const Format& found = format_called(format);
  const std::vector<std::string> parts =
      found.left_out == nullptr ? std::vector<std::string>{} : found.left_out(take);
  if (!parts.empty()) {
    Diagnostics losses;
    losses.add("not_kept",
               fmt::format("a new file is written: {} are left out", fmt::join(parts, ", ")));
    return losses;
  }
  if (take.has_joints()) return {};
  Diagnostics losses =
      found.name == "c3d" ? lost_in_c3d(take) : lost_beside_points(take, found.name);
  const std::string rest = csv_beside_markers(take, found.name == "csv");
  if (!rest.empty()) losses.add("rest_lost", rest + " are left out");
  return losses;
}

std::optional<SideFile> side_file(const Take& take, std::string_view bytes, std::string_view format,
                                  const std::filesystem::path& output) {
  if (format != "amc") return std::nullopt;
  return amc_side_file(take, bytes, output);
}

TakeFiles files_of_take(const Take& take, std::string_view format,
                        const std::filesystem::path& output) {
  const Format& found = format_to_write(take, format);
  if (found.write_files != nullptr) return found.write_files(take, output);
  TakeFiles files{write_take(take, format), {}};
  if (auto beside = side_file(take, files.bytes, format, output))
    files.beside.push_back(std::move(*beside));
  return files;
}

}  // namespace kinemend
