// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/elastic_constants.hpp"
#include "piola/math/tensor.hpp"
#include <string_view>

namespace piola::inline PIOLA_MACHINE {

/// Linear elasticity in the small strain e = (F + F^T)/2 - I.
///   W = mu (e:e - (tr e)^2/3) + kappa/2 (tr e)^2
///   P = mu (F + F^T - 2/3 tr F I) + p I,   p = kappa (tr F - 3)
/// (Lee et al. 2016, examples 8.1 and 8.2.) Not objective under large rotation: for small displacement only.
struct LinearElastic : ElasticConstants {
  static constexpr std::string_view name = "linear_elastic";
  static constexpr std::string_view about = "linear elasticity, small strain and small rotation";
  static constexpr bool small_strain = true;
  using ElasticConstants::ElasticConstants;
  using ElasticConstants::parameters;

  template <class T>
  PIOLA_FN T pressure(Mat<3, T> const& F) const {
    return kappa * (trace(F) - 3.0);
  }
  template <class T>
  PIOLA_FN Mat<3, T> first_piola(Mat<3, T> const& F) const {
    Mat<3, T> P = mu * (F + transpose(F));
    T const diagonal = pressure(F) - (2.0 / 3.0) * mu * trace(F);
    for (int i = 0; i < 3; ++i) P(i, i) = P(i, i) + diagonal;
    return P;
  }
  template <class T>
  PIOLA_FN T energy(Mat<3, T> const& F) const {
    Mat<3, T> const e = 0.5 * (F + transpose(F)) - identity<3, T>();
    T const volume = trace(e);
    return mu * (contract(e, e) - (1.0 / 3.0) * (volume * volume)) + 0.5 * kappa * (volume * volume);
  }
};

}  // namespace piola::inline PIOLA_MACHINE
