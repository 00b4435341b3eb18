#include "tests/support/mass_form.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace plenum::test {
namespace {

using State = std::vector<double>;  // kg: actuators, reservoir, delivered, vented

class Simulator {
 public:
  explicit Simulator(const MassRig& rig)
      : rig_(rig), n_(rig.groups.size()), direction_(n_, 0), next_(n_, 0) {
    factor_ = kReferenceDensity * rig.gas_factor * std::sqrt(kReferenceK / rig.temperature_k);
  }

  MassResult Run(double end_s, double step_s, double sample_s);

 private:
  double Temperature() const { return kGasConstant * rig_.temperature_k; }

  double LineFlow(const std::vector<MassElement>& line, double upstream, double downstream) const {
    return ChainFlow(line, upstream, downstream, factor_, rig_.linear_ratio);
  }

  double Pressure(std::size_t i, double mass) const {
    const MassGroup& g = rig_.groups[i];
    const double content = mass * Temperature();
    // p·V(p) rises with p and V does not fall: Newton's method with a difference, then checked.
    double p = content / g.volume_m3(g.operating_pa);
    for (int k = 0; k < 60; ++k) {
      const double h = 1e-4 * p;
      const double value = p * g.volume_m3(p) - content;
      const double slope =
          ((p + h) * g.volume_m3(p + h) - (p - h) * g.volume_m3(p - h)) / (2.0 * h);
      const double next = std::max(0.1 * p, p - value / slope);
      const bool done = std::abs(next - p) < 1e-13 * p;
      p = next;
      if (done) break;
    }
    return p;
  }

  double SourcePressure(const State& m) const {
    return rig_.source == MassRig::Source::kReservoir ? m[n_] * Temperature() / rig_.reservoir_m3
                                                      : rig_.source_pa;
  }

  double PumpFlow(double pressure) const {
    const auto& table = rig_.delivery;
    if (table.empty() || pressure > table.back().first) return 0.0;
    auto upper = std::lower_bound(table.begin(), table.end(), pressure,
                                  [](const auto& row, double p) { return row.first < p; });
    double flow = upper->second;
    if (upper != table.begin()) {
      const auto lower = upper - 1;
      flow = lower->second + (upper->second - lower->second) * (pressure - lower->first) /
                                 (upper->first - lower->first);
    }
    return kReferenceDensity * flow;
  }

  double NodePressure(double source, const State& pressure) const {
    double lowest = source;
    for (std::size_t i = 0; i < n_; ++i) {
      if (direction_[i] > 0) lowest = std::min(lowest, pressure[i]);
    }
    const auto surplus = [&](double node) {
      double flow = kReferenceDensity * rig_.flow_max_m3_per_s;
      if (!rig_.regulator.empty()) flow = std::min(flow, LineFlow(rig_.regulator, source, node));
      for (std::size_t i = 0; i < n_; ++i) {
        if (direction_[i] <= 0) continue;
        flow -= rig_.groups[i].count * LineFlow(rig_.groups[i].fill, node, pressure[i]);
      }
      return flow;
    };
    if (surplus(source) >= 0.0) return source;
    return Bisect(lowest, source, surplus, 1e-9 * source);
  }

  State Slope(const State& m) const {
    State pressure(n_), slope(m.size(), 0.0);
    for (std::size_t i = 0; i < n_; ++i) pressure[i] = Pressure(i, m[i]);
    const double source = SourcePressure(m);
    double node = source;
    if (!rig_.regulator.empty() || std::isfinite(rig_.flow_max_m3_per_s)) {
      node = NodePressure(source, pressure);
    }
    double draw = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      const MassGroup& g = rig_.groups[i];
      if (direction_[i] > 0 && rig_.source != MassRig::Source::kNone) {
        slope[i] = LineFlow(g.fill, node, pressure[i]);
        draw += g.count * slope[i];
      } else if (direction_[i] < 0) {
        slope[i] = -LineFlow(g.exhaust, pressure[i], rig_.ambient_pa);
        slope[n_ + 2] -= g.count * slope[i];
      }
    }
    if (rig_.source == MassRig::Source::kReservoir) {
      slope[n_ + 1] = pumping_ ? PumpFlow(std::min(source, PumpLimit())) : 0.0;
      if (holding_) slope[n_ + 1] = draw;
      slope[n_] = slope[n_ + 1] - draw;
    } else {
      slope[n_ + 1] = draw;
    }
    return slope;
  }

  double PumpLimit() const {
    return rig_.delivery.empty() ? -1.0 : std::min(rig_.stop_pa, rig_.delivery.back().first);
  }

  // The pumps' state at the start of a step; at the limit it depends on what the lines draw.
  void Switch(const State& m) {
    pumping_ = holding_ = false;
    for (std::size_t i = 0; i < n_; ++i) {
      const MassGroup& g = rig_.groups[i];
      if (direction_[i] > 0 && g.close_at_operating &&
          Pressure(i, m[i]) >= g.operating_pa * (1.0 - 1e-11)) {
        direction_[i] = 0;
      }
    }
    if (rig_.source != MassRig::Source::kReservoir) return;
    const double off_limit = SourcePressure(m) / PumpLimit() - 1.0;
    pumping_ = PumpLimit() > 0.0 && off_limit < -1e-11;
    if (PumpLimit() > 0.0 && std::abs(off_limit) <= 1e-11) {
      const double draw = -Slope(m)[n_];
      holding_ = draw <= PumpFlow(PumpLimit());
      pumping_ = !holding_;
    }
  }

  // Whether something that Switch() looks at has been passed between two states.
  bool Passed(const State& before, const State& after) const {
    for (std::size_t i = 0; i < n_; ++i) {
      const MassGroup& g = rig_.groups[i];
      if (direction_[i] > 0 && g.close_at_operating && Pressure(i, after[i]) >= g.operating_pa) {
        return true;
      }
    }
    if (rig_.source != MassRig::Source::kReservoir || PumpLimit() < 0.0 || holding_) return false;
    const double first = SourcePressure(before) / PumpLimit() - 1.0;
    const double last = SourcePressure(after) / PumpLimit() - 1.0;
    return pumping_ ? last >= 0.0 && first < -1e-11 : last <= 0.0 && first > 1e-11;
  }

  State RungeKutta(const State& m, double h) const {
    const auto at = [&](const State& k, double share) {
      State y = m;
      for (std::size_t i = 0; i < y.size(); ++i) y[i] += share * h * k[i];
      return y;
    };
    const State k1 = Slope(m), k2 = Slope(at(k1, 0.5)), k3 = Slope(at(k2, 0.5));
    const State k4 = Slope(at(k3, 1.0));
    State y = m;
    for (std::size_t i = 0; i < y.size(); ++i) {
      y[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
    }
    return y;
  }

  // Advances from t to `to_s`, cutting steps at whatever switches on the way.
  void Advance(State& m, double t_s, double to_s, double step_s) {
    while (t_s < to_s) {
      Switch(m);
      double h = std::min(step_s, to_s - t_s);
      State next = RungeKutta(m, h);
      if (Passed(m, next)) {
        double low = 0.0, high = h;
        while (high - low > 1e-14 * h) {
          const double middle = 0.5 * (low + high);
          (Passed(m, RungeKutta(m, middle)) ? high : low) = middle;
        }
        h = high;
        next = RungeKutta(m, h);
      }
      m = next;
      t_s = h == to_s - t_s ? to_s : t_s + h;
    }
  }

  const MassRig& rig_;
  std::size_t n_;
  double factor_ = 0.0;
  std::vector<int> direction_;
  std::vector<std::size_t> next_;
  bool pumping_ = false, holding_ = false;
};

MassResult Simulator::Run(double end_s, double step_s, double sample_s) {
  State m(n_ + 3, 0.0);
  for (std::size_t i = 0; i < n_; ++i) {
    const MassGroup& g = rig_.groups[i];
    m[i] = g.initial_pa * g.volume_m3(g.initial_pa) / Temperature();
  }
  if (rig_.source == MassRig::Source::kReservoir) {
    m[n_] = rig_.source_pa * rig_.reservoir_m3 / Temperature();
  }
  const auto gas = [&] {
    double sum = m[n_];
    for (std::size_t i = 0; i < n_; ++i) sum += rig_.groups[i].count * m[i];
    return sum;
  };
  MassResult result;
  result.gas_start_kg = gas();
  result.pressure_pa.resize(n_);
  double t_s = 0.0;
  for (std::size_t sample = 0;; ++sample) {
    const double sample_at_s = std::min(end_s, static_cast<double>(sample) * sample_s);
    while (t_s < sample_at_s || sample == 0) {
      double to_s = sample_at_s;
      for (std::size_t i = 0; i < n_; ++i) {
        const auto& schedule = rig_.groups[i].schedule;
        while (next_[i] < schedule.size() && schedule[next_[i]].time_s <= t_s) {
          direction_[i] = schedule[next_[i]++].direction;
        }
        if (next_[i] < schedule.size()) to_s = std::min(to_s, schedule[next_[i]].time_s);
      }
      if (sample == 0) break;
      Advance(m, t_s, to_s, step_s);
      t_s = to_s;
    }
    result.t_s.push_back(sample_at_s);
    for (std::size_t i = 0; i < n_; ++i) result.pressure_pa[i].push_back(Pressure(i, m[i]));
    result.source_pa.push_back(SourcePressure(m));
    if (sample_at_s >= end_s) break;
  }
  result.delivered_kg = m[n_ + 1];
  result.vented_kg = m[n_ + 2];
  result.gas_kg = gas();
  return result;
}

}  // namespace

MassResult SimulateMasses(const MassRig& rig, double end_s, double step_s, double sample_s) {
  return Simulator(rig).Run(end_s, step_s, sample_s);
}

}  // namespace plenum::test
