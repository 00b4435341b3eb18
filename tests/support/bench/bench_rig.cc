#include "tests/support/bench/bench_rig.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace plenum::test {
namespace {

// Δ(p·V) from rest to the operating pressure.
double Content(const BenchRig& rig) {
  const double operating_pa = rig.ambient_pa + rig.operating_gauge_pa;
  return rig.rest_volume_m3 * (operating_pa * rig.expansion_ratio - rig.ambient_pa);
}

double Digits3(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2.0);
  return std::round(value / unit) * unit;
}

double Milliseconds(double time_s) { return std::round(time_s * 1e3) * 1e-3; }

// First time at which the pressures pass the target; the last time if they never do.
double Crossing(const EffectResult& result, double target_pa, double sign) {
  for (std::size_t i = 0; i < result.t_s.size(); ++i) {
    if (sign * (result.pressure_pa[i] - target_pa) >= 0.0) return result.t_s[i];
  }
  return result.t_s.back();
}

void AddDelivery(BenchRig& rig, double source_pa, double rise_s, Random& random) {
  const double sag_pa = random.Uniform(0.03, 0.15) * source_pa;
  rig.reservoir_m3 = Digits3(Content(rig) / sag_pa);
  const double free_air = Content(rig) / (1e5 * rise_s) * random.Uniform(0.3, 1.2);
  const double stall_pa = random.Uniform(1.3, 2.0) * source_pa;
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    rig.delivery.emplace_back(std::lerp(rig.ambient_pa, stall_pa, share), free_air * (1.0 - share));
  }
}

// --- Schedules -------------------------------------------------------------------------------

class ScheduleWriter {
 public:
  explicit ScheduleWriter(double rest_s) { Then(0, rest_s); }
  void Then(int direction, double duration_s) {
    commands_.push_back({Milliseconds(now_s_), direction});
    now_s_ += duration_s;
  }
  void Into(BenchRun& run) const {
    run.schedule = commands_;
    run.end_s = Milliseconds(now_s_);
  }

 private:
  double now_s_ = 0.0;
  std::vector<MassCommand> commands_;
};

enum class Programme { kStep, kCycles, kStairs };

void WriteSchedule(BenchRun& run, Programme programme, const StrokeTimes& stroke, Random& random) {
  ScheduleWriter write(random.Uniform(0.1, 0.5));
  const double level = random.Uniform(0.75, 1.03);
  if (programme == Programme::kStep) {
    write.Then(1, level * stroke.rise_s);
    write.Then(0, random.LogUniform(1.5, 7.0));
    write.Then(-1, random.Uniform(0.8, 1.4) * stroke.fall_s);
  } else if (programme == Programme::kCycles) {
    const int cycles = random.Integer(3, 6);
    const double hold_s = random.Uniform(0.05, 0.4), share = random.Uniform(0.6, 1.2);
    for (int i = 0; i < cycles; ++i) {
      write.Then(1, level * stroke.rise_s * (i == 0 ? 1.0 : 0.9));
      write.Then(0, hold_s);
      write.Then(-1, share * stroke.fall_s);
      if (i + 1 < cycles) write.Then(0, 0.5 * hold_s);
    }
  } else {
    const int steps = random.Integer(2, 3);
    for (int i = 0; i < steps; ++i) {
      write.Then(1, level * stroke.rise_s / steps);
      write.Then(0, random.LogUniform(0.4, 2.0));
    }
    for (const double share : {0.3, 0.8}) {
      write.Then(-1, share * stroke.fall_s);
      write.Then(0, random.LogUniform(0.4, 2.0));
    }
  }
  write.Then(0, random.Uniform(0.3, 0.9));
  write.Into(run);
}

// Of a chamber that was filled beforehand.
void WriteEmptying(BenchRun& run, const StrokeTimes& stroke, Random& random) {
  ScheduleWriter write(random.LogUniform(1.0, 6.0));
  const int steps = random.Integer(1, 3);
  for (int i = 0; i < steps; ++i) {
    write.Then(-1, 1.2 / steps * stroke.fall_s);
    write.Then(0, random.LogUniform(0.5, 3.0));
  }
  write.Into(run);
}

// A supply that dips at every filling and wanders by a few percent.
std::function<double(double)> DrawCourse(const BenchRun& run, double level_pa, double rise_s,
                                         Random& random) {
  const double dip_pa = level_pa * random.Uniform(0.01, 0.05);
  const double recovery_s = rise_s * random.Uniform(0.5, 2.0);
  const double wander_pa = level_pa * random.Uniform(0.002, 0.02);
  const double hz = random.Uniform(0.1, 0.8), phase = random.Uniform(0.0, 6.28);
  std::vector<double> fills;
  for (const MassCommand& c : run.schedule) {
    if (c.direction > 0) fills.push_back(c.time_s);
  }
  return [=](double t_s) {
    double p = level_pa + wander_pa * std::sin(2.0 * std::numbers::pi * hz * t_s + phase);
    for (const double fill_s : fills) {
      const double u = (t_s - fill_s) / recovery_s;
      if (u > 0.0) p -= dip_pa * u * std::exp(1.0 - u);
    }
    return p;
  };
}

void SampleEvery(double interval_s, std::vector<BenchRun>& runs, Random& random) {
  const double jitter = random.Coin(0.25) ? 0.35 : 0.0;
  for (BenchRun& run : runs) {
    for (int i = 1; i * interval_s <= run.end_s; ++i) {
      const double off = jitter > 0.0 ? random.Uniform(-jitter, jitter) : 0.0;
      run.t_s.push_back(std::round((i + off) * interval_s * 1e6) * 1e-6);
    }
  }
}

void DrawSampleTimes(std::vector<BenchRun>& runs, Random& random) {
  double total_s = 0.0;
  for (const BenchRun& run : runs) total_s += run.end_s;
  std::vector<double> rates;
  for (const double hz : {50.0, 80.0, 100.0, 125.0, 200.0, 250.0, 400.0, 500.0, 1000.0}) {
    if (hz * total_s <= 30000.0 || rates.empty()) rates.push_back(hz);
  }
  SampleEvery(1.0 / random.Pick(rates), runs, random);
}

// --- What a hasty experimenter records --------------------------------------------------------

void WriteNarrow(BenchRun& run, const StrokeTimes& stroke, Random& random) {
  const bool holds = random.Coin(), falls = random.Coin();
  const double level = random.Uniform(0.6, 1.0);
  ScheduleWriter write(random.Uniform(0.1, 0.5));
  write.Then(1, level * stroke.rise_s);
  if (holds) write.Then(0, random.LogUniform(0.3, 5.0));
  if (falls) write.Then(-1, random.Uniform(0.4, 1.2) * stroke.fall_s);
  write.Into(run);
}

void WriteNarrowEmptying(BenchRun& run, const StrokeTimes& stroke, Random& random) {
  const bool empties = random.Coin(0.7);
  ScheduleWriter write(empties ? random.LogUniform(0.2, 4.0) : random.LogUniform(1.0, 10.0));
  if (empties) write.Then(-1, random.Uniform(0.4, 1.2) * stroke.fall_s);
  write.Into(run);
}

}  // namespace

MassElement TubeAsElement(const LineDynamics& tube) {
  const double d = tube.inner_diameter_m;
  const double c = 0.029 * d * d / std::sqrt(tube.length_m / std::pow(d, 1.25) + 510.0);
  return {c, std::clamp(474.0 * c / (d * d), 0.0, 0.528)};
}

EffectRig Plant(const BenchRig& declared, const BenchRun& run, const Numbers& factors) {
  EffectRig rig;
  rig.rest_volume_m3 = factors[kRestVolume] * declared.rest_volume_m3;
  rig.expansion_ratio = factors[kExpansionRatio] * declared.expansion_ratio;
  rig.operating_pa =
      declared.ambient_pa + factors[kOperatingPressure] * declared.operating_gauge_pa;
  rig.blocked = run.blocked;
  rig.ambient_pa = declared.ambient_pa;
  rig.ambient_k = declared.ambient_k;
  rig.initial_pa = declared.ambient_pa + run.initial_gauge_pa;
  rig.source_pa = declared.ambient_pa + factors[kSourcePressure] * run.source_gauge_pa;
  rig.source_course = run.source_course;
  rig.source = EffectRig::Source::kRegulated;
  if (declared.supply == BenchSupply::kNone) rig.source = EffectRig::Source::kNone;
  if (declared.supply == BenchSupply::kCompressor) {
    rig.source = EffectRig::Source::kReservoir;
    rig.reservoir_m3 = factors[kReservoirVolume] * declared.reservoir_m3;
    rig.delivery = declared.delivery;
  }
  const auto true_pair = [&](MassElement e) {
    e.conductance *= factors[kSonicConductance];
    e.critical_ratio *= factors[kCriticalRatio];
    return e;
  };
  rig.fill = {true_pair(declared.fill)};
  rig.exhaust = {true_pair(declared.exhaust)};
  if (declared.tube) {
    LineDynamics tube = *declared.tube;
    tube.inner_diameter_m *= factors[kTubeInnerDiameter];
    rig.fill.push_back(TubeAsElement(tube));
    rig.exhaust.insert(rig.exhaust.begin(), TubeAsElement(tube));
    rig.dead_volume_m3 =
        std::numbers::pi / 4.0 * tube.inner_diameter_m * tube.inner_diameter_m * tube.length_m;
  }
  rig.schedule = run.schedule;
  return rig;
}

StrokeTimes TimesOf(const BenchRig& rig, bool blocked, double source_gauge_pa) {
  BenchRun run;
  run.blocked = blocked;
  run.source_gauge_pa = source_gauge_pa;
  std::vector<double> times;
  for (int i = 1; i <= 4000; ++i) times.push_back(0.002 * i);
  StrokeTimes strokes;
  const double operating_pa = rig.ambient_pa + rig.operating_gauge_pa;
  if (rig.supply != BenchSupply::kNone) {
    run.schedule = {{0.0, 1}};
    const EffectResult rise = SimulateEffects(Plant(rig, run, kAsDeclared), times, 0.002);
    const double highest_pa = *std::max_element(rise.pressure_pa.begin(), rise.pressure_pa.end());
    const double reached_pa = std::lerp(rig.ambient_pa, highest_pa, 0.97);
    strokes.rise_s = Crossing(rise, std::min(operating_pa, reached_pa), 1.0);
  }
  run.schedule = {{0.0, -1}};
  run.initial_gauge_pa = rig.operating_gauge_pa;
  const EffectResult fall = SimulateEffects(Plant(rig, run, kAsDeclared), times, 0.002);
  strokes.fall_s = Crossing(fall, rig.ambient_pa + 0.05 * rig.operating_gauge_pa, -1.0);
  return strokes;
}

BenchRig DrawRig(BenchSupply supply, Random& random) {
  BenchRig rig;
  rig.supply = supply;
  rig.rest_volume_m3 = Digits3(random.LogUniform(10e-6, 200e-6));
  rig.expansion_ratio = Digits3(random.Uniform(1.2, 2.5));
  rig.operating_gauge_pa = Digits3(random.Uniform(40e3, 200e3));
  rig.ambient_pa = Digits3(random.Uniform(95e3, 103e3));
  rig.ambient_k = random.Coin() ? 293.15 : std::round(random.Uniform(288.0, 303.0) * 10.0) / 10.0;
  const double rise_s = random.LogUniform(0.15, 1.5);
  const double source_pa = rig.ambient_pa + 2.0 * rig.operating_gauge_pa;
  rig.fill.conductance = Digits3(Content(rig) / (1e5 * 0.85 * source_pa * rise_s));
  rig.fill.critical_ratio = Digits3(random.Uniform(0.15, 0.5));
  rig.exhaust = rig.fill;
  rig.one_pair = random.Coin();
  if (!rig.one_pair) {
    rig.exhaust.conductance = Digits3(rig.fill.conductance * random.Uniform(0.8, 1.6));
    rig.exhaust.critical_ratio = Digits3(random.Uniform(0.15, 0.5));
  }
  if (random.Coin(0.35)) {
    LineDynamics tube;
    tube.length_m = Digits3(random.Uniform(0.2, 1.5));
    for (const double bore_mm : {1.2, 1.6, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
      tube.inner_diameter_m = bore_mm * 1e-3;
      if (TubeAsElement(tube).conductance > 1.2 * rig.fill.conductance) break;
    }
    rig.tube = tube;
  }
  if (supply == BenchSupply::kCompressor) AddDelivery(rig, source_pa, rise_s, random);
  return rig;
}

namespace {

std::vector<BenchRun> DrawRuns(const BenchRig& rig, int fitted, Random& random) {
  const int levels = random.Integer(2, 4);
  const double low = random.Uniform(1.25, 1.5), high = random.Uniform(2.2, 3.0);
  const bool some_blocked = random.Coin(0.85);
  const double interior = random.Uniform(0.3, 0.7);
  std::vector<BenchRun> runs;
  for (int i = 0; i <= fitted; ++i) {
    const bool held_out = i == fitted;
    BenchRun run;
    run.id = "r" + std::to_string(i + 1);
    run.blocked = !held_out && some_blocked && (i == 2 || (i > 3 && random.Coin(0.3)));
    // Levels are spread evenly; the run held out lies between the lowest two.
    const double share = held_out ? interior / (levels - 1) : (i % levels) / (levels - 1.0);
    run.source_gauge_pa = Digits3(rig.operating_gauge_pa * std::lerp(low, high, share));
    if (rig.supply == BenchSupply::kNone) {
      run.initial_gauge_pa = Digits3(rig.operating_gauge_pa * std::lerp(0.5, 1.05, share));
      WriteEmptying(run, TimesOf(rig, run.blocked, 0.0), random);
    } else {
      const StrokeTimes stroke = TimesOf(rig, run.blocked, run.source_gauge_pa);
      const auto any = static_cast<Programme>(random.Integer(0, 2));
      const Programme programme = i == 0 || i == 2 ? Programme::kStep
                                  : i == 1         ? Programme::kCycles
                                                   : any;
      WriteSchedule(run, programme, stroke, random);
      if (rig.supply == BenchSupply::kMeasured) {
        run.source_course =
            DrawCourse(run, rig.ambient_pa + run.source_gauge_pa, stroke.rise_s, random);
      }
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace

std::vector<BenchRun> DrawRuns(const BenchRig& rig, Random& random) {
  std::vector<BenchRun> runs = DrawRuns(rig, random.Integer(4, 7), random);
  DrawSampleTimes(runs, random);
  return runs;
}

std::vector<BenchRun> DrawFiveRuns(const BenchRig& rig, Random& random) {
  std::vector<BenchRun> runs = DrawRuns(rig, 5, random);
  for (BenchRun& run : runs)
    for (int i = 0; i < 1000; ++i) run.t_s.push_back(run.end_s * i / 999.0);
  return runs;
}

std::vector<BenchRun> DrawNarrowRuns(const BenchRig& rig, Random& random) {
  BenchRun run;
  run.blocked = random.Coin(0.2);
  run.source_gauge_pa = Digits3(rig.operating_gauge_pa * random.Uniform(1.25, 3.0));
  if (rig.supply == BenchSupply::kNone) {
    run.initial_gauge_pa = Digits3(rig.operating_gauge_pa * random.Uniform(0.5, 1.05));
    WriteNarrowEmptying(run, TimesOf(rig, run.blocked, 0.0), random);
  } else {
    WriteNarrow(run, TimesOf(rig, run.blocked, run.source_gauge_pa), random);
  }
  std::vector<BenchRun> runs;
  for (int i = random.Integer(1, 2); i >= 0; --i) {
    runs.push_back(run);
    runs.back().id = "r" + std::to_string(runs.size());
    if (rig.supply != BenchSupply::kMeasured) continue;
    runs.back().source_course =
        DrawCourse(run, rig.ambient_pa + run.source_gauge_pa,
                   TimesOf(rig, run.blocked, run.source_gauge_pa).rise_s, random);
  }
  SampleEvery(run.end_s / random.LogUniform(40.0, 600.0), runs, random);
  return runs;
}

}  // namespace plenum::test
