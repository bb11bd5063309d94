#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "io/bvh.hpp"
#include "io/text.hpp"
#include "kinemend/error.hpp"
#include "kinemend/io.hpp"

namespace kinemend {

namespace {

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
              fmt::format("unknown format {}; there is: {}", quote(name), known_formats()));
}

const Format& format_of(std::string_view bytes, std::string_view name) {
  const Format* best = nullptr;
  int best_score = 0;
  for (const Format& format : formats()) {
    const int score = format.sniff(bytes.substr(0, sniffed_bytes));
    if (score > best_score) {
      best = &format;
      best_score = score;
    }
  }
  if (best == nullptr) best = format_of_path(std::filesystem::path(name));
  if (best != nullptr) return *best;
  if (bytes.empty()) throw Error::at_line(name, 1, "the file is empty");
  throw Error::at_line(name, 1,
                       fmt::format("not a motion file of a known format ({})", known_formats()));
}

}  // namespace

std::span<const Format> formats() {
  static const std::array<Format, 1> list{
      {{"bvh", "Biovision hierarchy", {".bvh"}, &sniff_bvh, &read_bvh, &write_bvh}}};
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

ReadResult read_clip(const std::filesystem::path& path, const ReadOptions& options) {
  return read_clip(read_file(path), path == "-" ? "standard input" : path.string(), options);
}

ReadResult read_clip(std::string bytes, std::string_view name, const ReadOptions& options) {
  const Format& format =
      options.format.empty() ? format_of(bytes, name) : format_called(options.format);
  return format.read(std::move(bytes), name, options);
}

std::string write_clip(const Clip& clip, std::string_view format) {
  return format_called(format).write(clip);
}

}  // namespace kinemend
