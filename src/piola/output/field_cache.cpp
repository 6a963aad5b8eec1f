// SPDX-License-Identifier: Apache-2.0
#include "piola/output/field_cache.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/error_agreement.hpp"
#include "piola/formulations/derived_fields.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

namespace piola {

FieldCache::FieldCache(Formulation const& formulation, ParticleSet const& particles, Of of)
    : observables_(formulation.observables()), particles_(particles), fields_(observables_.fields()), of_(of) {
  if (of == Of::local) local_ = observables_.local_particles();
  auto const add = [&](FieldInfo info) {
    if (!knows(info.name)) fields_.push_back(std::move(info));
  };
  if (knows("Displacement")) add({"Position", "m", 3});
  for (DerivedField const& derived : derived_fields())
    if (knows(derived.from)) add({std::string(derived.name), std::string(derived.unit), components_of(derived)});
  add({"Body", "1", 1});
  add({"Id", "1", 1});
}

bool FieldCache::knows(std::string_view field) const {
  return std::any_of(fields_.begin(), fields_.end(), [&](FieldInfo const& f) { return f.name == field; });
}

FieldInfo const& FieldCache::info(std::string_view field) const { return info_of(fields_, field); }

namespace {

/// Name of a field that rank 0 requests from all ranks; empty: no more.
using FieldRequest = std::array<char, 64>;

/// The request of rank 0, on all ranks. Collective.
FieldRequest broadcast_request(std::string_view field) {
  FieldRequest request{};
  PIOLA_EXPECTS(field.size() < request.size());
  std::copy(field.begin(), field.end(), request.begin());
  return comm::of_root(request);
}

/// Calls f() on rank 0, then ends the requests also if f() throws.
void evaluate_all(Formulation const& formulation, ParticleSet const& particles,
                  std::function<void(FieldCache&)> const& f) {
  std::exception_ptr error;
  try {
    FieldCache fields(formulation, particles);
    f(fields);
  } catch (...) {
    error = std::current_exception();
  }
  if (comm::is_parallel()) broadcast_request("");
  if (error) std::rethrow_exception(error);
}

/// Samples what rank 0 requests.
void sample_requests(Observables const& observables) {
  for (FieldRequest next = broadcast_request(""); next[0] != 0; next = broadcast_request(""))
    observables.sample(next.data(), {});
}

}  // namespace

void evaluate_on_root(Formulation const& formulation, ParticleSet const& particles,
                      std::function<void(FieldCache&)> const& f) {
  PIOLA_EXPECTS(f != nullptr);
  comm::agree_after([&] {
    if (comm::rank() == 0)
      evaluate_all(formulation, particles, f);
    else
      sample_requests(formulation.observables());
  });
}

std::vector<double> FieldCache::make(std::string_view field, std::size_t components) {
  auto const count = local_ ? local_->size() : static_cast<std::size_t>(particles_.size());
  auto const id_of = [&](std::size_t k) { return local_ ? static_cast<std::size_t>((*local_)[k]) : k; };
  std::vector<double> out(count * components);
  if (field == "Body") {
    for (std::size_t i = 0; i < count; ++i) out[i] = particles_.body[id_of(i)];
  } else if (field == "Id") {
    for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<double>(id_of(i));
  } else if (field == "Position") {
    auto const displacement = values("Displacement");
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = particles_.X[id_of(i / 3)][i % 3] + displacement[i];
  } else if (DerivedField const* const derived = find_derived(field)) {
    derive(*derived, values(derived->from), out);
  } else if (of_ == Of::local) {
    observables_.sample_local(field, out);
  } else {
    if (comm::is_parallel()) broadcast_request(field);
    observables_.sample(field, out);
  }
  return out;
}

std::span<double const> FieldCache::values(std::string_view field) {
  auto found = cache_.find(field);
  if (found == cache_.end()) {
    auto made = make(field, static_cast<std::size_t>(info(field).components));
    found = cache_.emplace(std::string(field), std::move(made)).first;
  }
  return found->second;
}

std::vector<double> component_values(FieldCache& cache, std::string_view field, int component) {
  PIOLA_EXPECTS(component == FieldQuantity::magnitude || (component >= 0 && component < cache.info(field).components));
  auto const width = static_cast<std::size_t>(cache.info(field).components);
  auto const all = cache.values(field);
  std::vector<double> out(all.size() / width);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (component == FieldQuantity::magnitude) {
      double sum = 0;
      for (std::size_t c = 0; c < width; ++c) sum += all[i * width + c] * all[i * width + c];
      out[i] = std::sqrt(sum);
    } else {
      out[i] = all[i * width + static_cast<std::size_t>(component)];
    }
  }
  return out;
}

}  // namespace piola
