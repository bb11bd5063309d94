// Converts texts, options and arrays, and states the expected shape of an array.
#include "conversions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstring>
#include <type_traits>
#include <variant>

namespace kinemend::python {

static_assert(sizeof(Quat) == 4 * sizeof(double) && std::is_trivially_copyable_v<Quat>);
static_assert(sizeof(Vec3) == 3 * sizeof(double) && std::is_trivially_copyable_v<Vec3>);

py::str text_of(std::string_view bytes) {
  PyObject* const text =
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "surrogateescape");
  if (text == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(text);
}

py::list texts_of(const std::vector<std::string>& list) {
  py::list texts;
  for (const std::string& bytes : list) texts.append(text_of(bytes));
  return texts;
}

std::string bytes_of(const py::handle& text) {
  if (PyUnicode_Check(text.ptr()) == 0) throw py::type_error("expected a str");
  PyObject* const bytes = PyUnicode_AsEncodedString(text.ptr(), "utf-8", "surrogateescape");
  if (bytes == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::bytes>(bytes);
}

std::vector<std::string> all_bytes_of(const py::iterable& texts) {
  // The letters of one str would be taken for names.
  if (PyUnicode_Check(texts.ptr()) != 0)
    throw py::type_error("expected a list of names, not one str");
  std::vector<std::string> list;
  for (const py::handle text : texts) list.push_back(bytes_of(text));
  return list;
}

KnownNames known_names_of(const py::dict& names) {
  KnownNames known;
  for (const auto& [key, value] : names) known[bytes_of(key)] = bytes_of(value);
  return known;
}

py::object object_of(const OptionValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return text_of(*text);
  if (const auto* is_set = std::get_if<bool>(&value)) return py::bool_(*is_set);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return py::int_(*whole);
  return py::float_(std::get<double>(value));
}

py::dict dict_of(const OptionValues& values) {
  py::dict dict;
  for (const auto& [name, value] : values) dict[text_of(name)] = object_of(value);
  return dict;
}

namespace {

OptionValue option_value_of(const std::string& name, const py::handle& value) {
  PyObject* const object = value.ptr();
  if (PyBool_Check(object) != 0) return value.cast<bool>();
  if (PyUnicode_Check(object) != 0) return bytes_of(value);
  if (PyIndex_Check(object) != 0) return value.cast<std::int64_t>();
  if (PyFloat_Check(object) != 0) return value.cast<double>();
  throw py::type_error(fmt::format("{}: expected a bool, a number or a str, not {}", name,
                                   std::string(py::str(py::type::of(value)))));
}

}  // namespace

OptionValues option_values_of(const py::dict& values) {
  OptionValues options;
  for (const auto& [key, value] : values) {
    const std::string name = bytes_of(key);
    options[name] = option_value_of(name, value);
  }
  return options;
}

void check_shape(const py::array& array, const std::vector<py::ssize_t>& shape,
                 std::string_view name) {
  bool fits = array.ndim() == static_cast<py::ssize_t>(shape.size());
  for (std::size_t i = 0; fits && i < shape.size(); ++i)
    fits = shape[i] < 0 || array.shape(static_cast<py::ssize_t>(i)) == shape[i];
  if (fits) return;
  std::vector<std::string> expected;
  for (const py::ssize_t length : shape)
    expected.push_back(length < 0 ? "any" : std::to_string(length));
  const std::vector<py::ssize_t> found(array.shape(), array.shape() + array.ndim());
  throw py::value_error(fmt::format("{}: expected an array of shape ({}), found ({})", name,
                                    fmt::join(expected, ", "), fmt::join(found, ", ")));
}

namespace {

template <class T, class Array>
std::vector<T> elements_of(const Array& array) {
  const std::size_t bytes = static_cast<std::size_t>(array.nbytes());
  std::vector<T> elements(bytes / sizeof(T));
  if (bytes > 0) std::memcpy(static_cast<void*>(elements.data()), array.data(), bytes);
  return elements;
}

}  // namespace

std::vector<Quat> quats_of(const Numbers& array) { return elements_of<Quat>(array); }
std::vector<Vec3> vectors_of(const Numbers& array) { return elements_of<Vec3>(array); }
std::vector<std::uint8_t> marks_of(const Marks& array) { return elements_of<std::uint8_t>(array); }

}  // namespace kinemend::python
