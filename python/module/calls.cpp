#include "calls.h"

#include <algorithm>
#include <string>

namespace pelage::python {

namespace {

/// Python objects that go away in any thread.
std::shared_ptr<py::object> shared(py::object object) {
  return {new py::object(std::move(object)), [](py::object* p) {
            py::gil_scoped_acquire lock;
            delete p;
          }};
}

/// Whether to go on.
bool call(const py::object& function, std::string_view what, double fraction) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (function.is_none()) return true;
  const py::object answer = function(py::str(what.data(), what.size()), fraction);
  return !answer.is(py::bool_(false));
}

/// A constant stands for the same everywhere.
void take_rates(const py::handle& from, std::size_t count, double* to) {
  const auto rates = Numbers<double>::ensure(from);
  if (!rates) throw py::error_already_set();
  if (rates.size() == 1)
    std::fill(to, to + count, *rates.data());
  else if (rates.ndim() == 1 && static_cast<std::size_t>(rates.size()) == count)
    std::copy(rates.data(), rates.data() + count, to);
  else
    throw py::value_error("rates of a species have to be as many as its concentrations: " + std::to_string(count) +
                          ", not " + std::to_string(rates.size()));
}

void call(const py::object& function, const std::vector<const double*>& u, double t, std::size_t count,
          const std::vector<double*>& rate) {
  const py::capsule library(&function, [](void*) {});  // whose memory it is
  py::tuple arguments(u.size() + 1);
  arguments[0] = t;
  for (std::size_t i = 0; i < u.size(); ++i) arguments[i + 1] = view(u[i], {static_cast<py::ssize_t>(count)}, library);
  const py::object rates = function(*arguments);
  if (!py::isinstance<py::sequence>(rates) || py::len(rates) != rate.size())
    throw py::value_error("rates have to be a sequence of " + std::to_string(rate.size()) + " arrays, one per species");
  for (std::size_t i = 0; i < rate.size(); ++i) take_rates(rates[py::int_(i)], count, rate[i]);
}

}  // namespace

Progress progress_of(py::object function, std::shared_ptr<Thrown> thrown) {
  return [function = shared(std::move(function)), thrown = std::move(thrown)](std::string_view what, double fraction) {
    py::gil_scoped_acquire lock;
    try {
      return call(*function, what, fraction);
    } catch (py::error_already_set& error) {
      thrown->keep(error);
      return false;
    }
  };
}

OwnRates own_rates_of(py::object function, std::string stage, std::shared_ptr<Thrown> thrown) {
  if (function.is_none()) return {};
  return {std::move(stage), [function = shared(std::move(function)), thrown = std::move(thrown)](
                                const std::vector<const double*>& u, double t, std::size_t begin, std::size_t end,
                                const std::vector<double*>& rate) {
            py::gil_scoped_acquire lock;
            try {
              call(*function, u, t, end - begin, rate);
            } catch (py::error_already_set& error) {
              thrown->keep(error);
              throw Error(Fault::cancelled, "the rates have thrown an exception");
            } catch (const py::builtin_exception& fault) {
              fault.set_error();
              py::error_already_set error;
              thrown->keep(error);
              throw Error(Fault::cancelled, "the rates are of the wrong form");
            }
          }};
}

UpAxis up_called(const std::string& name) {
  if (name == "y") return UpAxis::y;
  if (name == "z") return UpAxis::z;
  throw py::value_error("up is y or z, not " + name);
}

SaveOptions save_options(const std::string& name, const std::string& up, bool compress) {
  SaveOptions options;
  options.name = name;
  options.up = up_called(up);
  options.compress = compress;
  return options;
}

void translate_errors() {
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const Error& e) {
      const py::object make = py::module_::import("pelage.errors").attr("error_of");
      const Location& at = e.where();
      const py::object error = make(static_cast<int>(e.fault()), e.what(), at.file, at.line, at.column);
      PyErr_SetObject(py::type::handle_of(error).ptr(), error.ptr());
    }
  });
}

}  // namespace pelage::python
