// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/expression.hpp"
#include "piola/simulation/observers.hpp"
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace piola {

/// A field of a run at one time, beside the particles that carry it.
struct FieldSample {
  std::string field = {};
  double time = 0;  ///< s, as asked for
  int dimension = 3;
  std::size_t components = 1;
  std::vector<double> values = {};            ///< [id * components + c]
  std::vector<std::array<double, 3>> X = {};  ///< reference positions [m]
  std::vector<double> volume = {};            ///< tributary, m^dimension
  std::vector<double> spacing = {};           ///< m, from the full volume
  std::vector<int> body = {};
};

/// Takes fields at given times out of a run, linear in time between the two steps around each.
class FieldSampler : public Observer {
 public:
  struct Wish {
    std::string field;
    double time = 0;  ///< s
    bool operator==(Wish const&) const = default;
  };
  FieldSampler(std::vector<Wish> wishes, ParticleSet const& particles);
  void see(Formulation const& formulation, Moment const& moment) override;
  /// What was seen so far. A wish for a field that the formulation does not have, or for a time that the run did not
  /// reach, leaves none.
  std::vector<FieldSample> const& samples() const { return samples_; }

 private:
  struct Pending {
    Wish wish;
    double before = 0;                ///< s, of `values`
    std::vector<double> values = {};  ///< shortly before the time; empty: not yet
  };
  bool take(Pending& pending, FieldCache& cache, Moment const& moment);

  ParticleSet const& particles_;
  std::vector<Pending> pending_;
  std::vector<FieldSample> samples_;
};

/// sqrt(sum V |f - r|^2 / sum V |r|^2) over the particles of `f` that `where` selects (null: all), with r the reference
/// at their places: the linear function that fits its particles of the same body within 1.8 spacings best (weights fall
/// to zero there), or the value of the particle that stands at the very place. Frobenius norm as in probes of kind
/// error. Second order in the spacing of the reference; exact for linear fields
/// (FieldSamples.SeeLinearFieldsExactly). Nothing if the fields differ in kind, a particle of `f` has no particle of
/// the reference near it, or the reference is zero.
std::optional<double> relative_difference(FieldSample const& f, FieldSample const& reference, Expression const* where);

}  // namespace piola
