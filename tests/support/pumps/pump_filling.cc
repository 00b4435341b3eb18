#include "tests/support/pumps/pump_filling.h"

#include <algorithm>
#include <cmath>

namespace plenum::test {
namespace {

class Filling {
 public:
  explicit Filling(const PumpFilling& filling)
      : in_(filling),
        density_(kReferenceDensity * std::sqrt(kReferenceK / filling.temperature_k)),
        gas_constant_(kGasConstant * filling.temperature_k) {}

  double Mass(std::size_t g, double p) const {
    return p * in_.groups[g].volume_m3(p) / gas_constant_;
  }
  double Pressure(std::size_t g, double mass) const {
    return Bisect(
        0.5 * in_.ambient_pa, 2.0 * in_.highest_pa, [&](double p) { return mass - Mass(g, p); },
        1e-9);
  }

  // kg/s into one chamber of the group.
  double Flow(std::size_t g, double node_pa, double p) const {
    return node_pa > p ? ChainFlow(in_.groups[g].fill, node_pa, p, density_, in_.linear_ratio)
                       : 0.0;
  }

  // Where all pumps deliver what the open lines take. `pressures` of closed groups are above all.
  double Node(const std::vector<double>& pressures) const {
    const double lowest_pa = *std::min_element(pressures.begin(), pressures.end());
    return Bisect(
        lowest_pa, in_.highest_pa,
        [&](double node_pa) {
          double surplus = kReferenceDensity * in_.delivery_m3_per_s(node_pa);
          for (std::size_t g = 0; g < pressures.size(); ++g)
            surplus -= in_.groups[g].count * Flow(g, node_pa, pressures[g]);
          return surplus;
        },
        1e-10);
  }

  // One group: dt/dm = 1/ṁ by Simpson's rule over even steps of mass.
  PumpFilled Alone(int steps) const {
    const double first = Mass(0, in_.ambient_pa), last = Mass(0, in_.groups[0].close_pa);
    const auto at = [&](double mass, double& joules_per_kg) {
      const double p = Pressure(0, mass);
      const double node_pa = Node({p});
      const double seconds_per_kg = 1.0 / Flow(0, node_pa, p);
      joules_per_kg = seconds_per_kg * in_.power_w(node_pa);
      return seconds_per_kg;
    };
    PumpFilled filled{{0.0}, 0.0, Node({in_.groups[0].close_pa})};
    const double width = (last - first) / steps;
    for (int i = 0; i < steps; ++i) {
      double from_j = 0.0, middle_j = 0.0, to_j = 0.0;
      const double from = at(first + i * width, from_j);
      const double middle = at(first + (i + 0.5) * width, middle_j);
      const double to = at(first + (i + 1) * width, to_j);
      filled.seconds[0] += width / 6.0 * (from + 4.0 * middle + to);
      filled.energy_j += width / 6.0 * (from_j + 4.0 * middle_j + to_j);
    }
    return filled;
  }

  PumpFilled Together(int steps) const {
    const std::size_t groups = in_.groups.size();
    std::vector<double> mass(groups), full(groups), rate(groups);
    PumpFilled filled{std::vector<double>(groups, 0.0), 0.0, 0.0};
    double total = 0.0;
    for (std::size_t g = 0; g < groups; ++g) {
      mass[g] = Mass(g, in_.ambient_pa);
      full[g] = Mass(g, in_.groups[g].close_pa);
      total += in_.groups[g].count * (full[g] - mass[g]);
    }
    const double step_s =
        total / (kReferenceDensity * in_.delivery_m3_per_s(in_.ambient_pa)) / steps;
    std::vector<bool> closed(groups, false);
    double now_s = 0.0;
    const auto rates = [&](const std::vector<double>& masses, std::vector<double>& slope) {
      std::vector<double> pressures(groups, 1e12);
      for (std::size_t g = 0; g < groups; ++g)
        if (!closed[g]) pressures[g] = Pressure(g, masses[g]);
      const double node_pa = filled.node_end_pa = Node(pressures);
      for (std::size_t g = 0; g < groups; ++g)
        slope[g] = closed[g] ? 0.0 : Flow(g, node_pa, pressures[g]);
      return in_.power_w(node_pa);
    };
    // Masses after a step, and the energy of it.
    const auto stepped = [&](double width_s, double& energy_j) {
      std::vector<double> k1(groups), k2(groups), k3(groups), k4(groups), at(groups);
      const auto move = [&](const std::vector<double>& slope, double share) {
        for (std::size_t g = 0; g < groups; ++g) at[g] = mass[g] + share * width_s * slope[g];
      };
      const double e1 = rates(mass, k1);
      move(k1, 0.5);
      const double e2 = rates(at, k2);
      move(k2, 0.5);
      const double e3 = rates(at, k3);
      move(k3, 1.0);
      const double e4 = rates(at, k4);
      for (std::size_t g = 0; g < groups; ++g)
        at[g] = mass[g] + width_s / 6.0 * (k1[g] + 2.0 * k2[g] + 2.0 * k3[g] + k4[g]);
      energy_j = width_s / 6.0 * (e1 + 2.0 * e2 + 2.0 * e3 + e4);
      return at;
    };
    while (std::find(closed.begin(), closed.end(), false) != closed.end()) {
      double width_s = step_s, energy_j = 0.0;
      std::vector<double> after = stepped(width_s, energy_j);
      std::size_t first = groups;
      for (std::size_t g = 0; g < groups; ++g) {
        if (closed[g] || after[g] < full[g]) continue;
        width_s = Bisect(
            0.0, width_s,
            [&](double s) {
              double unused = 0.0;
              return full[g] - stepped(s, unused)[g];
            },
            1e-13);
        after = stepped(width_s, energy_j);
        first = g;
      }
      now_s += width_s;
      filled.energy_j += energy_j;
      mass = after;
      if (first == groups) continue;
      for (std::size_t g = 0; g < groups; ++g)
        if (!closed[g] && mass[g] >= full[g] * (1.0 - 1e-12)) {
          closed[g] = true;
          filled.seconds[g] = now_s;
        }
    }
    return filled;
  }

 private:
  const PumpFilling& in_;
  double density_, gas_constant_;
};

}  // namespace

PumpFilled FillByMasses(const PumpFilling& filling, int steps) {
  return filling.groups.size() == 1 ? Filling(filling).Alone(steps)
                                    : Filling(filling).Together(steps);
}

}  // namespace plenum::test
