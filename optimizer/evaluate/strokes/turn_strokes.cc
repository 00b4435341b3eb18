#include "optimizer/evaluate/strokes/turn_strokes.h"

#include <algorithm>
#include <cmath>

#include "model/physics/storage.h"
#include "model/strokes/stroke.h"

namespace plenum::optimizer {
namespace {

constexpr double kRepeats = 1e-9;  // of the reservoir's pressure
constexpr int kPeriodsMax = 200;

struct Turn {
  Squad squad;
  double begin_s, until_next_s;
};

std::vector<Turn> TurnsOf(const Problem& problem) {
  const double period_s = 1.0 / problem.frequency_hz;
  std::vector<Turn> turns;
  const std::vector<Squad> squads = SquadsOf(problem);
  for (const auto& [at, squad] : BeginsOf(problem, squads))
    turns.push_back({squads[squad], at * period_s, 0.0});
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const bool last = i + 1 == turns.size();
    turns[i].until_next_s = last ? turns[0].begin_s + period_s - turns[i].begin_s
                                 : turns[i + 1].begin_s - turns[i].begin_s;
  }
  return turns;
}

// Whether each turn is as the next, so that the reservoir repeats after one of them.
bool AllAlike(const std::vector<Turn>& turns) {
  constexpr double kSame = 1e-12;
  return std::all_of(turns.begin(), turns.end(), [&](const Turn& turn) {
    return turn.squad.group == turns[0].squad.group && turn.squad.count == turns[0].squad.count &&
           std::abs(turn.until_next_s - turns[0].until_next_s) <= kSame * turn.until_next_s;
  });
}

class Turns {
 public:
  Turns(const Problem& problem, const Candidate& candidate, const OperatingPoint& point)
      : problem_(problem), candidate_(candidate), point_(point), turns_(TurnsOf(problem)) {
    if (!AllAlike(turns_)) return;
    times_ = static_cast<double>(turns_.size());
    turns_.resize(1);
  }

  std::optional<Strokes> Run() {
    // The solution is below high_pa and not below low_pa.
    double high_pa = point_.source_pa, high_rise = Rise(high_pa);
    if (overlap_) return std::nullopt;
    if (!strokes_.works || high_rise >= -kRepeats * high_pa) return strokes_;
    double low_pa = problem_.ambient.pressure_pa, low_rise = kUnlimited;
    double next_pa = high_pa + high_rise;  // as the rig goes on by itself
    for (int i = 0; i < kPeriodsMax && !candidate_.stopped(); ++i) {
      const double pa = next_pa, rise = Rise(pa);
      if (overlap_) return std::nullopt;
      if (strokes_.works && std::abs(rise) <= kRepeats * pa) return strokes_;
      if (strokes_.works && rise < 0.0) {
        // The chord through two periods above.
        const double slope = (rise - high_rise) / (pa - high_pa);
        high_pa = pa;
        high_rise = rise;
        next_pa = slope < 0.0 ? pa - rise / slope : pa + rise;
      } else {
        low_pa = pa;
        low_rise = strokes_.works ? rise : kUnlimited;
        next_pa = std::isfinite(low_rise)
                      ? low_pa + (high_pa - low_pa) * low_rise / (low_rise - high_rise)
                      : 0.5 * (low_pa + high_pa);
      }
      if (!(next_pa > low_pa && next_pa < high_pa)) next_pa = 0.5 * (low_pa + high_pa);
      if (high_pa - low_pa <= kRepeats * high_pa) return strokes_;
    }
    return std::nullopt;
  }

 private:
  // What the reservoir rises by in a period that begins with so much; sets strokes_ and overlap_.
  double Rise(double begin_pa) {
    strokes_ = ToBeKept(problem_);
    strokes_.works = true;
    double reservoir_pa = begin_pa;
    for (const Turn& turn : turns_) {
      reservoir_pa = After(turn, reservoir_pa);
      if (!strokes_.works || overlap_) break;
    }
    return reservoir_pa - begin_pa;
  }

  // One stroke, and the pumps until the next.
  double After(const Turn& turn, double start_pa) {
    const int g = turn.squad.group;
    const model::ReservoirStrokeInput input =
        MakeStrokeInput(problem_, candidate_, point_, g, turn.squad.count, start_pa);
    const model::ReservoirStroke stroke = model::FillFromReservoir(input);
    Keep(strokes_.rise_s[g], stroke.reached ? stroke.rise_s : model::kNever);
    Keep(strokes_.inflate_s[g], stroke.reached ? stroke.inflate_s : model::kNever);
    Keep(strokes_.filled_pa[g], stroke.chamber_end_pa);
    if (!stroke.reached || stroke.inflate_s > InflateWindow(problem_, g)) {
      strokes_.works = false;
      return start_pa;
    }
    const double left_s = turn.until_next_s - std::max(stroke.inflate_s, input.open_s);
    if (left_s < 0.0) {
      overlap_ = true;
      return start_pa;
    }
    const double end_pa = model::PressureAfterPumping(
        *input.compressor, input.compressors, input.volume_rising_m3, stroke.reservoir_end_pa,
        input.stop_pa, left_s, input.temperature_k);
    const double refill_s =
        end_pa < input.stop_pa
            ? left_s
            : model::PumpUpTime(*input.compressor, input.compressors, input.volume_rising_m3,
                                stroke.reservoir_end_pa, end_pa, input.temperature_k);
    const Pumped pumped = PumpedFor(input, stroke, end_pa, refill_s);
    strokes_.pump_on_s += times_ * pumped.on_s;
    strokes_.pump_energy_j += times_ * pumped.energy_j;
    strokes_.pump_air_m3 += times_ * pumped.air_m3;
    return end_pa;
  }

  const Problem& problem_;
  const Candidate& candidate_;
  const OperatingPoint& point_;
  std::vector<Turn> turns_;
  double times_ = 1.0;  // that they come in a period
  Strokes strokes_;
  bool overlap_ = false;
};

}  // namespace

Pumped PumpedFor(const model::ReservoirStrokeInput& input, const model::ReservoirStroke& stroke,
                 double end_pa, double refill_s) {
  const double volume_m3 = input.volume_rising_m3;
  return {stroke.chamber_end_pa, stroke.pump_on_s + refill_s,
          stroke.pump_energy_j + model::EnergyToFill(*input.compressor, volume_m3,
                                                     stroke.reservoir_end_pa, end_pa,
                                                     input.temperature_k),
          stroke.pump_air_m3 + model::StandardVolume(volume_m3 * (end_pa - stroke.reservoir_end_pa),
                                                     input.temperature_k)};
}

model::ReservoirStrokeInput MakeStrokeInput(const Problem& problem, const Candidate& candidate,
                                            const OperatingPoint& point, int g, int count,
                                            double start_pa) {
  model::ReservoirStrokeInput input;
  input.fill = &candidate.lines[g]->curve->flow;
  input.chamber = &candidate.lines[g]->chamber;
  input.count = count;
  input.compressor = &ChosenPump(problem, candidate).curve;
  input.compressors = candidate.compressor.quantity;
  input.stop_pa = point.source_pa;
  input.volume_falling_m3 = point.reservoir_m3;
  input.volume_rising_m3 = point.reservoir_rising_m3;
  input.from_pa = problem.ambient.pressure_pa;
  input.target_pa = RiseTarget(problem, problem.groups[g]);
  input.operating_pa = problem.groups[g].chamber.operating_pressure_pa;
  if (!candidate.lines[g]->holds) input.open_s = InflateWindow(problem, g);
  input.temperature_k = problem.ambient.temperature_k;
  input.start_pa = start_pa;
  return input;
}

std::optional<ReservoirStrokes> FirstAtOnce(const Problem& problem, const Candidate& candidate,
                                            const OperatingPoint& point) {
  const bool curves = std::all_of(candidate.lines.begin(), candidate.lines.end(),
                                  [](const Line* line) { return line->curve != nullptr; });
  if (!IsBurst(problem) || !curves) return std::nullopt;
  std::vector<StrokeOfMany> many;
  many.reserve(problem.groups.size());
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    many.push_back(
        {MakeStrokeInput(problem, candidate, point, g, FilledAtOnce(problem, g), point.source_pa),
         InflateWindow(problem, g)});
  ReservoirStrokes found = FillFromReservoir(
      many, candidate.bench != nullptr ? candidate.bench->stop : std::function<bool()>());
  if (!found.done) return std::nullopt;
  return found;
}

std::optional<Strokes> StrokesAtOnce(const Problem& problem, const Candidate& candidate,
                                     const OperatingPoint& point) {
  std::optional<ReservoirStrokes> found = FirstAtOnce(problem, candidate, point);
  if (!found) return std::nullopt;
  Strokes strokes = ToBeKept(problem);
  strokes.rise_s = std::move(found->rise_s);
  strokes.inflate_s = std::move(found->inflate_s);
  strokes.works = AllReached(strokes);
  if (!strokes.works) return strokes;
  const model::ReservoirStrokeInput in =
      MakeStrokeInput(problem, candidate, point, 0, FilledAtOnce(problem, 0), point.source_pa);
  const double refill_s = model::PumpUpTime(*in.compressor, in.compressors, in.volume_rising_m3,
                                            found->reservoir_end_pa, in.stop_pa, in.temperature_k);
  const double bursts = BurstsPerPeriod(problem);
  if (!((found->end_s + refill_s) * bursts * problem.frequency_hz <= 1.0)) return std::nullopt;
  strokes.filled_pa = std::move(found->chamber_end_pa);
  model::ReservoirStroke all;
  all.reservoir_end_pa = found->reservoir_end_pa;
  all.pump_on_s = found->pump_on_s;
  all.pump_energy_j = found->pump_energy_j;
  all.pump_air_m3 = found->pump_air_m3;
  const Pumped pumped = PumpedFor(in, all, in.stop_pa, refill_s);
  strokes.pump_on_s = bursts * pumped.on_s;
  strokes.pump_energy_j = bursts * pumped.energy_j;
  strokes.pump_air_m3 = bursts * pumped.air_m3;
  return strokes;
}

std::optional<Strokes> StrokesInTurns(const Problem& problem, const Candidate& candidate,
                                      const OperatingPoint& point) {
  return Turns(problem, candidate, point).Run();
}

}  // namespace plenum::optimizer
