// Full strokes of many rigs at once: what FullStrokes gives for each, faster.
//
// Rigs of one group in the base model (no effects, the linear volume law, each way one element with
// m = ½ and no cracking pressure, a source of constant pressure without regulator and flow limit, a
// reservoir without compressor, or none) are integrated side by side in vector lanes
// (bench/batch/simulate_lanes.h): the same equations in time, with the same tolerances, but at
// steps of their own, so that the times agree within the tolerance. All other rigs, targets within
// 1e-6 of the pressure that the stroke ends at, and lanes that do not arrive in 1000 steps go to
// FullStrokes one by one.
#ifndef PLENUM_BENCH_BATCH_SIMULATE_BATCH_H_
#define PLENUM_BENCH_BATCH_SIMULATE_BATCH_H_

#include <span>

#include "bench/batch/closed_form_batch.h"
#include "model/simulate/simulate.h"

namespace plenum::bench {

// `strokes` holds one entry per group of every rig, in the order of rigs and groups. A rig's result
// does not depend on the others or on the number of threads, and is the same bits for all
// `instructions`. Once options.cancelled says so, the rest is +∞ with status kCancelled; with
// several threads it is asked by all of them.
void FullStrokesOfMany(std::span<const model::Rig> rigs, const model::SimulateOptions& options,
                       std::span<model::FullStroke> strokes, int threads = 1,
                       Instructions instructions = WidestSupported());

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_BATCH_SIMULATE_BATCH_H_
