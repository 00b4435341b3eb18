// What passes between actuators that are linked: always open lines, from the actuator with the
// higher pressure into the other, by the flow law of lines (flow/simulate_line.h) with the
// temperature of the gas that enters them.
#ifndef PLENUM_MODEL_SIMULATE_LINKED_PASSAGES_H_
#define PLENUM_MODEL_SIMULATE_LINKED_PASSAGES_H_

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "model/effects/unit.h"
#include "model/flow/simulate_line.h"
#include "model/simulate/simulate_rig.h"

namespace plenum::model {

template <class T>
class Passages {
 public:
  Passages() = default;
  // `factor` on what the lines conduct.
  Passages(std::span<const Link> links, const T& factor, const LineOptions& options,
           const Lift& lift) {
    for (const Link& link : links)
      passages_.push_back({link.from, link.to, Line<T>(Lifted<T>(link.fill, factor, lift), options),
                           Line<T>(Lifted<T>(link.back, factor, lift), options)});
  }

  // Adds to the moments of the groups, `groups[i].moment`, what passes between them.
  template <class Groups>
  void Pass(const T& ambient_k, Groups& groups) const {
    using std::sqrt;
    for (const Passage& passage : passages_) {
      Moment<T>*up = &groups[passage.from].moment, *down = &groups[passage.to].moment;
      const bool forward = up->pressure_pa >= down->pressure_pa;
      if (!forward) std::swap(up, down);
      T flow = (forward ? passage.fill : passage.back).Flow(up->pressure_pa, down->pressure_pa);
      flow *= sqrt(ambient_k / up->temperature_k);
      up->passed.out_m3_per_s += flow;
      down->passed.in_m3_per_s += flow;
      down->passed.heat_w += kContentPerKelvin * up->temperature_k * flow;
    }
  }

 private:
  struct Passage {
    std::size_t from, to;  // groups
    Line<T> fill, back;
  };
  std::vector<Passage> passages_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_LINKED_PASSAGES_H_
