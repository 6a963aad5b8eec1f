// SPDX-License-Identifier: Apache-2.0
#include "piola/output/summary.hpp"
#include "session.hpp"
#include <pybind11/stl.h>

namespace piola::python {
namespace {

std::map<std::string, double> energies(Diagnostics const& d) {
  std::map<std::string, double> all{{"kinetic", d.kinetic_energy},
                                    {"strain", d.strain_energy},
                                    {"total", d.total_energy()},
                                    {"external_work", d.external_work},
                                    {"stabilisation_loss", d.stabilisation_loss},
                                    {"projection_loss", d.projection_loss},
                                    {"damping_loss", d.damping_loss}};
  for (auto const& [name, value] : d.more) all[name] = value;
  return all;
}

/// Session.load with where the state stood.
void load(Session& session, std::map<std::string, Table> const& arrays, double time, std::int64_t step, double dt,
          double first_dt) {
  TimeState at = session.moment();
  at.time = time;
  at.step = step;
  at.dt = dt;
  at.first_dt = first_dt;
  session.load(arrays, at);
}

py::array view(py::object const& self, py::array (*of)(ParticleSet const&, py::handle)) {
  return of(self.cast<Session&>().simulation().particles, self);
}

}  // namespace

void add_run(py::module_& m) {
  py::class_<Session>(m, "Session")
      .def(py::init([](ReadCase const& from, std::string const& folder, bool resume, bool force,
                       std::map<std::string, Table> velocity, std::map<std::string, Table> displacement,
                       std::map<std::string, py::function> supports) {
             return std::make_unique<Session>(from, folder, resume, force,
                                              Given{std::move(velocity), std::move(displacement), std::move(supports)});
           }),
           py::arg("case"), py::arg("folder"), py::arg("resume"), py::arg("force"), py::arg("initial_velocity"),
           py::arg("initial_displacement"), py::arg("support_velocity"))
      .def("advance", &Session::advance, py::arg("until"), py::arg("steps"), py::arg("exactly"))
      .def("finish", [](Session& s) { return to_json(s.finish().summary); })
      .def("observe", &Session::observe, py::arg("call"), py::arg("every"))
      .def("field", &Session::field, py::arg("name"), py::arg("out").noconvert() = py::none())
      .def("state", &Session::state)
      .def("load", &load, py::arg("arrays"), py::arg("time"), py::arg("step"), py::arg("dt"), py::arg("first_dt"))
      .def("take_warnings", &Session::take_warnings)
      .def_property_readonly("fields", &Session::fields)
      .def_property_readonly("history", &Session::history)
      .def_property_readonly("X", [](py::object const& self) { return view(self, &positions_of); })
      .def_property_readonly("volume", [](py::object const& self) { return view(self, &volumes_of); })
      .def_property_readonly("body", [](py::object const& self) { return view(self, &bodies_of); })
      .def_property_readonly("time", [](Session const& s) { return s.moment().time; })
      .def_property_readonly("step", [](Session const& s) { return s.moment().step; })
      .def_property_readonly("dt", [](Session const& s) { return s.moment().dt; })
      .def_property_readonly("first_dt", [](Session const& s) { return s.moment().first_dt; })
      .def_property_readonly("end", [](Session const& s) { return s.simulation().spec.run.end; })
      .def_property_readonly("stable_step",
                             [](Session const& s) { return s.simulation().formulation->stable_time_step(); })
      .def_property_readonly("threads", [](Session const& s) { return s.simulation().threads; })
      .def_property_readonly("mass", [](Session const& s) { return s.simulation().mass; })
      .def_property_readonly("energies",
                             [](Session const& s) { return energies(s.simulation().formulation->diagnose()); })
      .def_property_readonly("momentum",
                             [](Session const& s) { return s.simulation().formulation->diagnose().linear_momentum; })
      .def_property_readonly("angular_momentum",
                             [](Session const& s) { return s.simulation().formulation->diagnose().angular_momentum; });
}

}  // namespace piola::python
