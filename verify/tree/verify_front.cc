#include "verify/tree/verify_front.h"

#include "verify/tree/verify_gaps.h"

namespace plenum::verify {
namespace {

// Resolutions that a front may have: of parts off the shelf, of a reservoir's volume made to
// measure, and where that trades against energy.
constexpr double kExact = 1e-6, kMade = 1e-4, kCurve = 1e-2;

double AmountOf(Amount amount, const Totals& totals) {
  switch (amount) {
    case Amount::kMass:
      return totals.mass_kg;
    case Amount::kVolume:
      return totals.volume_m3 * 1e3;
    case Amount::kCost:
      return totals.cost_eur.value_or(kUnlimited);
    case Amount::kEnergy:
      return totals.energy_j / optimizer::kJoulePerWattHour;
  }
  return kUnlimited;
}

bool NoWorse(const Point& a, const Point& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] > b[i] * (1.0 + kTieTolerance)) return false;
  return true;
}

}  // namespace

void CheckFront(const Problem& problem, const Front& front, const Stop& stop, Findings& findings,
                std::vector<NotRechecked>& open) {
  const Answer& answer = front.answer;
  std::vector<Amount> amounts = front.amounts;  // the one that has no resolution first
  for (Amount least : {Amount::kMass, Amount::kEnergy})
    if (const auto found = std::find(amounts.begin(), amounts.end(), least); found != amounts.end())
      std::rotate(amounts.begin(), found, found + 1);
  std::vector<Point> points;
  for (const Design& design : answer.designs) {
    Point point;
    for (Amount amount : amounts) point.push_back(AmountOf(amount, design.totals));
    points.push_back(std::move(point));
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < points.size(); ++j)
      if (i != j && NoWorse(points[j], points[i]))
        findings.push_back({"front", "rank " + std::to_string(i + 1) + " is no better than rank " +
                                         std::to_string(j + 1)});
  const bool energy = std::find(amounts.begin(), amounts.end(), Amount::kEnergy) != amounts.end();
  const bool made = problem.configurations.contains(Configuration::kCompressor);
  const bool curve = energy && (made || problem.configurations.contains(Configuration::kTank) ||
                                problem.configurations.contains(Configuration::kTankAndPump));
  if (front.resolution > (curve ? kCurve : made ? kMade : kExact))
    findings.push_back({"front", "the resolution hides points"});
  const bool whole = answer.status == Status::kOptimal || answer.status == Status::kInfeasible;
  if (whole != front.unexplored.empty() || whole != answer.proof.complete ||
      whole != (front.searches == front.proved) ||
      (answer.status == Status::kInfeasible) != (whole && points.empty()))
    findings.push_back({"status", std::string(Name(answer.status)) + " is not what was proved"});
  if (!whole || !findings.empty()) {
    open.push_back(
        {"combinations that are not listed: only a whole front is looked at for what is missing",
         answer.proof.combinations - answer.designs.size()});
    return;
  }
  std::vector<Point> bettered = points;  // what lies below one of these in an amount betters it
  for (Point& point : bettered)
    for (std::size_t i = 0; i < point.size(); ++i)
      point[i] *= (1.0 - kTieTolerance) * (i > 0 ? 1.0 - front.resolution : 1.0);
  std::sort(bettered.begin(), bettered.end());
  const BigCount count =
      CheckGaps(problem, amounts, points, GapsBetween(bettered, amounts.size()), stop, findings);
  if (count > 0) open.push_back({"combinations that may lie between points", count});
}

}  // namespace plenum::verify
