#include "verify/corner/verify_pump.h"

#include <cmath>

#include "model/physics/storage.h"
#include "optimizer/problem/pump_feed.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/verify_finding.h"

namespace plenum::verify {
namespace {

constexpr double kFinestRatio = 1.01;  // of the ends of an interval of made-to-measure volumes
constexpr double kSlack = 1.0 + kSumTolerance;

double OperatingPa(const Problem& problem, int g) {
  return problem.groups[g].chamber.operating_pressure_pa;
}

}  // namespace

Packs::Packs(std::vector<Pack> packs) : packs_(std::move(packs)) {
  std::sort(packs_.begin(), packs_.end(),
            [](const Pack& a, const Pack& b) { return a.energy_j < b.energy_j; });
  for (std::size_t i = packs_.size(); i-- > 1;)
    packs_[i - 1].objective = std::min(packs_[i - 1].objective, packs_[i].objective);
}

double Packs::Least(double energy_j) const {
  const auto found =
      std::lower_bound(packs_.begin(), packs_.end(), energy_j / kSlack,
                       [](const Pack& pack, double energy) { return pack.energy_j < energy; });
  return found == packs_.end() ? kUnlimited : found->objective;
}

Pumps::Pumps(const Problem& problem, const ProofPlan& plan, const SlotAmounts& amounts,
             KnownStrokes& strokes)
    : problem_(problem),
      plan_(plan),
      amounts_(amounts),
      strokes_(strokes),
      choices_(strokes.pumps()),
      compressor_(SlotOf(plan, PumpFamily(plan.configuration), -1)),
      reservoir_(SlotOf(plan, Family::kReservoir, -1)),
      battery_(SlotOf(plan, Family::kBattery, -1)),
      content_per_m3_(ContentPerVolume(problem)),
      bursts_(Bursts(problem)) {}

// Batteries that can drive some pump of the range at all.
const Packs& Pumps::PacksIn(Range compressors, Range batteries) {
  const std::array<int, 4> key{compressors.first, compressors.second, batteries.first,
                               batteries.second};
  if (const auto found = packs_.find(key); found != packs_.end()) return found->second;
  const double current_a = choices_.CellsIn(compressors).current_a;
  std::vector<Packs::Pack> packs;
  for (int i = batteries.first; i < batteries.second; ++i) {
    const ProofItem& item = plan_.slots[battery_].choices[i];
    const model::Battery& battery = problem_.parts.batteries[item.part];
    bool drives = false;
    for (int c = compressors.first; c < compressors.second && !drives; ++c) {
      const ProofItem& pumps = plan_.slots[compressor_].choices[c];
      const model::Compressor& pump = PumpsOf(problem_, plan_.configuration)[pumps.part];
      drives = AirSuffices(problem_, pump, pumps.quantity) &&
               model::VoltageMatches(battery.nominal_voltage_v, pump.curve.voltage_v);
    }
    if (drives && item.quantity * battery.current_max_a * kSlack >= current_a)
      packs.push_back(
          {item.quantity * model::UsableEnergy(battery.capacity_ah, battery.nominal_voltage_v),
           amounts_[battery_][i].objective});
  }
  return packs_.emplace(key, Packs(std::move(packs))).first->second;
}

KnownStrokes::Query Pumps::QueryOf(const Case& c, int g, Volumes v) const {
  return {*c.lines[g], c.pumps, g, v};
}

// Of one group what a valve that cannot hold draws above the operating pressure is pumped at no
// lower a pressure than if it had closed.
const std::vector<double>& Pumps::DrawnBy(const BestLine& line, int g) {
  const auto [entry, fresh] = drawn_by_.try_emplace(&line);
  std::vector<double>& drawn = entry->second;
  if (!fresh) return drawn;
  const bool one_group = problem_.groups.size() == 1;  // and one unit
  const model::Chamber& chamber = one_group ? line.chamber : line.widest;
  const double full_pa = one_group || line.all_hold ? OperatingPa(problem_, g) : kUnlimited;
  for (std::size_t cell = 0; cell <= kPumpCells; ++cell)
    drawn.push_back(Drawn(problem_, g, chamber, std::min(choices_.PressureOf(cell), full_pa)));
  return drawn;
}

// Energy to fill the reservoir for the first time, J.
double Pumps::FirstFill(const Case& c, double stop_pa, Volumes v) const {
  const std::size_t cell = choices_.CellOf(stop_pa);
  const double beyond_pa = stop_pa - choices_.PressureOf(cell);
  double energy_j = v.low_m3 * c.pumps.filling_j_per_m3[cell];
  if (beyond_pa > 0.0)
    energy_j += v.low_m3 * beyond_pa / content_per_m3_ * c.pumps.energy_j_per_m3[cell];
  return energy_j;
}

ItemAmounts Pumps::Made(double volume_m3, double stop_pa) const {
  const model::MadeReservoir made =
      model::MakeReservoir(volume_m3, stop_pa - problem_.ambient.pressure_pa);
  return {.mass_kg = made.mass_kg,
          .volume_m3 = made.body_volume_m3,
          .objective = problem_.objective.mass_kg * made.mass_kg +
                       problem_.objective.volume_l * made.body_volume_m3 * 1e3};
}

bool Pumps::IsTooMuch(const Case& c, const ItemAmounts& reservoir) const {
  ItemAmounts all = c.others;
  return TooMuch(problem_, all += reservoir, kSumTolerance);
}

// Battery and energy of pumps, and a made-to-measure reservoir built for where they stop, that find
// `starts_pa` at the starts of the strokes: one for all, or one for each of two groups that take
// turns.
double Pumps::Rest(const Case& c, const std::vector<double>& starts_pa, double stop_pa,
                   Volumes v) const {
  const double first_fill_j = FirstFill(c, stop_pa, v);
  if (std::isinf(first_fill_j)) return kUnlimited;
  // Since the start, at most up to the lower end of a cell.
  const auto pumped_m3 = [&](std::size_t i, std::size_t cell) {
    const double held = v.low_m3 * (choices_.PressureOf(cell) - starts_pa[i]) + (*c.drawn[i])[cell];
    return std::max(0.0, held) / content_per_m3_;
  };
  std::size_t cell = kPumpCells;  // the first where something is pumped
  for (std::size_t i = 0; i < starts_pa.size(); ++i) {
    std::size_t last = choices_.CellOf(starts_pa[i]);
    std::size_t low = 0;
    while (low < last) {
      const std::size_t middle = (low + last) / 2;
      if (pumped_m3(i, middle + 1) > 0.0)
        last = middle;
      else
        low = middle + 1;
    }
    cell = std::min(cell, low);
  }
  double left_m3 = c.air_m3, on_s = 0.0, pump_j = 0.0;
  for (; left_m3 > 0.0 && choices_.PressureOf(cell) < stop_pa; ++cell) {
    const double delivery = c.pumps.delivery_m3_per_s[cell];
    if (!(delivery > 0.0)) return kUnlimited;
    double bit_m3 = 0.0;
    for (std::size_t i = 0; i < starts_pa.size(); ++i)
      bit_m3 += choices_.PressureOf(cell + 1) >= starts_pa[i]
                    ? kUnlimited
                    : pumped_m3(i, cell + 1) - pumped_m3(i, cell);
    bit_m3 = std::min(bit_m3, left_m3);
    left_m3 -= bit_m3;
    on_s += bit_m3 / delivery;
    pump_j += bit_m3 * c.pumps.energy_j_per_m3[cell];
  }
  const double times = std::max(1, bursts_);
  on_s *= times;
  pump_j *= times;
  if (on_s * problem_.frequency_hz > c.pumps.duty_max * kSlack) return kUnlimited;
  const double beyond_j = first_fill_j + problem_.actuations * (pump_j + c.inflating_j);
  const double coils_j = problem_.actuations * c.coil_j;
  const double made = c.made ? Made(v.low_m3, stop_pa).objective : 0.0;
  return made + c.packs.Least(beyond_j + coils_j) +
         problem_.objective.energy_wh * beyond_j / optimizer::kJoulePerWattHour;
}

double Pumps::LeastAt(const Case& c, double reservoir, Volumes v) {
  double low_pa = problem_.ambient.pressure_pa;
  double high_pa = std::min(c.pumps.highest_pa, c.reservoir_pa);
  for (const BestLine* line : c.lines) {
    low_pa = std::max(low_pa, line->source_low_pa);
    high_pa = std::min(high_pa, line->source_high_pa);
  }
  if (!(low_pa <= high_pa)) return kUnlimited;
  if (c.made && IsTooMuch(c, Made(v.low_m3, low_pa))) return kUnlimited;
  const double parts = c.chosen + reservoir;
  return bursts_ > 0 ? parts + LeastTogether(c, c.enough - parts, low_pa, high_pa, v)
                     : parts + LeastInTurns(c, c.enough - parts, low_pa, high_pa, v);
}

// One pressure for all, sought only until it is known whether the least that is fast enough is
// below the one whose needs are too large.
double Pumps::LeastTogether(const Case& c, double enough, double low_pa, double high_pa,
                            Volumes v) {
  const auto rest = [&](double p) { return Rest(c, {p}, p, v); };
  const int groups = static_cast<int>(c.lines.size());
  const auto too_slow = [&](double p) {
    for (int g = 0; g < groups; ++g)
      if (strokes_.TooSlow(QueryOf(c, g, v), p)) return true;
    return false;
  };
  for (int g = 0; g < groups; ++g)
    if (strokes_.Known(QueryOf(c, g, v)).too_slow_pa >= high_pa) return kUnlimited;
  double bound = rest(low_pa);
  if (bound > enough || !too_slow(low_pa)) return bound;
  if (too_slow(high_pa)) return kUnlimited;
  double fast_enough_pa = low_pa;
  for (int g = 0; g < groups; ++g) {
    const KnownStrokes::Starts& known = strokes_.Known(QueryOf(c, g, v));
    low_pa = std::max(low_pa, known.too_slow_pa);
    fast_enough_pa = std::max(fast_enough_pa, known.fast_enough_pa);
  }
  high_pa = std::min(high_pa, fast_enough_pa);
  bound = rest(low_pa);
  if (bound > enough || rest(high_pa) <= enough) return bound;
  while (bound <= enough && high_pa - low_pa > kStartTolerance * high_pa) {
    const double middle_pa = 0.5 * (low_pa + high_pa);
    if (too_slow(middle_pa)) {
      low_pa = middle_pa;
      bound = rest(low_pa);
    } else {
      high_pa = middle_pa;
      if (rest(high_pa) <= enough) return bound;
    }
  }
  return bound;
}

// Each of two groups leaves after half of the period what the other needs; until that is `settled`.
// False: at no pressure.
bool Pumps::RaiseStarts(const Case& c, double high_pa, Volumes v,
                        const std::function<bool()>& settled,
                        std::vector<double>& starts_pa) const {
  constexpr int kRaisesMax = 40;  // fewer leave bounds that hold
  for (int quiet = 0, raises = 0, g = 0; quiet < 2 && raises < kRaisesMax && !settled();
       g = 1 - g, ++raises) {
    const auto needed_pa =
        strokes_.LeastStartLeaving(QueryOf(c, g, v), starts_pa[1 - g], starts_pa[g], high_pa);
    if (!needed_pa) return false;
    quiet = *needed_pa > starts_pa[g] ? 0 : quiet + 1;
    starts_pa[g] = *needed_pa;
  }
  return true;
}

// Of two groups each finds at least what the other was filled to: air only flows downhill.
double Pumps::LeastInTurns(const Case& c, double enough, double low_pa, double high_pa, Volumes v) {
  const int groups = static_cast<int>(c.lines.size());
  const bool alternate = Alternate(problem_);
  std::vector<double> starts_pa(groups, problem_.ambient.pressure_pa);
  if (alternate)
    starts_pa = {std::min(OperatingPa(problem_, 1), high_pa),
                 std::min(OperatingPa(problem_, 0), high_pa)};
  const auto least = [&] {
    const double most_pa = *std::max_element(starts_pa.begin(), starts_pa.end());
    const std::vector<double> most{most_pa};  // of others some may draw at once
    return Rest(c, alternate ? starts_pa : most, std::max(low_pa, most_pa), v);
  };
  const double quick = least();
  if (quick > enough) return quick;
  for (int g = 0; g < groups; ++g) {
    const auto needed_pa = strokes_.LeastStart(QueryOf(c, g, v), starts_pa[g], high_pa);
    if (!needed_pa) return kUnlimited;
    starts_pa[g] = *needed_pa;
  }
  const auto settled = [&] { return least() > enough; };
  if (alternate && !RaiseStarts(c, high_pa, v, settled, starts_pa)) return kUnlimited;
  return least();
}

double Pumps::LeastMade(const Case& c, Volumes v) {
  const double least = LeastAt(c, 0.0, v);
  const auto settled = [&](double bound) { return bound > c.enough || std::isinf(bound); };
  if (settled(least) || v.high_m3 < kFinestRatio * v.low_m3) return least;
  const double middle_m3 = std::sqrt(v.low_m3 * v.high_m3);
  const double low = LeastMade(c, {v.low_m3, middle_m3});
  return settled(low) ? std::min(low, LeastMade(c, {middle_m3, v.high_m3})) : least;
}

double Pumps::Least(const Ranges& ranges, const std::vector<const BestLine*>& lines,
                    const ItemAmounts& others, const Objectives& objectives) {
  Case c{choices_.CellsIn(ranges[compressor_]),
         PacksIn(ranges[compressor_], ranges[battery_]),
         lines,
         {},
         0.0,
         0.0,
         0.0,
         others,
         objectives.chosen,
         objectives.enough,
         kUnlimited,
         false};
  for (int g = 0; g < static_cast<int>(lines.size()); ++g) {
    const double strokes = problem_.groups[g].gait.strokes_per_period;
    c.air_m3 += (bursts_ > 0 ? 1.0 : strokes) *
                Drawn(problem_, g, lines[g]->chamber, OperatingPa(problem_, g)) / content_per_m3_;
    c.coil_j += lines[g]->coil_w * lines[g]->coil_s;
    c.inflating_j += strokes * lines[g]->coil_w * lines[g]->inflate_s;
  }
  const std::vector<double> of_all(kPumpCells + 1, content_per_m3_ * c.air_m3);
  if ((lines.size() == 1 && bursts_ > 0) || Alternate(problem_))
    for (int g = 0; g < static_cast<int>(lines.size()); ++g)
      c.drawn.push_back(&DrawnBy(*lines[g], g));
  else
    c.drawn.push_back(&of_all);
  double least = kUnlimited;
  for (int i = ranges[reservoir_].first; i < ranges[reservoir_].second; ++i) {
    if (std::isfinite(least) && least <= c.enough)
      return objectives.floor;  // no closer look is asked for
    const ProofItem& item = plan_.slots[reservoir_].choices[i];
    c.made = item.part < 0;
    if (c.made) {
      c.reservoir_pa = problem_.ambient.pressure_pa + model::kMadeReservoirPressureMaxGaugePa;
      least = std::min(
          least, LeastMade(c, {model::kMadeReservoirSmallestM3, model::kMadeReservoirLargestM3}));
      continue;
    }
    if (IsTooMuch(c, amounts_[reservoir_][i])) continue;
    const model::Reservoir& reservoir = problem_.parts.reservoirs[item.part];
    c.reservoir_pa = reservoir.pressure_max_pa;
    const double volume_m3 = item.quantity * reservoir.volume_m3;
    least = std::min(least, LeastAt(c, amounts_[reservoir_][i].objective, {volume_m3, volume_m3}));
  }
  return least;
}

}  // namespace plenum::verify
