// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field.hpp"
#include "piola/mechanics/prescribed.hpp"
#include "piola/mechanics/prescribed_data.hpp"
#include "piola/mechanics/resultants.hpp"
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace piola {

/// The component of a vector field of D components along a held direction.
double along(FieldRef const& field, PrescribedDirection const& h, int D);

/// Supports of one body: the particles that they hold, the held directions with their speeds, and the impulses of the
/// supports.
class BodySupports {
 public:
  using Point = std::array<double, 3>;
  struct PrescribedParticle {
    Index slot;
    Point X;
    double mass;
    Point position;  ///< at t = 0 [m]
  };
  /// `multiplied`: Lagrange multipliers enforce the supports.
  BodySupports(int dimension, std::vector<Support> const& supports, bool multiplied);

  bool multiplied() const { return multiplied_; }
  /// See the functions of BodyBoundary with these names.
  std::size_t add_particle(PrescribedParticle const& particle);
  void add_row(std::size_t particle, std::size_t support, Direction const& direction);
  void add_supports(std::vector<Support> const& supports, std::function<bool(std::int64_t id)> const& takes,
                    std::function<PrescribedParticle(std::int64_t id)> const& particle_of);
  /// Discards particles in other slots. Not with multipliers.
  void keep(Range own);

  int ended(double time) const;  ///< number of supports that have ended
  double next_end_time(double time) const { return piola::next_end_time(time, supports_); }
  /// Before a step from `time` to end_time: `changed`: other supports hold than in the last step; `continues`: the step
  /// starts where the last one ended.
  void begin_step(FieldRef const& x, double time, double end_time, bool changed, bool continues);
  /// After the step: adds the impulses of local particles.
  void end_step(FieldRef const& x, std::optional<Range> const& own);
  void start(FieldRef const& v) const;
  /// Multiplies the velocities in slots `first` to `last` by `factor`, except along held directions.
  void damp(FieldRef const& v, Index first, Index last, double factor) const;

  std::vector<PrescribedDirection>& held() { return held_; }
  std::vector<PrescribedDirection> const& held() const { return held_; }
  /// Impulses by support; the reader resets them.
  std::vector<ImpulseSum>& impulses() { return impulses_; }
  std::vector<ImpulseSum> const& impulses() const { return impulses_; }

 private:
  /// One prescribed velocity of one particle, as given. A particle may have several, in any directions.
  struct Row {
    std::size_t support;
    Direction direction;
    double speed;  ///< at the time of the last evaluation [m/s]
    bool at_rest;
  };
  struct Particle {
    PrescribedParticle of;
    std::vector<Row> rows;  ///< the last ones added come first
  };
  /// Particle and rows that a held direction is computed from.
  struct Origin {
    std::size_t particle;
    PrescribedAxis along;  ///< of the particle's rows
  };
  void choose_directions(double time);
  void add_direction(std::size_t particle, PrescribedAxis const& along);
  void evaluate_rows(double time);
  void evaluate_speeds(double time, double end_time, bool continues);

  int D_;
  bool multiplied_;
  std::vector<Support> supports_;  ///< without their particles
  bool steady_ = true;             ///< no speed depends on time
  std::vector<Particle> particles_;
  std::vector<PrescribedDirection> held_;
  std::vector<Origin> origins_;       ///< of held_
  std::vector<Point> held_start_;     ///< positions at the start of the step [m]
  std::vector<ImpulseSum> impulses_;  ///< by support
};

}  // namespace piola
