// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/surface.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/math/solve.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include "piola/neighbours/line_of_sight.hpp"
#include <algorithm>
#include <array>
#include <map>

namespace piola::contact {
namespace {

/// Neighbours within these spacings, one after the other until they span space.
constexpr std::array reaches{1.6, 2.1, 3.1};
constexpr double flat = 1e-3;  // ratio of pivots below which neighbours span no volume

Vec<3> place(ParticleSet const& set, std::int64_t id) {
  auto const& X = set.X[static_cast<std::size_t>(id)];
  return {{X[0], X[1], X[2]}};
}

struct Stencil {
  std::vector<std::int64_t> ids;
  std::vector<Vec<3>> g;
};

/// Weighted least squares: g_j = w_j M^-1 r_j, M = sum w r (x) r, r = X_j - X_p.
bool fit(ParticleSet const& set, std::int64_t p, std::vector<std::int64_t> const& around, double reach, Stencil& out) {
  int const D = set.dimension;
  Mat<3> M;
  std::vector<Vec<3>> r;
  std::vector<double> weight;
  for (auto const id : around) {
    r.push_back(place(set, id) - place(set, p));
    double const rest = 1 - dot(r.back(), r.back()) / (reach * reach);
    weight.push_back(rest > 0 ? rest * rest : 0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) M(i, j) += weight.back() * r.back()[i] * r.back()[j];
  }
  double const scale = trace(M) / D;
  for (int c = D; c < 3; ++c) M(c, c) = scale;
  double columns[3][3];
  for (int c = 0; c < 3; ++c) {
    double A[9];
    std::copy(M.c, M.c + 9, A);
    for (int k = 0; k < 3; ++k) columns[c][k] = k == c ? 1 : 0;
    if (!(solve_in_place<3>(A, columns[c]) > flat)) return false;
  }
  out = {};
  for (std::size_t k = 0; k < around.size(); ++k) {
    if (!(weight[k] > 0)) continue;
    Vec<3> g;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) g[i] += weight[k] * columns[j][i] * r[k][j];
    out.ids.push_back(around[k]);
    out.g.push_back(g);
  }
  return true;
}

/// Particles of one body by place.
class Around {
 public:
  Around(ParticleSet const& set, Body const& body, double spacing)
      : set_(set),
        body_(body),
        grid_(places(set, body), reaches.back() * spacing),
        line_(body.outline.distance, spacing) {}

  std::vector<std::int64_t> operator()(std::int64_t p, double reach) const {
    std::vector<std::int64_t> found;
    grid_.visit(set_.X[static_cast<std::size_t>(p)], [&](Index k) {
      std::int64_t const id = body_.first + k;
      Vec<3> const r = place(set_, id) - place(set_, p);
      if (id != p && dot(r, r) < reach * reach && !line_.is_blocked(place_of(p), place_of(id))) found.push_back(id);
    });
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  static std::vector<std::array<double, 3>> places(ParticleSet const& set, Body const& body) {
    return {set.X.begin() + body.first, set.X.begin() + body.last};
  }
  std::array<double, 3> const& place_of(std::int64_t id) const { return set_.X[static_cast<std::size_t>(id)]; }

  ParticleSet const& set_;
  Body const& body_;
  CellGrid grid_;
  LineOfSight line_;
};

Stencil stencil_of(ParticleSet const& set, Body const& body, Around const& around, std::int64_t p, double spacing) {
  Stencil stencil;
  for (double const reach : reaches)
    if (fit(set, p, around(p, reach * spacing), reach * spacing, stencil)) return stencil;
  throw InputError("body '" + body.name +
                   "' is too thin for contact: particles around one of its surface points do not span the space "
                   "(allowed: two layers or more) - take more particles across, or contact.law = \"none\"");
}

}  // namespace

HostParticles::HostParticles(ParticleSet const& particles, std::vector<Surface> const& surfaces)
    : dimension_(particles.dimension), of_(surfaces.size()), begin_{0} {
  PIOLA_EXPECTS(dimension_ >= 1 && dimension_ <= 3);
  PIOLA_EXPECTS(surfaces.size() <= particles.bodies.size());
  std::vector<Stencil> stencils;
  std::vector<std::int64_t> particle;  // of each host
  for (std::size_t b = 0; b < surfaces.size(); ++b) {
    if (surfaces[b].points.empty()) continue;
    PIOLA_EXPECTS(surfaces[b].spacing > 0);
    Body const& body = particles.bodies[b];
    Around const around(particles, body, surfaces[b].spacing);
    std::map<std::int64_t, Index> known;
    for (SurfacePoint const& point : surfaces[b].points) {
      auto const [entry, fresh] = known.try_emplace(point.particle, static_cast<Index>(particle.size()));
      of_[b].push_back(entry->second);
      if (!fresh) continue;
      particle.push_back(point.particle);
      stencils.push_back(stencil_of(particles, body, around, point.particle, surfaces[b].spacing));
    }
  }
  ids_ = particle;
  for (Stencil const& stencil : stencils) ids_.insert(ids_.end(), stencil.ids.begin(), stencil.ids.end());
  std::sort(ids_.begin(), ids_.end());
  ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
  auto const index = [&](std::int64_t id) {
    return static_cast<Index>(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin());
  };
  for (std::size_t k = 0; k < stencils.size(); ++k) {
    self_.push_back(index(particle[k]));
    for (std::size_t j = 0; j < stencils[k].ids.size(); ++j)
      neighbours_.push_back({index(stencils[k].ids[j]), stencils[k].g[j]});
    begin_.push_back(neighbours_.size());
  }
}

Mat<3> HostParticles::F(Index host, std::vector<Vec<3>> const& x) const {
  Mat<3> F;
  Vec<3> const own = x[static_cast<std::size_t>(self(host))];
  for (std::size_t k = first(host); k < last(host); ++k)
    F = F + outer(x[static_cast<std::size_t>(neighbours_[k].at)] - own, neighbours_[k].g);
  for (int c = dimension_; c < 3; ++c) F(c, c) = 1;
  return F;
}

}  // namespace piola::contact
