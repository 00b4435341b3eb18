// The periodic state of strokes out of a compressor's reservoir, each of which ends before the next
// begins, or of all groups at once in bursts, so that only the reservoir's pressure is handed on.
//
// With F the reservoir's pressure after a period that began with p, F rises with p and by less than
// it does, so that p = F(p) has one solution; found from the stop pressure down. A stroke that is
// too slow there is too slow in the periodic state, where the reservoir holds no more.
#ifndef PLENUM_OPTIMIZER_EVALUATE_STROKES_TURN_STROKES_H_
#define PLENUM_OPTIMIZER_EVALUATE_STROKES_TURN_STROKES_H_

#include <optional>
#include <vector>

#include "model/strokes/reservoir_stroke.h"
#include "optimizer/evaluate/strokes/reservoir_filling.h"
#include "optimizer/evaluate/strokes/stroke_rig.h"

namespace plenum::optimizer {

// To 1e-6 of times and energy; none where a stroke goes on when the next begins. Of strokes that
// never reach their pressures, or not within their window, `works` may be false.
std::optional<Strokes> StrokesInTurns(const Problem& problem, const Candidate& candidate,
                                      const OperatingPoint& point);

// When a rise is too late for sure, s.
double LatestRise(const Problem& problem, int group);
// The rise times of a burst of several groups out of a full reservoir, until one is later than
// that, so that later ones are not known; none where it is no burst, for lines without a curve,
// after too many steps, or told to stop (reservoir_filling.h).
std::optional<std::vector<double>> FirstAtOnce(const Problem& problem, const Candidate& candidate,
                                               const OperatingPoint& point);

// The periodic state of such bursts, as exact as reservoir_filling.h; none where FirstAtOnce() has
// none.
std::optional<Strokes> StrokesAtOnce(const Problem& problem, const Candidate& candidate,
                                     const OperatingPoint& point);

// What pumps do for one stroke of a squad and to bring the reservoir to `end_pa` after it, in
// `refill_s`, and the pressure that the stroke ends at.
struct Pumped {
  double filled_pa, on_s, energy_j, air_m3;
};
Pumped PumpedFor(const model::ReservoirStrokeInput& input, const model::ReservoirStroke& stroke,
                 double end_pa, double refill_s);

// A squad's stroke out of the candidate's reservoir that holds `start_pa`.
model::ReservoirStrokeInput MakeStrokeInput(const Problem& problem, const Candidate& candidate,
                                            const OperatingPoint& point, int group, int count,
                                            double start_pa);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_STROKES_TURN_STROKES_H_
