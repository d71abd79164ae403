#pragma once
// Calls between Python and the library: progress, interrupts, exceptions, and Python's lock, which the library gives
// back while it works.

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "arrays.h"
#include "pelage/error.h"
#include "pelage/io.h"
#include "pelage/own_rates.h"
#include "pelage/progress.h"

namespace pelage::python {

/// What Python functions that the library calls have thrown. The library is left by an Error, from any thread; the
/// exception itself is thrown on where Python called.
class Thrown {
 public:
  /// Python's lock is held.
  void keep(py::error_already_set& error) {
    if (!error_) error_.emplace(error);
  }
  void throw_on() {
    if (!error_) return;
    py::error_already_set error = std::move(*error_);
    error_.reset();
    throw error;
  }

 private:
  std::optional<py::error_already_set> error_;
};

/// A Python function of what is being done and how much of it is, or None; what it throws, Ctrl-C, and the value False
/// stop the work.
Progress progress_of(py::object function, std::shared_ptr<Thrown> thrown);

/// A Python function of the time and of an array per species; it returns an array per species. The arrays look into the
/// library's memory, as long as the call lasts.
OwnRates own_rates_of(py::object function, std::string stage, std::shared_ptr<Thrown> thrown);

/// Runs the work without Python's lock; what a Python function has thrown in it is thrown on.
template <class Work>
auto without_lock(Thrown& thrown, Work&& work) {
  try {
    py::gil_scoped_release release;
    return work();
  } catch (const Error&) {
    thrown.throw_on();
    throw;
  }
}

/// The same for work that may only be stopped by a function of its own.
template <class Work>
auto with_progress(py::object function, Work&& work) {
  const auto thrown = std::make_shared<Thrown>();
  const Progress progress = progress_of(std::move(function), thrown);
  return without_lock(*thrown, [&] { return work(progress); });
}

/// `up`: "y" or "z"; throws Python's ValueError otherwise.
UpAxis up_called(const std::string& up);
SaveOptions save_options(const std::string& name, const std::string& up, bool compress);

/// Error as the exceptions of pelage/errors.py.
void translate_errors();

}  // namespace pelage::python
