// SPDX-License-Identifier: Apache-2.0
#include "piola/base/version.hpp"
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <elf.h>
#include <fmt/format.h>
#include <link.h>
#include <span>

#ifndef PIOLA_VERSION
#define PIOLA_VERSION "0.0.0"
#endif

namespace piola {
namespace {

/// The build id among the notes of a loaded file: each is a header, a name and a content, padded to 4 bytes.
std::string build_id_in(std::span<std::byte const> notes) {
  constexpr std::size_t padding = 4;
  auto const padded = [](std::size_t bytes) { return (bytes + padding - 1) / padding * padding; };
  while (notes.size() >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) head;
    std::memcpy(&head, notes.data(), sizeof head);
    std::size_t const content = sizeof head + padded(head.n_namesz), end = content + padded(head.n_descsz);
    if (end > notes.size()) break;
    bool const gnu = head.n_namesz == sizeof "GNU" && std::memcmp(notes.data() + sizeof head, "GNU", sizeof "GNU") == 0;
    if (gnu && head.n_type == NT_GNU_BUILD_ID) {
      std::string text;
      for (std::byte const byte : notes.subspan(content, head.n_descsz)) text += fmt::format("{:02x}", byte);
      return text;
    }
    notes = notes.subspan(end);
  }
  return "";
}

/// Whether an address lies in a loaded file.
bool holds(dl_phdr_info const& file, std::uintptr_t address) {
  for (ElfW(Phdr) const& part : std::span(file.dlpi_phdr, file.dlpi_phnum)) {
    std::uintptr_t const begin = file.dlpi_addr + part.p_vaddr;
    if (part.p_type == PT_LOAD && address >= begin && address - begin < part.p_memsz) return true;
  }
  return false;
}

constexpr char own_address = 0;  ///< lies in the file that is looked for

int look_for_build_id(dl_phdr_info* file, std::size_t, void* found) {
  if (!holds(*file, std::bit_cast<std::uintptr_t>(&own_address))) return 0;
  for (ElfW(Phdr) const& part : std::span(file->dlpi_phdr, file->dlpi_phnum)) {
    if (part.p_type != PT_NOTE) continue;
    auto const* const begin = std::bit_cast<std::byte const*>(file->dlpi_addr + part.p_vaddr);
    auto& text = *static_cast<std::string*>(found);
    if (text.empty()) text = build_id_in({begin, part.p_memsz});
  }
  return 1;
}

}  // namespace

std::string_view version() { return PIOLA_VERSION; }

std::string build_id() {
  std::string text;
  ::dl_iterate_phdr(&look_for_build_id, &text);
  return text;
}

}  // namespace piola
