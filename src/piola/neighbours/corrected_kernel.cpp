// SPDX-License-Identifier: Apache-2.0
#include "piola/math/solve.hpp"
#include "piola/neighbours/reference_pairs.hpp"

namespace piola {
namespace {

/// The inverse of the D x D part of M, both row by row in rows of three.
template <int D>
std::array<double, 9> inverse_of(double const (&M)[9]) {
  double A[D * D], inverse[D * D];
  for (int k = 0; k < D * D; ++k) A[k] = M[3 * (k / D) + k % D];
  invert<D>(A, inverse);
  std::array<double, 9> C{};
  for (int k = 0; k < D * D; ++k) C[std::size_t{3} * (k / D) + k % D] = inverse[k];
  return C;
}

}  // namespace

ReferencePairs::CorrectedKernel ReferencePairs::correct_kernel() const {
  CorrectedKernel r;
  r.at_zero = kernel_volume_ * kernel_of(0);
  r.gamma.resize(static_cast<std::size_t>(particles_));
  r.C.resize(static_cast<std::size_t>(particles_));
  exec_host::parallel_for(own_.last - own_.first, [&](Index k) {
    Index const a = own_.first + k;
    double sum = r.at_zero, M[9]{}, kernel_moment[3]{};
    visit(a, [&](Pair const& p) {
      double const s = s_of(p.r2), w = kernel_volume_ * kernel_of(p.r2);
      sum += w;
      for (std::size_t i = 0; i < 3; ++i) {
        kernel_moment[i] += w * p.r[i];
        for (std::size_t j = 0; j < 3; ++j) M[3 * i + j] += s * p.r[i] * p.r[j];
      }
    });
    std::array<double, 3> gamma = corrections_.G[corrections_.at(a)];
    for (double& g : gamma) g /= sum;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) M[3 * i + j] -= kernel_moment[i] * gamma[j];
    auto const slot = static_cast<std::size_t>(a);
    r.gamma[slot] = gamma;
    r.C[slot] = dimension_ == 1 ? inverse_of<1>(M) : dimension_ == 2 ? inverse_of<2>(M) : inverse_of<3>(M);
  });
  return r;
}

}  // namespace piola
