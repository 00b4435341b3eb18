#include "calibration/names/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>

#include "calibration/judge/evidence.h"
#include "calibration/values/parallel.h"
#include "calibration/values/thresholds.h"

namespace plenum::calibration {
namespace {

constexpr std::size_t kRivals = 4, kCompanies = 2, kParts = 4;
constexpr int kIterations = 12;
constexpr double kNoiseShare = 1e-2, kTolerance = 1e-5;
constexpr std::uint64_t kSeed = 20'260'101;
constexpr double kNever = std::numeric_limits<double>::infinity();

// The readings under a change. Where `dataset` is not set they are those of the bench.
struct Changed {
  std::string what;
  double memory = 1.0;
  bool shifted = false;  // by an offset
  std::vector<std::size_t> runs = {};
  std::vector<ObservedRun> observed = {};
  std::unique_ptr<Dataset> dataset = nullptr;
  std::unique_ptr<ForwardModel> forward = nullptr;
};

FitData DataOf(const Bench& bench, const Changed& changed) {
  FitData data = bench.data;
  data.runs = changed.runs;
  if (!changed.observed.empty()) data.observed = &changed.observed;
  if (changed.forward) data.forward = changed.forward.get();
  return data;
}

double RangeOf(const Bench& bench) {
  double low = kNever, high = -kNever;
  for (const std::size_t run : bench.data.runs)
    for (const std::size_t i : bench.observed[run].signals.front().samples) {
      const double reading_pa = bench.dataset.runs[run].pressure_pa[i];
      low = std::min(low, reading_pa), high = std::max(high, reading_pa);
    }
  return std::max(0.0, high - low);
}

// With other readings: `change(run, reading)` of every one. A start that was read is read again.
template <class Change>
Changed WithReadings(const Bench& bench, const std::string& what, double memory,
                     const Change& change) {
  Changed changed{.what = what, .memory = memory, .runs = bench.data.runs};
  changed.dataset = std::make_unique<Dataset>(bench.dataset);
  for (const std::size_t index : bench.data.runs) {
    Run& run = changed.dataset->runs[index];
    const double first_pa = run.pressure_pa.front();
    for (double& reading_pa : run.pressure_pa) reading_pa = change(index, reading_pa);
    if (run.initial_pressure_pa == first_pa && first_pa != run.ambient.pressure_pa)
      run.initial_pressure_pa = run.pressure_pa.front();
  }
  changed.forward = std::make_unique<ForwardModel>(*changed.dataset);
  return changed;
}

Changed WithNoise(const Bench& bench, double memory) {
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal;
  return WithReadings(bench, "noise of its own size", memory,
                      [&](std::size_t run, double reading_pa) {
                        const ObservedSignal& signal = bench.observed[run].signals.front();
                        const double quantum_pa = signal.grid.quantum();
                        if (quantum_pa == 0.0) return reading_pa + signal.sigma * normal(random);
                        const double steps = signal.grid.noise() * normal(random) / quantum_pa;
                        return reading_pa + quantum_pa * std::round(steps);
                      });
}

std::vector<Changed> ChangesOf(const Bench& bench, double memory) {
  std::vector<Changed> changes;
  for (const bool even : {true, false}) {
    Changed changed{.what = even ? "even readings" : "odd readings",
                    .memory = std::max(1.0, 0.5 * memory),
                    .runs = bench.data.runs};
    changed.observed = EverySecond(bench.dataset, bench.observed, even ? 0 : 1);
    changes.push_back(std::move(changed));
  }
  for (const std::size_t run : bench.data.runs) {
    if (bench.data.runs.size() < 2u) break;
    Changed changed{
        .what = "without " + bench.dataset.runs[run].id, .memory = memory, .runs = bench.data.runs};
    std::erase(changed.runs, run);
    changes.push_back(std::move(changed));
  }
  const double shift_pa = kShiftShare * RangeOf(bench);
  changes.push_back(WithReadings(bench, "a shift of 0.1 % of the range", memory,
                                 [&](std::size_t, double pa) { return pa + shift_pa; }));
  changes.back().shifted = true;
  changes.push_back(WithNoise(bench, memory));
  return changes;
}

// The sets that are fitted again: the named ones, sets that hold one of them, parts of them, the
// base model among these, and others.
struct Table {
  std::vector<const Contender*> named, companies, parts, rivals;
  std::vector<const Contender*> All() const {
    std::vector<const Contender*> all = named;
    all.insert(all.end(), companies.begin(), companies.end());
    all.insert(all.end(), parts.begin(), parts.end());
    all.insert(all.end(), rivals.begin(), rivals.end());
    return all;
  }
};

Table TableOf(std::span<const Contender> contenders, const std::vector<const Contender*>& named,
              double memory) {
  std::vector<const Contender*> order;
  for (const Contender& contender : contenders)
    if (contender.fit.Usable() && MayBeNamed(contender)) order.push_back(&contender);
  std::stable_sort(order.begin(), order.end(), [&](const Contender* a, const Contender* b) {
    return BicWith(a->fit, memory) < BicWith(b->fit, memory);
  });
  Table table{named, {}, {}, {}};
  const auto any = [](const std::vector<const Contender*>& list, const auto& is) {
    return std::any_of(list.begin(), list.end(), is);
  };
  for (const Contender* one : order) {
    const auto same = [&](const Contender* other) { return SameEffects(*one, *other); };
    if (any(table.All(), same)) continue;
    const bool larger = any(named, [&](const Contender* other) { return Contains(*one, *other); });
    const bool nested = any(named, [&](const Contender* other) { return IsNested(*one, *other); });
    const bool part = any(named, [&](const Contender* other) { return Contains(*other, *one); });
    if (larger && table.companies.size() < kCompanies) table.companies.push_back(one);
    if (part && !larger && table.parts.size() < kParts) table.parts.push_back(one);
    if (!nested && table.rivals.size() < kRivals) table.rivals.push_back(one);
  }
  return table;
}

// Beside a set that has none, an offset of the sensor to begin with none: whether one was added.
bool AddOffset(ModelState& state) {
  const model::EffectSpec* offset = model::FindEffect("sensor_offset");
  const auto has = [&](const model::Effect& effect) { return effect.spec == offset; };
  if (std::any_of(state.effects.begin(), state.effects.end(), has)) return false;
  const auto place =
      std::find_if(state.effects.begin(), state.effects.end(),
                   [&](const model::Effect& effect) { return Precedes(offset, effect.spec); });
  state.effects.insert(place, {offset, {0.0}});
  return true;
}

double BicOf(const Bench& bench, const Changed& changed, const Contender& contender) {
  FitOptions options = bench.tight;
  options.threads = 1;
  options.noise_share = kNoiseShare;
  options.function_tolerance = kTolerance;
  options.iterations_max = kIterations;
  const FitData data = DataOf(bench, changed);
  ModelState start = contender.fit.state;
  const bool with_offset = changed.shifted && AddOffset(start);
  Fit fit;
  if (changed.memory > 1.0) {
    fit = FitWeighed(data, options, changed.memory, contender.fit, start);
  } else {
    fit = FitModel(data, start, options);
    Narrow(data, options, fit);
  }
  if (!fit.Usable()) return kNever;
  const double worth = std::max(1.0, static_cast<double>(fit.rows) / changed.memory);
  return BicWith(fit, changed.memory) - (with_offset ? std::log(worth) : 0.0);
}

}  // namespace

bool Stability::Holds() const {
  return std::all_of(changes.begin(), changes.end(),
                     [](const StabilityChange& change) { return change.holds; });
}

Stability StabilityOf(const Bench& bench, std::span<const Contender> contenders,
                      const std::vector<const Contender*>& named, double memory) {
  const Table table = TableOf(contenders, named, memory);
  const std::vector<const Contender*> all = table.All();
  const std::vector<Changed> changes = ChangesOf(bench, memory);
  std::vector<double> bic(changes.size() * all.size(), kNever);
  ForAll(bic.size(), bench.tight.threads, [&](std::size_t i) {
    if (!Stopped(bench)) bic[i] = BicOf(bench, changes[i / all.size()], *all[i % all.size()]);
  });
  Stability stability;
  for (std::size_t c = 0; c < changes.size() && !Stopped(bench); ++c) {
    const auto row = bic.begin() + static_cast<std::ptrdiff_t>(c * all.size());
    const auto rivals = row + static_cast<std::ptrdiff_t>(all.size() - table.rivals.size());
    const auto row_end = row + static_cast<std::ptrdiff_t>(all.size());
    const double own = *std::min_element(row, rivals);
    StabilityChange change{changes[c].what, {}, std::isfinite(own)};
    if (const auto best = std::min_element(rivals, row_end);
        best != row_end && std::isfinite(*best) && std::isfinite(own)) {
      change.delta_bic = *best - own;
      change.holds = *change.delta_bic >= -kTie;
      if (!change.holds)
        stability.beaten_by.push_back(table.rivals[static_cast<std::size_t>(best - rivals)]);
    }
    stability.changes.push_back(std::move(change));
  }
  return stability;
}

}  // namespace plenum::calibration
