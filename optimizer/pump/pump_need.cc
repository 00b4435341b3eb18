// What pumps at least take for the air of a cycle and for the first fill, by pump_bounds.h.
#include <algorithm>
#include <cmath>

#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/pump/pump_bounds.h"
#include "optimizer/pump/pump_march.h"

namespace plenum::optimizer {

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
  PerAir per_m3;

  double seconds() const { return air_m3 * per_m3.seconds; }
  double energy_j() const { return air_m3 * per_m3.energy_j; }

  // No more than `most_m3` of it, the first.
  PumpedAir First(const PumpRates& rates, double most_m3) const {
    if (!(most_m3 < air_m3)) return *this;
    const double end_pa = from_pa + (to_pa - from_pa) * most_m3 / air_m3;
    return {from_pa, end_pa, most_m3, rates.Mean(from_pa, end_pa)};
  }
};

// Integrals up to pressures that mostly come in turn, each bit of air beginning where the one
// before ends.
class Bits {
 public:
  explicit Bits(const PumpRates& rates) : rates_(rates) {}

  PumpedAir Make(double from_pa, double to_pa, double air_m3) {
    const PerAir from = from_pa == last_pa_ ? last_ : rates_.Integral(from_pa);
    last_pa_ = to_pa;
    last_ = rates_.Integral(to_pa);
    return {from_pa, to_pa, air_m3, rates_.Mean(from_pa, from, to_pa, last_)};
  }

 private:
  const PumpRates& rates_;
  double last_pa_ = -1.0;
  PerAir last_{};
};

// What the first bits take that make up the air of a cycle.
class NeedOfBits {
 public:
  NeedOfBits(const PumpFacts& facts, double air_m3)
      : rates_(facts.rates), enough_m3_(1e-9 * air_m3), left_m3_(air_m3) {}

  bool enough() const { return left_m3_ <= enough_m3_; }
  const PumpNeed& need() const { return need_; }

  void Add(const PumpedAir& bit) {
    const PumpedAir first = bit.First(rates_, left_m3_);
    need_.on_s += first.seconds();
    need_.energy_j += first.energy_j();
    left_m3_ -= first.air_m3;
  }

 private:
  const PumpRates& rates_;
  double enough_m3_, left_m3_;
  PumpNeed need_;
};

// Air that is pumped while a group's chambers fill, at least, handed to step(from, to, m³ ANR) as
// by MarchPump. With m pumped and D drawn, as content,
//   dD/dm = n·q(s, p(D))/Q(s),  s = p_1 − (D − m)/V ≤ p_1,
// does not fall with m nor rise with D, so that a curve D(m) that everywhere is at least as steep
// as that lies above the true one: panel by panel of D the slope is taken where the panel begins in
// D and ends in m. More flow, a wider tube and a larger volume only make it steeper. The reservoir
// then is no lower than with that D and the smallest volume, which is linear in m within a panel.
template <typename Step>
double MarchDraw(const Problem& problem, int g, const Line& line, const PumpFacts& facts,
                 double start_pa, double low_m3, double high_m3, const Step& step) {
  constexpr int kPanels = 8;
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
      const double flow = group.count * line.curve->flow.Flow(s, p);
      return flow > 0.0 ? pumped + (next - drawn) / (flow * facts.rates.SecondsAtMost(s)) : most;
    };
    const double reached = std::min(pumped_by(std::min(pumped_by(pumped), next)), next);
    if (reached > pumped) {
      const double begin_pa = std::max(ambient_pa, start_pa - (drawn - pumped) / low_m3);
      const double end_pa = std::max(ambient_pa, start_pa - (next - reached) / low_m3);
      step(std::min(begin_pa, end_pa), std::max(begin_pa, end_pa),
           (reached - pumped) / content_per_m3);
      pumped = reached;
    }
    drawn = next;
    p = next_pa;
  }
  return pumped / content_per_m3;
}

// The bits of all phases, those at the lowest pressures first. march(phase, take) calls take(bit)
// for the bits of a phase in that order, until it returns false.
template <class March>
std::optional<PumpNeed> SumPhases(NeedOfBits sum, int phases, const March& march) {
  if (phases == 1) {
    march(0, [&](const PumpedAir& bit) {
      sum.Add(bit);
      return !sum.enough();
    });
  } else {
    std::vector<PumpedAir> bits;
    for (int phase = 0; phase < phases; ++phase)
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

}  // namespace

std::optional<PumpNeed> LeastPumpNeed(const Problem& problem, const PumpFacts& facts,
                                      const PumpLoad& load, const std::vector<double>& start_pa,
                                      double low_m3, double high_m3) {
  // One group in each phase.
  const bool apart = start_pa.size() > 1 || MeetingOf(problem) == Meeting::kAlone;
  const double bursts = BurstsPerPeriod(problem);
  const double phase_s =
      1.0 / problem.frequency_hz / (bursts * static_cast<double>(start_pa.size()));
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
    // A volume that follows a table, or one that is evacuated, may take more air at the lower
    // pressures of a bit.
    const bool even = line.chamber.volume_curve.empty() && !line.chamber.evacuated;
    const double volume_m3 = even ? model::Volume(line.chamber, 0.0) : 0.0;
    const double slope = even ? model::VolumeSlope(line.chamber, 0.0) : 0.0;
    const auto drawn = [&](double pressure_pa) {  // as MostDrawn
      if (!apart) return drawn_at_once;
      const double p = std::min(pressure_pa, full_pa);
      const double content = even ? p * (volume_m3 + slope * p) : model::Content(line.chamber, p);
      return count * (content - empty + spread_m3 * (p - ambient_pa));
    };
    double left_s = phase_s;
    Bits bits_of(facts.rates);
    const auto add = [&](double from_pa, double to_pa, double air_m3) {
      if (!(left_s > 0.0)) return false;
      const PumpedAir bit = bits_of.Make(from_pa, to_pa, air_m3);
      // At the speed of its begin, which is the highest, the time may be enough for more.
      const PumpedAir first = bit.First(facts.rates, left_s * facts.rates.Delivery(from_pa));
      left_s -= first.seconds();
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
  std::optional<PumpNeed> need =
      SumPhases(NeedOfBits(facts, load.air_m3), static_cast<int>(start_pa.size()), march);
  if (need) {
    need->on_s *= bursts;
    need->energy_j *= bursts;
  }
  return need;
}

double LeastFirstFill(const Problem& problem, const PumpFacts& facts, double source_pa,
                      double reservoir_m3) {
  const double ambient_pa = problem.ambient.pressure_pa;
  return reservoir_m3 / ContentPerVolume(problem) * (source_pa - ambient_pa) *
         facts.rates.Mean(ambient_pa, source_pa).energy_j;
}

}  // namespace plenum::optimizer
