// A problem of the base model whose designs are tried when effects act: no design meets less of it
// than of the problem with its effects.
#ifndef PLENUM_OPTIMIZER_EVALUATE_RELAXATION_H_
#define PLENUM_OPTIMIZER_EVALUATE_RELAXATION_H_

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// Without effects, and with room for what they might ease:
//   * effects that only slow strokes down or add to the air (dead volume, delay, ramp, droop,
//     restriction, cracking pressure, a line that conducts less): none. Each takes away from the
//     flow, or adds to the volume, at every state, and the pressure of an actuator keeps its order
//     in both. Dead volume is that of the chamber; a delay shortens what is left for a stroke.
//   * leak: slows the rise likewise, but helps the fall: fall times are not limited.
//   * effects that may also speed strokes up or save air (on the volume, the energy balance, waves
//   in
//     the line, learned from data): rise and fall times may be longer by kRoom, actuations fewer.
//     What an effect gains beyond that is not looked at: the list is then the best of what was
//     tried, and nothing is proved.
inline constexpr double kRoom = 1.4;
Problem Relaxed(const Problem& problem);

// The same with limits as much tighter, or looser, as the effects make a design of the base model
// slower or faster, `nominal` with its margins `revised` under them (resize.h): designs of this
// problem are likely to be good ones. It bounds nothing.
Problem Guide(const Problem& problem, const Design& nominal, const std::vector<Margin>& revised);

// The problem of the base model.
Problem WithoutEffects(Problem problem);

// Whether every effect is of the kinds for which that is proved.
bool RelaxationIsProved(const Problem& problem);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_RELAXATION_H_
