// Derivatives of a simulated response with respect to numbers of the rig, exact along the steps
// that the simulator takes: the whole run, its flow laws, switches and event times included, is
// computed in dual numbers (model/flow/scalar.h), a dozen parameters at a time.
//
// A parameter is the address of a number inside the given rig; DifferentiableNumbers lists all of
// them. Only that number moves, or along a direction several numbers together, by its weights:
//   * ambient.pressure_pa moves the ambient pressure of all groups with it (chamber
//     .ambient_pressure_pa is a copy that must stay equal, so it is no parameter of its own), but
//     no initial pressure, operating pressure or source pressure, which are absolute.
//   * a number that two parts share in life moves as the sum of its derivatives.
//   * a command's time moves that command, and its stroke's times, which count from it.
// A value of the table by which a reservoir's pump delivers may be one, too, though the list leaves
// it out: the table's slopes move with its values.
// Times of events move as the implicit function theorem says: dt/dθ = −(∂g/∂θ)/(dg/dt) for the
// guard g that turned there. Commands that fall together keep their own derivatives.
//
// Where a derivative does not exist or says nothing:
//   * a target never reached: the time is +∞ and its derivative 0.
//   * a pressure that only grazes a level (dg/dt → 0): the derivative grows without bound and is
//     returned as computed; the time itself may jump to +∞ beside it.
//   * a number on the border of two behaviours (a reservoir that starts at the stop pressure, b on
//     a choked ratio at the very start): the derivative of the behaviour taken.
//   * samples at the instant of an event: the derivative of one side.
// The error control sees the values, and of the derivatives only that none grows where a step is
// too long for the explicit method: they are those of the computed solution, and come to the true
// ones with the tolerance. Measured against CVODES, as a share of the largest derivative in the
// run: 1e-5 at a relative tolerance of 1e-11, up to 1e-3 at the default 1e-8 where a leak or creep
// goes on at equal pressures. Stiff rigs go on with a linearly implicit method of order 3
// (model/integrate/rosenbrock.h), whose steps are more for the same tolerance.
#ifndef PLENUM_MODEL_SIMULATE_SENSITIVITY_H_
#define PLENUM_MODEL_SIMULATE_SENSITIVITY_H_

#include <span>
#include <string>
#include <vector>

#include "model/simulate/simulate.h"

namespace plenum::model {

struct RigNumber {
  std::string name;  // e.g. "groups[0].fill[1].critical_ratio", "groups[0].effects[2].delay_s"
  const double* number = nullptr;
};

// ∂/∂θ along a direction is Σ weight·∂/∂number: one parameter of a fit that moves several numbers.
struct WeightedNumber {
  const double* number = nullptr;
  double weight = 1.0;
};
using Direction = std::vector<WeightedNumber>;

// Every number of the rig that may be a parameter, in a fixed order.
std::vector<RigNumber> DifferentiableNumbers(const Rig& rig);

struct SensitivityResponse {
  Response response;
  // One per parameter and of the response's shape: in place of each computed number q stands
  // ∂q/∂θ, in its unit per the parameter's. Counts, names, sample times and status are the
  // response's.
  std::vector<Response> derivatives;
};

// The response and its derivatives along directions; an empty one moves nothing. kInvalid, with the
// direction's place in the list, where an address is no differentiable number of the rig;
// kNotFinite where a derivative is not finite. Integrator::kCvode and kImplicit take the implicit
// method from the start.
SensitivityResponse SimulateAlongDirections(const Rig& rig, const SimulateOptions& options,
                                            std::span<const Direction> directions);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_SENSITIVITY_H_
