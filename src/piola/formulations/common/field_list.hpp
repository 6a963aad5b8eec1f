// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include <deque>
#include <string>

namespace piola {

/// Name of a field in checkpoints: that of "WaveSpeed" is "wave_speed".
std::string checkpoint_name(char const* field);

/// The particle fields of one body: their memory, and the references by which loops read and write it. A formulation
/// declares its fields once, as ListedRefs of the state of a body; memory and checkpoints follow from that list.
class FieldList {
 public:
  FieldList() = default;
  FieldList(FieldList const&) = delete;
  FieldList& operator=(FieldList const&) = delete;

  /// Keeps a pointer to `ref`, which must outlive the list.
  void add(FieldRef& ref, bool exists, char const* name, char const* unit, int components, Role role);
  /// The memory of a field, given by its reference in the state of the body.
  Field& operator[](FieldRef const& ref);
  /// Calls f(field) for the fields that the body has and that have no memory yet.
  template <class F>
  void each_without_memory(F const& f) {
    for (Entry& entry : entries_)
      if (entry.exists && entry.field.size() == 0) f(entry.field);
  }
  /// Points the references to the memory.
  void bind();
  /// Calls f(name, reference, components) for the evolved fields, which a checkpoint holds under these names.
  template <class F>
  void each_evolved(F const& f) const {
    for (Entry const& entry : entries_)
      if (entry.exists && entry.field.role() == Role::evolved)
        f(checkpoint_name(entry.field.name()), static_cast<FieldRef const&>(*entry.ref), entry.field.components());
  }
  std::size_t bytes() const;

 private:
  struct Entry {
    Entry(FieldRef& of, bool is_wanted, char const* name, char const* unit, int components, Role role)
        : ref(&of), exists(is_wanted), field(name, unit, components, role) {}
    FieldRef* ref;
    bool exists;
    Field field;
  };

  std::deque<Entry> entries_;  // a Field stays where it is
};

/// A FieldRef that adds itself to the list of its body when the state of the body is constructed; copies of the state
/// do not. Plain data.
struct ListedRef : FieldRef {
  /// list: nullptr for a state without memory of its own. exists: whether the body has the field. A field that it has
  /// not can be given memory by Field::place() or Field::allocate().
  ListedRef(FieldList* list, char const* of, char const* unit, int components, Role role, bool exists = true);
  using FieldRef::operator=;
};

}  // namespace piola
