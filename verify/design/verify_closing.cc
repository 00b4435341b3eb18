#include "verify/design/verify_closing.h"

#include <algorithm>
#include <cmath>

#include "model/flow/series.h"
#include "model/flow/tube.h"
#include "model/strokes/stroke.h"

namespace plenum::verify {
namespace {

constexpr int kHalvings = 60;

bool ClosesLate(Configuration configuration, const LineParts& line) {
  return model::Holds(line.valve->kind) && line.valve->closing_scatter_s > 0.0 &&
         !IsDirect(configuration);
}

// The line that fills fastest of those that tolerances allow.
class Fastest {
 public:
  Fastest(const Problem& problem, Configuration configuration, int g, const LineParts& line)
      : group_(problem.groups[g]),
        chamber_(group_.least ? *group_.least : group_.chamber),
        temperature_k_(problem.ambient.temperature_k) {
    const double bore_m = line.tube->inner_diameter_m;
    chamber_.dead_volume_m3 += model::BoreVolume(bore_m, group_.tube_length_m);
    std::vector<model::FlowElement> crossed{line.valve->fill_most.value_or(line.valve->fill)};
    for (int i = 0; i <= group_.fittings_per_line; ++i) {
      if (i == (group_.fittings_per_line + 1) / 2)
        crossed.push_back(model::TubeElement(bore_m, group_.tube_length_m));
      if (i < group_.fittings_per_line)
        crossed.push_back(line.fitting->flow_most.value_or(line.fitting->flow));
    }
    if (Evacuated(problem)) std::reverse(crossed.begin(), crossed.end());
    const model::Gas gas =
        configuration == Configuration::kCo2 ? model::Gas::kCo2 : model::Gas::kAir;
    fill_ =
        model::MakeSeries(crossed, model::FlowFactor(gas) *
                                       std::sqrt(model::kReferenceTemperatureK / temperature_k_));
  }

  double Seconds(double source_pa, double to_pa) const {
    return model::FillTime(fill_, chamber_, source_pa, group_.chamber.operating_pressure_pa, to_pa,
                           temperature_k_);
  }

 private:
  const ActuatorGroup& group_;
  model::Chamber chamber_;
  double temperature_k_;
  model::Series fill_;
};

// Where a condition that holds at `low` and not at `high` changes: the end where it holds.
template <typename Condition>
double LastWhere(const Condition& condition, double low, double high) {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (condition(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace

double PeakPa(const Problem& problem, Configuration configuration, int g, const LineParts& line,
              double source_pa) {
  const double operating_pa = problem.groups[g].chamber.operating_pressure_pa;
  if (!model::Holds(line.valve->kind)) return source_pa;
  if (!ClosesLate(configuration, line) || source_pa <= operating_pa) return operating_pa;
  const Fastest fastest(problem, configuration, g, line);
  const auto reached = [&](double pa) {
    return fastest.Seconds(source_pa, pa) <= line.valve->closing_scatter_s;
  };
  return reached(source_pa) ? source_pa : LastWhere(reached, operating_pa, source_pa);
}

double MostForPeakPa(const Problem& problem, Configuration configuration, int g,
                     const LineParts& line, double most_pa) {
  const double limit_pa = problem.groups[g].pressure_max_pa;
  if (!ClosesLate(configuration, line) || most_pa <= limit_pa) return most_pa;
  const Fastest fastest(problem, configuration, g, line);
  const auto kept = [&](double pa) {
    return fastest.Seconds(pa, limit_pa) >= line.valve->closing_scatter_s;
  };
  return kept(most_pa) ? most_pa : LastWhere(kept, limit_pa, most_pa);
}

}  // namespace plenum::verify
