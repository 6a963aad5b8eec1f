// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/block_law.hpp"
#include "piola/materials/finite_increment.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <mutex>
#include <vector>

namespace piola {
namespace {

thread_local char const* running = nullptr;

/// Marks the time in which a thread runs code of a law.
struct Running {
  explicit Running(char const* name) { running = name; }
  ~Running() { running = nullptr; }
  Running(Running const&) = delete;
  Running& operator=(Running const&) = delete;
};

std::mutex& one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

/// Parameters as the law sees them: the numbers after the density, then the words.
std::array<double, BlockLaw::most_values> parameters_of(MaterialParameters const& material) {
  LawInfo const& law = law_of(material);
  std::array<double, BlockLaw::most_values> all{};
  std::copy_n(material.value + 1, MaterialParameters::max_values - 1, all.begin());
  if (!law.parameters.empty())
    std::copy_n(material.word, law.choices.size(),
                all.begin() + static_cast<std::ptrdiff_t>(law.parameters.size()) - 1);
  return all;
}

}  // namespace

char const* running_block_law() { return running; }

BlockLaw::BlockLaw(MaterialParameters const& material)
    : rho0(material.value[0]), law_(law_of(material).block), parameters_(parameters_of(material)) {
  constexpr double small = 1e-6;
  double most = 0, bulk = 0;
  for (std::size_t c = 0; c < 6; ++c) {
    std::array<double, 6> e{};
    e[c] = small;
    auto const above = stress_at(e);
    e[c] = -small;
    auto const below = stress_at(e);
    double const stiffness = (above[c] - below[c]) / (2 * small);
    if (c < 3) most = std::max(most, stiffness);
    if (c >= 3) mu = std::max(mu, 0.5 * stiffness);
    for (std::size_t d = 0; c < 3 && d < 3; ++d) bulk += (above[d] - below[d]) / (18 * small);
    if (!std::isfinite(stiffness)) mu = stiffness;
  }
  kappa = std::max(bulk, most - 4 * mu / 3);
}

int BlockLaw::history_index(std::string_view name) const {
  for (int h = 0; h < law_->history_count; ++h)
    if (name == law_->history[h].name) return h;
  return -1;
}

void BlockLaw::start(double* history) const {
  for (int h = 0; h < law_->history_count; ++h) history[h] = law_->history[h].start;
  if (law_->start == nullptr) return;
  Running const mark(law_->name);
  law_->start(parameters_.data(), history);
}

int BlockLaw::update(piola_points& points) const {
  points.density = rho0;
  points.parameters = parameters_.data();
  Running const mark(law_->name);
  if ((law_->properties & PIOLA_ONE_THREAD) == 0) return law_->update(&points);
  std::lock_guard const lock(one_at_a_time());
  return law_->update(&points);
}

std::array<double, 6> BlockLaw::stress_at(std::array<double, 6> const& e, double heat) const {
  constexpr double at_rest[9]{1, 0, 0, 0, 1, 0, 0, 0, 1};
  constexpr std::array<std::size_t, 9> symmetric{0, 3, 5, 3, 1, 4, 5, 4, 2};
  double U[6], F[9], stress[9]{}, energy = rho0 * heat, speed = 0;
  std::array<double, most_history> history{};
  for (std::size_t c = 0; c < 6; ++c) U[c] = e[c] + (c < 3 ? 1 : 0);
  for (std::size_t c = 0; c < 9; ++c) F[c] = U[symmetric[c]];
  constexpr double stretch_at_rest[6]{1, 1, 1, 0, 0, 0};
  start(history.data());
  piola_points points{1,
                      1,
                      0,
                      0,
                      rho0,
                      nullptr,
                      at_rest,
                      F,
                      corotated() ? stretch_at_rest : nullptr,
                      corotated() ? U : nullptr,
                      stress,
                      &energy,
                      history.data(),
                      &speed};
  update(points);
  if (corotated()) return {stress[0], stress[1], stress[2], stress[3], stress[4], stress[5]};
  Mat<3> gradient, P;
  std::copy_n(F, 9, gradient.c);
  std::copy_n(stress, 9, P.c);
  return std::to_array(cauchy_stress(P, gradient, determinant(gradient)).c);
}

std::string problem_of_block_law(MaterialParameters const& material) {
  std::array<char, 512> text{};
  piola_material const& law = *law_of(material).block;
  if (law.check != nullptr) {
    Running const mark(law.name);
    if (law.check(parameters_of(material).data(), text.data(), static_cast<int>(text.size())) != 0) {
      text.back() = 0;
      return text.data();
    }
  }
  BlockLaw const at_rest(material);
  if (at_rest.kappa > 0 && at_rest.mu > 0 && std::isfinite(at_rest.kappa) && std::isfinite(at_rest.mu)) return {};
  return fmt::format("at rest it has the bulk modulus {:.4g} Pa and the shear modulus {:.4g} Pa", at_rest.kappa,
                     at_rest.mu);
}

}  // namespace piola
