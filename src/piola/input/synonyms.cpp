// SPDX-License-Identifier: Apache-2.0
#include "piola/input/synonyms.hpp"
#include "piola/base/text.hpp"
#include <algorithm>
#include <array>
#include <cctype>

namespace piola {
namespace {

struct Synonym {
  std::string_view words;  ///< in lower case, between blanks; without _, - and blanks of their own
  std::string_view key;    ///< the key, or the word of a list
  std::string_view owner;  ///< section of the key
  bool distinct = false;   ///< the words mean nothing else, so that other tables may point here
};

constexpr std::array synonyms{
    Synonym{" gravity gravitation bodyacceleration ", "acceleration", "[[load]]", true},
    Synonym{" g weight ", "acceleration", "[[load]]"},
    Synonym{" force nodalforce pointload ", "traction", "[[load]]"},
    Synonym{" volumeforce ", "body_force", "[[load]]"},
    Synonym{" followerload followerpressure ", "follower", "[[load]]"},
    Synonym{" young youngs youngmodulus elasticmodulus elasticitymodulus ", "youngs_modulus", "material", true},
    Synonym{" e modulus stiffness ", "youngs_modulus", "material"},
    Synonym{" nu poisson poissons poissonratio ", "poissons_ratio", "material", true},
    Synonym{" v ", "poissons_ratio", "material"},
    Synonym{" rho massdensity ", "density", "material", true},
    Synonym{" sigy sigmay fy yield yieldstrength ", "yield_stress", "material", true},
    Synonym{" etan tangentmodulus plasticmodulus ", "hardening_modulus", "material", true},
    Synonym{" cp heatcapacity ", "specific_heat", "material", true},
    Synonym{" model type materiallaw constitutivelaw ", "law", "material"},
    Synonym{" c0 soundspeed ", "bulk_sound_speed", "material"},
    Synonym{" dt timestep maxdt ", "max_step", "[run]", true},
    Synonym{" step ", "max_step", "[run]"},
    Synonym{" tend endtime tfinal finaltime tmax totaltime ", "end", "[run]", true},
    Synonym{" duration time ", "end", "[run]"},
    Synonym{" courant cflnumber safetyfactor ", "cfl", "[run]"},
    Synonym{" nthreads cores processors ", "threads", "[run]"},
    Synonym{" velocity v0 speed ", "initial_velocity", "[[body]]"},
    Synonym{" displacement ", "initial_displacement", "[[body]]"},
    Synonym{" method solver scheme ", "formulation", "[[body]]"},
    Synonym{" geometry ", "shape", "[[body]]"},
    Synonym{" bodies object ", "body", "[[body]]"},
    Synonym{" dx dp h resolution meshsize elementsize particlespacing ", "spacing", "shape of [[body]]"},
    Synonym{" frictioncoefficient coefficientoffriction ", "friction", "[contact]", true},
    Synonym{" mu ", "friction", "[contact]"},
    Synonym{" boundary boundarycondition bc constraint constraints fixed clamp dirichlet spc ", "support",
            "[[support]]"},
    Synonym{" symmetry ", "mirror", "[[mirror]]"},
    Synonym{" wall obstacle rigidbody rigidwall ", "rigid", "[[rigid]]"},
    Synonym{" sensor gauge tracer monitor observer ", "probe", "[[probe]]"},
    Synonym{" parameters variables define params ", "constants", "[constants]"},
    // Words of `law`.
    Synonym{" fluid liquid water gas idealgas newtonian ", "elastic",
            "law, with an equation of state (eos) and a small youngs_modulus"},
    Synonym{" linear hooke hookean isotropic ", "linear_elastic", "law"},
    Synonym{" hyperelastic rubber ", "neo_hookean", "law"},
    Synonym{" svk stvk kirchhoff venantkirchhoff ", "saint_venant_kirchhoff", "law"},
    Synonym{" plastic elastoplastic vonmises j2 idealplastic ", "perfectly_plastic", "law"},
    Synonym{" jc ", "johnson_cook", "law"},
    Synonym{" jh2 jh ", "johnson_holmquist", "law"},
    Synonym{" hardening linearhardening bilinear ", "isotropic_hardening", "law"},
    Synonym{" piecewiselinear piecewiselinearplasticity table tabulated plasticitytable ", "tabulated_hardening",
            "law"},
    Synonym{" saturation exponentialhardening vocehardening ", "voce", "law"},
};

/// "Young_Modulus" becomes " youngmodulus ".
std::string plain(std::string_view word) {
  std::string text = " ";
  for (char const c : word)
    if (c != '_' && c != '-' && c != ' ') text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text + " ";
}

}  // namespace

std::string advice_for_synonym(std::string_view word, std::span<std::string const> known) {
  if (word.empty() || word.size() > 64) return "";
  std::string const wanted = plain(word);
  std::string elsewhere;
  for (Synonym const& synonym : synonyms) {
    if (synonym.words.find(wanted) == std::string_view::npos) continue;
    bool const here = std::find(known.begin(), known.end(), synonym.key) != known.end();
    std::string const key = in_quotes(synonym.key);
    if (here && synonym.owner.starts_with("law,")) return "write " + key + " as " + std::string(synonym.owner);
    if (here) return "write " + key;
    if (elsewhere.empty() && synonym.distinct) elsewhere = "that is " + key + " of " + std::string(synonym.owner);
  }
  return elsewhere;
}

}  // namespace piola
