// SPDX-License-Identifier: Apache-2.0
#include "piola/math/solve.hpp"
#include "piola/neighbours/reference_pairs.hpp"

namespace piola {
namespace {

/// C with M C = 1 for the D x D part of M, both row by row in rows of three.
template <int D>
std::array<double, 9> inverse_of(double const (&M)[9]) {
  std::array<double, 9> C{};
  for (int column = 0; column < D; ++column) {
    double A[D * D], b[D];
    for (int i = 0; i < D; ++i) {
      for (int j = 0; j < D; ++j) A[i * D + j] = M[3 * i + j];
      b[i] = i == column ? 1 : 0;
    }
    solve_in_place<D>(A, b);
    for (int i = 0; i < D; ++i) C[static_cast<std::size_t>(3 * i + column)] = b[i];
  }
  return C;
}

}  // namespace

ReferencePairs::CorrectedKernel ReferencePairs::correct_kernel() const {
  CorrectedKernel r;
  r.at_zero = kernel_volume_ * kernel_of(0);
  for (Index a = 0; a < particles_; ++a) {
    double sum = r.at_zero, M[9]{}, kernel_moment[3]{};
    visit(a, [&](Pair const& p) {
      double const s = s_of(p.r2), w = kernel_volume_ * kernel_of(p.r2);
      sum += w;
      for (std::size_t i = 0; i < 3; ++i) {
        kernel_moment[i] += w * p.r[i];
        for (std::size_t j = 0; j < 3; ++j) M[3 * i + j] += s * p.r[i] * p.r[j];
      }
    });
    std::array<double, 3> gamma = corrections_.G[static_cast<std::size_t>(a)];
    for (double& g : gamma) g /= sum;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) M[3 * i + j] -= kernel_moment[i] * gamma[j];
    r.gamma.push_back(gamma);
    r.C.push_back(dimension_ == 1 ? inverse_of<1>(M) : dimension_ == 2 ? inverse_of<2>(M) : inverse_of<3>(M));
  }
  return r;
}

}  // namespace piola
