#include "calibration/learn/slips.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "calibration/learn/slip_kinds.h"

namespace plenum::calibration {
namespace {

constexpr double kTolerance = 1e-3;  // of the simulations
constexpr std::size_t kStepsMax = 20'000;
constexpr std::size_t kExchangedAmong = 12;  // runs that are astray
constexpr double kNearer = 0.5;
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr int kIterations = 20;
constexpr double kNearlyNoise = 0.1;  // above it, in units of its variance

// Σ(m − y)², and Σ(m² + y²) of both gauge.
struct Mismatch {
  double apart = 0.0, size = 0.0;
  double E() const { return size > 0.0 ? apart / size : 0.0; }
  // What is left of the mismatch before a slip was undone: of E and, unless that gave the readings
  // another unit, of Σ(m − y)² too, as pressures near vacuum are all large and alike in gauge.
  double LeftOf(const Mismatch& before, bool another_unit) const {
    const double of_e = Share(E(), before.E());
    return another_unit ? of_e : std::max(of_e, Share(apart, before.apart));
  }
  static double Share(double now, double then) { return then > 0.0 ? now / then : kNever; }
};

Mismatch MismatchOf(const Run& run, const std::vector<double>& model_pa) {
  const double ambient_pa = run.ambient.pressure_pa;
  double apart = 0.0, size = 0.0;
  for (std::size_t i = 0; i < model_pa.size(); ++i) {
    if (std::isnan(run.pressure_pa[i])) continue;
    apart += std::pow(model_pa[i] - run.pressure_pa[i], 2);
    size += std::pow(model_pa[i] - ambient_pa, 2) + std::pow(run.pressure_pa[i] - ambient_pa, 2);
  }
  return {apart, size};
}

// Of every run; infinite where it cannot be simulated.
std::vector<Mismatch> Mismatches(const Dataset& dataset, const std::function<bool()>& cancelled) {
  const ForwardModel forward(dataset);
  const ModelState declared = forward.Declared();
  PredictOptions options;
  options.relative_tolerance = kTolerance;
  options.steps_max = kStepsMax;
  options.cancelled = cancelled;
  std::vector<Mismatch> mismatches(dataset.runs.size(), Mismatch{kNever, 1.0});
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    const Prediction prediction = forward.Predict(i, declared, {}, options);
    if (prediction.status == model::SimulateStatus::kDone)
      mismatches[i] = MismatchOf(dataset.runs[i], prediction.reading.pressure_pa);
  }
  return mismatches;
}

// The same of a record with a slip undone; infinite where pressures would be below vacuum.
std::vector<Mismatch> MismatchesUndone(const Dataset& undone,
                                       const std::function<bool()>& cancelled) {
  std::vector<Mismatch> mismatches = Mismatches(undone, cancelled);
  for (std::size_t i = 0; i < mismatches.size(); ++i)
    if (!IsPossible(undone.runs[i])) mismatches[i] = {kNever, 1.0};
  return mismatches;
}

std::string Names(const Dataset& astray, const std::vector<std::size_t>& some) {
  std::string text = some.size() == 1 ? "run " : "runs ";
  for (std::size_t k = 0; k < some.size(); ++k)
    text += (k == 0 ? "" : k + 1 < some.size() ? ", " : " and ") + astray.runs[some[k]].id;
  return text;
}

// Ids as an assumption names them: ":r1,r3".
std::string Ids(const Dataset& astray, const std::vector<std::size_t>& some) {
  std::string text;
  for (const std::size_t run : some) text += (text.empty() ? ":" : ",") + astray.runs[run].id;
  return text;
}

SuspectedSlip OfAll(const SlipKind& kind) {
  return {std::string("the runs fit the declared model far better if ") + kind.what +
              ": check the record",
          kind.name};
}

SuspectedSlip OfSome(const SlipKind& kind, const Dataset& astray,
                     const std::vector<std::size_t>& runs) {
  return {Names(astray, runs) + (runs.size() == 1 ? " fits" : " fit") +
              " the declared model far better if " + kind.what + ": check the record",
          kind.name + Ids(astray, runs)};
}

SuspectedSlip OfPair(const ExchangeKind& kind, const Run& a, const Run& b) {
  return {"runs " + a.id + " and " + b.id + " fit the declared model far better with their " +
              kind.what + " exchanged: check the record",
          std::string(kind.name) + ":" + a.id + "," + b.id};
}

// Whether the slip undone brings every run nearer, those too that are not astray.
bool BringsAllNearer(const SlipKind& kind, Dataset record, const std::vector<Mismatch>& before,
                     const std::function<bool()>& cancelled) {
  for (Run& run : record.runs) kind.undo(run);
  const std::vector<Mismatch> after = MismatchesUndone(record, cancelled);
  for (std::size_t i = 0; i < after.size(); ++i)
    if (!(after[i].LeftOf(before[i], kind.another_unit) < kNearer)) return false;
  return true;
}

// The slip that undoes most runs, of those the one that leaves least.
std::vector<SuspectedSlip> OfSingleRuns(const Dataset& astray, const std::vector<Mismatch>& before,
                                        const Dataset& record, const std::vector<Mismatch>& all,
                                        const std::function<bool()>& cancelled) {
  const SlipKind* likeliest = nullptr;
  std::vector<std::size_t> most;
  double least = std::numeric_limits<double>::infinity();
  for (const SlipKind& kind : SlipKinds()) {
    // Where times are ms, next to nothing moves, and readings in a larger unit hardly move either:
    // OfTimes() looks at that where no run is astray.
    if (std::string_view(kind.name) == kAllMs) continue;
    Dataset undone = astray;
    for (Run& run : undone.runs) kind.undo(run);
    const std::vector<Mismatch> after = MismatchesUndone(undone, cancelled);
    std::vector<std::size_t> runs;
    double left = 0.0;
    for (std::size_t i = 0; i < after.size(); ++i)
      if (after[i].LeftOf(before[i], kind.another_unit) < kUndone)
        runs.push_back(i), left += after[i].E();
    if (runs.empty() || runs.size() < most.size()) continue;
    if (runs.size() == most.size() && left >= least) continue;
    likeliest = &kind;
    most = std::move(runs);
    least = left;
  }
  if (!likeliest) return {};
  const bool of_all = BringsAllNearer(*likeliest, record, all, cancelled);
  return {of_all ? OfAll(*likeliest) : OfSome(*likeliest, astray, most)};
}

std::vector<SuspectedSlip> OfPairs(const Dataset& astray, const std::vector<Mismatch>& before,
                                   const std::function<bool()>& cancelled) {
  std::vector<SuspectedSlip> slips;
  const ExchangeKind& readings = ExchangeKinds().front();
  const std::size_t count = astray.runs.size();
  for (std::size_t i = 0; i < count && count <= kExchangedAmong; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      Dataset pair = astray;
      pair.runs = {astray.runs[i], astray.runs[j]};
      readings.undo(pair.runs[0], pair.runs[1]);
      const std::vector<Mismatch> after = MismatchesUndone(pair, cancelled);
      if (after[0].LeftOf(before[i], false) < kUndone &&
          after[1].LeftOf(before[j], false) < kUndone)
        slips.push_back(OfPair(readings, astray.runs[i], astray.runs[j]));
    }
  }
  return slips;
}

double MeanInterval(const Run& run) {
  return (run.t_s.back() - run.t_s.front()) /
         std::max(1.0, static_cast<double>(run.t_s.size()) - 1.0);
}

// All times in ms, in every run.
std::vector<SuspectedSlip> OfTimes(const Dataset& record, const std::vector<Mismatch>& before,
                                   const std::function<bool()>& cancelled) {
  for (std::size_t i = 0; i < before.size(); ++i)
    if (!(before[i].E() > kAstrayInTime) || !std::isfinite(before[i].apart) ||
        MeanInterval(record.runs[i]) < kSlowS)
      return {};
  const auto kinds = SlipKinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [](const SlipKind& one) {
    return std::string_view(one.name) == kAllMs;
  });
  Dataset undone = record;
  for (Run& run : undone.runs) kind->undo(run);
  const std::vector<Mismatch> after = MismatchesUndone(undone, cancelled);
  for (std::size_t i = 0; i < after.size(); ++i)
    if (!(after[i].LeftOf(before[i], false) < kUndone)) return {};
  return {OfAll(*kind)};
}

// A slip, and what undoes it in a record.
struct Undoing {
  SuspectedSlip slip;
  std::function<void(Dataset&)> undo;
  bool another_unit = false;
};

// In all runs, or in two of those that are fitted.
std::vector<Undoing> Undoings(const FitData& data) {
  const std::vector<Run>& record = data.forward->dataset().runs;
  std::vector<Undoing> all;
  for (const SlipKind& kind : SlipKinds())
    all.push_back({OfAll(kind),
                   [&kind](Dataset& dataset) {
                     for (Run& run : dataset.runs) kind.undo(run);
                   },
                   kind.another_unit});
  const std::size_t count = data.runs.size() <= kExchangedAmong ? data.runs.size() : 0;
  for (const ExchangeKind& kind : ExchangeKinds())
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = i + 1; j < count; ++j) {
        const std::size_t a = data.runs[i], b = data.runs[j];
        all.push_back({OfPair(kind, record[a], record[b]), [&kind, a, b](Dataset& dataset) {
                         kind.undo(dataset.runs[a], dataset.runs[b]);
                       }});
      }
  return all;
}

Mismatch Sum(const std::vector<Mismatch>& mismatches, const std::vector<std::size_t>& runs) {
  Mismatch sum;
  for (const std::size_t run : runs) {
    sum.apart += mismatches[run].apart;
    sum.size += mismatches[run].size;
  }
  return sum;
}

// The record with a slip undone, as fits take it.
struct UndoneRecord {
  UndoneRecord(const FitData& data, const Undoing& undoing)
      : dataset([&] {
          Dataset undone = data.forward->dataset();
          undoing.undo(undone);
          return undone;
        }()),
        forward(dataset) {}
  UndoneRecord(const UndoneRecord&) = delete;
  FitData Data(FitData data) const {
    if (observed.empty()) observed = Observe(dataset);
    data.forward = &forward;
    data.observed = &observed;
    return data;
  }
  Dataset dataset;
  ForwardModel forward;
  mutable std::vector<ObservedRun> observed;  // once it is asked for
};

// Variance above that of the noise, in units of it.
double AboveNoise(const Fit& fit) {
  return std::max(0.0, fit.chi2_data / static_cast<double>(fit.rows) - 1.0);
}

}  // namespace

std::vector<SuspectedSlip> SuspectedSlips(const Dataset& dataset,
                                          const std::function<bool()>& cancelled) {
  const std::vector<Mismatch> all = Mismatches(dataset, cancelled);
  Dataset astray = dataset;
  astray.runs.clear();
  std::vector<Mismatch> before;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].E() > kAstray && std::isfinite(all[i].apart))
      astray.runs.push_back(dataset.runs[i]), before.push_back(all[i]);
  if (before.empty()) return OfTimes(dataset, all, cancelled);
  std::vector<SuspectedSlip> slips = OfSingleRuns(astray, before, dataset, all, cancelled);
  return slips.empty() ? OfPairs(astray, before, cancelled) : slips;
}

std::vector<SuspectedSlip> SlipsThatFit(const FitData& data, const Fit& base, const Fit& chosen,
                                        const SearchOptions& options) {
  FitOptions fitting;
  fitting.iterations_max = kIterations;
  fitting.threads = options.threads;
  fitting.cancelled = options.cancelled;
  const auto& cancelled = options.cancelled;
  const Mismatch as_declared = Sum(Mismatches(data.forward->dataset(), cancelled), data.runs);
  double least = kUndone * AboveNoise(base);
  std::optional<Undoing> likeliest;
  for (const Undoing& undoing : Undoings(data)) {
    if (cancelled && cancelled()) return {};
    const UndoneRecord undone(data, undoing);
    // Only of what is nearer as it is declared is a fit worth its time.
    const Mismatch nearer = Sum(MismatchesUndone(undone.dataset, cancelled), data.runs);
    if (!(nearer.LeftOf(as_declared, undoing.another_unit) < kNearer)) continue;
    const Fit fit = FitModel(undone.Data(data), undone.forward.Declared(), fitting);
    if (!fit.Usable() || !(AboveNoise(fit) < least)) continue;
    least = AboveNoise(fit);
    likeliest = undoing;
  }
  if (!likeliest) return {};
  if (least < AboveNoise(chosen)) return {likeliest->slip};
  // Effects beside a slip and effects in its place.
  const UndoneRecord undone(data, *likeliest);
  const SearchResult found = SearchEffects(
      undone.Data(data), options, [](const Fit& fit) { return AboveNoise(fit) < kNearlyNoise; });
  const Fit& beside = found.contenders[found.chosen].fit;
  if (!beside.Usable() || !(AboveNoise(beside) < kUndone * AboveNoise(chosen))) return {};
  return {likeliest->slip};
}

}  // namespace plenum::calibration
