#include "optimizer/search/configurations.h"

#include <algorithm>

#include "optimizer/choices/make_plan.h"

namespace plenum::optimizer {

Configurations::Configurations(const Problem& problem, const Workbench& bench, bool record)
    : problem_(problem), bench_(bench), record_(record) {
  for (const Layout& layout : LayoutsOf(problem)) {
    waiting_.push_back(MakeOutline(problem, layout));
    combinations_ += waiting_.back().combinations;
  }
  std::reverse(waiting_.begin(), waiting_.end());
  std::stable_sort(waiting_.begin(), waiting_.end(),
                   [](const Outline& a, const Outline& b) { return a.bound > b.bound; });
}

double Configurations::LeastWaiting() const {
  return waiting_.empty() ? kUnlimited : waiting_.back().bound;
}

Bounds* Configurations::PlantNext() {
  std::unique_ptr<Plan> plan = MakePlan(problem_, waiting_.back().layout, record_, bench_.stop);
  if (!plan) return nullptr;
  waiting_.pop_back();
  plans_.push_back(std::move(plan));
  planted_.push_back(std::make_unique<Bounds>(problem_, *plans_.back(), &bench_));
  return planted_.back().get();
}

}  // namespace plenum::optimizer
