#include "optimizer/pump_bounds.h"

#include <algorithm>
#include <cmath>

#include "optimizer/evaluate_strokes.h"
#include "optimizer/pump_march.h"
#include "optimizer/root.h"
#include "optimizer/stroke_bound.h"

namespace plenum::optimizer {
namespace {

constexpr int kCells = 1024;
constexpr double kNoDelivery = 1e12;
constexpr double kIntervalRatio = 1.25;
constexpr int kNeedDivisions = 8;        // of its range, for the energy
constexpr double kNeedTolerance = 3e-3;  // of the source pressure; its lower end is used

double ContentPerVolume(const Problem& problem) {
  return model::kReferencePressurePa * problem.ambient.temperature_k /
         model::kReferenceTemperatureK;
}

std::vector<double> EvenCells(double low_pa, double high_pa, int cells) {
  std::vector<double> edges;
  for (int i = 0; i <= cells; ++i) edges.push_back(low_pa + (high_pa - low_pa) * i / cells);
  return edges;
}

// Tables of a pump over cells of pressure, as minorants: delivery falls with pressure, so that a
// cell's lower edge has the most; the least power is at an edge or at a point of the table.
struct PumpTables {
  std::vector<double> energy_j_per_m3, seconds_per_m3, current_a;
};

void MakeNonFalling(std::vector<double>& values) {
  for (std::size_t i = values.size() - 1; i-- > 0;) values[i] = std::min(values[i], values[i + 1]);
}

PumpTables MakeTables(const model::CompressorCurve& curve, int pumps,
                      const std::vector<double>& edges) {
  const model::MonotoneCurve& current = curve.current_a;
  const auto current_at = [&](double pressure_pa) {
    return current.empty() ? 0.0
                           : current(std::clamp(pressure_pa, current.front(), current.back()));
  };
  PumpTables tables;
  for (std::vector<double>* table :
       {&tables.energy_j_per_m3, &tables.seconds_per_m3, &tables.current_a})
    table->reserve(edges.size() - 1);
  std::size_t knot = 0;
  while (knot < current.x().size() && current.x()[knot] <= edges.front()) ++knot;
  double high_a = current_at(edges.front()), largest_a = high_a;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    tables.current_a.push_back(pumps * largest_a);
    const double low_a = high_a;
    high_a = current_at(edges[i + 1]);
    double least_a = std::min(low_a, high_a);
    for (; knot < current.x().size() && current.x()[knot] < edges[i + 1]; ++knot) {
      least_a = std::min(least_a, current.y()[knot]);
      largest_a = std::max(largest_a, current.y()[knot]);
    }
    largest_a = std::max(largest_a, high_a);
    // Past the last delivery nothing can be pumped; a large number keeps integrals finite.
    const double delivery = model::FreeAirDelivery(curve, edges[i]);
    const double power_w = curve.voltage_v * least_a;
    tables.energy_j_per_m3.push_back(delivery > 0.0 ? power_w / delivery : kNoDelivery);
    tables.seconds_per_m3.push_back(delivery > 0.0 ? 1.0 / (pumps * delivery) : kNoDelivery);
  }
  MakeNonFalling(tables.energy_j_per_m3);
  MakeNonFalling(tables.seconds_per_m3);
  return tables;
}

PumpFacts MakeFacts(const Problem& problem, double highest_pa, PumpTables tables) {
  PumpFacts facts;
  facts.target_pa = kUnlimited;
  double rising_s = 0.0;
  for (const ActuatorGroup& group : problem.groups) {
    facts.target_pa = std::min(facts.target_pa, RiseTarget(problem, group));
    const double rise_s = std::min(group.rise_time_max_s, HalfPeriod(problem));
    rising_s = problem.simultaneous ? std::max(rising_s, rise_s) : rising_s + rise_s;
  }
  facts.early_m3 = rising_s / tables.seconds_per_m3.front();
  const auto minorant = [&](std::vector<double>& values) {
    return Minorant(problem.ambient.pressure_pa, highest_pa, std::move(values));
  };
  facts.energy_j_per_m3 = minorant(tables.energy_j_per_m3);
  facts.seconds_per_m3 = minorant(tables.seconds_per_m3);
  facts.current_a = minorant(tables.current_a);
  return facts;
}

}  // namespace

Minorant::Minorant(double low_pa, double high_pa, std::vector<double> value)
    : low_pa_(low_pa),
      cells_per_pa_(static_cast<double>(value.size()) / (high_pa - low_pa)),
      last_(static_cast<double>(value.size() - 1)),
      value_(std::move(value)),
      integral_(value_.size(), 0.0) {
  for (std::size_t i = 0; i + 1 < value_.size(); ++i)
    integral_[i + 1] = integral_[i] + value_[i] / cells_per_pa_;
}

double Minorant::Integral(double pressure_pa) const {
  const std::size_t cell = Cell(pressure_pa);
  return integral_[cell] +
         value_[cell] * (pressure_pa - low_pa_ - static_cast<double>(cell) / cells_per_pa_);
}

double Minorant::Mean(double low_pa, double high_pa) const {
  constexpr double kNarrow = 1e-6;  // where the difference of integrals would lose digits
  if (!(high_pa - low_pa > kNarrow * high_pa)) return At(low_pa);
  return (Integral(high_pa) - Integral(low_pa)) / (high_pa - low_pa);
}

PumpFacts MakePumpFacts(const Problem& problem, const model::CompressorCurve& curve, int pumps) {
  const double ambient_pa = problem.ambient.pressure_pa;
  const double highest_pa = std::max(model::HighestPressure(curve), 1.01 * ambient_pa);
  PumpFacts facts = MakeFacts(problem, highest_pa,
                              MakeTables(curve, pumps, EvenCells(ambient_pa, highest_pa, kCells)));
  facts.exact = true;
  return facts;
}

double HighestPumpPressure(const Problem& problem) {
  double highest_pa = problem.ambient.pressure_pa * 1.01;
  for (const model::Compressor& compressor : problem.parts.compressors)
    highest_pa = std::max(highest_pa, model::HighestPressure(compressor.curve));
  return std::clamp(problem.source_pressure_max_pa, 1.01 * problem.ambient.pressure_pa, highest_pa);
}

CoarsePump MakeCoarsePump(const Problem& problem, double highest_pa,
                          const model::CompressorCurve& curve) {
  const PumpTables tables =
      MakeTables(curve, 1, EvenCells(problem.ambient.pressure_pa, highest_pa, kCoarseCells));
  CoarsePump coarse;
  std::copy_n(tables.energy_j_per_m3.begin(), kCoarseCells, coarse.energy_j_per_m3.begin());
  std::copy_n(tables.seconds_per_m3.begin(), kCoarseCells, coarse.seconds_per_m3.begin());
  std::copy_n(tables.current_a.begin(), kCoarseCells, coarse.current_a.begin());
  return coarse;
}

CoarsePump Several(CoarsePump one, int pumps) {
  for (double& seconds : one.seconds_per_m3) seconds /= pumps;
  for (double& current : one.current_a) current *= pumps;
  return one;
}

PumpFacts MakePumpFacts(const Problem& problem, double highest_pa, const CoarsePump& coarse) {
  const auto table = [](const std::array<double, kCoarseCells>& values) {
    return std::vector<double>(values.begin(), values.end());
  };
  return MakeFacts(
      problem, highest_pa,
      {table(coarse.energy_j_per_m3), table(coarse.seconds_per_m3), table(coarse.current_a)});
}

double MostDrawn(const Problem& problem, int group, const Line& line, double pressure_pa,
                 double full_pa) {
  const double p = std::min(pressure_pa, full_pa);
  const double ambient_pa = problem.ambient.pressure_pa;
  return problem.groups[group].count *
         (model::Content(line.chamber, p) - model::Content(line.chamber, ambient_pa) +
          line.dead_volume_spread_m3 * (p - ambient_pa));
}

namespace {

// Air that the pumps deliver at pressures in between or above, the more of it the higher.
struct PumpedAir {
  double from_pa, to_pa, air_m3;

  // No more than `air_m3` of it, the first.
  PumpedAir First(double most_m3) const {
    if (!(most_m3 < air_m3)) return *this;
    return {from_pa, from_pa + (to_pa - from_pa) * most_m3 / air_m3, most_m3};
  }
  double On(const Minorant& per_m3) const { return air_m3 * per_m3.Mean(from_pa, to_pa); }
};

// What the first bits take that make up the air of a cycle.
class NeedOfBits {
 public:
  NeedOfBits(const PumpFacts& facts, double air_m3)
      : facts_(facts), enough_m3_(1e-9 * air_m3), left_m3_(air_m3) {}

  bool enough() const { return left_m3_ <= enough_m3_; }
  const PumpNeed& need() const { return need_; }

  void Add(const PumpedAir& bit) {
    const PumpedAir first = bit.First(left_m3_);
    need_.on_s += first.On(facts_.seconds_per_m3);
    need_.energy_j += first.On(facts_.energy_j_per_m3);
    left_m3_ -= first.air_m3;
  }

 private:
  const PumpFacts& facts_;
  double enough_m3_, left_m3_;
  PumpNeed need_;
};

// Air that is pumped while a group's chambers fill, at least, handed to step(from, to, m³ ANR) as
// by MarchPump. With m pumped and D drawn, as content,
//   dD/dm = n·q(s, p(D))/Q(s),  s = p_1 − (D − m)/V ≤ p_1,
// does not fall with m nor rise with D, so that a curve D(m) that everywhere is at least as steep
// as that lies above the true one: panel by panel of D the slope is taken where the panel begins in
// D and ends in m. More flow, a wider tube and a larger volume only make it steeper. The reservoir
// then is no lower than with that D and the smallest volume.
template <typename Step>
double MarchDraw(const Problem& problem, int g, const Line& line, const PumpFacts& facts,
                 double start_pa, double low_m3, double high_m3, const Step& step) {
  constexpr int kPanels = 16;
  const ActuatorGroup& group = problem.groups[g];
  const double ambient_pa = problem.ambient.pressure_pa;
  const double operating_pa = group.chamber.operating_pressure_pa;
  const double content_per_m3 = ContentPerVolume(problem);
  double p = ambient_pa, drawn = 0.0, pumped = 0.0;
  for (int i = 1; i <= kPanels; ++i) {
    // Closer to each other towards the end, where the flow drops fastest.
    const double rest = 1.0 - static_cast<double>(i) / kPanels;
    const double next_pa = operating_pa - (operating_pa - ambient_pa) * rest * std::sqrt(rest);
    const double next = MostDrawn(problem, g, line, next_pa, operating_pa);
    const auto pumped_by = [&](double most) {
      const double s = std::min(start_pa, start_pa - (drawn - most) / high_m3);
      const double flow = group.count * s * line.fill_table(p / s);
      return flow > 0.0 ? pumped + (next - drawn) / (flow * facts.seconds_per_m3.AtMost(s)) : most;
    };
    const double reached = std::min(pumped_by(std::min(pumped_by(pumped), next)), next);
    if (reached > pumped) {
      const auto reservoir_pa = [&](double m) {
        return std::max(ambient_pa, start_pa - (next - m) / low_m3);
      };
      step(reservoir_pa(pumped), reservoir_pa(reached), (reached - pumped) / content_per_m3);
      pumped = reached;
    }
    drawn = next;
    p = next_pa;
  }
  return pumped / content_per_m3;
}

}  // namespace

std::optional<PumpNeed> LeastPumpNeed(const Problem& problem, const PumpFacts& facts,
                                      const PumpLoad& load, const std::vector<double>& start_pa,
                                      double low_m3, double high_m3) {
  const bool apart = start_pa.size() == problem.groups.size();  // one group in each phase
  const double phase_s = 1.0 / problem.frequency_hz / static_cast<double>(start_pa.size());
  const double drawn_at_once = load.air_m3 * ContentPerVolume(problem);
  // Calls take(bit) for what a phase gives, until it returns false.
  const auto march = [&](int phase, const auto& take) {
    const Line& line = *load.lines[phase];
    const double full_pa = !apart          ? problem.ambient.pressure_pa
                           : line.all_hold ? problem.groups[phase].chamber.operating_pressure_pa
                                           : kUnlimited;
    const double ambient_pa = problem.ambient.pressure_pa;
    const double empty = model::Content(line.chamber, ambient_pa);
    const double spread_m3 = line.dead_volume_spread_m3;
    const int count = problem.groups[phase].count;
    const auto drawn = [&](double pressure_pa) {  // as MostDrawn
      const double p = std::min(pressure_pa, full_pa);
      return apart
                 ? count * (model::Content(line.chamber, p) - empty + spread_m3 * (p - ambient_pa))
                 : drawn_at_once;
    };
    // A volume that follows a table may take more air at the lower pressures of a bit.
    const bool even = line.chamber.volume_curve.empty();
    double left_s = phase_s;
    const auto add = [&](double from_pa, double to_pa, double air_m3) {
      if (!(left_s > 0.0)) return false;
      const PumpedAir bit{from_pa, to_pa, air_m3};
      // At the speed of its begin, which is the highest, the time may be enough for more.
      const PumpedAir first = bit.First(left_s / facts.seconds_per_m3.At(from_pa));
      left_s -= first.On(facts.seconds_per_m3);
      return take(first) && first.air_m3 == air_m3;
    };
    double begun_m3 = 0.0;
    if (apart && facts.exact)
      begun_m3 = MarchDraw(problem, phase, line, facts, start_pa[phase], low_m3, high_m3, add);
    MarchPump(problem, start_pa[phase], low_m3, full_pa, begun_m3, drawn,
              [&](double from_pa, double to_pa, double air_m3) {
                return add(from_pa, even || from_pa >= full_pa ? to_pa : from_pa, air_m3);
              });
  };

  NeedOfBits sum(facts, load.air_m3);
  if (start_pa.size() == 1) {
    march(0, [&](const PumpedAir& bit) {
      sum.Add(bit);
      return !sum.enough();
    });
  } else {
    std::vector<PumpedAir> bits;
    for (int phase = 0; phase < static_cast<int>(start_pa.size()); ++phase)
      march(phase, [&](const PumpedAir& bit) {
        bits.push_back(bit);
        return true;
      });
    std::stable_sort(bits.begin(), bits.end(),
                     [](const PumpedAir& a, const PumpedAir& b) { return a.from_pa < b.from_pa; });
    for (const PumpedAir& bit : bits) sum.Add(bit);
  }
  if (!sum.enough()) return std::nullopt;
  return sum.need();
}

double LeastFirstFill(const Problem& problem, const PumpFacts& facts, double source_pa,
                      double reservoir_m3) {
  const double ambient_pa = problem.ambient.pressure_pa;
  return reservoir_m3 / ContentPerVolume(problem) * (source_pa - ambient_pa) *
         facts.energy_j_per_m3.Mean(ambient_pa, source_pa);
}

namespace {

// Air that the reservoir must give by the end of the rise times, by (2).
double GivenByReservoir(const Problem& problem, const PumpFacts& facts, double air_to_target_m3) {
  const bool burst = problem.simultaneous || problem.groups.size() == 1;
  return burst ? std::max(0.0, air_to_target_m3 - facts.early_m3) : 0.0;
}

double LeastStopPressure(const Problem& problem, const PumpFacts& facts, double air_to_target_m3,
                         double reservoir_m3) {
  return facts.target_pa + ContentPerVolume(problem) *
                               GivenByReservoir(problem, facts, air_to_target_m3) / reservoir_m3;
}

}  // namespace

double AirToTarget(const Problem& problem, int group, const model::Chamber& chamber) {
  const ActuatorGroup& actuators = problem.groups[group];
  const double content = model::Content(chamber, RiseTarget(problem, actuators)) -
                         model::Content(chamber, problem.ambient.pressure_pa);
  return actuators.count * model::StandardVolume(content, problem.ambient.temperature_k);
}

namespace {

// Highest stop pressure that `bearable` accepts, from one that it accepts up to `high_pa`; a little
// too high rather than too low.
template <typename Bearable>
double MostBearable(ReservoirNeed need, double high_pa, double tolerance, Bearable&& bearable) {
  double low_pa = need.source_pa;
  need.source_pa = high_pa;
  if (bearable(need)) return high_pa;
  while (high_pa - low_pa > tolerance * high_pa) {
    need.source_pa = 0.5 * (low_pa + high_pa);
    (bearable(need) ? low_pa : high_pa) = need.source_pa;
  }
  return high_pa;
}

}  // namespace

PumpLoad MakePumpLoad(const Problem& problem, const std::vector<const Line*>& lines,
                      double source_min_pa) {
  PumpLoad load{lines};
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    load.air_m3 += AirPerStroke(problem, g, *lines[g], source_min_pa);
    load.air_to_target_m3 += AirToTarget(problem, g, lines[g]->chamber);
    load.coil_j += CoilEnergyPerCycle(problem, *lines[g], lines[g]->inflate_time_least_s);
  }
  return load;
}

bool EnergyMayGrow(const Problem& problem, const PumpLoad& load) {
  const bool turns = !problem.simultaneous && problem.groups.size() > 1;
  return !turns && std::any_of(load.lines.begin(), load.lines.end(),
                               [](const Line* line) { return line->all_hold; });
}

namespace {

// Coils of the mission at a stop pressure, at least.
double CoilEnergyAt(const Problem& problem, const PumpFacts& facts, const PumpLoad& load,
                    const ReservoirNeed& need, double source_pa) {
  double energy_j = 0.0;
  for (int g = 0; g < static_cast<int>(load.lines.size()); ++g) {
    const Line& line = *load.lines[g];
    const double inflate_s =
        line.all_hold
            ? std::max(line.inflate_time_least_s,
                       LeastInflateTime(problem, g, line, facts,
                                        {source_pa, source_pa, need.low_m3, need.high_m3}))
            : 0.0;
    energy_j += CoilEnergyPerCycle(problem, line, inflate_s);
  }
  return problem.actuations * energy_j;
}

}  // namespace

double MissionEnergyAtLeastPressure(const Problem& problem, const PumpFacts& facts,
                                    const PumpLoad& load, const ReservoirNeed& need) {
  if (!EnergyMayGrow(problem, load)) return need.energy_j;
  return need.energy_j - problem.actuations * load.coil_j +
         CoilEnergyAt(problem, facts, load, need, need.source_pa);
}

// The pumps take no less at a higher stop pressure while coils that are energised only for the
// strokes take no more: of each interval of pressures the lower end counts for the pumps and the
// upper end for the coils. The interval with the least energy is divided.
double LeastMissionEnergy(const Problem& problem, const PumpFacts& facts, const PumpLoad& load,
                          const ReservoirNeed& need, int divisions) {
  if (!EnergyMayGrow(problem, load)) return need.energy_j;
  constexpr double kNarrow = 1e-3;      // of a pressure
  constexpr double kShare = 0.4;        // energy mostly changes fastest next to the lowest pressure
  constexpr double kWorthwhile = 1e-3;  // of the energy
  const double least_coils_j = problem.actuations * load.coil_j;
  const auto pumps_j = [&](double source_pa) {
    const std::optional<PumpNeed> pump =
        LeastPumpNeed(problem, facts, load, {source_pa}, need.low_m3, need.high_m3);
    return pump ? LeastFirstFill(problem, facts, source_pa, need.low_m3) +
                      problem.actuations * pump->energy_j
                : kUnlimited;
  };
  const auto coils_j = [&](double source_pa) {
    return CoilEnergyAt(problem, facts, load, need, source_pa);
  };
  const double pump_j = need.energy_j - least_coils_j;
  if (!(coils_j(need.source_pa) > least_coils_j + kWorthwhile * need.energy_j))
    return need.energy_j;
  struct Interval {
    double low_pa, high_pa, pump_j, coils_j;
    double energy_j() const { return pump_j + coils_j; }
  };
  std::vector<Interval> intervals{{need.source_pa, need.source_max_pa, pump_j, least_coils_j}};
  const auto lowest = [&]() -> Interval& {
    return *std::min_element(
        intervals.begin(), intervals.end(),
        [](const Interval& a, const Interval& b) { return a.energy_j() < b.energy_j(); });
  };
  for (int i = 0; i < divisions; ++i) {
    Interval& low = lowest();
    if (low.high_pa - low.low_pa < kNarrow * low.low_pa) break;
    Interval high = low;
    low.high_pa = high.low_pa = low.low_pa + kShare * (low.high_pa - low.low_pa);
    low.coils_j = coils_j(low.high_pa);
    high.pump_j = pumps_j(high.low_pa);
    intervals.push_back(high);
  }
  return lowest().energy_j();
}

std::optional<ReservoirNeed> LeastReservoirNeed(const Problem& problem, const PumpFacts& facts,
                                                const PumpLoad& load, const PumpLimits& limits,
                                                const Window& window, ReservoirNeed need,
                                                double tolerance) {
  const int groups = static_cast<int>(problem.groups.size());
  // Groups that take turns may find less than the stop pressure.
  const bool turns = !problem.simultaneous && groups > 1;
  std::vector<double> start_pa(1, 0.0);
  // Sets what stopping at need.source_pa at least takes; false if that is too much.
  const auto bearable = [&](ReservoirNeed& at) {
    if (!turns) start_pa.front() = at.source_pa;
    const std::optional<PumpNeed> pump =
        LeastPumpNeed(problem, facts, load, start_pa, at.low_m3, at.high_m3);
    if (!pump) return false;
    at.energy_j = LeastFirstFill(problem, facts, at.source_pa, at.low_m3) +
                  problem.actuations * (pump->energy_j + load.coil_j);
    return pump->on_s * problem.frequency_hz <= limits.duty_max &&
           at.energy_j <= limits.energy_max_j;
  };
  need.source_max_pa = std::min(need.source_max_pa, window.high_pa);
  // Cheap first: the mass balance (2) at the largest volume.
  need.source_pa =
      std::max({need.source_pa, window.low_pa,
                LeastStopPressure(problem, facts, load.air_to_target_m3, need.high_m3)});
  if (!(need.source_pa <= need.source_max_pa)) return std::nullopt;
  const auto excess = [&](double p) {
    return LeastStrokeExcess(problem, load.lines, facts,
                             {p, turns ? need.source_max_pa : p, need.low_m3, need.high_m3});
  };
  if (!turns) {
    if (limits.find_most) {
      if (!bearable(need)) return std::nullopt;
      need.source_max_pa = MostBearable(need, need.source_max_pa, tolerance, bearable);
    }
    const std::optional<double> least_pa =
        RaisedFloor(excess, need.source_pa, need.source_max_pa, tolerance);
    if (!least_pa) return std::nullopt;
    need.source_pa = *least_pa;
  } else if (groups == 2) {
    if (!RaiseStarts(problem, load.lines, facts, need.source_max_pa, need.low_m3, need.high_m3,
                     tolerance, need.start_pa))
      return std::nullopt;
    start_pa.assign(need.start_pa.begin(), need.start_pa.end());
    need.source_pa = std::max({need.source_pa, need.start_pa[0], need.start_pa[1]});
  } else {  // some may draw at the same time: no phases to tell apart
    const std::optional<double> least_pa =
        RaisedFloor(excess, std::max(problem.ambient.pressure_pa, need.start_pa[0]),
                    need.source_max_pa, tolerance);
    if (!least_pa) return std::nullopt;
    need.start_pa[0] = start_pa.front() = *least_pa;
    need.source_pa = std::max(need.source_pa, *least_pa);
  }
  if (!bearable(need)) return std::nullopt;
  return need;
}

std::vector<ReservoirNeed> ReservoirNeeds(const Problem& problem, const PumpFacts& facts,
                                          const Candidate& candidate, double energy_max_j,
                                          double low_m3, double high_m3) {
  std::vector<ReservoirNeed> needs;
  const Window window = SourceWindow(problem, candidate);
  if (window.empty()) return needs;
  const PumpLimits limits{problem.parts.compressors[candidate.compressor.index].duty_max,
                          energy_max_j, true};
  const PumpLoad load = MakePumpLoad(problem, candidate.lines, window.low_pa);
  for (bool last = false; !last;) {
    const double next_m3 = std::min(low_m3 * kIntervalRatio, high_m3);
    last = next_m3 >= high_m3;
    std::optional<ReservoirNeed> need =
        LeastReservoirNeed(problem, facts, load, limits, window,
                           {.low_m3 = low_m3, .high_m3 = next_m3}, kNeedTolerance);
    if (need) need->energy_j = LeastMissionEnergy(problem, facts, load, *need, kNeedDivisions);
    if (need && need->energy_j <= limits.energy_max_j &&
        AloneStrokeExcess(problem, candidate, {need->source_max_pa, need->high_m3, need->low_m3}) <=
            0.0)
      needs.push_back(*need);
    low_m3 = next_m3;
  }
  return needs;
}

}  // namespace plenum::optimizer
