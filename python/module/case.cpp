// SPDX-License-Identifier: Apache-2.0
#include "case.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/read_file.hpp"
#include "piola/base/units.hpp"
#include "piola/formulations/renamed_outputs.hpp"
#include "piola/input/document.hpp"
#include "piola/input/document_limits.hpp"
#include "piola/model/read_case.hpp"
#include "piola/pictures/history_plot.hpp"
#include "piola/simulation/build.hpp"
#include "piola/simulation/case_schema.hpp"
#include <fmt/format.h>
#include <pybind11/stl.h>

namespace piola::python {

namespace {

/// The case file itself for a folder that holds a case.toml. Throws InputError if there is none.
std::filesystem::path case_path(std::string const& file) {
  std::filesystem::path path(file);
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) path /= "case.toml";
  if (!std::filesystem::exists(path, error))
    throw InputError(fmt::format("{}: there is no such case file - check the path", path.string()));
  return path;
}

py::object value_of(Node const& node) {
  switch (node.kind) {
    case Node::Kind::text:
    case Node::Kind::date: return py::str(node.text);
    case Node::Kind::integer: return py::int_(node.integer);
    case Node::Kind::real: return py::float_(node.real);
    case Node::Kind::flag: return py::bool_(node.flag);
    case Node::Kind::array: {
      py::list items;
      for (Node const& item : node.items) items.append(value_of(item));
      return items;
    }
    case Node::Kind::table: break;
  }
  py::dict entries;
  for (Node::Entry const& entry : node.entries) entries[py::str(entry.key)] = value_of(entry.value);
  return entries;
}

}  // namespace

ReadCase read(std::string const& file, std::string const& text, std::string const& name,
              std::vector<std::string> const& overrides, bool of_results) {
  py::gil_scoped_release const others_may_run;
  ReadCase from;
  from.file = file;
  if (file.empty()) {
    from.spec = read_case_text(text, name, overrides, {}, &from.particles);
    return from;
  }
  std::filesystem::path const path = case_path(file);
  from.file = path.string();
  from.spec = read_case(path, overrides, {.of_results = of_results}, &from.particles);
  return from;
}

py::tuple document(std::string const& file, std::string const& text, std::string const& name,
                   std::vector<std::string> const& overrides) {
  std::string const path = file.empty() ? "" : case_path(file).string();
  Problems problems;
  auto document = parse_document(file.empty() ? text : read_input_file(path, most_case_bytes),
                                 file.empty() ? name : path, problems);
  if (document) apply_overrides(*document, overrides, problems);
  problems.raise_if_any();
  return py::make_tuple(document->source, value_of(document->root));
}

std::vector<std::string> warnings_for(ReadCase const& from) {
  py::gil_scoped_release const others_may_run;
  return build(from.spec, from.particles).warnings;
}

py::array positions_of(ParticleSet const& particles, py::handle owner) {
  return shown(reinterpret_cast<double const*>(particles.X.seen().data()), {particles.size(), 3}, owner);
}

py::array volumes_of(ParticleSet const& particles, py::handle owner) {
  return shown(particles.volume.seen().data(), {particles.size()}, owner);
}

py::array bodies_of(ParticleSet const& particles, py::handle owner) {
  return shown(particles.body.seen().data(), {particles.size()}, owner);
}

namespace {

/// (name, first, last) of each body: its particles are [first, last).
std::vector<py::tuple> bodies(ReadCase const& from) {
  std::vector<py::tuple> list;
  for (Body const& body : from.particles.bodies) list.push_back(py::make_tuple(body.name, body.first, body.last));
  return list;
}

std::vector<std::string> supports(ReadCase const& from) {
  std::vector<std::string> names;
  for (SupportSpec const& support : from.spec.supports) names.push_back(support.name);
  return names;
}

double seconds(std::string const& text) {
  Quantity const time = read_quantity(text, "s");
  if (time.problem) throw InputError(*time.problem + " - give a time such as \"20 ms\"");
  return time.value;
}

}  // namespace

void add_case(py::module_& m) {
  m.def("read", &read, py::arg("file"), py::arg("text"), py::arg("name"), py::arg("overrides"),
        py::arg("of_results") = false);
  m.def("document", &document, py::arg("file"), py::arg("text"), py::arg("name"), py::arg("overrides"));
  m.def("case_schema", &case_schema);
  m.def("warnings", &warnings_for, py::arg("case"));
  m.def("seconds", &seconds, py::arg("text"));
  m.def("current_output_name", &current_output_name, py::arg("name"));
  m.def("unit_of_column", &unit_of_column, py::arg("name"));
  py::class_<ReadCase>(m, "ReadCase")
      .def_property_readonly("title", [](ReadCase const& from) { return from.spec.title; })
      .def_property_readonly("file", [](ReadCase const& from) { return from.file; })
      .def_property_readonly("source", [](ReadCase const& from) { return from.spec.source; })
      .def_property_readonly("identity", [](ReadCase const& from) { return from.spec.identity.run; })
      .def_property_readonly("end", [](ReadCase const& from) { return from.spec.run.end; })
      .def_property_readonly("dimension", [](ReadCase const& from) { return from.particles.dimension; })
      .def_property_readonly("bodies", &bodies)
      .def_property_readonly("supports", &supports)
      .def_property_readonly("X", [](py::object self) { return positions_of(self.cast<ReadCase&>().particles, self); })
      .def_property_readonly("volume",
                             [](py::object self) { return volumes_of(self.cast<ReadCase&>().particles, self); });
}

}  // namespace piola::python
