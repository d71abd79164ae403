#pragma once
// Between numpy's arrays and those of the library. Going out nothing is copied: an array looks into the memory of the
// object that it comes from, or takes that of a vector over. What looks into an object cannot be written to.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "pelage/point.h"

namespace pelage::python {

namespace py = pybind11;

using Extent = std::vector<py::ssize_t>;

/// Any numbers, as contiguous ones of that type; copied only where they are not.
template <class T>
using Numbers = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// The memory of `owner`, which lives as long as the array.
template <class T>
py::array view(const T* data, const Extent& extent, py::handle owner) {
  py::array array(py::dtype::of<T>(), extent, data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// The memory of a vector of numbers, or of tuples of them, which the array keeps.
template <class T, class Item>
py::array owned(std::vector<Item> values, const Extent& extent) {
  auto kept = std::make_unique<std::vector<Item>>(std::move(values));
  const auto* data = reinterpret_cast<const T*>(kept->data());
  py::capsule owner(kept.get(), [](void* p) { delete static_cast<std::vector<Item>*>(p); });
  kept.release();
  return py::array(py::dtype::of<T>(), extent, data, owner);
}

inline py::array rows_of(const std::vector<Point>& points, py::handle owner) {
  return view(reinterpret_cast<const double*>(points.data()), {std::ssize(points), 3}, owner);
}
inline py::array owned_rows(std::vector<Point> points) {
  const py::ssize_t count = std::ssize(points);
  return owned<double>(std::move(points), {count, 3});
}
inline py::array owned_numbers(std::vector<double> values) {
  const py::ssize_t count = std::ssize(values);
  return owned<double>(std::move(values), {count});
}

/// Throws Python's ValueError unless there are three numbers a row.
inline std::vector<Point> points_of(const Numbers<double>& rows, const std::string& name) {
  if (rows.ndim() != 2 || rows.shape(1) != 3) throw py::value_error(name + " has to be an array of shape (n, 3)");
  const auto* first = reinterpret_cast<const Point*>(rows.data());
  return {first, first + rows.shape(0)};
}

inline std::vector<double> values_of(const Numbers<double>& numbers) {
  return {numbers.data(), numbers.data() + numbers.size()};
}

}  // namespace pelage::python
