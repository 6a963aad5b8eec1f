// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/mesh_cells.hpp"
#include "neighbours/cell_checks.hpp"

namespace piola {
namespace {

using namespace testing;

/// Boxes and simplices of a set fill the volume and have the surface given.
void expect_both_filled(ParticleSet const& set, double volume, double surface_measure) {
  Cells const boxes = lattice_cells(set, set.bodies[0]);
  expect_filled(boxes, set.X, volume, surface_measure);
  expect_filled(split_alternately(boxes, set, set.bodies[0]), set.X, volume, surface_measure);
}

TEST(LatticeCells, FillBoxesOfEveryDimension) {
  expect_both_filled(box({3, 0, 0}, {7, 1, 1}, 1), 3, 2);
  expect_both_filled(box({3, 2, 0}, {7, 5, 1}, 2), 6, 10);
  expect_both_filled(box({3, 2, 1}, {7, 5, 4}), 6, 22);
}

TEST(LatticeCells, AreTheBoxesWithAllCorners) {
  auto const set = box({3, 2, 1}, {7, 5, 4});
  Cells const cells = lattice_cells(set, set.bodies[0]);
  EXPECT_EQ(cells.count(), 6 * 4 * 3);
  auto const first = cells.of(0);
  EXPECT_EQ(std::vector<Index>(first.begin(), first.end()), (std::vector<Index>{0, 1, 7, 8, 35, 36, 42, 43}));
  auto const row = box({1, 0.5, 0}, {5, 1, 1}, 2);  // one row of particles has no boxes
  EXPECT_EQ(lattice_cells(row, row.bodies[0]).count(), 0);
}

TEST(LatticeCells, CountCornersFromTheBodysFirstParticle) {
  auto set = box({1, 1, 0}, {3, 3, 1}, 2);
  auto const second = box({1, 1, 0}, {4, 4, 1}, 2);
  Body body = second.bodies[0];
  body.first = set.size();
  for (std::size_t k = 0; k < second.X.size(); ++k) {
    set.X.push_back(second.X[k]);
    set.lattice_index.push_back(second.lattice_index[k]);
  }
  body.last = set.size();
  set.bodies.push_back(body);
  Cells const boxes = lattice_cells(set, set.bodies[1]);
  EXPECT_EQ(boxes.corner, lattice_cells(second, second.bodies[0]).corner);
  EXPECT_EQ(split_alternately(boxes, set, set.bodies[1]).corner,
            split_alternately(boxes, second, second.bodies[0]).corner);
}

TEST(LatticeCells, LeaveOutNotchesAndHoles) {
  auto const angle = part_of(unit_box(2, 11), [](auto const& X) { return X[0] < 0.45 || X[1] < 0.35; });
  expect_both_filled(angle, 1 - 0.6 * 0.7, 4);
  auto const plate = part_of(
      unit_box(2, 11), [](auto const& X) { return std::max(std::fabs(X[0] - 0.5), std::fabs(X[1] - 0.5)) > 0.15; });
  expect_both_filled(plate, 1 - 0.16, 4 + 1.6);
  auto const block = part_of(unit_box(3, 7), [](auto const& X) {
    return std::max({std::fabs(X[0] - 0.5), std::fabs(X[1] - 0.5), std::fabs(X[2] - 0.5)}) > 0.1;
  });
  expect_both_filled(block, 1 - 1.0 / 27, 6 + 6.0 / 9);
  EXPECT_EQ(pieces(surface_of(lattice_cells(block, block.bodies[0]), block.X), block.X), 2);
}

TEST(SplitAlternately, MirrorsTheDiagonalsOfBoxesSideBySide) {
  auto const set = unit_box(2, 6);
  Cells const cells = split_alternately(lattice_cells(set, set.bodies[0]), set, set.bodies[0]);
  std::vector<int> degree(set.X.size(), 0);
  for (Index const p : cells.corner) ++degree[static_cast<std::size_t>(p)];
  for (std::size_t p = 0; p < set.X.size(); ++p) {
    auto const& i = set.lattice_index[p];
    if (i[0] % 5 == 0 || i[1] % 5 == 0) continue;
    EXPECT_EQ(degree[p], (i[0] + i[1]) % 2 == 0 ? 8 : 4);
  }
}

TEST(SplitAlternately, ByRowOrColumnPutsSixTrianglesAroundEachParticleInside) {
  auto const set = unit_box(2, 6);
  Cells const boxes = lattice_cells(set, set.bodies[0]);
  for (auto const diagonals : {Diagonals::by_row, Diagonals::by_column}) {
    Cells const cells = split_alternately(boxes, set, set.bodies[0], diagonals);
    expect_filled(cells, set.X, 1, 4);
    std::vector<int> degree(set.X.size(), 0);
    for (Index const p : cells.corner) ++degree[static_cast<std::size_t>(p)];
    for (std::size_t p = 0; p < set.X.size(); ++p) {
      auto const& i = set.lattice_index[p];
      if (i[0] % 5 != 0 && i[1] % 5 != 0) {
        EXPECT_EQ(degree[p], 6);
      }
    }
  }
}

TEST(SplitAlternately, MakesFiveTetrahedraThatFitThoseBeside) {
  auto const set = unit_box(3, 4);
  Cells const boxes = lattice_cells(set, set.bodies[0]);
  Cells const cells = split_alternately(boxes, set, set.bodies[0]);
  EXPECT_EQ(cells.count(), 5 * boxes.count());
  EXPECT_EQ(surface_of(cells, set.X).count(), 6 * 9 * 2);
  EXPECT_NEAR(smallest_volume(cells, set.X), 1.0 / 27 / 6, 1e-15);
}

TEST(VolumeOf, IsThatOfTheTrilinearMapForBoxes) {
  auto set = unit_box(3, 2);
  Cells const cell = lattice_cells(set, set.bodies[0]);
  set.X[7][2] = 2;  // z = zeta (1 + xi eta)
  EXPECT_NEAR(volume_of(cell, 0, set.X), 1.25, 1e-15);
  for (auto& x : set.X.own()) x[0] = -x[0];
  EXPECT_NEAR(volume_of(cell, 0, set.X), -1.25, 1e-15);
}

TEST(SurfaceOf, KnowsTheEndsOfABar) {
  auto const bar = box({1, 0, 0}, {5, 1, 1}, 1);
  Surface const surface = surface_of(lattice_cells(bar, bar.bodies[0]), bar.X);
  EXPECT_EQ(surface.corner, (std::vector<Index>{0, 4}));
  EXPECT_EQ(surface.outward, (std::vector<double>{-1, 1}));
}

TEST(SurfaceOf, ThatOfABentBlockIsClosed) {
  auto set = unit_box(3, 5, 0.2);
  for (auto& x : set.X.own()) x[2] += 0.3 * x[0] * x[1];
  Surface const surface = surface_of(lattice_cells(set, set.bodies[0]), set.X);
  Vec<3> sum;
  for (Index f = 0; f < surface.count(); ++f) sum = sum + facet_normal(surface, f, set.X);
  EXPECT_NEAR(std::sqrt(dot(sum, sum)), 0, 1e-14);
}

TEST(SurfaceOf, NoCellsIsNothing) {
  for (int dimension = 1; dimension <= 3; ++dimension)
    EXPECT_EQ(surface_of({dimension, dimension + 1, {}}, {}).count(), 0);
}

struct Cut {
  char const* name;
  Crack crack;
  int doubled;  ///< particles on each face
  int pieces;   ///< of the surface
};

std::vector<Cut> cuts() {
  return {{"edge", {0, {0, 0.5, 0}, {0.4, 0.5, 0}, false, true}, 4, 1},
          {"edge, seen from its tip", {0, {0.4, 0.5, 0}, {0, 0.5, 0}, true, false}, 4, 1},
          {"two tips", {0, {0.3, 0.5, 0}, {0.7, 0.5, 0}, true, true}, 3, 2},
          {"through", {0, {0, 0.5, 0}, {1, 0.5, 0}, false, false}, 11, 2}};
}

/// The crack shows on the surface with both faces; the plate is still all there.
void expect_open(Cells const& cells, ParticleSet const& set, Cut const& c) {
  SCOPED_TRACE(c.name);
  double const length = std::fabs(c.crack.to[0] - c.crack.from[0]);
  EXPECT_EQ(std::ssize(set.X), 121 + c.doubled);
  expect_filled(cells, set.X, 1, 4 + 2 * length);
  EXPECT_EQ(pieces(surface_of(cells, set.X), set.X), c.pieces);
  EXPECT_GT(expect_no_cell_straddles(cells, set, c.crack), 4 * c.doubled - 5);
}

TEST(LatticeCells, OpenCracks) {
  for (Cut const& c : cuts())
    for (std::int8_t const first_side : {std::int8_t{1}, std::int8_t{-1}}) {
      auto const set = cut(unit_box(2, 11), c.crack, first_side);
      Cells const boxes = lattice_cells(set, set.bodies[0]);
      expect_open(boxes, set, c);
      expect_open(split_alternately(boxes, set, set.bodies[0]), set, c);
    }
}

TEST(LatticeCells, OpenSeveralCracks) {
  Crack const low{0, {0, 0.2, 0}, {0.4, 0.2, 0}, false, true}, high{0, {0.8, 0.7, 0}, {0.3, 0.7, 0}, true, true};
  auto const set = cut(cut(unit_box(2, 11), low), high);
  expect_both_filled(set, 1, 4 + 2 * 0.4 + 2 * 0.5);
}

TEST(OpenCracks, AfterATriangulation) {
  for (Cut const& c : cuts()) {
    auto const set = cut(unit_box(2, 11), c.crack);
    Points const single(set.X.begin(), set.X.begin() + 121);
    std::vector<Index> twin(set.X.size(), -1);
    for (Index k = 121, p = 0; k < std::ssize(set.X); ++k, ++p) {
      while (at(single, p) != at(set.X, k)) ++p;
      twin[static_cast<std::size_t>(p)] = k;
      twin[static_cast<std::size_t>(k)] = p;
    }
    Cells cells = delaunay(single, 2, 0.1);
    open_cracks(cells, set.X, set.crack_side, twin, set.cracks);
    expect_open(cells, set, c);
  }
}

}  // namespace
}  // namespace piola
