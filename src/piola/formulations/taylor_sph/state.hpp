// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field.hpp"
#include "piola/kernels/registry.hpp"
#include "piola/materials/registry.hpp"
#include "piola/neighbours/cross_set_pairs.hpp"

/// State of one body for the loops: plain data, independent of the instruction set.
namespace piola::taylor_sph {

/// Estimate of values and gradients from the sources around a target.
enum class GradientForm {
  linear_exact,  ///< about the centroid of the weights: linear fields exactly, on any set
  as_published   ///< eqs. (19), (20): the interpolated value is used at the target's position
};

struct Constants {
  double rho0;           ///< density at the start [kg/m^3]
  double kernel_volume;  ///< volume of a real particle in kernel sums, at the start [m^D]
  double lateral;        ///< strain rate of a stress-free direction over minus that along the body; 0: fixed
  double modulus;        ///< D_11 of the body's assumption: c = sqrt(D_11 / rho) [Pa]
  double hourglass;      ///< fraction of the hourglass pattern removed in each step
  GradientForm form;
  Kernel const* kernel;            ///< for estimates
  bool moving;                     ///< updated Lagrangian; false: initial configuration, geometrically linear
  bool loaded;                     ///< there are accelerations
  bool adjoint = false;            ///< the adjoint exchange; else estimates by kernel sums
  double stress_retention = 0;     ///< adjoint: weight of the cells' own stress
  double hourglass_stiffness = 0;  ///< adjoint, boxes: of their patterns, as a fraction of D_11
};

/// Record of a particle for its neighbours: `stride` doubles, x (D) | volume in kernel sums | v (D) | Cauchy stress
/// (SymMat<D>). Virtual particles have the same record, with the values at half time.
template <int D>
struct Record {
  static constexpr int stress = D * (D + 1) / 2;
  static constexpr int fields = D + stress;  ///< v and stress
  static constexpr int x = 0, volume = D, v = D + 1, s = 2 * D + 1;
  static constexpr int values = D + 1 + fields;
  static constexpr int stride = (values + 7) / 8 * 8;
};
constexpr int record_stride(int dimension) { return dimension == 3 ? Record<3>::stride : Record<2>::stride; }
/// Position of the stress in a record.
constexpr int stress_in_record(int dimension) { return 2 * dimension + 1; }

/// Number of slots for n particles or cells: a multiple of every lane count.
constexpr Index aligned(Index n) { return (n + 15) / 16 * 16; }

/// Prescribed values at a particle of the surface, or of a support, during one step. Rows of stress are orthonormal in
/// the space of stresses with shear components times sqrt(2) (Mandel), in the order of SymMat.
struct BoundaryItem {
  int held = 0;                            ///< velocity: orthonormal directions with a prescribed speed
  double direction[3][3];                  ///< unit vectors
  int support[3];                          ///< indices in the assembly
  double speed_before[3], speed_after[3];  ///< at the start and at the end of the step [m/s]
  int rows = 0;                            ///< stress: combinations with a prescribed value
  double row[6][6];
  double before[6], after[6];  ///< [Pa]
  /// Row k concerns the traction on `normal` along `along`: the velocity's derivative along `normal` is not seen by the
  /// interior particles and follows from the rate of that traction.
  double along[6][3], normal[6][3];
};

/// Cells, whose centres are the virtual particles, interleaved by lanes like CrossSetPairTable.
struct CellTable {
  int corners = 0;
  bool simplices = true;
  Index const* corner = nullptr;              ///< corner k of lane l of group g: [(g * corners + k) * lanes + l]
  double const* reference_square = nullptr;   ///< squared distance of each pair of corners at the last list update [m2]
  double const* reference_quality = nullptr;  ///< volume / (longest edge)^D at the last construction of cells
  bool adjoint = false;                       ///< wave speed limits of the adjoint exchange apply
};

/// The cells around each real particle, for the adjoint exchange.
struct CellsAround {
  Index const* begin = nullptr;  ///< per slot
  Index const* entry = nullptr;  ///< cell * corners + number of the corner
};

/// State and output of cells under the adjoint exchange; a cell's own stress is in its record.
struct CellState {
  double* across = nullptr;     ///< out-of-plane stress [Pa]
  double* force = nullptr;      ///< on each corner [N], D per corner
  double* gradient = nullptr;   ///< volume times velocity gradient, D * D per cell
  double* hourglass = nullptr;  ///< amplitudes of the patterns of a box [m]
  int patterns = 0;
  template <int D>
  PIOLA_FN double* hourglass_of(Index cell, int pattern) const {
    return hourglass + (static_cast<std::ptrdiff_t>(cell) * patterns + pattern) * D;
  }
};

/// Boxes of the lattice, for the hourglass filter.
struct HourglassTable {
  Index boxes = 0;                ///< a multiple of the lanes
  Index const* corner = nullptr;  ///< as CellTable::corner, 2^D corners
  double* pattern = nullptr;      ///< [box][mode][field]
  Index const* box_of = nullptr;  ///< per slot, 2^D entries: box * 2^D + corner number, or -1
};

/// Measures of the cells of a moving body.
struct CellMeasures {
  double strain = 0;      ///< largest relative change of a squared distance since the last list update
  double quality = 1;     ///< smallest quality relative to that at the last construction of cells
  double spacing = 0;     ///< smallest distance that a wave may cross in a step [m]
  double dilation = 1;    ///< largest volume of a real particle over that at the start
  bool inverted = false;  ///< a cell is inverted
};

struct BodyState {
  int dimension = 0;
  MaterialParameters material;
  Constants k{};
  Range interior, boundary, virtuals;  ///< slots; ranges are multiples of every lane count
  Index interior_count = 0, boundary_count = 0, virtual_count = 0;
  double* real = nullptr;      ///< records
  double* virtual_ = nullptr;  ///< records
  FieldRef out_of_plane;       ///< out-of-plane stress [Pa]
  FieldRef drift;              ///< displacement velocity of particles in the last step [m/s]
  FieldRef displacement;       ///< in the fixed configuration, where positions are constant [m]
  FieldRef acceleration;       ///< of loads, at half time [m/s2]
  FieldRef mass;               ///< [kg]
  CrossSetPairTable to_virtual, to_real;
  CellTable cells;
  HourglassTable hourglass;
  CellsAround around;
  CellState cell_state;
  BoundaryItem* items = nullptr;  ///< per slot of `boundary`
  double* partial = nullptr;      ///< room for partial sums of reductions, 16 per block
  FailureSlot* failure = nullptr;
  double filter_loss = 0;    ///< energy taken by the hourglass filter since the start [J]
  double exchange_loss = 0;  ///< energy taken by the adjoint exchange since the start [J]
  double work = 0;           ///< adjoint: external work in the last step [J]
};

/// Indices of sums over a body: mass, mass x, mass x (x) x (XX YY ZZ XY YZ XZ), momentum, moment of momentum; missing
/// components are zero.
struct MotionSums {
  static constexpr int mass = 0, x = 1, xx = 4, v = 10, moment = 13, size = 16;
};

/// Sums over the cells of a body under the adjoint exchange [J, J, W/s].
struct CellEnergy {
  double stored = 0;     ///< V t:D^-1:t / 2 of the cells' own stress
  double hourglass = 0;  ///< of the patterns of boxes
  double square = 0;     ///< V L:D:L of the present velocities
};

/// The loops of one instruction set. Every entry accepts bodies of 1, 2 or 3 dimensions.
struct Backend {
  char const* name;
  int lanes;
  void (*half_step)(BodyState& body, double dt);           ///< eqs. (21): real to virtual
  void (*full_step)(BodyState& body, double dt);           ///< eqs. (22), (23): virtual to real
  void (*impose)(BodyState& body);                         ///< prescribed speeds and stresses at the end of the step
  void (*filter)(BodyState& body);                         ///< hourglass filter
  void (*motion)(BodyState& body, double* sums);           ///< MotionSums of the real particles
  void (*add_rigid)(BodyState& body, double const* rate);  ///< adds to the velocities: spin, push, centre
  CellMeasures (*place)(BodyState& body);                  ///< moves virtual particles to the centres of their cells
  void (*adjoint_step)(BodyState& body, double dt);        ///< a whole step by the adjoint exchange
  CellEnergy (*cell_energy)(BodyState& body);              ///< of the adjoint exchange
};

/// The instruction set of that name, or the best one of this processor for "auto"; nullptr if it is unknown or not
/// usable here.
Backend const* find_backend(char const* name);
/// Names of the instruction sets in this program that this processor can run, best first; ends with nullptr.
char const* const* backend_names();
/// As find_backend; throws InputError if there is none.
Backend const& choose_backend(char const* name);

}  // namespace piola::taylor_sph
