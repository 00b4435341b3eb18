#include "model/closed_form.h"

#include <array>

#include "bench/method.h"
#include "model/stroke.h"

namespace plenum::bench {
namespace {

double ClosedForm(const RiseRig& rig, double) {
  const double per_ambient = 1.0 / rig.ambient_pa;
  const double tau = model::NormalisedRiseTime(
      {rig.operating_pa * per_ambient, rig.expansion_ratio, rig.critical_ratio},
      rig.source_pa * per_ambient, 1.0, rig.TargetPa() * per_ambient);
  return tau * rig.rest_volume_m3 / (rig.conductance_m3_per_s_pa * model::kReferencePressurePa);
}

double Quadrature(const RiseRig& rig, double) {
  const std::array line = {model::FlowElement{rig.conductance_m3_per_s_pa, rig.critical_ratio}};
  model::Chamber chamber;
  chamber.rest_volume_m3 = rig.rest_volume_m3;
  chamber.expansion_ratio = rig.expansion_ratio;
  chamber.operating_pressure_pa = rig.operating_pa;
  chamber.ambient_pressure_pa = rig.ambient_pa;
  return model::FillTime(model::MakeSeries(line), chamber, rig.source_pa, rig.ambient_pa,
                         rig.TargetPa());
}

}  // namespace

std::vector<Method> ClosedForms() {
  return {OneByOne("plenum closed form", false, ClosedForm),
          OneByOne("plenum quadrature", false, Quadrature)};
}

}  // namespace plenum::bench
