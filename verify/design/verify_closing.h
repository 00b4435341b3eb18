// The peak that a valve leaves which closes later than told: what comes in meanwhile beyond the
// operating pressure, out of the source at its setting. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_CLOSING_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_CLOSING_H_

#include "verify/design/verify_design.h"

namespace plenum::verify {

// Absolute; of a valve that cannot hold the source pressure, of pumps that stop the operating
// pressure.
double PeakPa(const Problem& problem, Configuration configuration, int group, const LineParts& line,
              double source_pa);

// The highest source pressure, at most `most_pa`, whose peak keeps the group's limit.
double MostForPeakPa(const Problem& problem, Configuration configuration, int group,
                     const LineParts& line, double most_pa);

// The same of the line, out of all that these parts make, that may have the highest: the slowest to
// fill behind the valve that closes soonest. No fittings: a null list or null pointers in it.
struct LinesParts {
  std::vector<const model::Tubing*> tubes;
  std::vector<const model::Fitting*> fittings;
  std::vector<const model::Valve*> valves;
};
double MostForPeaksPa(const Problem& problem, Configuration configuration, int group,
                      const LinesParts& lines, double most_pa);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_CLOSING_H_
