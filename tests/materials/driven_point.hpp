// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/block_law.hpp"
#include "piola/math/polar.hpp"
#include "piola/verification/block_law_battery.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

/// One point of a law on blocks of points, driven along a path of deformation gradients.
namespace piola::testing {

using Values = std::map<std::string, double>;

/// Values of `b` replace those of `a`.
inline Values operator+(Values a, Values const& b) {
  for (auto const& [name, value] : b) a[name] = value;
  return a;
}

/// Material of a law of Piola's: numbers by name, the others at their defaults; words by their indices.
inline MaterialParameters own_material(std::string_view name, Values const& values, std::vector<int> const& words) {
  LawInfo const law = find_law(name).value();
  MaterialParameters m;
  m.law = law.index;
  std::size_t used = 0;
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    auto const given = values.find(std::string(law.parameters[i].name));
    used += given != values.end() ? 1u : 0u;
    m.value[i] =
        given != values.end() ? given->second : (law.parameters[i].required() ? 0 : law.parameters[i].default_value);
  }
  if (used != values.size()) throw std::logic_error("a parameter that the law does not have");
  std::copy(words.begin(), words.end(), m.word);
  return m;
}

inline Mat<3> diagonal(double x, double y, double z) {
  Mat<3> F;
  F(0, 0) = x, F(1, 1) = y, F(2, 2) = z;
  return F;
}
inline Mat<3> sheared(double xy) {
  Mat<3> F = identity<3>();
  F(0, 1) = xy;
  return F;
}

/// The parameters go together, and the law passes all checks of a library's law.
inline void expect_battery(MaterialParameters const& m) {
  EXPECT_EQ(problem_of_block_law(m), "");
  for (LawCheck const& check : check_block_law(m)) EXPECT_TRUE(check.passed()) << check.what << ": " << check.value;
}

class DrivenPoint {
 public:
  explicit DrivenPoint(MaterialParameters const& material) : law_(material) {
    history_.resize(static_cast<std::size_t>(law_.history_count()) + 1);
    law_.start(history_.data());
  }

  /// One step to F. Adds the work to the energy.
  void to(Mat<3> const& F, double dt = 1e-6) {
    SymMat<3> const before = stretch_of(rotation_of(F_), F_), after = stretch_of(rotation_of(F), F);
    double energy = energy_, speed = law_.p_wave_speed();
    Mat<3> const P = first_piola();
    bool const turned = law_.corotated();
    time_ += dt;
    piola_points points{1,
                        1,
                        time_,
                        dt,
                        0,
                        nullptr,
                        F_.c,
                        F.c,
                        turned ? before.c : nullptr,
                        turned ? after.c : nullptr,
                        stress_,
                        &energy,
                        history_.data(),
                        &speed};
    if (law_.update(points) != 0) throw std::runtime_error("the law fails");
    Mat<3> const old = F_;
    F_ = F;
    sound_speed_ = speed;
    energy_ += 0.5 * contract(P + first_piola(), F_ - old);
  }

  /// Stretch along the first axis, and along the second unless it is given, with which a step to the axial stretch
  /// along the third axis ends at this stress along the first axis [Pa].
  double side_of_stress(double wanted, double axial, double second = 0) const {
    auto const miss = [&](double side) {
      DrivenPoint copy(*this);
      copy.to(diagonal(side, second > 0 ? second : side, axial));
      return copy.stress(0) - wanted;
    };
    double low = F_(0, 0) - 1e-3, high = F_(0, 0) + 1e-3;
    for (int k = 0; k < 60; ++k) {
      double const middle = 0.5 * (low + high);
      (miss(middle) > 0 ? high : low) = middle;
    }
    return 0.5 * (low + high);
  }

  /// Component 11 22 33 12 23 13 of the Cauchy stress in axes that turn with the material [Pa].
  double stress(int c) const { return cauchy().c[c]; }
  double pressure() const { return -(stress(0) + stress(1) + stress(2)) / 3; }
  double mises() const {
    SymMat<3> const s = cauchy();
    double square = 0;
    for (int c = 0; c < 6; ++c) {
      double const x = s.c[c] + (c < 3 ? pressure() : 0);
      square += (c < 3 ? 1.5 : 3) * x * x;
    }
    return std::sqrt(square);
  }
  double history(char const* name) const { return history_.at(static_cast<std::size_t>(law_.history_index(name))); }
  double energy() const { return energy_; }
  double sound_speed() const { return sound_speed_; }
  Mat<3> first_piola() const {
    Mat<3> P;
    if (!law_.corotated()) {
      std::copy_n(stress_, 9, P.c);
      return P;
    }
    SymMat<3> turned;
    std::copy_n(stress_, 6, turned.c);
    Mat<3> const R = rotation_of(F_);
    return (R * turned) * transpose(R) * cofactor(F_);
  }

 private:
  SymMat<3> cauchy() const {
    Mat<3> const R = rotation_of(F_), s = (1 / determinant(F_)) * (transpose(R) * first_piola() * transpose(F_) * R);
    SymMat<3> r;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) r(i, j) = 0.5 * (s(i, j) + s(j, i));
    return r;
  }

  BlockLaw law_;
  Mat<3> F_ = identity<3>();
  double stress_[9]{}, energy_ = 0, sound_speed_ = 0, time_ = 0;
  std::vector<double> history_;
};

}  // namespace piola::testing
