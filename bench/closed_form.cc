#include "model/strokes/closed_form.h"

#include <array>
#include <vector>

#include "bench/batch/closed_form_batch.h"
#include "bench/method.h"
#include "model/strokes/stroke.h"

namespace plenum::bench {
namespace {

double ClosedForm(const RiseRig& rig, double) {
  const double per_ambient = 1.0 / rig.ambient_pa;
  const double tau = model::NormalisedRiseTime(
      {rig.operating_pa * per_ambient, rig.expansion_ratio, rig.critical_ratio},
      rig.source_pa * per_ambient, 1.0, rig.TargetPa() * per_ambient);
  return tau * rig.rest_volume_m3 / (rig.conductance_m3_per_s_pa * model::kReferencePressurePa);
}

// Columns are filled per call, as a search would that has its candidates one by one.
class BatchClosedForm {
 public:
  void operator()(std::span<const RiseRig> rigs, double, std::span<double> rise_s) {
    for (std::vector<double>* column : {&c_, &b_, &v0_, &v1_, &outer_, &from_, &to_}) {
      column->resize(rigs.size());
    }
    for (std::size_t i = 0; i < rigs.size(); ++i) {
      const RiseRig& rig = rigs[i];
      c_[i] = rig.conductance_m3_per_s_pa;
      b_[i] = rig.critical_ratio;
      v1_[i] =
          rig.rest_volume_m3 * (rig.expansion_ratio - 1.0) / (rig.operating_pa - rig.ambient_pa);
      v0_[i] = rig.rest_volume_m3 - v1_[i] * rig.ambient_pa;
      outer_[i] = rig.source_pa;
      from_[i] = rig.ambient_pa;
      to_[i] = rig.TargetPa();
    }
    RiseTimes({c_, b_, v0_, v1_, outer_, from_, to_, {}}, rise_s);
  }

 private:
  std::vector<double> c_, b_, v0_, v1_, outer_, from_, to_;
};

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
          {"plenum closed form, batch", false, BatchClosedForm()},
          OneByOne("plenum quadrature", false, Quadrature)};
}

}  // namespace plenum::bench
