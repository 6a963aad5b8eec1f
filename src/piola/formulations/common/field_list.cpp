// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/common/field_list.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <type_traits>

namespace piola {

static_assert(std::is_trivially_copyable_v<ListedRef>);

std::string checkpoint_name(char const* field) {
  std::string r;
  for (char const* c = field; *c != '\0'; ++c) {
    bool const capital = *c >= 'A' && *c <= 'Z';
    if (capital && c != field) r += '_';
    r += capital ? static_cast<char>(*c - 'A' + 'a') : *c;
  }
  return r;
}

ListedRef::ListedRef(FieldList* list, char const* of, char const* unit, int components, Role role, bool exists) {
  if (list != nullptr) list->add(*this, exists, of, unit, components, role);
}

void FieldList::add(FieldRef& ref, bool exists, char const* name, char const* unit, int components, Role role) {
  entries_.emplace_back(ref, exists, name, unit, components, role);
}

Field& FieldList::operator[](FieldRef const& ref) {
  auto const found =
      std::find_if(entries_.begin(), entries_.end(), [&](Entry const& entry) { return entry.ref == &ref; });
  PIOLA_EXPECTS(found != entries_.end());
  return found->field;
}

void FieldList::bind() {
  for (Entry& entry : entries_) *entry.ref = entry.field.ref();
}

std::size_t FieldList::bytes() const {
  std::size_t total = 0;
  for (Entry const& entry : entries_) total += entry.field.bytes();
  return total;
}

}  // namespace piola
