// SPDX-License-Identifier: Apache-2.0
#include "piola/output/summary.hpp"
#include "piola/base/contracts.hpp"
#include "piola/output/atomic_file.hpp"
#include <cmath>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

nlohmann::ordered_json guards_json(Summary const& s) {
  if (!s.guards) return "off";
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  for (GuardNumbers const& guard : *s.guards) {
    for (auto const& [name, value] : guard.values) all[guard.name][name] = value;
    if (!guard.words.empty()) all[guard.name]["warning"] = guard.words;
  }
  return all;
}

void add_ranks(Summary const& s, nlohmann::ordered_json& document) {
  for (RankTraffic const& rank : s.ranks)
    document["ranks"].push_back({{"messages", rank.messages},
                                 {"bytes", rank.bytes},
                                 {"collectives", rank.collectives},
                                 {"message_seconds", rank.message_seconds},
                                 {"replicated_bytes", rank.replicated_bytes},
                                 {"collective_seconds", rank.collective_seconds}});
  if (s.repartition_statistics)
    document["repartition"] = {{"count", s.repartition_statistics->imbalance.size()},
                               {"imbalance", s.repartition_statistics->imbalance},
                               {"last", s.repartition_statistics->last}};
}

nlohmann::ordered_json identity_json(Identity const& identity) {
  nlohmann::ordered_json files = nlohmann::ordered_json::object();
  for (auto const& [name, digest] : identity.files) files[name] = digest;
  return {{"run", identity.run},
          {"case", identity.case_text},
          {"files", files},
          {"program", identity.program},
          {"machine", identity.backend}};
}

nlohmann::ordered_json cracks_json(Summary::Cracks const& cracks) {
  return {
      {"area", cracks.area}, {"energy_per_area", cracks.energy}, {"fracture_energy_of_material", cracks.of_material}};
}

}  // namespace

std::string to_json(Summary const& s) {
  PIOLA_EXPECTS(s.threads >= 1 && s.particles >= 0 && s.steps >= 0);
  nlohmann::ordered_json quantities = nlohmann::ordered_json::object();
  for (MeasuredQuantity const& q : s.quantities) quantities[q.name] = {{"value", q.value}, {"unit", q.unit}};
  nlohmann::ordered_json document{{"status", s.status},
                                  {"title", s.title},
                                  {"version", s.version},
                                  {"identity", identity_json(s.identity)},
                                  {"formulation", s.formulation},
                                  {"particles", s.particles},
                                  {"steps", s.steps},
                                  {"bits", s.bits},
                                  {"end_time", s.end_time},
                                  {"wall_seconds", s.wall_seconds},
                                  {"stages_per_second", s.stages_per_second},
                                  {"threads", s.threads},
                                  {"energy",
                                   {{"initial", s.energy_initial},
                                    {"final", s.energy_final},
                                    {"max_increase", s.energy_max_increase},
                                    {"max_decrease", s.energy_max_decrease}}}};
  add_ranks(s, document);
  if (s.linear_drift && s.angular_drift)
    document["momentum"] = {{"linear_drift", *s.linear_drift}, {"angular_drift", *s.angular_drift}};
  if (s.cracks) document["cracks"] = cracks_json(*s.cracks);
  for (auto const& [unit, value] : s.scales) document["scales"][unit] = value;
  if (s.relaxation) {
    document["relaxation"] = {
        {"at_rest", s.relaxation->at_rest}, {"residual", s.relaxation->residual}, {"stops", s.relaxation->stops}};
    if (std::isfinite(s.relaxation->left)) document["relaxation"]["left"] = s.relaxation->left;
  }
  for (auto const& [name, value] : s.set_up) document["set_up"][name] = value;
  for (auto const& [name, value] : s.seconds) document["seconds"][name] = value;
  document["quantities"] = quantities;
  document["guards"] = guards_json(s);
  document["warnings"] = s.warnings;
  return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void write_summary(std::filesystem::path const& path, Summary const& summary) {
  write_whole_file(path, to_json(summary));
}

}  // namespace piola
