// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/library_sets.hpp"

namespace piola {
namespace {

constexpr std::array sources{
    LibrarySource{"assumed", "chosen here, not measured: tests at room temperature"},
    LibrarySource{"borvik_2002",
                  "T. Borvik, O. S. Hopperstad, T. Berstad, M. Langseth, Perforation of 12 mm thick steel plates by 20 "
                  "mm diameter projectiles with flat, hemispherical and conical noses, Part II: Numerical simulations, "
                  "Int. J. Impact Eng. 27 (2002) 37-64, table 2; model: Eur. J. Mech. A/Solids 20 (2001) 685-712"},
    LibrarySource{"brar_2009",
                  "N. S. Brar, V. S. Joshi, B. W. Harris, Constitutive model constants for Al7075-T651 and Al7075-T6, "
                  "AIP Conf. Proc. 1195 (2009) 945-948"},
    LibrarySource{"camacho_1997",
                  "G. T. Camacho, M. Ortiz, Comput. Methods Appl. Mech. Eng. 142 (1997) 269-301; Y. Y. Zhu, S. "
                  "Cescotto, Int. J. Numer. Methods Eng. 38 (1995) 987-1019"},
    LibrarySource{"cronin_2003",
                  "D. S. Cronin, K. Bui, C. Kaufmann, G. McIntosh, T. Berstad, Implementation and validation of the "
                  "Johnson-Holmquist ceramic material model in LS-DYNA, 4th European LS-DYNA Users Conf., Ulm 2003"},
    LibrarySource{"dobratz_1981", "B. M. Dobratz, LLNL explosives handbook, UCRL-52997, LLNL 1981"},
    LibrarySource{"dowling_2013",
                  "N. E. Dowling, Mechanical Behavior of Materials, 4th ed., Pearson 2013, table 5.2 (elastic "
                  "constants)"},
    LibrarySource{"dwivedi_2012",
                  "A. Dwivedi, J. Bradley, D. Casem, Mechanical response of polycarbonate with strength model fits, "
                  "ARL-TR-5899, US Army Research Laboratory 2012"},
    LibrarySource{"handbook", "usual values of handbooks and data sheets"},
    LibrarySource{"holmquist_1995",
                  "T. J. Holmquist, G. R. Johnson, D. E. Grady, C. M. Lopatin, E. S. Hertel, High strain rate "
                  "properties and constitutive modeling of glass, Proc. 15th Int. Symp. Ballistics, Jerusalem 1995, "
                  "pp. 237-244"},
    LibrarySource{"howell_2002",
                  "B. P. Howell, G. J. Ball, J. Comput. Phys. 175 (2002) 128-167, after D. J. Steinberg, S. G. "
                  "Cochran, M. W. Guinan, J. Appl. Phys. 51 (1980) 1498-1504"},
    LibrarySource{"iqbal_2015",
                  "M. A. Iqbal, K. Senthil, P. Bhargava, N. K. Gupta, The characterization and ballistic evaluation of "
                  "mild steel, Int. J. Impact Eng. 78 (2015) 98-113"},
    LibrarySource{"iqbal_2016",
                  "M. A. Iqbal, K. Senthil, P. Sharma, N. K. Gupta, An investigation of the constitutive behavior of "
                  "Armox 500T steel and armor piercing incendiary projectile material, Int. J. Impact Eng. 96 (2016) "
                  "146-164"},
    LibrarySource{"johnson_1985",
                  "G. R. Johnson, Strength and fracture characteristics of a titanium alloy (.06Al, .04V) subjected to "
                  "various strains, strain rates, temperatures and pressures, NSWC TR 86-144, Naval Surface Weapons "
                  "Center 1985"},
    LibrarySource{"johnson_cook_1983",
                  "G. R. Johnson, W. H. Cook, A constitutive model and data for metals subjected to large strains, "
                  "high strain rates and high temperatures, Proc. 7th Int. Symp. Ballistics, The Hague 1983, pp. "
                  "541-547, table 1"},
    LibrarySource{"johnson_cook_1985",
                  "G. R. Johnson, W. H. Cook, Fracture characteristics of three metals subjected to various strains, "
                  "strain rates, temperatures and pressures, Eng. Fract. Mech. 21 (1985) 31-48"},
    LibrarySource{"johnson_holmquist_1989",
                  "G. R. Johnson, T. J. Holmquist, Test data and computational strength and fracture model constants "
                  "for 23 materials subjected to large strains, high strain rates, and high temperatures, "
                  "LA-11463-MS, Los Alamos National Laboratory 1989"},
    LibrarySource{"johnson_holmquist_1999",
                  "G. R. Johnson, T. J. Holmquist, Response of boron carbide subjected to large strains, high strain "
                  "rates, and high pressures, J. Appl. Phys. 85 (1999) 8060-8073"},
    LibrarySource{"lesuer_2000",
                  "D. R. Lesuer, Experimental investigations of material models for Ti-6Al-4V titanium and 2024-T3 "
                  "aluminum, DOT/FAA/AR-00/25, Federal Aviation Administration 2000"},
    LibrarySource{"lesuer_2001",
                  "D. R. Lesuer, G. J. Kay, M. M. LeBlanc, Modeling large-strain, high-rate deformation in metals, "
                  "UCRL-JC-134118, LLNL 2001"},
    LibrarySource{"smith_1960", "J. F. Smith, C. L. Arbogast, J. Appl. Phys. 31 (1960) 99-102"},
    LibrarySource{"steinberg_1996",
                  "D. J. Steinberg, Equation of state and strength properties of selected materials, UCRL-MA-106439 "
                  "Change 1, LLNL 1996"},
    LibrarySource{"teng_2006",
                  "X. Teng, T. Wierzbicki, Evaluation of six fracture models in high velocity "
                  "perforation, Eng. Fract. Mech. 73 (2006) 1653-1678"},
    LibrarySource{"treloar_1944",
                  "L. R. G. Treloar, Stress-strain data for vulcanised rubber under various types of deformation, "
                  "Trans. Faraday Soc. 40 (1944) 59-70"},
    LibrarySource{"wen_2013",
                  "Y. Wen, C. Xu, H. Wang, A. Chen, R. C. Batra, Impact of steel spheres on ballistic gelatin at "
                  "moderate velocities, Int. J. Impact Eng. 62 (2013) 142-151"},
    LibrarySource{"wood_1964",
                  "L. A. Wood, G. M. Martin, Compressibility of natural rubber at pressures below 500 kg/cm2, J. Res. "
                  "Natl. Bur. Stand. 68A (1964) 259-268"},
    LibrarySource{"young_2021",
                  "J. Young, F. Teixeira-Dias, A. Azevedo, F. Mill, Adaptive Total Lagrangian Eulerian SPH for "
                  "high-velocity impacts, Int. J. Mech. Sci. 192 (2021) 106108"},
    LibrarySource{"zerilli_1987",
                  "F. J. Zerilli, R. W. Armstrong, Dislocation-mechanics-based constitutive relations for material "
                  "dynamics calculations, J. Appl. Phys. 61 (1987) 1816-1825"}};

}  // namespace

std::span<LibrarySource const> library_sources() { return sources; }

}  // namespace piola
