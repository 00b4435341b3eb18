#include "optimizer/choices/make_plan.h"

#include "optimizer/choices/plant/planter.h"

namespace plenum::optimizer {

void Planter::PlantGroup(int g) {
  LineMates mates;
  mates.fittings = problem_.groups[g].fittings_per_line > 0;
  for (const model::Fitting& fitting : problem_.parts.fittings) {
    mates.diameters.Bit(fitting.tube_outer_diameter_m);
    mates.threads.Bit(fitting.thread);
  }
  PlantTubing(g, mates);
  PlantFittings(g, mates);
  PlantValves(g, mates);
}

std::unique_ptr<Plan> MakePlan(const Problem& problem, const Layout& layout, bool name_left_out,
                               const std::function<bool()>& stop) {
  return Planter(problem, layout, name_left_out, stop).Plant();
}

}  // namespace plenum::optimizer
