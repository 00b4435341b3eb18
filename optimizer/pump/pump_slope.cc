#include "optimizer/pump/pump_slope.h"

#include <algorithm>
#include <array>

namespace plenum::optimizer {
namespace {

constexpr int kLooks = 32;  // cells between two points of the tables

// The points of both tables in between, and both ends.
std::vector<double> Knots(const model::CompressorCurve& curve, double low_pa, double high_pa) {
  std::vector<double> knots{low_pa, high_pa};
  for (const model::MonotoneCurve* table : {&curve.free_air_m3_per_s, &curve.current_a})
    for (double knot : table->x())
      if (knot > low_pa && knot < high_pa) knots.push_back(knot);
  std::sort(knots.begin(), knots.end());
  return knots;
}

// Range of the slope of a table within one of its pieces: that of a cubic is a parabola, which its
// Bézier points enclose. Outside the table the end value holds.
struct Slopes {
  double least = 0.0, most = 0.0;
};
Slopes SlopesOf(const model::MonotoneCurve& table, double from, double to) {
  if (table.empty() || from >= table.back() || to <= table.front()) return {};
  const double left = table.Slope(from), right = table.Slope(to);
  const double middle = 3.0 * (table(to) - table(from)) / (to - from) - left - right;
  return {std::min({left, middle, right}), std::max({left, middle, right})};
}

// Bézier points of a piece of a table; outside of it the end value holds.
std::array<double, 4> PiecePoints(const model::MonotoneCurve& table, double from, double to) {
  const double low = table(std::clamp(from, table.front(), table.back()));
  const double high = table(std::clamp(to, table.front(), table.back()));
  if (from >= table.back() || to <= table.front()) return {low, low, low, low};
  const double third = (to - from) / 3.0;
  return {low, low + third * table.Slope(from), high - third * table.Slope(to), high};
}

// Of a'·b − a·b', a and b cubics.
std::array<double, 6> Bend(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  constexpr double kTwo[] = {1.0, 2.0, 1.0}, kThree[] = {1.0, 3.0, 3.0, 1.0},
                   kFive[] = {1.0, 5.0, 10.0, 10.0, 5.0, 1.0};
  std::array<double, 6> points{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      points[i + j] += kTwo[i] * kThree[j] / kFive[i + j] * 3.0 *
                       ((a[i + 1] - a[i]) * b[j] - (b[i + 1] - b[i]) * a[j]);
  return points;
}

// Whether the polynomial with these Bézier points is nowhere below −`slack`.
bool NowhereBelow(std::array<double, 6> points, double slack, int halvings) {
  if (std::all_of(points.begin(), points.end(), [&](double p) { return p >= -slack; })) return true;
  if (points.front() < -slack || points.back() < -slack || halvings == 0) return false;
  std::array<double, 6> left{};  // de Casteljau's halves: what is left of `points` is the right one
  for (std::size_t i = 0; i < points.size(); ++i) {
    left[i] = points[0];
    for (std::size_t j = 0; j + 1 < points.size() - i; ++j)
      points[j] = 0.5 * (points[j] + points[j + 1]);
  }
  return NowhereBelow(left, slack, halvings - 1) && NowhereBelow(points, slack, halvings - 1);
}

bool RisesBetween(const model::CompressorCurve& curve, double from, double to) {
  constexpr double kSlack = 1e-12;
  constexpr int kHalvings = 40;
  const std::array<double, 4> current = PiecePoints(curve.current_a, from, to);
  const std::array<double, 4> flow = PiecePoints(curve.free_air_m3_per_s, from, to);
  const double scale = *std::max_element(current.begin(), current.end()) *
                       *std::max_element(flow.begin(), flow.end());
  return NowhereBelow(Bend(current, flow), kSlack * scale, kHalvings);
}

// −(P/Q)' = −P'/Q + P·Q'/Q² with Q' ≤ 0, at most: a parabola in 1/Q, which in the cell is between
// its values at the ends.
double EnergyPerAirFall(const model::CompressorCurve& curve, double from, double to,
                        double power_fall) {
  const model::MonotoneCurve& flow = curve.free_air_m3_per_s;
  const double bend =
      std::min(model::ElectricalPower(curve, from), model::ElectricalPower(curve, to)) *
      std::max(0.0, -SlopesOf(flow, from, to).most);
  const double low = 1.0 / flow(std::max(from, flow.front()));
  const double high = 1.0 / std::max(flow(std::max(to, flow.front())), 1e-300);
  const double slowness = bend > 0.0 ? std::clamp(0.5 * power_fall / bend, low, high) : high;
  return slowness * (power_fall - bend * slowness);
}

}  // namespace

// Between the points of a table the interpolation is monotone, so that they and the end decide.
bool PowerRises(const model::CompressorCurve& curve, double low_pa, double high_pa) {
  double before_w = model::ElectricalPower(curve, low_pa);
  const auto rises = [&](double pressure_pa) {
    const double power_w = model::ElectricalPower(curve, pressure_pa);
    const bool ok = power_w >= before_w * (1.0 - 1e-12);
    before_w = power_w;
    return ok;
  };
  for (double knot : curve.current_a.x())
    if (knot > low_pa && knot < high_pa && !rises(knot)) return false;
  return rises(high_pa);
}

// Where power rises so does its share per air, since delivery falls.
bool EnergyPerAirRises(const model::CompressorCurve& curve, double low_pa, double high_pa) {
  if (PowerRises(curve, low_pa, high_pa)) return true;
  const std::vector<double> knots = Knots(curve, low_pa, high_pa);
  for (std::size_t i = 0; i + 1 < knots.size(); ++i)
    if (knots[i] < knots[i + 1] && !RisesBetween(curve, knots[i], knots[i + 1])) return false;
  return true;
}

SteepestFall::SteepestFall(const model::CompressorCurve& curve, double low_pa, double high_pa) {
  if (PowerRises(curve, low_pa, high_pa)) return;
  const bool per_air_rises = EnergyPerAirRises(curve, low_pa, high_pa);
  const std::vector<double> knots = Knots(curve, low_pa, high_pa);
  Cell steepest{low_pa, 0.0, 0.0};
  for (std::size_t i = 0; i + 1 < knots.size(); ++i)
    for (int look = 0; look < kLooks && knots[i] < knots[i + 1]; ++look) {
      const double width = (knots[i + 1] - knots[i]) / kLooks;
      const double from = knots[i] + width * look, to = from + width;
      const Slopes current = SlopesOf(curve.current_a, from, to);
      const double power_fall = std::max(0.0, -curve.voltage_v * current.least);
      steepest.begin_pa = from;
      steepest.power = std::max(steepest.power, power_fall);
      if (!per_air_rises && power_fall > 0.0)
        steepest.energy_per_air =
            std::max(steepest.energy_per_air, EnergyPerAirFall(curve, from, to, power_fall));
      cells_.push_back(steepest);
    }
}

const SteepestFall::Cell* SteepestFall::At(double to_pa) const {
  const auto after =
      std::upper_bound(cells_.begin(), cells_.end(), to_pa,
                       [](double pa, const Cell& cell) { return pa < cell.begin_pa; });
  return after == cells_.begin() ? nullptr : &*(after - 1);
}

double SteepestFall::Power(double to_pa) const {
  const Cell* cell = At(to_pa);
  return cell == nullptr ? 0.0 : cell->power;
}

double SteepestFall::EnergyPerAir(double to_pa) const {
  const Cell* cell = At(to_pa);
  return cell == nullptr ? 0.0 : cell->energy_per_air;
}

}  // namespace plenum::optimizer
