// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/memory.hpp"
#include "piola/math/lanes.hpp"
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace piola {

/// Purpose of a field: `reference` never changes, `evolved` is the state (checkpoints), `derived` follows from it.
enum class Role { reference, evolved, derived };

/// Counts writes by owners and halo refreshes, so that a forgotten exchange is detected even on one rank (contract
/// builds).
struct FieldVersion {
  std::uint64_t owner = 0, halo = 0;
};

/// Particles per tile (2^tile_bits). Fields that loops only stream through store the components of a tile together, so
/// that a loop over many fields reads few streams, which hardware prefetchers can follow.
inline constexpr int tile_bits = 4;
inline constexpr Index tile_size = 1 << tile_bits;

/// Copies of particles by affine maps, e.g. mirror images, in slots after those of the body. Value c of copy k is
/// sign[transform[k]][c] * (value of source[k]) + shift[..]. Does not own its arrays.
struct Copies {
  Index first = 0, count = 0;  ///< slots of the copies
  Index const* source = nullptr;
  std::int32_t const* transform = nullptr;
  int values = 0;  ///< number of components per particle, from the first one of the field
  double const *sign = nullptr, *shift = nullptr;  ///< [transform][values]
};

/// Non-owning reference to a field for loops: component c of particle i is at data[c * component_stride + i *
/// particle_stride + (i / tile_size) * tile_extra]. Plain data without functions, so that code of different instruction
/// sets may exchange it.
struct FieldRef {
  double* data = nullptr;
  std::ptrdiff_t component_stride = 0;
  std::ptrdiff_t particle_stride = 1;
  std::ptrdiff_t tile_extra = 0;  ///< 0: not tiled
  FieldVersion* version = nullptr;
  char const* name = "";
  /// Reference fields of regular lattices, where most groups of lanes have equal values: index of the stored group per
  /// group of lanes. nullptr: particle i is stored at i.
  std::int32_t const* group = nullptr;
  Copies const* copies = nullptr;  ///< copies of particles that neighbours read; nullptr: none
};

/// Component c of particle i, for set-up and observers.
inline double& value_at(FieldRef const& f, Index i, int c = 0) {
  return f.data[c * f.component_stride + i * f.particle_stride + (i >> tile_bits) * f.tile_extra];
}

/// The first D components of particle i as a point; components from D on are taken from `others`.
inline std::array<double, 3> point_at(FieldRef const& f, Index i, int D, std::array<double, 3> others = {}) {
  for (int c = 0; c < D; ++c) others[static_cast<std::size_t>(c)] = value_at(f, i, c);
  return others;
}

/// A particle field. allocate(): one array per component, with `guard` readable zeros before the first and after the
/// last particle, so that a loop over lanes may read beyond the ends. place(): a view of memory that several fields
/// share, for loops that read them together; that memory must outlive the field.
class Field {
 public:
  Field(char const* name, char const* unit, int components, Role role)
      : name_(name), unit_(unit), components_(components), role_(role) {}
  Field(Field const&) = delete;
  Field& operator=(Field const&) = delete;

  void allocate(Index particles, Index guard) {
    auto const pad = (static_cast<std::ptrdiff_t>(guard) + 7) / 8 * 8;
    // An odd number of cache lines between components, for the reason given in memory.hpp.
    std::ptrdiff_t const lines = ((particles + 7) / 8 + 2 * pad / 8) | 1;
    memory_ = Memory(static_cast<std::size_t>(8 * lines * components_ + 2 * pad));
    ref_ = {memory_.data() + pad, 8 * lines, 1, 0, &version_, name_};
    particles_ = particles;
  }
  /// Tiled layout, for fields that are only streamed through and never read at neighbours.
  void allocate_tiled(Index particles) {
    std::ptrdiff_t const tiles = (particles + tile_size - 1) / tile_size,
                         size = std::ptrdiff_t{tile_size} * components_;
    memory_ = Memory(static_cast<std::size_t>(tiles * size));
    ref_ = {memory_.data(), tile_size, 1, size - tile_size, &version_, name_};
    particles_ = particles;
  }
  /// Uses memory that several fields share: component c of particle i at data[first + c * component + i * particle].
  /// Fields that are exchanged together share a version.
  void place(double* data, std::ptrdiff_t component, std::ptrdiff_t particle, std::ptrdiff_t first, Index particles,
             FieldVersion* version = nullptr) {
    ref_ = {data + first, component, particle, 0, version != nullptr ? version : &version_, name_};
    particles_ = particles;
  }

  /// Stores one value per lane of each distinct group instead of one per particle; see FieldRef::group.
  void share(std::int32_t const* group) { ref_.group = group; }

  FieldRef ref() const { return ref_; }
  double& at(Index i, int c = 0) { return value_at(ref_, i, c); }
  double at(Index i, int c = 0) const { return value_at(ref_, i, c); }

  char const* name() const { return name_; }
  char const* unit() const { return unit_; }
  int components() const { return components_; }
  Role role() const { return role_; }
  Index size() const { return particles_; }
  std::size_t bytes() const { return memory_.bytes(); }

 private:
  char const* name_;
  char const* unit_;
  int components_;
  Role role_;
  Index particles_ = 0;
  FieldRef ref_;
  Memory memory_;
  FieldVersion version_;
};

/// The fields of a body, in the order of declaration of its ListedFields. Holds pointers: the fields must outlive the
/// set.
class FieldSet {
 public:
  FieldSet() = default;
  FieldSet(FieldSet const&) = delete;
  FieldSet& operator=(FieldSet const&) = delete;

  void add(Field& field) { all_.push_back(&field); }
  template <class Visit>
  void each(Visit&& visit) {
    for (Field* field : all_) visit(*field);
  }
  template <class Visit>
  void each(Visit&& visit) const {
    for (Field const* field : all_) visit(*field);
  }
  std::size_t bytes() const {
    std::size_t total = 0;
    each([&](Field const& field) { total += field.bytes(); });
    return total;
  }

 private:
  std::vector<Field*> all_;
};

struct ListedField : Field {
  ListedField(FieldSet& set, char const* name, char const* unit, int components, Role role)
      : Field(name, unit, components, role) {
    set.add(*this);
  }
};

}  // namespace piola
