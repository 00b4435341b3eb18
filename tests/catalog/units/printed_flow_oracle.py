#!/usr/bin/env python3
"""The sonic conductance of what data sheets print, by another way than plenum's: mass flows in SI
units and bisection. Gives the rows of tests/catalog/units/printed_flow_test.cc."""
import math

R, T0, P0, ATMOSPHERE = 287.05, 293.15, 1e5, 1.013e5
RHO0 = P0 / (R * T0)
GAMMA = 1.4


def mass_flow(conductance, b, p1, p2):
    """ISO 6358: kg/s through C in m3/(s Pa) from p1 to p2, absolute."""
    choked = conductance * RHO0 * p1
    x = p2 / p1
    return choked if x <= b else choked * math.sqrt(1 - ((x - b) / (1 - b)) ** 2)


def of_nominal_flow(litres_per_minute, b, p1_gauge_bar=6.0, p2_gauge_bar=5.0):
    wanted = litres_per_minute / 6e4 * RHO0
    low, high = 0.0, 1e-3
    for _ in range(200):
        middle = 0.5 * (low + high)
        if mass_flow(middle, b, p1_gauge_bar * 1e5 + ATMOSPHERE, p2_gauge_bar * 1e5 + ATMOSPHERE) < wanted:
            low = middle
        else:
            high = middle
    return high * 1e8


def nozzle(area_mm2):
    """An ideal nozzle of that area: isentropic flow to the throat."""
    flux = math.sqrt(GAMMA / (R * T0)) * (2 / (GAMMA + 1)) ** ((GAMMA + 1) / (2 * (GAMMA - 1)))
    return area_mm2 * 1e-6 * flux / RHO0 * 1e8


if __name__ == "__main__":
    for name, flow, b in [("SMC V114", 8.4, .3), ("Festo MHA1", 10, .3), ("Festo MHA1 2/2", 14, .3),
                          ("SMC SYJ300", 92, .3), ("Festo MHA2", 100, .3), ("Festo VUVG-L10", 220, .3),
                          ("SMC SYJ500", 329, .3), ("Festo CPE10", 350, .3), ("Festo VUVG-L14", 560, .3),
                          ("SMC SYJ700", 724, .3), ("Norgren 97", 1300, .3)]:
        print(f'{{"Qn {flow} L/min at 6 to 5 bar", {b}, {of_nominal_flow(flow, b):.6f}}},  // {name}')
    for text, flow, b, p1, p2 in [("Qn 60 L/min at 2 to 1 bar", 60, .2, 2, 1),
                                  ("Qn 60 L/min at 6 to 0 bar", 60, .4, 6, 0),
                                  ("Qn 3.5 scfm at 87 psi to 72.5 psi", 3.5 * 28.316846592, .35,
                                   87 * .06894757293, 72.5 * .06894757293)]:
        print(f'{{"{text}", {b}, {of_nominal_flow(flow, b, p1, p2):.6f}}},')
    print("nozzle of 1 mm2:", nozzle(1.0))
