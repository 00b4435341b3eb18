#include "calibration/judge/independence.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>

#include "calibration/noise/phases.h"
#include "calibration/noise/whiteness.h"

namespace plenum::calibration {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

// A function of one input along one run; zero where it does not apply.
struct Function {
  std::string input;
  std::string name;  // the same function in another run has the same name
  std::vector<double> values;
};

// Ranks of the finite values spread over −1 to 1, ties at their mean; NaN elsewhere.
std::vector<double> Ranks(const std::vector<double>& u) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < u.size(); ++i)
    if (std::isfinite(u[i])) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return u[a] < u[b]; });
  std::vector<double> ranks(u.size(), kMissing);
  const double count = static_cast<double>(order.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i + 1;
    while (end < order.size() && u[order[end]] == u[order[i]]) ++end;
    const double rank = 0.5 * static_cast<double>(i + end) / count;  // 0 to 1
    for (; i < end; ++i) ranks[order[i]] = 2.0 * rank - 1.0;
  }
  return ranks;
}

double Legendre(int degree, double x) {
  switch (degree) {
    case 1:
      return x;
    case 2:
      return 0.5 * (3.0 * x * x - 1.0);
    default:
      return 0.5 * x * (5.0 * x * x - 3.0);
  }
}

// Legendre polynomials of the input's rank among the samples where it is finite.
void AddPolynomials(const std::string& input, const std::string& where, int degrees,
                    const std::vector<double>& u, std::vector<Function>& functions) {
  const std::vector<double> ranks = Ranks(u);
  for (int degree = 1; degree <= degrees; ++degree) {
    Function function{input, where + std::to_string(degree), std::vector<double>(u.size(), 0.0)};
    for (std::size_t i = 0; i < u.size(); ++i)
      if (std::isfinite(ranks[i])) function.values[i] = Legendre(degree, ranks[i]);
    functions.push_back(std::move(function));
  }
}

std::vector<double> Rates(const std::vector<double>& t_s, const std::vector<double>& y) {
  std::vector<double> rates(y.size(), kMissing);
  for (std::size_t i = 1; i + 1 < y.size(); ++i)
    if (t_s[i + 1] > t_s[i - 1]) rates[i] = (y[i + 1] - y[i - 1]) / (t_s[i + 1] - t_s[i - 1]);
  return rates;
}

std::vector<Function> FunctionsOf(const Run& run, const std::vector<double>& model_pa) {
  const std::vector<PhaseSpan> phases = PhasesOf(run);
  const std::size_t count = run.t_s.size();
  std::vector<Function> functions = {{"mean", "", std::vector<double>(count, 1.0)}};
  AddPolynomials("pressure", "", 3, model_pa, functions);
  AddPolynomials("rate", "", 3, Rates(run.t_s, model_pa), functions);
  AddPolynomials("time", "", 3, run.t_s, functions);
  std::vector<double> cycles(count);
  for (const Phase phase : {Phase::kRest, Phase::kRise, Phase::kHold, Phase::kFall}) {
    Function indicator{"valve", Name(phase), std::vector<double>(count, 0.0)};
    std::vector<double> since(count, kMissing);
    bool seen = false;
    for (std::size_t i = 0; i < count; ++i) {
      const PhaseSpan& span = phases[PhaseAt(phases, run.t_s[i])];
      cycles[i] = span.cycle;
      if (span.phase != phase) continue;
      seen = true;
      indicator.values[i] = 1.0;
      since[i] = run.t_s[i] - span.start_s;
    }
    if (!seen) continue;
    functions.push_back(std::move(indicator));
    AddPolynomials("since_command", Name(phase), 2, since, functions);
  }
  if (phases.back().cycle == 0) return functions;
  AddPolynomials("cycle", "", 1, cycles, functions);
  Function first{"cycle", "first", std::vector<double>(count, 0.0)};
  for (std::size_t i = 0; i < count; ++i) first.values[i] = cycles[i] == 0.0 ? 1.0 : 0.0;
  functions.push_back(std::move(first));
  return functions;
}

struct Sums {
  double product = 0.0, square = 0.0;
};

}  // namespace

Independence TestIndependence(const std::vector<ResidualSeries>& series,
                              const std::function<bool()>& cancelled) {
  std::map<std::pair<std::string, std::string>, Sums> sums;
  double squares = 0.0, count = 0.0;
  for (const ResidualSeries& one : series) {
    if (one.residual.empty()) continue;
    const Run& run = *one.run;
    const std::vector<double> e = Whitened(run.t_s, one.residual, one.memory);
    for (const double value : e) {
      if (!std::isfinite(value)) continue;
      squares += value * value;
      count += 1.0;
    }
    if (cancelled && cancelled()) return {};
    for (Function& function : FunctionsOf(run, one.model_pa)) {
      if (cancelled && cancelled()) return {};
      for (std::size_t i = 0; i < e.size(); ++i)
        if (!std::isfinite(e[i])) function.values[i] = kMissing;
      const std::vector<double> u = Whitened(run.t_s, function.values, one.memory);
      Sums& sum = sums[{function.input, function.name}];
      for (std::size_t i = 0; i < e.size(); ++i) {
        if (!std::isfinite(e[i])) continue;
        sum.product += u[i] * e[i];
        sum.square += u[i] * u[i];
      }
    }
  }
  Independence result;
  std::map<std::string, double> largest;
  int tested = 0;
  for (const auto& [key, sum] : sums) {
    if (!(sum.square > 0.0) || !(squares > 0.0)) continue;
    ++tested;
    const double statistic = std::abs(sum.product) / std::sqrt(sum.square * squares / count);
    largest[key.first] = std::max(largest[key.first], statistic);
  }
  for (const auto& [input, statistic] : largest) result.inputs.push_back({input, statistic});
  std::sort(result.inputs.begin(), result.inputs.end(),
            [](const auto& a, const auto& b) { return a.statistic > b.statistic; });
  if (!result.inputs.empty()) result.statistic = result.inputs.front().statistic;
  result.limit = boost::math::quantile(
      boost::math::complement(boost::math::normal(), kFalseAlarm / (2.0 * std::max(tested, 1))));
  return result;
}

}  // namespace plenum::calibration
