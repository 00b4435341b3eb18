// What the data do not fix in a fit: numbers of which they say nothing, and numbers of which they
// fix only a combination (aliases).
//
// H is the curvature of χ² in the fit's coordinates from the data alone. A coordinate by itself has
// the standard deviation 1/√H_jj; together with the others √(H⁻¹)_jj. Above `kUnidentified`
// (fit.h: of the prior's deviation, of an e-fold, of an effect's typical size or its range if that
// is less) the number is
//   silent   if that holds by itself already: no reading depends on it enough;
//   aliased  if it holds together only: another number does the same to the readings.
// Aliases are grouped by the eigenvectors of H scaled to a unit diagonal whose eigenvalues are
// below kAliasEigenvalue. Instants of stated uncertainty take no part: they are known to that, and
// H is what is left beside them. A prior may still fix each number of a group, but then it is the
// declared value that speaks, not the data. A measured conductance, or what a pump delivers, that
// is aliased with the rest volume alone is told by itself: it is known as well as that volume is.
// Source: Raue et al., Bioinformatics 25 (2009) 1923 (structural and practical identifiability), to
// second order in place of profiles.
#ifndef PLENUM_CALIBRATION_JUDGE_IDENTIFIABILITY_H_
#define PLENUM_CALIBRATION_JUDGE_IDENTIFIABILITY_H_

#include <optional>
#include <string>
#include <vector>

#include "calibration/fit/fit.h"

namespace plenum::calibration {

inline constexpr double kAliasEigenvalue = 1e-3;

struct Identifiability {
  std::vector<std::string> silent;
  std::vector<std::vector<std::string>> aliases;
  std::vector<std::string> by_volume;  // measured numbers, as well known as the rest volume
  double volume_uncertainty = 0.0;     // as declared, relative
};

// "sonic_conductance", "creep.fraction", "initial pressure of r1".
std::string NameOf(const Parameter& parameter, const ModelState& state, const Dataset& dataset);

// Empty where a simulation failed.
std::optional<Identifiability> Identify(const FitData& data, const Fit& fit,
                                        const FitOptions& options);

// One sentence for each finding, for Diagnosis::warnings.
std::vector<std::string> Sentences(const Identifiability& found);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_JUDGE_IDENTIFIABILITY_H_
