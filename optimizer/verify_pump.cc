#include "optimizer/verify_pump.h"

#include <cmath>

#include "model/storage.h"
#include "model/stroke.h"

namespace plenum::optimizer {
namespace {

constexpr double kPressureTolerance = 1e-3;  // relative; the safe end counts
constexpr double kFinestRatio = 1.01;  // of the ends of an interval of made-to-measure volumes
constexpr double kSlack = 1.0 + kSumTolerance;

double RiseLimit(const Problem& problem, int g) {
  return std::min(problem.groups[g].rise_time_max_s, 0.5 / problem.frequency_hz);
}

double OperatingPa(const Problem& problem, int g) {
  return problem.groups[g].chamber.operating_pressure_pa;
}

}  // namespace

Pumps::Pumps(const Problem& problem, const ProofPlan& plan, const SlotAmounts& amounts)
    : problem_(problem),
      plan_(plan),
      amounts_(amounts),
      choices_(problem, plan, amounts),
      compressor_(SlotOf(plan, Family::kCompressor, -1)),
      reservoir_(SlotOf(plan, Family::kReservoir, -1)),
      battery_(SlotOf(plan, Family::kBattery, -1)),
      content_per_m3_(model::kReferencePressurePa * problem.ambient.temperature_k /
                      model::kReferenceTemperatureK) {}

bool Pumps::TooSlow(const Case& c, int g, double start_pa, Volumes v) const {
  const BestLine& line = *c.lines[g];
  const double ambient_pa = problem_.ambient.pressure_pa;
  const double target_pa = PressureAt(problem_, g, problem_.rise_fraction);
  model::Chamber widest = line.chamber;
  widest.dead_volume_m3 = line.widest_dead_m3;
  double low_pa = ambient_pa, high_pa = start_pa;  // around the lowest pressure of the stroke
  while (high_pa - low_pa > kPressureTolerance * high_pa) {
    const double p = 0.5 * (low_pa + high_pa);
    const double held =
        v.low_m3 * (p - start_pa) + Drawn(problem_, g, widest, std::min(p, target_pa));
    (held < 0.0 ? low_pa : high_pa) = p;
  }
  const double limit_s = RiseLimit(problem_, g);
  const double pumped_m3 = limit_s * choices_.DeliveryAt(c.pumps, low_pa);
  return model::FillTimeFromReservoir(line.fill_series, line.chamber, problem_.groups[g].count,
                                      v.high_m3, start_pa + content_per_m3_ * pumped_m3 / v.low_m3,
                                      ambient_pa, target_pa,
                                      problem_.ambient.temperature_k) > limit_s * kSlack;
}

// The least pressure at the start of a group's stroke; none where even the highest is too slow.
std::optional<double> Pumps::LeastStart(const Case& c, int g, double low_pa, double high_pa,
                                        Volumes v) {
  const auto [entry, fresh] =
      starts_.try_emplace({c.lines[g], &c.pumps, low_pa, high_pa, v.low_m3, v.high_m3});
  if (fresh) entry->second = FindStart(c, g, low_pa, high_pa, v);
  return entry->second;
}

std::optional<double> Pumps::FindStart(const Case& c, int g, double low_pa, double high_pa,
                                       Volumes v) const {
  if (!(low_pa <= high_pa) || TooSlow(c, g, high_pa, v)) return std::nullopt;
  if (!TooSlow(c, g, low_pa, v)) return low_pa;
  while (high_pa - low_pa > kPressureTolerance * high_pa) {
    const double middle_pa = 0.5 * (low_pa + high_pa);
    (TooSlow(c, g, middle_pa, v) ? low_pa : high_pa) = middle_pa;
  }
  return low_pa;
}

// Battery and energy of pumps that find `starts_pa` at the starts of the strokes: one for all, or
// one for each of two groups that take turns.
double Pumps::Rest(const Case& c, const std::vector<double>& starts_pa, double stop_pa,
                   Volumes v) const {
  const bool one_group = problem_.groups.size() == 1, turns = starts_pa.size() > 1;
  const auto pumped_m3 = [&](std::size_t i, double p) {  // since the start, at most up to p
    double drawn = content_per_m3_ * c.air_m3;
    const int g = static_cast<int>(i);
    if (one_group || turns) {
      model::Chamber chamber = c.lines[g]->chamber;
      if (turns) chamber.dead_volume_m3 = c.lines[g]->widest_dead_m3;
      // Of one group what a valve that cannot hold draws above the operating pressure is pumped at
      // no lower a pressure than if it had closed.
      const bool closes = one_group || c.lines[g]->all_hold;
      const double full_pa = closes ? OperatingPa(problem_, g) : p;
      drawn = Drawn(problem_, g, chamber, std::min(p, full_pa));
    }
    return std::max(0.0, v.low_m3 * (p - starts_pa[i]) + drawn) / content_per_m3_;
  };
  double left_m3 = c.air_m3, on_s = 0.0, pump_j = 0.0, first_fill_j = 0.0;
  for (std::size_t cell = 0; cell < kPumpCells; ++cell) {
    const double from_pa = choices_.PressureOf(cell), to_pa = choices_.PressureOf(cell + 1);
    if (from_pa >= stop_pa) break;
    const double energy = c.pumps.energy_j_per_m3[cell];
    const double delivery = c.pumps.delivery_m3_per_s[cell];
    if (!(delivery > 0.0)) return kUnlimited;
    first_fill_j += v.low_m3 / content_per_m3_ * (std::min(to_pa, stop_pa) - from_pa) * energy;
    double bit_m3 = 0.0;
    for (std::size_t i = 0; i < starts_pa.size(); ++i)
      bit_m3 += to_pa >= starts_pa[i] ? kUnlimited : pumped_m3(i, to_pa) - pumped_m3(i, from_pa);
    bit_m3 = std::min(bit_m3, left_m3);
    left_m3 -= bit_m3;
    on_s += bit_m3 / delivery;
    pump_j += bit_m3 * energy;
  }
  if (on_s * problem_.frequency_hz > c.pumps.duty_max * kSlack) return kUnlimited;
  const double beyond_j = first_fill_j + problem_.actuations * (pump_j + c.inflating_j);
  const double coils_j = problem_.actuations * c.coil_w * 0.5 / problem_.frequency_hz;
  return c.packs.Least(beyond_j + coils_j) + problem_.objective.energy_wh * beyond_j / 3600.0;
}

double Pumps::LeastAt(const Case& c, double reservoir, Volumes v) {
  const bool together = problem_.simultaneous || c.lines.size() == 1;
  double low_pa = problem_.ambient.pressure_pa;
  double high_pa = std::min(c.pumps.highest_pa, c.reservoir_pa);
  for (const BestLine* line : c.lines) {
    low_pa = std::max(low_pa, line->source_low_pa);
    high_pa = std::min(high_pa, line->source_high_pa);
  }
  if (!(low_pa <= high_pa)) return kUnlimited;
  const double parts = c.chosen + reservoir;
  return together ? parts + LeastTogether(c, c.enough - parts, low_pa, high_pa, v)
                  : parts + LeastInTurns(c, c.enough - parts, low_pa, high_pa, v);
}

// One pressure for all: it is enough to ask whether strokes are too slow at the pressure whose
// needs are just too large.
double Pumps::LeastTogether(const Case& c, double enough, double low_pa, double high_pa,
                            Volumes v) const {
  const auto rest = [&](double p) { return Rest(c, {p}, p, v); };
  const double quick = rest(low_pa);
  if (quick > enough) return quick;
  double bound = kUnlimited;
  if (rest(high_pa) > enough) {
    while (high_pa - low_pa > kPressureTolerance * high_pa) {
      const double middle_pa = 0.5 * (low_pa + high_pa);
      (rest(middle_pa) > enough ? high_pa : low_pa) = middle_pa;
    }
    bound = rest(high_pa);
  }
  for (int g = 0; g < static_cast<int>(c.lines.size()); ++g)
    if (TooSlow(c, g, high_pa, v)) return bound;
  return quick;
}

// Of two groups each finds at least what the other was filled to: air only flows downhill.
double Pumps::LeastInTurns(const Case& c, double enough, double low_pa, double high_pa, Volumes v) {
  const int groups = static_cast<int>(c.lines.size());
  std::vector<double> starts_pa(groups, problem_.ambient.pressure_pa);
  if (groups == 2)
    starts_pa = {std::min(OperatingPa(problem_, 1), high_pa),
                 std::min(OperatingPa(problem_, 0), high_pa)};
  const auto least = [&] {
    const double most_pa = *std::max_element(starts_pa.begin(), starts_pa.end());
    const std::vector<double> most{most_pa};  // of more than two groups some may draw at once
    return Rest(c, groups > 2 ? most : starts_pa, std::max(low_pa, most_pa), v);
  };
  const double quick = least();
  if (quick > enough) return quick;
  for (int g = 0; g < groups; ++g) {
    const auto needed_pa = LeastStart(c, g, starts_pa[g], high_pa, v);
    if (!needed_pa) return kUnlimited;
    starts_pa[g] = *needed_pa;
  }
  return least();
}

double Pumps::LeastMade(const Case& c, Volumes v) {
  const double rating_pa = std::min(problem_.source_pressure_max_pa - problem_.ambient.pressure_pa,
                                    model::kMadeReservoirPressureMaxGaugePa);
  const model::MadeReservoir made = model::MakeReservoir(v.low_m3, rating_pa);
  const double reservoir = problem_.objective.mass_kg * made.mass_kg +
                           problem_.objective.volume_l * made.body_volume_m3 * 1e3;
  const double least = LeastAt(c, reservoir, v);
  const auto settled = [&](double bound) { return bound > c.enough || std::isinf(bound); };
  if (settled(least) || v.high_m3 < kFinestRatio * v.low_m3) return least;
  const double middle_m3 = std::sqrt(v.low_m3 * v.high_m3);
  const double low = LeastMade(c, {v.low_m3, middle_m3});
  return settled(low) ? std::min(low, LeastMade(c, {middle_m3, v.high_m3})) : least;
}

double Pumps::Least(const Ranges& ranges, const std::vector<const BestLine*>& lines, double chosen,
                    double floor, double enough) {
  Case c{choices_.CellsIn(ranges[compressor_]),
         choices_.PacksIn(ranges[compressor_], ranges[battery_]),
         lines,
         0.0,
         0.0,
         0.0,
         chosen,
         enough,
         kUnlimited};
  for (int g = 0; g < static_cast<int>(lines.size()); ++g) {
    c.air_m3 += Drawn(problem_, g, lines[g]->chamber, OperatingPa(problem_, g)) / content_per_m3_;
    c.coil_w += lines[g]->coil_w;
    c.inflating_j += lines[g]->coil_w * lines[g]->inflate_s;
  }
  double least = kUnlimited;
  for (int i = ranges[reservoir_].first; i < ranges[reservoir_].second; ++i) {
    if (std::isfinite(least) && least <= enough) return floor;  // no closer look is asked for
    const ProofItem& item = plan_.slots[reservoir_].choices[i];
    if (item.part < 0) {
      c.reservoir_pa = problem_.ambient.pressure_pa + model::kMadeReservoirPressureMaxGaugePa;
      least = std::min(
          least, LeastMade(c, {model::kMadeReservoirSmallestM3, model::kMadeReservoirLargestM3}));
      continue;
    }
    const model::Reservoir& reservoir = problem_.parts.reservoirs[item.part];
    c.reservoir_pa = reservoir.pressure_max_pa;
    const double volume_m3 = item.quantity * reservoir.volume_m3;
    least = std::min(least, LeastAt(c, amounts_[reservoir_][i].objective, {volume_m3, volume_m3}));
  }
  return least;
}

}  // namespace plenum::optimizer
