// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/contact_model.hpp"
#include <cstdint>
#include <vector>

namespace piola::contact {

class StateVector;

/// Points of one surface that have passed through another one: they were deeper than a spacing behind it and left at
/// the far side. Numbers of bodies; those of rigid shapes follow.
struct Passed {
  std::size_t of = 0, through = 0;
  std::int64_t points = 0;
};

/// Detects points that pass through surfaces, from their depths in one evaluation and the next.
class Passages {
 public:
  std::vector<Passed> const& passed() const { return passed_; }  ///< since the start
  /// Starts an evaluation.
  void begin();
  /// Depth of a point behind a surface in spacings, and the normal of the surface. point, with: as in NormalContact.
  void record(std::int64_t point, std::size_t with, double depth, Vec<3> const& normal);
  /// Counts points that were deep behind a surface and are now in front of it or out of its range.
  void count(ContactModel const& model);
  /// Adds one point.
  void add(std::size_t of, std::size_t through);

  void save(std::vector<double>& all) const;
  void load(StateVector& from);

 private:
  struct DeepPoint {
    std::int64_t point;
    std::size_t with;
    Vec<3> normal;
    bool counts;  ///< whether it is deeper than a spacing
    bool operator<(DeepPoint const& o) const { return with != o.with ? with < o.with : point < o.point; }
  };
  std::vector<DeepPoint> deep_, last_deep_;
  std::vector<Passed> passed_;
};

}  // namespace piola::contact
