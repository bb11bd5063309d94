// Conversions of texts, options and arrays between Python and C++.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/options.hpp"
#include "kinemend/extend/rotation.hpp"
#include "kinemend/take.hpp"

namespace kinemend::python {

namespace py = pybind11;

/// Bytes of a file as text. Bytes that are not UTF-8 are kept, as in `os.fsdecode`.
py::str text_of(std::string_view bytes);
py::list texts_of(const std::vector<std::string>& list);
/// The inverse of `text_of`.
std::string bytes_of(const py::handle& text);
std::vector<std::string> all_bytes_of(const py::iterable& texts);
/// Names of feet in a take, by the known ones.
KnownNames known_names_of(const py::dict& names);

py::object object_of(const OptionValue& value);
py::dict dict_of(const OptionValues& values);
/// Errors: TypeError for a value that is not a bool, number or text.
OptionValues option_values_of(const py::dict& values);

/// An array that refers to memory kept alive by `owner`, without a copy.
template <class T>
py::array view_of(const py::handle& owner, std::vector<py::ssize_t> shape, const T* data,
                  bool is_writable = true) {
  py::array_t<T> array(std::move(shape), data, owner);
  if (!is_writable) array.attr("setflags")(py::arg("write") = false);
  return array;
}
inline const double* numbers_of(const std::vector<Quat>& list) {
  return reinterpret_cast<const double*>(list.data());
}
inline const double* numbers_of(const std::vector<Vec3>& list) {
  return reinterpret_cast<const double*>(list.data());
}

/// An array of doubles from Python, in C order.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Marks = py::array_t<bool, py::array::c_style | py::array::forcecast>;

/// Checks the shape of an array; a length of -1 allows any. Errors: ValueError for another shape.
void check_shape(const py::array& array, const std::vector<py::ssize_t>& shape,
                 std::string_view name);
std::vector<Quat> quats_of(const Numbers& array);
std::vector<Vec3> vectors_of(const Numbers& array);
std::vector<std::uint8_t> marks_of(const Marks& array);

}  // namespace kinemend::python
