// Plants a plan: the choices of every family of a layout, as trees of boxes.
#ifndef PLENUM_OPTIMIZER_CHOICES_MAKE_PLAN_H_
#define PLENUM_OPTIMIZER_CHOICES_MAKE_PLAN_H_

#include <functional>
#include <memory>

#include "optimizer/choices/plan.h"
#include "optimizer/problem/own_regulators.h"

namespace plenum::optimizer {

// Null where `stop` said so. `name_left_out`: fill Slot::dominated.
std::unique_ptr<Plan> MakePlan(const Problem& problem, const Layout& layout,
                               bool name_left_out = false, const std::function<bool()>& stop = {});

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_MAKE_PLAN_H_
