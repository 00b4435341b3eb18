#include "verify/corner/verify_known_strokes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "model/strokes/stroke.h"
#include "verify/corner/verify_node.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/verify_finding.h"

namespace plenum::verify {
namespace {

constexpr double kSlack = 1.0 + kSumTolerance;
constexpr int kBoxesMax = 100'000;

// Another group of the source needs more than the limit of this one.
bool MayConflict(const Problem& problem, int g) {
  return std::any_of(problem.groups.begin(), problem.groups.end(), [&](const ActuatorGroup& other) {
    return other.chamber.operating_pressure_pa > problem.groups[g].pressure_max_pa;
  });
}

}  // namespace

KnownStrokes::KnownStrokes(const Problem& problem, const ProofPlan& plan)
    : problem_(problem), plan_(plan) {
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    slots_.push_back({SlotOf(plan, Family::kTubing, g), SlotOf(plan, Family::kFitting, g),
                      SlotOf(plan, Family::kValve, g)});
  if (IsPumped(plan.configuration)) pumps_.emplace(problem, plan);
}

const BestLine& KnownStrokes::Line(const Ranges& ranges, int g) {
  const auto& [tubing, fitting, valve] = slots_[g];
  const auto &tubes = ranges[tubing], &fittings = ranges[fitting], &valves = ranges[valve];
  const auto [entry, fresh] = lines_.try_emplace(
      {g, tubes.first, tubes.second, fittings.first, fittings.second, valves.first, valves.second});
  if (!fresh) return entry->second;
  BestLine& line = entry->second = BestOf(problem_, plan_, ranges, g);
  if (plan_.own_regulators) return line;  // nothing of it is another group's
  line.source_high_pa = std::min(line.source_high_pa, HighestSource(g));
  if (line.works && AllAtOnce(problem_)) line.least_means = LeastMeans(problem_, g, line);
  return line;
}

// Halves of the ranges of a group's slots, those first that may have the highest.
double KnownStrokes::HighestSource(int g) {
  const auto [known, fresh] = highest_source_pa_.try_emplace(g, kUnlimited);
  if (!fresh || IsDirect(plan_.configuration) || !MayConflict(problem_, g)) return known->second;
  const std::array<int, 3> slots{SlotOf(plan_, Family::kTubing, g),
                                 SlotOf(plan_, Family::kFitting, g),
                                 SlotOf(plan_, Family::kValve, g)};
  std::multimap<double, Ranges, std::greater<>> open;
  const auto look = [&](Ranges ranges) {
    const BestLine line = BestOf(problem_, plan_, ranges, g);
    if (line.mates && line.works) open.emplace(line.source_high_pa, std::move(ranges));
  };
  Ranges all;
  for (const ProofSlot& slot : plan_.slots)
    all.emplace_back(0, static_cast<int>(slot.choices.size()));
  look(std::move(all));
  for (int boxes = 0; !open.empty() && boxes < kBoxesMax; ++boxes) {
    const double source_pa = open.begin()->first;
    const Ranges most = std::move(open.begin()->second);
    open.erase(open.begin());
    const auto size = [&](int s) { return most[s].second - most[s].first; };
    const int widest = *std::max_element(slots.begin(), slots.end(),
                                         [&](int a, int b) { return size(a) < size(b); });
    if (size(widest) == 1) return known->second = source_pa;
    const int middle = most[widest].first + size(widest) / 2;
    for (const bool upper : {false, true}) {
      Ranges half = most;
      (upper ? half[widest].first : half[widest].second) = middle;
      look(std::move(half));
    }
  }
  return known->second = open.empty() ? 0.0 : open.begin()->first;
}

bool KnownStrokes::IsTooSlow(const Query& query, double start_pa) const {
  const auto& [line, pumps, g, v] = query;
  const double ambient_pa = problem_.ambient.pressure_pa;
  const double temperature_k = problem_.ambient.temperature_k;
  const double target_pa = PressureAt(problem_, g, problem_.rise_fraction);
  const int count = MostAtOnce(problem_, g);
  const double share = static_cast<double>(count) / problem_.groups[g].count;
  double low_pa = ambient_pa, high_pa = start_pa;  // around the lowest pressure of the stroke
  while (high_pa - low_pa > kStartTolerance * high_pa) {
    const double p = 0.5 * (low_pa + high_pa);
    const double held =
        v.low_m3 * (p - start_pa) + share * Drawn(problem_, g, line.widest, std::min(p, target_pa));
    (held < 0.0 ? low_pa : high_pa) = p;
  }
  const double limit_s = std::min(problem_.groups[g].rise_time_max_s, FillWindow(problem_, g));
  const double pumped_m3 = limit_s * pumps_->DeliveryAt(pumps, low_pa);
  if (!line.chamber.evacuated &&
      model::FillTimeFromReservoir(line.series.fill, line.chamber, count, v.high_m3,
                                   start_pa + ContentPerVolume(problem_) * pumped_m3 / v.low_m3,
                                   ambient_pa, target_pa, temperature_k) > limit_s * kSlack)
    return true;
  return !MayFill(problem_, *pumps_, pumps, line, g, v, start_pa, limit_s * kSlack);
}

std::optional<double> KnownStrokes::LeastStartLeaving(const Query& query, double end_pa,
                                                      double low_pa, double high_pa) const {
  const auto missing = [&](double start_pa) {
    return end_pa - kSlack * FastestStroke(problem_, *pumps_, query.pumps, query.line, query.group,
                                           query.volumes, start_pa)
                                 .end_pa;
  };
  double low_missing = missing(low_pa);
  if (low_missing <= 0.0) return low_pa;
  double high_missing = missing(high_pa);
  if (high_missing > 0.0) return std::nullopt;
  const auto narrow = [&](double start_pa) {
    const double here = missing(start_pa);
    (here <= 0.0 ? high_pa : low_pa) = start_pa;
    (here <= 0.0 ? high_missing : low_missing) = here;
  };
  // About a straight line: a little below and above where it crosses; by halves where that fails.
  while (high_pa - low_pa > kStartTolerance * high_pa) {
    const double width_pa = high_pa - low_pa, step_pa = 0.4 * kStartTolerance * high_pa;
    const double crossing_pa = low_pa + width_pa * low_missing / (low_missing - high_missing);
    narrow(std::clamp(crossing_pa - step_pa, low_pa + step_pa, high_pa - step_pa));
    if (high_pa - crossing_pa > step_pa && low_pa < crossing_pa + step_pa)
      narrow(crossing_pa + step_pa);
    if (high_pa - low_pa > 0.5 * width_pa) narrow(0.5 * (low_pa + high_pa));
  }
  return low_pa;
}

KnownStrokes::Starts& KnownStrokes::KnownOf(const Query& query) {
  return known_[{&query.line, &query.pumps, query.volumes.low_m3, query.volumes.high_m3}];
}

bool KnownStrokes::TooSlow(const Query& query, double start_pa) {
  Starts& known = KnownOf(query);
  if (start_pa <= known.too_slow_pa) return true;
  if (start_pa >= known.fast_enough_pa) return false;
  const bool too_slow = IsTooSlow(query, start_pa);
  (too_slow ? known.too_slow_pa : known.fast_enough_pa) = start_pa;
  return too_slow;
}

std::optional<double> KnownStrokes::LeastStart(const Query& query, double low_pa, double high_pa) {
  if (!(low_pa <= high_pa) || TooSlow(query, high_pa)) return std::nullopt;
  if (!TooSlow(query, low_pa)) return low_pa;
  const Starts& known = KnownOf(query);
  low_pa = std::max(low_pa, known.too_slow_pa);
  high_pa = std::min(high_pa, known.fast_enough_pa);
  while (high_pa - low_pa > kStartTolerance * high_pa) {
    const double middle_pa = 0.5 * (low_pa + high_pa);
    (TooSlow(query, middle_pa) ? low_pa : high_pa) = middle_pa;
  }
  return low_pa;
}

}  // namespace plenum::verify
