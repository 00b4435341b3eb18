// Several chambers in a row or side by side behind one valve, for comparison: shares no code with
// the model.
//
// States are masses of gas (kg). Of a linear volume law the pressure follows from m = p·V(p)/(R·T)
// by the quadratic's closed form; flow is the ISO 6358 mass flow through chains of elements, and
// time goes in fixed small steps of classical Runge–Kutta. Isothermal.
#ifndef PLENUM_TESTS_SUPPORT_CHAMBERS_CHAMBER_NET_H_
#define PLENUM_TESTS_SUPPORT_CHAMBERS_CHAMBER_NET_H_

#include <cstddef>
#include <optional>
#include <vector>

#include "tests/support/flow/iso_chain.h"

namespace plenum::test {

struct NetChamber {
  double rest_m3 = 50e-6, ratio = 1.0;
  double operating_pa = 2e5;  // below ambient: it shrinks as it is evacuated
  double initial_pa = 1e5;
  std::optional<std::size_t> from = std::nullopt;  // none: the valve
  std::vector<MassElement> way = {}, back = {};    // from there and back, in the order crossed
  MassElement leak = {};                           // to the surroundings; conductance 0: tight
};

struct NetCommand {
  double time_s = 0.0;
  int direction = 0;  // +1: the source, 0: closed, −1: the surroundings
};

struct ChamberNet {
  double ambient_pa = 1e5, temperature_k = 293.15;
  double source_pa = 3e5;                  // below ambient: what is evacuated to
  std::vector<MassElement> fill, exhaust;  // of gas that enters (leaves) the first chamber
  std::vector<NetCommand> schedule;
  std::vector<NetChamber> chambers;  // the valve leads to the first
};

struct NetResult {
  std::vector<std::vector<double>> pressure_pa;    // by chamber, at the times asked for
  std::vector<double> gas_kg;                      // in all chambers, at these times
  double through_valve_kg = 0.0, leaked_kg = 0.0;  // in, out, until the last time
};

NetResult SimulateNet(const ChamberNet& net, const std::vector<double>& t_s, double step_s);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_CHAMBERS_CHAMBER_NET_H_
