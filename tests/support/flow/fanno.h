// Adiabatic flow with friction through a tube: a second opinion on the tube formula.
#ifndef PLENUM_TESTS_SUPPORT_FLOW_FANNO_H_
#define PLENUM_TESTS_SUPPORT_FLOW_FANNO_H_

namespace plenum::test {

struct FannoTube {
  double sonic_conductance_m3_per_s_pa;
  double critical_ratio;  // mean of the b that fit the points at 80, 60, 40 and 20 % flow
  double friction_factor;
  double reynolds_number;
};

// Isentropic entry, then K_in + f·L/d = (1−M²)/(γM²) + (γ+1)/(2γ)·ln[(γ+1)M²/(2+(γ−1)M²)] from the
// inlet to the choking point; f = 64/Re or 0.3164·Re^−¼ at each flow; 20 °C.
FannoTube SolveFanno(double inner_diameter_m, double length_m, double upstream_pa,
                     double entry_loss = 0.5);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_FLOW_FANNO_H_
