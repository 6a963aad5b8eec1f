// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/particles/particle_set.hpp"
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

namespace piola::python {

namespace py = pybind11;

/// Rows of doubles as Python gives them.
using Table = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// A case that was read and checked, with its particles.
struct ReadCase {
  CaseSpec spec;
  ParticleSet particles;
  std::string file;  ///< empty: from a text
};

/// Reads a file (`file` not empty) or a text. Throws InputError with all that is wrong.
ReadCase read(std::string const& file, std::string const& text, std::string const& name,
              std::vector<std::string> const& overrides, bool of_results);

/// The TOML text of a case with its settings, and its values as a dict, with texts and units as they are written.
/// Checks no more than the syntax. Throws InputError with all that is wrong with it.
py::tuple document(std::string const& file, std::string const& text, std::string const& name,
                   std::vector<std::string> const& overrides);

/// What warnings `piola check` has for a case. Builds its formulation. Throws InputError.
std::vector<std::string> warnings_for(ReadCase const& from);

/// A read-only array that shows memory of `owner`, which it keeps alive; no copy.
template <class T>
py::array shown(T const* data, std::vector<py::ssize_t> shape, py::handle owner) {
  py::array view(py::dtype::of<T>(), std::move(shape), data, owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

/// X (n, 3), volume (n) and body (n) of particles that `owner` holds.
py::array positions_of(ParticleSet const& particles, py::handle owner);
py::array volumes_of(ParticleSet const& particles, py::handle owner);
py::array bodies_of(ParticleSet const& particles, py::handle owner);

void add_case(py::module_& m);
void add_run(py::module_& m);

}  // namespace piola::python
