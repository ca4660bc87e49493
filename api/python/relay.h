// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/progress.h>
#include <pybind11/pybind11.h>

#include <string>
#include <string_view>

namespace navcal::python {

/// Progress of the library to a Python function (None: to nobody), and Ctrl-C to the library. The function gets
/// step and share; False ends the job, and so does what it raises. The job must run without the interpreter's
/// lock.
[[nodiscard]] inline api::Progress relay_to(const pybind11::object& function) {
  return [&function](std::string_view step, double share) {
    const pybind11::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
    if (function.is_none()) return true;
    return !function(std::string(step), share).is(pybind11::bool_(false));
  };
}

}  // namespace navcal::python
