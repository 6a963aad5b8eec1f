// SPDX-License-Identifier: Apache-2.0
#include "piola/study/refinement.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/formulations/renamed_outputs.hpp"
#include "piola/input/document.hpp"
#include "piola/output/atomic_file.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace piola {
namespace {

/// A case as read with its settings, before anything is made of it.
Document document_of(std::filesystem::path const& file, std::vector<std::string> const& settings) {
  Problems problems;
  auto document = parse_document(read_text_file(file), file.string(), problems);
  if (document) apply_overrides(*document, settings, problems);
  problems.raise_if_any();
  return *document;
}

/// Particles of a box in one direction when its spacing is `factor` times as large.
int scaled_count(int particles, double factor, ShapeSpec::Placement placement) {
  bool const on_faces = placement == ShapeSpec::Placement::on_boundary;
  if (on_faces && particles == 1) return 1;
  int const parts = on_faces ? particles - 1 : particles;
  int const scaled = std::max(1, static_cast<int>(std::lround(parts / factor)));
  return on_faces ? scaled + 1 : scaled;
}

Node whole_number(int number) {
  Node node;
  node.kind = Node::Kind::integer;
  node.integer = number;
  return node;
}

Node scaled_counts(ShapeSpec const& shape, double factor) {
  Node list;
  list.kind = Node::Kind::array;
  for (std::size_t d = 0; d < static_cast<std::size_t>(shape.dimension); ++d)
    list.items.push_back(whole_number(scaled_count(shape.particles[d], factor, shape.placement)));
  return list;
}

/// The setting for a body. A box that is given by its spacing gets a shape with numbers of particles in its place.
std::string spacing_setting(Node shape, std::size_t body, ShapeSpec const& spec, double factor) {
  std::string const key = fmt::format("body.{}.shape", body);
  if (spec.kind != ShapeSpec::Kind::box) return fmt::format("{}.spacing={}", key, exact_text(factor * spec.spacing));
  std::erase_if(shape.entries, [](auto const& entry) { return entry.key == "spacing" || entry.key == "particles"; });
  shape.entries.push_back({"particles", {}, scaled_counts(spec, factor)});
  return key + "=" + toml_value(shape);
}

/// The directions of a body in which the spacing can change, with the spacing there [m].
std::vector<double> spacings_of(ShapeSpec const& shape, ShapeSpec const& as) {
  std::vector<double> spacings;
  auto const all = spacing_of(shape);
  for (std::size_t d = 0; d < static_cast<std::size_t>(as.dimension); ++d)
    if (as.kind != ShapeSpec::Kind::box || as.particles[d] > 1) spacings.push_back(all[d]);
  return spacings;
}

}  // namespace

std::vector<std::string> spacing_settings(std::filesystem::path const& file, std::vector<std::string> const& settings,
                                          CaseSpec const& spec, double factor) {
  PIOLA_EXPECTS(factor > 0);
  std::vector<std::string> more;
  if (factor == 1) return more;
  Document const document = document_of(file, settings);
  Node const* const bodies = document.root.find("body");
  for (std::size_t b = 0; b < spec.bodies.size() && bodies != nullptr; ++b) {
    BodySpec const& body = spec.bodies[b];
    if (body.shape.kind == ShapeSpec::Kind::points)
      throw InputError(fmt::format(
          "{}: body {} has the particles of a file, which has one spacing (allowed: a shape with spacing or "
          "particles) - make files of several spacings and give them as values of body.{}.shape.points.file in a study",
          file.string(), in_quotes(body.name), body.name));
    more.push_back(spacing_setting(*bodies->items[b].find("shape"), b, body.shape, factor));
  }
  return more;
}

std::string quantity_setting(std::filesystem::path const& file, std::vector<std::string> const& settings,
                             std::vector<std::string> const& columns) {
  Document const document = document_of(file, settings);
  Node list;
  list.kind = Node::Kind::array;
  if (Node const* const given = document.root.find("quantity"); given != nullptr) list.items = given->items;
  for (std::string const& asked : columns) {
    std::size_t const colon = std::min(asked.find(':'), asked.size());
    std::string const take = colon < asked.size() ? asked.substr(colon + 1) : "final_value";
    std::string const column = current_output_name(asked.substr(0, colon));
    std::string name = column + "_" + take;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '.' || c == '-'; }, '_');
    Node quantity;
    quantity.entries = {
        {"name", {}, text_node(name)}, {"column", {}, text_node(column)}, {"take", {}, text_node(take)}};
    list.items.push_back(std::move(quantity));
  }
  return "quantity=" + toml_value(list);
}

SpacingRatio spacing_ratio(CaseSpec const& fine, CaseSpec const& coarse) {
  PIOLA_EXPECTS(fine.bodies.size() == coarse.bodies.size());
  SpacingRatio ratio{1, std::numeric_limits<double>::infinity(), 0};
  double sum = 0, count = 0;
  for (std::size_t b = 0; b < fine.bodies.size(); ++b) {
    auto const a = spacings_of(fine.bodies[b].shape, coarse.bodies[b].shape),
               c = spacings_of(coarse.bodies[b].shape, coarse.bodies[b].shape);
    for (std::size_t k = 0; k < a.size(); ++k) {
      sum += std::log(a[k] / c[k]);
      count += 1;
      ratio.least = std::min(ratio.least, a[k] / c[k]);
      ratio.most = std::max(ratio.most, a[k] / c[k]);
    }
  }
  if (count == 0) return {};
  ratio.mean = std::exp(sum / count);
  return ratio;
}

double finest_spacing(CaseSpec const& spec) {
  double finest = std::numeric_limits<double>::infinity();
  for (BodySpec const& body : spec.bodies)
    for (double const spacing : spacings_of(body.shape, body.shape)) finest = std::min(finest, spacing);
  return finest;
}

}  // namespace piola
