// SPDX-License-Identifier: Apache-2.0
// Formulas of the toughness of solids, at points computed by hand.
#include "piola/materials/damage/fracture.hpp"
#include <gtest/gtest.h>

namespace piola::testing {
namespace {

TEST(Fracture, BandSoftensFromTheStrengthToTheLastStress) {
  // 2 * 50 J/m2 * 32 GPa / (10 mm * 3 MPa)
  CrackBand const band = crack_band(3e6, 50, 32e9, 0.01);
  EXPECT_FALSE(band.weakened);
  EXPECT_NEAR(band.last, 1.0666667e8, 1e2);
  EXPECT_EQ(band.softening(3e6), 0);
  EXPECT_NEAR(band.softening(6e6), 106.6666667 / 103.6666667 * 0.5, 1e-9);
  EXPECT_EQ(band.softening(band.last), 1);
}

/// The stress (1 - softening) r over the strain r / E encloses the energy over the width of the band.
TEST(Fracture, BandTakesTheFractureEnergyPerArea) {
  double const energy = 50, modulus = 32e9, width = 0.01;
  CrackBand const band = crack_band(3e6, energy, modulus, width);
  constexpr int n = 20000;
  double work = 0;
  for (int k = 0; k < n; ++k) {
    double const r = band.last * (k + 0.5) / n;
    work += (1 - band.softening(r)) * r * (band.last / n) / modulus;
  }
  EXPECT_NEAR(work * width, energy, 1e-4 * energy);
}

TEST(Fracture, TooWideBandKeepsTheEnergyAndLosesStrength) {
  CrackBand const band = crack_band(3e6, 0.5, 32e9, 0.01);
  EXPECT_TRUE(band.weakened);
  EXPECT_NEAR(band.strength, 1.745743e6, 1);  // sqrt(2 * 0.5 * 32e9 / (1.05 * 0.01))
  EXPECT_NEAR(band.last / band.strength, 1.05, 1e-12);
}

/// E = 200 GPa, nu = 0.3: w = (a^2 + b^2 - 2 nu a b) / (2 E) for two stresses a, b; compression does not count.
TEST(Fracture, TensionIsTheEnergyOfTensileStresses) {
  double const young = 200e9, nu = 0.3, mu = young / (2 * (1 + nu)), kappa = young / (3 * (1 - 2 * nu));
  EXPECT_NEAR(squared_tension({5e6, -3e6, 0}, young, kappa, mu), 25e12, 1e3);
  EXPECT_NEAR(squared_tension({4e6, 2e6, -1e6}, young, kappa, mu), 15.2e12, 1e3);
  EXPECT_NEAR(squared_tension({1e6, 1e6, 1e6}, young, kappa, mu), 1.2e12, 1e3);
  // Plane strain across a crack: the stress along the crack's edge is nu times that across it.
  EXPECT_NEAR(squared_tension({5e6, 1.5e6, 0}, modulus_across_crack(2, kappa, mu), kappa, mu), 25e12, 1e3);
  EXPECT_NEAR(squared_tension({7e6, 3e6, 3e6}, modulus_across_crack(1, kappa, mu), kappa, mu), 49e12, 1e3);
}

TEST(Fracture, ModulusAcrossACrackIsThatOfTheDimension) {
  double const young = 200e9, nu = 0.3, mu = young / (2 * (1 + nu)), kappa = young / (3 * (1 - 2 * nu));
  EXPECT_NEAR(modulus_across_crack(1, kappa, mu), young * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), 1);
  EXPECT_NEAR(modulus_across_crack(2, kappa, mu), young / (1 - nu * nu), 1);
  EXPECT_NEAR(modulus_across_crack(3, kappa, mu), young, 1);
}

}  // namespace
}  // namespace piola::testing
