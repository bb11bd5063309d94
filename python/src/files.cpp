// Reads and writes takes as the program does.
#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <utility>

#include "conversions.hpp"
#include "held.hpp"
#include "kinemend/io.hpp"
#include "running.hpp"

namespace kinemend::python {

namespace {

using namespace py::literals;
namespace fs = std::filesystem;

ReadOptions read_options(const std::string& format, bool strict, const fs::path& skeleton,
                         double frame_rate_hz, const py::str& animation) {
  ReadOptions options;
  options.format = format;
  options.strict = strict;
  options.skeleton = skeleton;
  options.frame_rate_hz = frame_rate_hz;
  options.animation = bytes_of(animation);
  return options;
}

template <class Read>
HeldTakePtr read_watched(const py::object& progress, ReadOptions options, const Read& read) {
  TakeResult result;
  run_watched(progress, [&](const Tell& tell) {
    options.progress = [&](double done) { tell("reading", done); };
    result = read(options);
  });
  return hold(std::move(result.take), std::move(result.diagnostics));
}

HeldTakePtr read_path(const fs::path& path, const std::string& format, bool strict,
                      const fs::path& skeleton, double frame_rate_hz, const py::str& animation,
                      const py::object& progress) {
  return read_watched(progress, read_options(format, strict, skeleton, frame_rate_hz, animation),
                      [&](const ReadOptions& options) { return read_take(path, options); });
}

HeldTakePtr read_bytes(const py::bytes& bytes, const std::string& name, const std::string& format,
                       bool strict, const fs::path& skeleton, double frame_rate_hz,
                       const py::str& animation, const py::object& progress) {
  std::string content = bytes;
  return read_watched(
      progress, read_options(format, strict, skeleton, frame_rate_hz, animation),
      [&](const ReadOptions& options) { return read_take(std::move(content), name, options); });
}

bool holds(const fs::path& path, std::string_view bytes) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) && read_file(path) == bytes;
}

// Takes written at the same time may share a skeleton, so it may exist already.
void write_side_file(const SideFile& file, bool overwrite) {
  std::error_code ignored;
  if (file.path.has_parent_path()) fs::create_directories(file.path.parent_path(), ignored);
  try {
    write_file(file.path, file.bytes, overwrite);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::cannot_write || !holds(file.path, file.bytes)) throw;
  }
}

std::string format_for(const fs::path& path, const std::string& asked, const Take& take) {
  if (!asked.empty()) return asked;
  const Format* const format = path.extension().empty() ? nullptr : format_of_path(path);
  return format != nullptr ? std::string(format->name) : take.source.format;
}

void write_path(const HeldTakePtr& held, const fs::path& path, const std::string& format,
                bool overwrite) {
  const py::gil_scoped_release release;
  held->check();
  std::error_code ignored;
  if (!overwrite && fs::is_regular_file(path, ignored))
    throw Error(ErrorKind::cannot_write,
                path.string() + ": exists already (overwrite=True overwrites it)");
  const TakeFiles files = files_of_take(held->take, format_for(path, format, held->take), path);
  for (const SideFile& file : files.beside) write_side_file(file, overwrite);
  write_file(path, files.bytes, overwrite);
}

py::bytes to_bytes(const HeldTakePtr& held, const std::string& format) {
  std::string bytes;
  {
    const py::gil_scoped_release release;
    held->check();
    bytes = write_take(held->take, format);
  }
  return bytes;
}

py::list losses(const HeldTake& held, const std::string& format) {
  py::list list;
  const Diagnostics lost = lost_in_writing(held.take, format);
  for (const Diagnostic& entry : lost.entries())
    list.append(py::make_tuple(entry.name, text_of(entry.message), entry.first_line, entry.count));
  return list;
}

}  // namespace

void bind_files(py::module_& module) {
  module.def("read_path", read_path, "path"_a, "format"_a, "strict"_a, "skeleton"_a,
             "frame_rate_hz"_a, "animation"_a, "progress"_a);
  module.def("read_bytes", read_bytes, "bytes"_a, "name"_a, "format"_a, "strict"_a, "skeleton"_a,
             "frame_rate_hz"_a, "animation"_a, "progress"_a);
  module.def("write_path", write_path, "take"_a, "path"_a, "format"_a, "overwrite"_a);
  module.def("to_bytes", to_bytes, "take"_a, "format"_a);
  module.def("losses", losses, "take"_a, "format"_a);
}

}  // namespace kinemend::python
