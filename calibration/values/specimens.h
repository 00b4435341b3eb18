// Pieces of the actuator that runs are of (Dataset::specimens): the factors of each on the
// actuator's own numbers, and what a piece that no fit saw is taken to have.
//
// Pieces of one kind are draws of one law, so that a piece without a fitted run has the mean of
// those with one, and is off by their scatter: the standard deviation s between m pieces, of a
// further one s·√(1 + 1/m), and not less than what was declared.
#ifndef PLENUM_CALIBRATION_VALUES_SPECIMENS_H_
#define PLENUM_CALIBRATION_VALUES_SPECIMENS_H_

#include <array>
#include <span>
#include <string>
#include <vector>

#include "calibration/values/dataset.h"
#include "calibration/values/model_state.h"

namespace plenum::calibration {

// Whether each specimen has its own factor: a number of the actuator that is not exact, where runs
// are of several specimens; of several chambers, which stand for specimens here, an exact one, too,
// should it be found wrong.
bool OfEachSpecimen(const Dataset& dataset, Declared number);

// ModelState::specimen_factor of what is declared.
std::array<std::vector<double>, kOfActuator> DeclaredFactors(const Dataset& dataset);

// The specimens of those of the runs whose readings depend on the number, in rising order; of a
// number that all specimens share 0 or none.
std::vector<std::size_t> SpecimensWith(const Dataset& dataset, std::span<const std::size_t> runs,
                                       Declared number);

// Those of the actuator's own numbers of a run that the runs given tell of other specimens alone.
std::vector<Declared> UntoldNumbers(const Dataset& dataset, std::span<const std::size_t> runs,
                                    std::size_t run);

// The mean over the specimens that the runs tell; 1 without one.
double MeanFactor(const Dataset& dataset, std::span<const std::size_t> runs,
                  const ModelState& state, Declared number);

// Gives the mean to the specimens that the runs do not tell.
void TakeMeans(const Dataset& dataset, std::span<const std::size_t> runs, ModelState& state);

// One standard deviation of the factor of a piece that the runs do not tell.
double ScatterOf(const Dataset& dataset, std::span<const std::size_t> runs, const ModelState& state,
                 Declared number);

// The mean of some numbers, and the standard deviation between them: of at least two.
double MeanOf(std::span<const double> numbers);
double DeviationOf(std::span<const double> numbers);

// " of b", behind the name of a number.
std::string OfSpecimenInWords(const std::string& specimen);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_VALUES_SPECIMENS_H_
