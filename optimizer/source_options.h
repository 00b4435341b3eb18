// Choices of each source family: a part, some pieces in parallel.
#ifndef PLENUM_OPTIMIZER_SOURCE_OPTIONS_H_
#define PLENUM_OPTIMIZER_SOURCE_OPTIONS_H_

#include <vector>

#include "optimizer/candidate.h"

namespace plenum::optimizer {

struct OptionSet {
  std::vector<Option> options;  // by rising share of the objective
  long long total = 0;          // part × quantity, as the contract counts combinations
  long long unpriced = 0;       // left out because a price is needed and missing
};

OptionSet RegulatorOptions(const Problem& problem);
OptionSet CylinderOptions(const Problem& problem);  // gas charge included in the mass
OptionSet Co2Options(const Problem& problem);       // CO2 included in the mass
OptionSet CompressorOptions(const Problem& problem);
OptionSet BatteryOptions(const Problem& problem);
// Stock reservoirs, and the made-to-measure one unless it is excluded or has no price that is
// needed.
OptionSet ReservoirOptions(const Problem& problem);

// Whether the parts may stand together, as far as data sheets say.
bool RegulatorFits(const Problem& problem, Configuration configuration, int regulator);
bool RegulatorFitsCylinder(const Problem& problem, int regulator, int cylinder);
bool BatteryFitsCompressor(const Problem& problem, int battery, int compressor);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SOURCE_OPTIONS_H_
