// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/expression.hpp"
#include "piola/observers/observer.hpp"
#include "piola/output/field_cache.hpp"
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace piola {

/// A field of a run at one time, with its particles.
struct FieldSample {
  std::string field = {};
  double time = 0;  ///< requested time [s]
  int dimension = 3;
  std::size_t components = 1;
  std::vector<double> values = {};            ///< [id * components + c]
  std::vector<std::array<double, 3>> X = {};  ///< reference positions [m]
  std::vector<double> volume = {};            ///< tributary, m^dimension
  std::vector<double> spacing = {};           ///< m, from the full volume
  std::vector<int> body = {};
};

/// Samples fields of a run at given times, interpolated linearly between the two steps around each.
class FieldSampler : public Observer {
 public:
  struct SampleRequest {
    std::string field;
    double time = 0;  ///< s
    bool operator==(SampleRequest const&) const = default;
  };
  FieldSampler(std::vector<SampleRequest> sample_requests, ParticleSet const& particles);
  void observe(Formulation const& formulation, TimeState const& moment) override;
  /// Samples so far. Requests for a missing field, or for a time that the run did not reach, give none.
  std::vector<FieldSample> const& samples() const { return samples_; }

 private:
  struct Pending {
    SampleRequest sample_request;
    double before = 0;                ///< s, of `values`
    std::vector<double> values = {};  ///< shortly before the time; empty: not yet sampled
  };
  bool take(Pending& pending, FieldCache& cache, TimeState const& moment);

  ParticleSet const& particles_;
  std::vector<Pending> pending_;
  std::vector<FieldSample> samples_;
};

/// sqrt(sum V |f - r|^2 / sum V |r|^2) over the particles of `f` that `where` selects (null: all). r is the reference
/// at their positions: the best linear fit to its particles of the same body within 1.8 spacings, with weights that
/// fall to zero there, or the value of a particle at exactly that position. Frobenius norm as in probes of kind error.
/// Second order in the spacing of the reference; exact for linear fields (FieldSamples.SeeLinearFieldsExactly). Empty
/// if the fields differ in kind, a particle of `f` has no reference particle near it, or the reference is zero.
std::optional<double> relative_difference(FieldSample const& f, FieldSample const& reference, Expression const* where);

}  // namespace piola
