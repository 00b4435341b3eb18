// Compressors or vacuum pumps: some of one kind. Several of them are another pump.
#include "optimizer/choices/plant/corner_table.h"
#include "optimizer/choices/plant/planter.h"
#include "optimizer/problem/part_tables.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::optimizer {
namespace {

using namespace corner_table;

// Energy, time and current of pumps over the coarse cells of pressure.
struct Pumping {};
void Widen(const Pumping&, CompressorCorner& a, const CompressorCorner& b) {
  for (int i = 0; i < kCoarseCells; ++i) {
    ToLeast(a.pump.energy_j_per_m3[i], b.pump.energy_j_per_m3[i]);
    ToLeast(a.pump.seconds_per_m3[i], b.pump.seconds_per_m3[i]);
    ToLeast(a.pump.current_a[i], b.pump.current_a[i]);
  }
  for (std::size_t g = 0; g < a.pump.holding.size(); ++g) {
    HoldingPump& holding = a.pump.holding[g];
    const HoldingPump& other = b.pump.holding[g];
    ToLeast(holding.power_w, other.power_w);
    for (int i = 0; i < kCoarseCells; ++i)
      ToLeast(holding.beyond_j_per_m3[i], other.beyond_j_per_m3[i]);
  }
}
constexpr std::size_t KeyCount(const Pumping&) { return 2; }
void AddKeys(const Pumping&, const CompressorCorner& c, const auto& add) {
  add(Log(1.0 / c.pump.seconds_per_m3[kCoarseCells / 2]));
  add(0.5 * Log(c.pump.energy_j_per_m3[kCoarseCells / 2]));
}
void SetNumber(const Pumping&, const PartNumbers&, CompressorCorner&) {}

constexpr std::tuple kRows{Mates{&CompressorCorner::voltages}, Pumping{},
                           Ruled{Use::kMore, FieldNamed(kCompressorFields, "duty_max").weight,
                                 &CompressorCorner::duty_max},
                           Ruled{Use::kMore, 1.0, &CompressorCorner::pressure_max_pa}};

// Equal for equal curves.
std::string Bytes(const model::CompressorCurve& curve) {
  std::string bytes;
  const auto add = [&](std::span<const double> values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  };
  add(std::array{curve.voltage_v, curve.pressure_max_pa});
  for (const model::MonotoneCurve* table : {&curve.free_air_m3_per_s, &curve.current_a}) {
    add(table->x());
    add(table->y());
  }
  return bytes;
}

}  // namespace

void Widen(CompressorCorner& a, const CompressorCorner& b) { WidenBy(kRows, a, b); }
std::array<double, 5> SplitKeys(const CompressorCorner& c) {
  return KeysBy<KeyCountOf(kRows)>(kRows, c);
}
void SetNumbers(const PartNumbers& numbers, CompressorCorner& corner) {
  SetNumbersBy(kRows, numbers, corner);
}

int Planter::PlantPumps(Family family, BoxTree<CompressorCorner>& tree) {
  const std::vector<model::Compressor>& parts = PumpsIn(problem_.parts, family);
  // Of the vacuum beside a source the image of no pressure at all.
  const double highest_pa = family == PumpFamily(plan_->configuration)
                                ? plan_->highest_pump_pa
                                : 2.0 * problem_.ambient.pressure_pa;
  const int most = problem_.limits.compressors;
  for (const model::Compressor& part : parts) voltages_.Bit(part.curve.voltage_v);
  CoarsePump alone;                                // one of the part that is planted
  std::unordered_map<std::string, int> number_of;  // of a curve
  int curve_number = 0;
  const auto rule = [&](int i, int quantity, const Entry<CompressorCorner>& entry) {
    const model::CompressorCurve& curve = parts[i].curve;
    CompressorCorner& corner = entry.item.corner;
    // Where there is not enough compressed air no battery helps.
    corner.voltages =
        AirSuffices(problem_, parts[i], quantity) ? voltages_.Bit(curve.voltage_v) : Kinds{0};
    corner.pressure_max_pa = model::HighestPressure(curve);
    corner.duty_max = parts[i].duty_max;
    if (quantity == 1) {
      alone = MakeCoarsePump(problem_, highest_pa, curve);
      curve_number =
          number_of.try_emplace(Bytes(curve), static_cast<int>(number_of.size())).first->second;
    }
    corner.pump = Several(alone, quantity);
    entry.contender.mates = curve_number * most + quantity - 1;
  };
  return PlantSlot(family, -1, ChoicesOf(family), MakeSourceEntries<CompressorCorner>(family, rule),
                   tree);
}

}  // namespace plenum::optimizer
