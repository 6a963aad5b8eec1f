// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/communicator.hpp"
#include "piola/domain/sum_over_slots.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/common/distributed_mode.hpp"
#include "piola/formulations/nodal/body.hpp"
#include <vector>

namespace piola::nodal {

/// Reduction payload of ParticleVectors::extent().
struct ExtentReduction {
  exec::ReproducibleSums<1> square;
  double most;
  void add(ExtentReduction const& other) {
    square.add(other.square);
    comm::max_or_nan(other.most, most);
  }
};

/// Vectors of D values per local particle of a body, in the order of slots, with the product u.M.v over all ranks.
class ParticleVectors {
 public:
  using Vector = std::vector<double>;
  explicit ParticleVectors(NodalBody& body) : body_(body), dimension_(body.state().dimension) {}

  /// Index in a vector of component c of the particle in slot i.
  std::size_t place(Index i, int c) const { return mode_place(body_, i, c); }
  /// Calls f(slot) for the local particles.
  template <class F>
  void each_particle(F const& f) const {
    exec_host::parallel_for(body_.own(), f);
  }
  /// Calls f(place) for the entries.
  template <class F>
  void each_number(F const& f) const {
    each_particle([&](Index i) {
      for (int c = 0; c < dimension_; ++c) f(place(i, c));
    });
  }
  Vector values_of(FieldRef const& field) const {
    Vector u(size_of_mode(body_));
    each_particle([&](Index i) {
      for (int c = 0; c < dimension_; ++c) u[place(i, c)] = value_at(field, i, c);
    });
    return u;
  }
  /// Sets a field to u.
  void put(Vector const& u, FieldRef const& to) const {
    each_particle([&](Index i) {
      for (int c = 0; c < dimension_; ++c) value_at(to, i, c) = u[place(i, c)];
    });
  }
  /// Moves the particles to x + scale u.
  void put_moved(Vector const& x, double scale, Vector const& u) const {
    each_particle([&](Index i) {
      for (int c = 0; c < dimension_; ++c) value_at(body_.state().x, i, c) = x[place(i, c)] + scale * u[place(i, c)];
    });
  }
  /// sum m u.v. Collective.
  double product(Vector const& u, Vector const& v) const {
    auto sum = own_product(u, v);
    if (body_.shared()) comm::allreduce_sum(sum);
    return sum.value();
  }
  /// sum m u.u and the largest |u_k|. Collective.
  struct Extent {
    double square, most;
  };
  Extent extent(Vector const& u) const {
    ExtentReduction said{own_product(u, u), largest_of(u)};
    if (body_.shared()) comm::allreduce_sum(said);
    return {said.square.value(), said.most};
  }

 private:
  /// sum m u.v, of the particles of this rank.
  exec::ReproducibleSums<1> own_product(Vector const& u, Vector const& v) const {
    return sums_over_slots<1>(false, body_.own(), [&](Index i, double* x) {
      double sum = 0;
      for (int c = 0; c < dimension_; ++c) sum += u[place(i, c)] * v[place(i, c)];
      *x = body_.mass(i) * sum;
    });
  }

  NodalBody& body_;
  int dimension_;
};

}  // namespace piola::nodal
