#include "optimizer/evaluate/strokes/turn_strokes.h"

#include <algorithm>
#include <cmath>

#include "model/physics/storage.h"
#include "model/strokes/stroke.h"

namespace plenum::optimizer {
namespace {

// Of the reservoir's pressure; of bursts, which are integrated in steps.
constexpr double kRepeats = 1e-9, kBurstRepeats = 1e-7;
constexpr int kPeriodsMax = 200;

// What begins at once: a squad, or all of a burst.
struct Turn {
  Squad squad;
  double begin_s, until_next_s;
};

// A stroke, or those of a burst, until the last valve closes.
struct Draw {
  model::ReservoirStroke stroke;
  double end_s = 0.0;
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

bool HasCurves(const Candidate& candidate) {
  return std::all_of(candidate.lines.begin(), candidate.lines.end(),
                     [](const Line* line) { return line->curve != nullptr; });
}

// `first`: only whether rises are in time is asked for.
ReservoirStrokes Burst(const Problem& problem, const Candidate& candidate,
                       const OperatingPoint& point, double start_pa, bool first = false) {
  std::vector<StrokeOfMany> many;
  many.reserve(problem.groups.size());
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    many.push_back(
        {MakeStrokeInput(problem, candidate, point, g, FilledAtOnce(problem, g), start_pa),
         InflateWindow(problem, g), first ? LatestRise(problem, g) : model::kNever});
  return FillFromReservoir(
      many, candidate.bench != nullptr ? candidate.bench->stop : std::function<bool()>());
}

class Turns {
 public:
  // `at_once`: all groups in bursts.
  Turns(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
        bool at_once)
      : problem_(problem),
        candidate_(candidate),
        point_(point),
        at_once_(at_once),
        turns_(at_once ? std::vector<Turn>{} : TurnsOf(problem)) {
    if (at_once) {
      times_ = BurstsPerPeriod(problem);
      turns_.push_back({{}, 0.0, 1.0 / (times_ * problem.frequency_hz)});
      return;
    }
    if (!AllAlike(turns_)) return;
    times_ = static_cast<double>(turns_.size());
    turns_.resize(1);
  }

  std::optional<Strokes> Run() {
    const double repeats = at_once_ ? kBurstRepeats : kRepeats;
    // The solution is below high_pa and, where strokes work there, not below low_pa.
    double high_pa = point_.source_pa, high_rise = Rise(high_pa);
    if (unable_) return std::nullopt;
    if (!strokes_.works || high_rise >= -repeats * high_pa) return strokes_;
    double low_pa = problem_.ambient.pressure_pa, low_rise = kUnlimited;
    double next_pa = high_pa + high_rise;  // as the rig goes on by itself
    for (int i = 0; i < kPeriodsMax && !candidate_.stopped(); ++i) {
      const double pa = next_pa, rise = Rise(pa);
      if (unable_) return std::nullopt;
      if (strokes_.works && std::abs(rise) <= repeats * pa) return strokes_;
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
      if (high_pa - low_pa <= repeats * high_pa) {
        strokes_.works = std::isfinite(low_rise);
        return strokes_;
      }
    }
    return std::nullopt;
  }

 private:
  // What the reservoir rises by in a period that begins with so much; sets strokes_ and unable_.
  double Rise(double begin_pa) {
    strokes_ = ToBeKept(problem_);
    strokes_.works = true;
    double reservoir_pa = begin_pa;
    for (const Turn& turn : turns_) {
      reservoir_pa = After(turn, reservoir_pa);
      if (!strokes_.works || unable_) break;
    }
    return reservoir_pa - begin_pa;
  }

  Draw Alone(const model::ReservoirStrokeInput& input, int g) {
    const model::ReservoirStroke stroke = model::FillFromReservoir(input);
    Keep(strokes_.rise_s[g], stroke.reached ? stroke.rise_s : model::kNever);
    Keep(strokes_.inflate_s[g], stroke.reached ? stroke.inflate_s : model::kNever);
    Keep(strokes_.filled_pa[g], stroke.chamber_end_pa);
    strokes_.works = stroke.reached && stroke.inflate_s <= InflateWindow(problem_, g);
    return {stroke, std::max(stroke.inflate_s, input.open_s)};
  }

  Draw AtOnce(double start_pa) {
    ReservoirStrokes found = Burst(problem_, candidate_, point_, start_pa);
    unable_ = !found.done;
    if (unable_) return {};
    strokes_.rise_s = std::move(found.rise_s);
    strokes_.inflate_s = std::move(found.inflate_s);
    strokes_.filled_pa = std::move(found.chamber_end_pa);
    strokes_.works = AllReached(strokes_);
    Draw draw;
    draw.stroke.reservoir_end_pa = found.reservoir_end_pa;
    draw.stroke.pump_on_s = found.pump_on_s;
    draw.stroke.pump_energy_j = found.pump_energy_j;
    draw.stroke.pump_air_m3 = found.pump_air_m3;
    draw.end_s = found.end_s;
    return draw;
  }

  // One stroke, or a burst, and the pumps until the next.
  double After(const Turn& turn, double start_pa) {
    const int g = turn.squad.group;
    const model::ReservoirStrokeInput input =
        MakeStrokeInput(problem_, candidate_, point_, g, turn.squad.count, start_pa);
    const auto [stroke, end_s] = at_once_ ? AtOnce(start_pa) : Alone(input, g);
    if (unable_ || !strokes_.works) return start_pa;
    const double left_s = turn.until_next_s - end_s;
    if (left_s < 0.0) {
      unable_ = true;
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
  bool at_once_;
  std::vector<Turn> turns_;
  double times_ = 1.0;  // that they come in a period
  Strokes strokes_;
  bool unable_ = false;  // to integrate it
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

double LatestRise(const Problem& problem, int group) {
  constexpr double kSlack = 1.0 + 5e-5;  // what integrations may be off by
  return kSlack * RiseWindow(problem, group);
}

std::optional<std::vector<double>> FirstAtOnce(const Problem& problem, const Candidate& candidate,
                                               const OperatingPoint& point) {
  if (!IsBurst(problem) || !HasCurves(candidate)) return std::nullopt;
  ReservoirStrokes found = Burst(problem, candidate, point, point.source_pa, true);
  if (!found.done) return std::nullopt;
  return std::move(found.rise_s);
}

std::optional<Strokes> StrokesAtOnce(const Problem& problem, const Candidate& candidate,
                                     const OperatingPoint& point) {
  if (!IsBurst(problem) || !HasCurves(candidate)) return std::nullopt;
  return Turns(problem, candidate, point, true).Run();
}

std::optional<Strokes> StrokesInTurns(const Problem& problem, const Candidate& candidate,
                                      const OperatingPoint& point) {
  return Turns(problem, candidate, point, false).Run();
}

}  // namespace plenum::optimizer
