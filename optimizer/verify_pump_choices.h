// The pumps and batteries of a box, as far as bounds need them. Internal to verify*.cc.
#ifndef PLENUM_OPTIMIZER_VERIFY_PUMP_CHOICES_H_
#define PLENUM_OPTIMIZER_VERIFY_PUMP_CHOICES_H_

#include <array>
#include <map>
#include <vector>

#include "optimizer/verify_dominance.h"
#include "optimizer/verify_line.h"

namespace plenum::optimizer {

using SlotAmounts = std::vector<std::vector<ItemAmounts>>;  // per slot and choice

// Batteries of a range by energy.
class Packs {
 public:
  struct Pack {
    double energy_j, objective;
  };
  explicit Packs(std::vector<Pack> packs);
  double Least(double energy_j) const;  // share of the objective; +∞: none has the energy

 private:
  std::vector<Pack> packs_;  // by energy; objective: the least of this and all with more
};

// The best of several pumps over even cells of pressure.
inline constexpr std::size_t kPumpCells = 128;
struct PumpCells {
  std::vector<double> delivery_m3_per_s, energy_j_per_m3;
  double highest_pa = 0.0, duty_max = 0.0, current_a = kUnlimited;
};

class PumpChoices {
 public:
  using Range = std::pair<int, int>;  // of a slot's choices

  PumpChoices(const Problem& problem, const ProofPlan& plan, const SlotAmounts& amounts);

  const PumpCells& CellsIn(Range compressors);
  // Batteries that can drive some pump of the range at all.
  const Packs& PacksIn(Range compressors, Range batteries);

  double PressureOf(std::size_t cell) const;                            // lower end
  double DeliveryAt(const PumpCells& pumps, double pressure_pa) const;  // at least the true one

 private:
  PumpCells CellsOf(const ProofItem& item) const;

  const Problem& problem_;
  const ProofPlan& plan_;
  const SlotAmounts& amounts_;
  int compressor_, battery_;      // slots
  double highest_pa_;             // of any compressor
  std::vector<PumpCells> items_;  // of single choices
  std::map<Range, PumpCells> ranges_;
  std::map<std::array<int, 4>, Packs> packs_;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_VERIFY_PUMP_CHOICES_H_
