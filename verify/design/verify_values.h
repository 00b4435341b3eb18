// The values that verification shares with the search: the problem, its answer and the
// record of the search. It shares no code.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_VALUES_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_VALUES_H_

#include <functional>

#include "optimizer/problem/amount.h"
#include "optimizer/problem/big_count.h"
#include "optimizer/problem/own_regulators.h"
#include "optimizer/problem/pareto_front.h"
#include "optimizer/problem/problem.h"
#include "optimizer/problem/proof.h"
#include "optimizer/problem/robust_answer.h"

namespace plenum::verify {

using optimizer::ActuatorGroup;
using optimizer::Amount;
using optimizer::Answer;
using optimizer::BigCount;
using optimizer::BoxKind;
using optimizer::Choice;
using optimizer::Configuration;
using optimizer::Constraint;
using optimizer::Design;
using optimizer::DrawParts;
using optimizer::Evacuated;
using optimizer::Family;
using optimizer::Front;
using optimizer::GroupPerformance;
using optimizer::HasOwnRegulators;
using optimizer::HasPump;
using optimizer::HasTank;
using optimizer::IsDirect;
using optimizer::IsPumped;
using optimizer::KeepsReservoir;
using optimizer::kUnlimited;
using optimizer::Layout;
using optimizer::LayoutsOf;
using optimizer::Limits;
using optimizer::Margin;
using optimizer::Objective;
using optimizer::Performance;
using optimizer::Problem;
using optimizer::Proof;
using optimizer::ProofBox;
using optimizer::ProofDominated;
using optimizer::ProofItem;
using optimizer::ProofPlan;
using optimizer::ProofRecord;
using optimizer::ProofSlot;
using optimizer::Pruned;
using optimizer::PumpFamily;
using optimizer::PumpFeed;
using optimizer::PumpsHoldOn;
using optimizer::PumpsOf;
using optimizer::PumpsRail;
using optimizer::RailSettings;
using optimizer::RobustAnswer;
using optimizer::RobustOptions;
using optimizer::Searched;
using optimizer::Settings;
using optimizer::Status;
using optimizer::Totals;

inline Layout LayoutOf(const ProofPlan& plan) { return {plan.configuration, plan.own_regulators}; }
inline Layout LayoutOf(const Design& design) {
  return {design.configuration, HasOwnRegulators(design.parts)};
}

// Whether somebody wants a check to end before it has looked at all. May be empty; true from some
// time on. What is not looked at by then stays open.
using Stop = std::function<bool()>;
inline bool Stopped(const Stop& stop) { return stop && stop(); }

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_VALUES_H_
