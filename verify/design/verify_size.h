// The best settings of one combination of parts. Internal to verify*.cc.
//
// Strokes get no slower with a higher source pressure, and all that the source must bear grows with
// it but for the coils, which strokes shorten. So an interval of source pressures is closed by the
// strokes at its upper end, and by air, pumps and current at its lower end with the coils of its
// upper end. For the pumps' energy that holds where their energy per air rises with pressure (where
// groups take turns: their power); where it falls on the way up, for the share that is held
// (verify_pump_curve.h). Volumes of made-to-measure reservoirs are divided in the same way.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_SIZE_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_SIZE_H_

#include "verify/design/cycle/verify_known_cycles.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

enum class Sized { kFeasible, kInfeasible, kUnknown };

struct Sizing {
  Sized status = Sized::kUnknown;
  double objective = kUnlimited;  // the least found
  double lower_bound = 0.0;       // over all settings
};

// Sizes combinations one by one; those that come after each other and differ in battery, bottles or
// reservoir alone share what is known of their strokes.
class Sizer {
 public:
  explicit Sizer(const Problem& problem, Stop stop = {})
      : problem_(problem), stop_(std::move(stop)) {}

  // Every requirement may be missed by `slack`, relative; negative: met with that to spare. Ends as
  // soon as the lower bound passes `enough`, or when stopped, with status kUnknown where nothing
  // was found till then.
  Sizing Size(const Assembly& assembly, double slack, double enough);

 private:
  Sizing SizeAsIs(const Assembly& assembly, double slack, double enough);

  const Problem& problem_;
  const Stop stop_;
  DirectFills fills_;
  std::optional<KnownCycles> cycles_;  // look at the fills
};

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_SIZE_H_
