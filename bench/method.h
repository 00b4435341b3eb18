// What is compared: a way to get the rise times of many rigs at a tolerance.
#ifndef PLENUM_BENCH_METHOD_H_
#define PLENUM_BENCH_METHOD_H_

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/rigs.h"

namespace plenum::bench {

// A method gets all rigs at once, so that a solver may keep its memory from rig to rig and a batch
// kernel may take several rigs together. A rig that fails gets NaN.
struct Method {
  std::string name;
  bool takes_tolerance = true;
  std::function<void(std::span<const RiseRig> rigs, double tolerance, std::span<double> rise_s)>
      run;
};

// The times one by one.
template <class RiseTime>  // (const RiseRig&, double tolerance) → s
Method OneByOne(std::string name, bool takes_tolerance, RiseTime rise_time) {
  return {std::move(name), takes_tolerance,
          [rise_time](std::span<const RiseRig> rigs, double tolerance,
                      std::span<double> rise_s) mutable {
            for (std::size_t i = 0; i < rigs.size(); ++i) {
              rise_s[i] = rise_time(rigs[i], tolerance);
            }
          }};
}

// bench/closed_form.cc: model/strokes/closed_form.h, the same in bench/batch/closed_form_batch.h,
// and the quadrature of model/strokes/stroke.h.
std::vector<Method> ClosedForms();
// bench/simulator.cc: model/simulate/simulate.h and bench/batch/simulate_batch.h.
std::vector<Method> Simulators();
// bench/odeint.cc: Boost.odeint's dopri5, with dense output.
std::vector<Method> OdeintMethods();
// bench/cvode.cc: SUNDIALS CVODE, Adams and BDF, with its root finding.
std::vector<Method> CvodeMethods();

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_METHOD_H_
