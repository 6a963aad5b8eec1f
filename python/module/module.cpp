// SPDX-License-Identifier: Apache-2.0
// piola._piola: the library as Python sees it. What users call stands in python/piola/.
#include "piola/base/errors.hpp"
#include "piola/base/version.hpp"
#include "case.hpp"

namespace {

/// Raises the class of piola.errors that stands for a C++ exception.
void raise_as(char const* name, char const* what) {
  pybind11::object const type = pybind11::module_::import("piola.errors").attr(name);
  PyErr_SetString(type.ptr(), what);
}

void translate(std::exception_ptr error) {
  try {
    if (error) std::rethrow_exception(error);
  } catch (piola::InputError const& e) {
    raise_as("InputError", e.what());
  } catch (piola::PhysicsError const& e) {
    raise_as("PhysicsError", e.what());
  } catch (piola::FileError const& e) {
    raise_as("FileError", e.what());
  }
}

}  // namespace

PYBIND11_MODULE(_piola, m) {
  m.doc() = "Piola's library; use the module piola";
  m.attr("version") = std::string(piola::version());
  pybind11::register_exception_translator(&translate);
  piola::python::add_case(m);
  piola::python::add_run(m);
}
