// SPDX-License-Identifier: Apache-2.0
// Whatever bytes stand for a mesh, the answer is a solid that can be asked and cut, or problems. The first character
// chooses the format and the repair: "0" to "8".
#include "piola/geometry/mesh.hpp"
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace piola::geometry;
  if (size == 0) return 0;
  constexpr std::array<char const*, 3> names{"fuzz.stl", "fuzz.obj", "fuzz.ply"};
  constexpr std::array<MeshOptions::Repair, 3> repairs{MeshOptions::Repair::none, MeshOptions::Repair::orient,
                                                       MeshOptions::Repair::holes};
  unsigned const choice = static_cast<std::uint8_t>(data[0] - '0') % 9;
  std::string bytes;
  for (std::size_t i = 1; i < size; ++i) bytes += static_cast<char>(data[i]);
  MeshOptions options{.scale = 1e-3, .repair = repairs[choice / 3], .largest_hole = 10, .spacing = 1e-4};
  options.time_limit = 1;  // by the clock: on a busy machine a tenth of it passes before the child has begun
  MeshReport report;
  SolidPtr const solid = mesh_from_bytes(bytes, names[choice % 3], options, report);
  if ((solid == nullptr) == report.problems.empty()) std::abort();
  if (solid == nullptr) return 0;
  solid->at({{1e-3, 2e-4, -3e-4}});
  std::vector<SurfacePiece> pieces;
  Bounds const box = solid->bounds();
  solid->cut_surface(0.2 * (box.max[0] - box.min[0] + box.max[1] - box.min[1] + box.max[2] - box.min[2]), pieces);
  for (SurfacePiece const& p : pieces)
    if (p.patch < 0 || p.patch >= static_cast<int>(solid->patches().size())) std::abort();
  return 0;
}
