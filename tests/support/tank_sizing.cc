#include "tests/support/tank_sizing.h"

#include <algorithm>
#include <cmath>

#include "model/strokes/stroke.h"

namespace plenum::test {
namespace {

using optimizer::Candidate;
using optimizer::Problem;

constexpr double kAirJPerKgK = 287.05;
constexpr double kJoulePerWattHour = 3600.0;

class Sizing {
 public:
  Sizing(const Problem& problem, const Candidate& candidate)
      : problem_(problem),
        candidate_(candidate),
        group_(problem.groups[0]),
        line_(*candidate.lines[0]),
        temperature_k_(problem.ambient.temperature_k) {
    const model::Reservoir& tank = problem.parts.tanks[candidate.bottle.index];
    tank_m3_ = candidate.bottle.quantity * tank.volume_m3;
    most_pa_ = std::min(tank.pressure_max_pa, problem.tank_fill_max_pa);
    std::vector<model::FlowElement> elements = line_.fill;
    if (candidate.regulator.index >= 0) {
      regulator_ = &problem.parts.regulators[candidate.regulator.index];
      most_pa_ = std::min(most_pa_, regulator_->inlet_pressure_max_pa);
      elements.insert(elements.begin(), regulator_->flow);
      elements.front().sonic_conductance_m3_per_s_pa /= group_.count;
    }
    fill_ = model::MakeSeries(elements, std::sqrt(293.15 / temperature_k_));
  }

  optimizer::Leaf Run() {
    optimizer::Leaf leaf;
    leaf.status = optimizer::LeafStatus::kInfeasible;
    const double vent_s = (1.0 - group_.gait.inflate_fraction) * StrokeSeconds();
    if (line_.fall_time_s > std::min(vent_s, group_.fall_time_max_s)) return leaf;
    if (!regulator_ && !line_.holds) return leaf;
    double low_pa = group_.chamber.operating_pressure_pa;
    double high_pa = std::min(line_.source_max_pa, problem_.source_pressure_max_pa);
    if (regulator_) {
      low_pa = std::max(low_pa, regulator_->outlet_pressure_min_pa);
      high_pa = std::min(high_pa, regulator_->outlet_pressure_max_pa);
    } else {
      // The pressure that is kept, and what all strokes take from above it.
      low_pa = std::max(low_pa, problem_.parts.valves[line_.valve].pressure_min_pa) +
               Strokes() * Fall(StrokeContent(group_.chamber.operating_pressure_pa));
      high_pa = std::min(high_pa, most_pa_);
    }
    if (low_pa > high_pa || !InTime(high_pa)) return leaf;
    for (int i = 0; i < 60 && !InTime(low_pa); ++i) {
      const double middle_pa = 0.5 * (low_pa + high_pa);
      (InTime(middle_pa) ? high_pa : low_pa) = middle_pa;
    }
    const double source_pa = InTime(low_pa) ? low_pa : high_pa;
    return At(source_pa);
  }

 private:
  // Of the mission, and from one to the next.
  double Strokes() const { return problem_.actuations * group_.gait.strokes_per_period; }
  double StrokeSeconds() const {
    return 1.0 / (problem_.frequency_hz * group_.gait.strokes_per_period);
  }
  double OpenSeconds() const { return group_.gait.inflate_fraction * StrokeSeconds(); }
  // p·V of one actuator and its tube.
  double Content(double p) const {
    const model::Chamber& c = line_.chamber;
    const double x =
        (p - c.ambient_pressure_pa) / (c.operating_pressure_pa - c.ambient_pressure_pa);
    return p * (c.rest_volume_m3 * (1.0 + (c.expansion_ratio - 1.0) * x) + c.dead_volume_m3);
  }
  double StrokeContent(double filled_pa) const {
    return group_.count * (Content(filled_pa) - Content(problem_.ambient.pressure_pa));
  }
  double Fall(double content) const { return content / tank_m3_; }

  // Out of the tank as the last stroke finds it, or the regulator.
  double Seconds(double source_pa, double to_pa) const {
    const double ambient_pa = problem_.ambient.pressure_pa;
    if (regulator_)
      return model::FillTime(fill_, line_.chamber, source_pa, ambient_pa, to_pa, temperature_k_,
                             regulator_->flow_max_m3_per_s / group_.count);
    const double last_pa =
        source_pa - (Strokes() - 1.0) * Fall(StrokeContent(group_.chamber.operating_pressure_pa));
    return model::FillTimeFromReservoir(fill_, line_.chamber, group_.count, tank_m3_, last_pa,
                                        ambient_pa, to_pa, temperature_k_);
  }

  bool InTime(double source_pa) const {
    const double ambient_pa = problem_.ambient.pressure_pa;
    const double operating_pa = group_.chamber.operating_pressure_pa;
    return Seconds(source_pa, operating_pa) <= OpenSeconds() &&
           Seconds(source_pa, ambient_pa + problem_.rise_fraction * (operating_pa - ambient_pa)) <=
               group_.rise_time_max_s;
  }

  // A valve that cannot hold fills for the whole window.
  double FilledPa(double source_pa) const {
    double low_pa = group_.chamber.operating_pressure_pa, high_pa = source_pa;
    if (line_.holds) return low_pa;
    if (Seconds(source_pa, high_pa) <= OpenSeconds()) return high_pa;
    for (int i = 0; i < 60; ++i) {
      const double middle_pa = 0.5 * (low_pa + high_pa);
      (Seconds(source_pa, middle_pa) <= OpenSeconds() ? low_pa : high_pa) = middle_pa;
    }
    return low_pa;
  }

  optimizer::Leaf At(double source_pa) const {
    optimizer::Leaf leaf;
    leaf.status = optimizer::LeafStatus::kInfeasible;
    double fill_pa = source_pa;
    if (regulator_)
      fill_pa = std::max(source_pa, regulator_->inlet_pressure_min_pa) +
                Strokes() * Fall(StrokeContent(FilledPa(source_pa)));
    const double vent_s = StrokeSeconds() - OpenSeconds();
    const double inflate_s = Seconds(source_pa, group_.chamber.operating_pressure_pa);
    double power_w = line_.coil_power_w;
    double per_cycle_j = power_w * group_.gait.strokes_per_period *
                         (line_.holds ? vent_s + inflate_s : OpenSeconds());
    if (regulator_) {
      power_w += regulator_->electrical_power_w;
      per_cycle_j += regulator_->electrical_power_w / problem_.frequency_hz;
    }
    const model::Battery& pack = problem_.parts.batteries[candidate_.battery.index];
    const double packs = candidate_.battery.quantity;
    optimizer::Amounts sum = line_.amounts;
    for (const optimizer::Option* option :
         {&candidate_.regulator, &candidate_.bottle, &candidate_.battery})
      sum += option->amounts;
    sum.mass_kg += tank_m3_ * (fill_pa - group_.chamber.operating_pressure_pa) /
                   (kAirJPerKgK * temperature_k_);
    const bool bears =
        fill_pa <= most_pa_ &&
        per_cycle_j * problem_.actuations <=
            packs * pack.capacity_ah * kJoulePerWattHour * pack.nominal_voltage_v * 0.8 &&
        power_w / pack.nominal_voltage_v <= packs * pack.current_max_a &&
        sum.mass_kg <= problem_.mass_max_kg && sum.volume_m3 * 1e3 <= problem_.volume_max_l &&
        sum.cost_eur <= problem_.cost_max_eur;
    if (!bears) return leaf;
    leaf.status = optimizer::LeafStatus::kFeasible;
    leaf.point = {source_pa, tank_m3_, tank_m3_, fill_pa};
    leaf.objective = leaf.lower_bound = problem_.objective.mass_kg * sum.mass_kg +
                                        problem_.objective.volume_l * sum.volume_m3 * 1e3 +
                                        problem_.objective.cost_eur * sum.cost_eur;
    return leaf;
  }

  const Problem& problem_;
  const Candidate& candidate_;
  const optimizer::ActuatorGroup& group_;
  const optimizer::Line& line_;
  double temperature_k_;
  const model::Regulator* regulator_ = nullptr;
  model::Series fill_;
  double tank_m3_ = 0.0, most_pa_ = 0.0;
};

}  // namespace

bool CanSizeTank(const Problem& problem, const Candidate& candidate) {
  return candidate.configuration == optimizer::Configuration::kTank && problem.groups.size() == 1 &&
         problem.groups[0].gait.phases.size() <= 1 && problem.objective.energy_wh == 0.0;
}

optimizer::Leaf SizeTank(const Problem& problem, const Candidate& candidate) {
  return Sizing(problem, candidate).Run();
}

}  // namespace plenum::test
