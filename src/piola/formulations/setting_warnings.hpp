// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace piola {

/// A setting that has no effect here, or an effect that users may not expect.
struct SettingWarning {
  std::size_t body = 0;
  std::string key;   ///< within the body: "formulation.blend", "material.poissons_ratio", "initial_displacement"
  std::string text;  ///< what is unusual (why) - what to do
};

/// Returns warnings about the bodies of a valid case: settings without effect, laws that lock or cannot fail.
std::vector<SettingWarning> setting_warnings(Assembly const& assembly);

/// Collects the warnings about one body.
class BodyWarnings {
 public:
  /// `assembly` and `found` must outlive this.
  BodyWarnings(Assembly const& assembly, std::size_t body, std::vector<std::size_t> group,
               std::vector<SettingWarning>& found)
      : assembly_(assembly), body_(body), group_(std::move(group)), found_(found) {}

  /// Bodies that the formulation simulates together with this one, which is among them, in ascending order.
  std::vector<std::size_t> const& group() const { return group_; }
  FormulationSpec const& spec() const { return assembly_.formulations[body_]; }
  MaterialParameters const& material() const { return assembly_.materials[body_]; }
  bool has_support() const;
  bool has_mirror() const;
  /// Whether the case gives a setting of the formulation.
  bool has_setting(std::string_view name) const;
  /// Whether the case gives this word for the choice `name`.
  bool has_setting(std::string_view name, std::string_view word) const;
  /// Adds a warning that a given setting has no effect; `why`: when it has one.
  void ignored(std::string_view name, std::string_view why);
  void add(std::string key, std::string text);

 private:
  Assembly const& assembly_;
  std::size_t body_;
  std::vector<std::size_t> group_;
  std::vector<SettingWarning>& found_;
};

/// Whether a formula differs between particles at time t [s], by more than 1e-6 of its largest size.
bool varies_between(std::span<std::int64_t const> particles, Expression const& formula, ParticleSet const& set,
                    double t);

/// Warns of a metal without a limit of tension, for a body whose particles are or become Eulerian.
void warn_of_tension(BodyWarnings& warnings);

/// Poisson's ratio of a law in the undeformed state, from its bulk and shear moduli.
double poissons_ratio_of(MaterialParameters const& material);

}  // namespace piola
